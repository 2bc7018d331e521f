# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Group D: where and when bolus breaks, and what the pieces carry."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import numpy as np  # noqa: E402
from matplotlib import pyplot as plt  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402

from bolus_validation import rheology  # noqa: E402
from bolus_validation.fields import Case  # noqa: E402
from bolus_validation.results import read_table  # noqa: E402
from bolus_validation.specimens import (  # noqa: E402
    GRIPPING,
    SLIDING,
    box,
    compression,
    prepare_compression,
    ramp,
    replace,
    solve,
)
from bolus_validation.studies import Findings, study  # noqa: E402
from bolus_validation.synthetic import (  # noqa: E402
    run as execute,
)
from bolus_validation.synthetic import (
    write_field,
    write_file,
    write_motion_fields,
)

# Onset of the common material
ONSET = 0.25
LAW = rheology.Tabulated(rheology.RATES, rheology.STRESSES)
STICKING = "type contactWall; friction { type noSlip; } separation no;"


def write_each(case: Path, interval: float) -> None:
    """Let a box write its fields at an interval [s]."""
    replace(
        case / "system" / "controlDict",
        r"writeInterval[^;]*;",
        f"writeInterval {interval};",
    )


def monitor_damage(case: Path) -> None:
    """Add the function object damagedVolume to a case."""
    replace(
        case / "system" / "controlDict",
        r"functions\s*\{",
        "functions\n{\ndamagedVolume { type damagedVolume; "
        'libs ("libbolusFunctionObjects.so"); }\n',
    )


def paint(axes, case: Case, time: float, name: str, limits, least=0.1) -> None:
    """A field of the cells with alpha > least, in mm."""
    mesh = case.mesh(time)
    section = mesh.section
    alpha = case.field(time, "alpha")[section.cells]
    values = case.field(time, name)[section.cells]
    cells = PolyCollection(
        [1e3 * polygon for polygon in section.polygons],
        array=np.where(alpha > least, values, np.nan),
        cmap="magma_r",
        edgecolors="face",
        linewidths=0.1,
    )
    cells.set_clim(*limits)
    axes.add_collection(cells)
    axes.set_aspect("equal")
    axes.autoscale()
    axes.set_title(f"{name}, t = {time:g} s", fontsize=8)
    axes.tick_params(labelsize=6)
    axes.figure.colorbar(cells, ax=axes, shrink=0.7)


def onset_time(rate: float, start: float = 0.0) -> float:
    """Exact time [s] when a bar pulled at a Hencky rate [1/s] breaks.

    The plastic strain is total strain less sigma/E, and start before.
    """
    times = np.linspace(0, 0.6 / rate, 60001)
    sigma = rheology.uniaxial_tabulated(LAW, rate, times)
    plastic = start + rate * times - sigma / rheology.E
    return float(np.interp(ONSET, plastic, times))


def pull(
    case: Path,
    rate: float = 0.1,
    step: float = 0.05,
    columns: int = 10,
    weak: float = 0.0,
    strain: float = 0.45,
):
    """A wedge bar of 20 mm pulled by walls that hold on to it.

    weak    plastic strain that the column next to the middle has from the
            start, which breaks first
    Returns the tables of force, damage, and volume.
    """
    options = {
        "strainRate": rate,
        "strain": -strain,
        "unloadStrain": 0,
        "strainStep": step * rate,
        "writeStrain": 0.05,
        "separation": "no",
        "nAxial": columns,
        "nRadial": 36,
    }
    prepare_compression(case, material="viscoplasticDamage", **options)
    monitor_damage(case)
    if weak:
        mesh = Case(case).mesh(0)
        x = mesh.cell_centres[:, 0]
        column = np.floor(x / 0.020 * columns).astype(int)
        write_field(
            case,
            mesh,
            0,
            "epsilonPEq",
            np.where(column == columns // 2, weak, 0.0),
        )
    solve(case)
    return tuple(
        read_table(case, name)
        for name in ("contactForce", "damagedVolume", "freeSurface")
    )


def first(table, name: str, least: float = 0.0) -> float:
    """Time [s] of the first row in which a column is above least."""
    rows = np.flatnonzero(table[name] > least)
    return float(table.time[rows[0]]) if rows.size else np.nan


@study(
    "barInTension",
    "D",
    "A bar in tension breaks",
    "exact uniaxial solution: plastic strain 0.25 at triaxiality 1/3",
)
def bar_in_tension(folder: Path, quick: bool) -> Findings:
    """Onset, where, fall of the force, stress of the parts."""
    found = Findings()
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.5), layout="constrained")
    runs = [(0.1, 0.1)]
    if not quick:
        runs += [(0.1, 0.05), (0.1, 0.025), (1.0, 0.005)]
    for rate, step in runs:
        force, damage, surface = pull(folder / f"bar-{rate}-{step}", rate, step)
        exact = onset_time(rate)
        onset = first(damage, "damaged")
        found.row(
            f"onset, {rate:g}/s, steps of {step:g} s",
            "s",
            onset,
            exact,
            1.001,
            scale=step,
            remark="error in steps",
        )
        strain = rate * force.time
        section = surface["volume"] / (0.020 * np.exp(strain))
        stress = -force["axial"] / section
        axes[0].plot(strain, stress / 1e3, label=f"{rate:g}/s, {step:g} s")
        after = force.time > onset + 0.5 * step
        found.row(
            f"stress one step after onset, of that before, {rate:g}/s, "
            f"steps of {step:g} s",
            "-",
            abs(stress[after][0]) / stress.max(),
            0,
            0.01,
            scale=1,
        )
    axes[0].set(xlabel="strain [-]", ylabel="stress [kPa]")
    axes[0].legend(fontsize=7)

    # Where: a column that has flowed by 0.02 before breaks alone
    weak = 0.02
    step = 0.1 if quick else 0.05
    case = folder / "weak"
    force, damage, surface = pull(
        case, 0.1, step, columns=11, weak=weak, strain=0.40
    )
    exact = onset_time(0.1, weak)
    onset = first(damage, "damaged")
    found.row(
        "onset of the weak column",
        "s",
        onset,
        exact,
        1.001,
        scale=step,
        remark="error in steps",
    )
    broken = damage["damaged"] > 0
    found.row(
        "part of the bolus that breaks, against the weak column's",
        "-",
        damage["fraction"][broken][0],
        1 / 11,
        0.01,
        remark="in the step of onset",
    )
    strain = 0.1 * force.time
    section = surface["volume"] / (0.020 * np.exp(strain))
    stress = -force["axial"] / section
    after = force.time > onset + 0.5 * step
    found.row(
        "damaged part at the end, against the weak column's",
        "-",
        damage["fraction"][-1],
        1 / 11,
        0.1,
        remark="broken bolus that flows into a neighbour must not break it",
    )
    if not quick:
        # The whole bar's elastic strain opens this one column in one step
        found.row(
            "stress one step after its onset, of that before",
            "-",
            abs(stress[after][0]) / stress.max(),
            0,
            0.01,
            scale=1,
            remark="backward Euler leaves 1/(1 + dt/tau) of it, tau = "
            "(zeta + etaDamaged 4/3) L/(h E), the parts' recoil",
        )
    found.row(
        "stress two steps after its onset, of that before",
        "-",
        abs(stress[after][1]) / stress.max(),
        0,
        0.01,
        scale=1,
    )
    axes[1].plot(strain, stress / 1e3)
    axes[1].axvline(0.1 * exact, color="k", ls=":")
    axes[1].set(xlabel="strain [-]", ylabel="stress, weak column [kPa]")
    fields = Case(case)
    end = max(fields.times)
    alpha = fields.field(end, "alpha")
    intact = (alpha > 0.99) & (fields.field(end, "D") < 0.5)
    found.row(
        "mean von Mises stress of the parts, of that before",
        "-",
        fields.field(end, "sigmaEq")[intact].mean() / stress.max(),
        0,
        0.01,
        scale=1,
    )
    mesh = fields.mesh(end)
    pieces = mesh.fragments(intact, (alpha * mesh.cell_volumes))
    large = int((pieces > 0.01 * pieces.sum()).sum())
    found.row("intact fragments", "-", large, 2, 0)
    paint(axes[2], fields, end, "D", (0, 1))
    figure.savefig(folder / "bar.png", dpi=120)
    plt.close(figure)
    found.picture = "bar.png"
    return found


def write_points(path: Path, points) -> None:
    """A plain list of vectors, (n, 3), as boundaryData has it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    rows = "".join(f"({x:.15g} {y:.15g} {z:.15g})\n" for x, y, z in points)
    path.write_text(f"{len(points)}\n(\n{rows})\n")


def shear(case: Path, gamma: float, step: float = 0.05, cells: int = 6):
    """A block that is full of bolus, in homogeneous simple shear at 1/s."""
    mesh = box(
        case,
        (0.010, 0.010),
        (cells, cells),
        {
            "x0": STICKING,
            "x1": STICKING,
            "y0": (STICKING, ramp(gamma, lambda t: (0, 0, 0), 1)),
            "y1": (STICKING, ramp(gamma, lambda t: (0.010 * t, 0, 0), 1)),
        },
        end=gamma,
        step=step,
        material="viscoplasticDamage",
        measured=("y1",),
    )
    # The sides move in proportion to y; box() has no words for that
    path = case / "0" / "pointDisplacement"
    for side, x in (("x0", 0.0), ("x1", 0.010)):
        points = mesh.points[np.isclose(mesh.points[:, 0], x)]
        data = case / "constant" / "boundaryData" / side
        write_points(data / "points", points)
        for time in (0, gamma):
            moved = np.outer(points[:, 1] * time, (1, 0, 0))
            write_points(data / f"{time:g}" / "pointDisplacement", moved)
        replace(
            path,
            side + r" \{ type zeroGradient; \}",
            side + " { type timeVaryingMappedFixedValue; mapMethod nearest; "
            "offset (0 0 0); value uniform (0 0 0); }",
        )
    monitor_damage(case)
    solve(case)


@study(
    "noFracture",
    "D",
    "Nothing breaks in compression or simple shear",
    "triaxiality -1/3 and 0, both below the 0.2 of onset",
)
def no_fracture(folder: Path, quick: bool) -> Findings:
    """A cylinder compressed and a block sheared beyond a strain of 1."""
    found = Findings()
    run = compression(
        folder / "compressed",
        material="viscoplasticDamage",
        strain=1.13,
        unloadStrain=0,
        strainStep=0.02 if quick else 0.01,
        writeStrain=1.13,
        nAxial=10,
        nRadial=24 if quick else 36,
    )
    shear(folder / "sheared", 2.2, 0.1 if quick else 0.05)

    figure, axes = plt.subplots(1, 2, figsize=(9, 3.5), layout="constrained")
    for name, axis, expected in (
        ("compressed", axes[0], -1 / 3),
        ("sheared", axes[1], 0.0),
    ):
        case = Case(folder / name)
        end = max(case.times)
        full = case.field(end, "alpha") > 0.999
        damage = case.field(end, "D")
        strain = case.field(end, "epsilonPEq")[full]
        found.row(f"least plastic strain, {name}", "-", strain.min())
        found.row(
            f"what of it is missing to 1, {name}",
            "-",
            max(1 - strain.min(), 0.0),
            0,
            1e-12,
            scale=1,
        )
        found.row(f"damage, {name}", "-", damage.max(), 0, 1e-12, scale=1)
        found.row(
            f"mean triaxiality, {name}",
            "-",
            case.field(end, "triaxiality")[full].mean(),
            expected,
            0.01,
            scale=1 / 3,
        )
        paint(axis, case, end, "triaxiality", (-0.5, 0.5))
    figure.savefig(folder / "unbroken.png", dpi=120)
    plt.close(figure)
    found.picture = "unbroken.png"
    found.remarks.append(
        f"The cylinder was compressed to {run.strain[-1]:.2f}."
    )
    return found


def fill(case: Path, inside) -> None:
    """Set alpha from inside(x, y) -> bool, by samples in each cell."""
    mesh = Case(case).mesh(0)
    section = mesh.section
    alpha = np.zeros(mesh.n_cells)
    ticks = (np.arange(8) + 0.5) / 8
    u, v = np.meshgrid(ticks, ticks)
    for cell, corners in zip(section.cells, section.polygons, strict=True):
        low, high = corners.min(axis=0), corners.max(axis=0)
        x, y = (low[i] + w * (high[i] - low[i]) for i, w in ((0, u), (1, v)))
        alpha[cell] = np.mean(inside(x, y))
    write_field(case, mesh, 0, "alpha", alpha)


# Notched bar in plane strain, a quarter of it: length and width [m], radius of
# the notch [m], speed of the grip [m/s]
BAR = (0.010, 0.005)
NOTCH = 0.002
GRIP_SPEED = 2e-4

# Over which damage sees the plastic strain, where it has a length [m]
LENGTH = 1e-3


def average_over(case: Path, length: float) -> None:
    """Give damage a length [m] over which it sees the plastic strain."""
    with open(case / "constant" / "bolusProperties", "a") as file:
        file.write(f"damage {{ nonlocalLength {length:g}; }}\n")


def notched(case: Path, cell: float, step: float, end: float, length: float):
    """Pull the notched bar; x = 0 is the plane of the notch."""
    box(
        case,
        (BAR[0], 0.006),
        (round(BAR[0] / cell), round(0.006 / cell)),
        {
            "x0": "symmetryPlane",
            "x1": (GRIPPING, ramp(end, lambda t: (GRIP_SPEED * t, 0, 0), 1)),
            "y0": "symmetryPlane",
            "y1": "open",
        },
        end=end,
        step=step,
        material="viscoplasticDamage",
    )
    average_over(case, length)
    fill(case, lambda x, y: (y < BAR[1]) & (np.hypot(x, y - BAR[1]) > NOTCH))
    write_each(case, end / 12)
    monitor_damage(case)
    solve(case)


def breakage(case: Path, table: str, sign: float) -> dict:
    """What a run to fracture tells: times [s], force [N], parts [-]."""
    force = read_table(case, table, "contactForce")
    damage = read_table(case, "damagedVolume")
    load = sign * force["axial"]
    peak = load.max()
    after = np.flatnonzero((load < 0.05 * peak) & (force.time > 0.3))
    late = after[after > load.argmax()]
    fields = Case(case)
    end = max(fields.times)
    mesh = fields.mesh(end)
    alpha = fields.field(end, "alpha")
    volume = alpha * mesh.cell_volumes
    intact = (alpha > 0.5) & (fields.field(end, "D") < 0.5)
    pieces = mesh.fragments(intact, volume) / volume.sum()
    return {
        "time": force.time,
        "load": load,
        "onset": first(damage, "damaged"),
        "some": first(damage, "damaged", 0.01 * damage["bolus"][0]),
        "peak": peak,
        "parted": force.time[late[0]] if late.size else np.nan,
        "damaged": damage["fraction"][-1],
        "pieces": pieces,
        "written": end,
    }


def convergence(
    found: Findings, runs: dict, reference, variable: str, unit: str
) -> None:
    """Rows of onset, peak, parting, fragments against the finest run.

    runs    {cell size or step: breakage}, coarse to fine
    """
    for size, run in runs.items():
        where = f"{variable} {size * 1e3:g} {unit}"
        if size == reference:
            limits = (None,) * 5
        else:
            limits = (0.05, 0.05, 0.05, 0.05, 0.02)
        best = runs[reference]
        for (name, u, key), limit in zip(
            (
                ("onset", "s", "onset"),
                ("1 % broken", "s", "some"),
                ("largest force", "N", "peak"),
                ("force gone", "s", "parted"),
            ),
            limits,
            strict=False,
        ):
            found.row(
                f"{name}, {where}",
                u,
                run[key],
                best[key],
                limit,
                remark="against the finest",
            )
        largest = run["pieces"][0] if run["pieces"].size else 0.0
        found.row(
            f"largest intact piece, {where}",
            "-",
            largest,
            best["pieces"][0] if best["pieces"].size else 0.0,
            limits[4],
            scale=1,
            remark=f"at {run['written']:.3g} s; "
            f"{(run['pieces'] > 0.01).sum()} pieces above 1 %, "
            f"{(run['pieces'] <= 0.01).sum()} crumbs; damaged "
            f"{100 * run['damaged']:.1f} %",
        )


def notched_bar(folder: Path, quick: bool, length: float) -> Findings:
    """Onset, largest force, parting, and pieces over cell size and step."""
    found = Findings()
    end = 3.0 if quick else 9.0
    compare(
        found,
        folder,
        lambda case, cell, step: notched(case, cell, step, end, length),
        ("forceX1", -1),
        (1e-3, 5e-4) if quick else (5e-4, 2.5e-4, 1.25e-4),
        () if quick else (0.1, 0.05, 0.025),
    )
    return found


@study(
    "notchedBar",
    "D",
    "A notched bar in tension, plane strain: mesh and step dependence",
    "itself on the finest mesh and step: the abrupt local law has no length",
)
def notched_bar_local(folder: Path, quick: bool) -> Findings:
    """The local law, as the paper has it."""
    return notched_bar(folder, quick, 0.0)


@study(
    "notchedBarNonlocal",
    "D",
    "The notched bar, damage by plastic strain averaged over 1 mm",
    "itself on the finest mesh and step",
)
def notched_bar_nonlocal(folder: Path, quick: bool) -> Findings:
    """The law with a length, which has to converge."""
    return notched_bar(folder, quick, LENGTH)


def compare(found, folder: Path, make, load, cells, steps) -> None:
    """Run over cell sizes [m] and time steps [s]; rows and a picture.

    make(case, cell, step) runs; load is (name of the force, its sign)
    """
    figure, axes = plt.subplots(1, 4, figsize=(15, 3.5), layout="constrained")
    # Sizes with the middle step, steps with the middle size
    middle = 0.05, cells[1] if len(cells) > 1 else cells[0]
    done = {}
    for axis, names, sizes in (
        (axes[0], ("cells", "mm"), [(cell, middle[0]) for cell in cells]),
        (axes[1], ("steps", "ms"), [(middle[1], step) for step in steps]),
    ):
        runs = {}
        for cell, step in sizes:
            if (cell, step) not in done:
                case = folder / f"cell-{1e6 * cell:.0f}-step-{1e3 * step:.0f}"
                try:
                    make(case, cell, step)
                except AssertionError:
                    # Told on the page; what was reached still counts
                    found.row(
                        f"run to the end, cells {1e3 * cell:g} mm, "
                        f"steps {1e3 * step:g} ms",
                        "-",
                        0,
                        1,
                        0,
                        remark="no: the solver gave up before",
                    )
                done[cell, step] = breakage(case, *load), case
            size = cell if names[0] == "cells" else step
            runs[size] = run = done[cell, step][0]
            axis.plot(
                run["time"], run["load"], label=f"{1e3 * size:g} {names[1]}"
            )
        if runs:
            convergence(found, runs, sizes[-1][names[0] == "steps"], *names)
            axis.set(xlabel="t [s]", ylabel="force [N]")
            axis.legend(fontsize=7)
    fields = Case(done[cells[-1], middle[0]][1])
    paint(axes[2], fields, max(fields.times), "alpha", (0, 1))
    paint(axes[3], fields, max(fields.times), "D", (0, 1))
    figure.savefig(folder / "broken.png", dpi=120)
    plt.close(figure)
    found.picture = "broken.png"


# Block between opposed punches, a quarter: half width and height of the block,
# half width of the punch, outer ends of the mesh [m]; speed of a punch [m/s]
SPLIT = (0.005, 0.008)
PUNCH = 0.001
OUTER = (0.008, 0.010)
PUNCH_SPEED = 5e-4


def punched(
    case: Path, cell: float, step: float, end: float, length: float
) -> None:
    """Press two punches into a block from above and below; x = 0 splits."""
    down = ramp(end, lambda t: (0, -PUNCH_SPEED * t, 0), 1)
    # Everything but the mesh and what belongs to its patches
    box(
        case,
        OUTER,
        (4, 4),
        {k: "open" for k in ("x0", "x1", "y0", "y1")},
        end=end,
        step=step,
        material="viscoplasticDamage",
        measured=("punch",),
    )
    replace(case / "system" / "controlDict", "forcePUNCH", "forcePunch")
    replace(
        case / "system" / "controlDict",
        r"patches \(punch\);",
        "patches (punch); axis (0 1 0);",
    )
    xs, ys = (0, PUNCH, OUTER[0]), (0, SPLIT[1], OUTER[1])
    number = {
        (i, j, k): n
        for n, (k, j, i) in enumerate(
            (k, j, i) for k in range(2) for j in range(3) for i in range(3)
        )
    }
    vertices = "".join(
        f"({xs[i]:.9g} {ys[j]:.9g} {0.01 * k:g})\n"
        for (i, j, k) in sorted(number, key=number.get)
    )

    def side(i0, j0, i1, j1):
        """A face over the edge from (i0, j0) to (i1, j1)."""
        ends = ((i0, j0, 0), (i1, j1, 0), (i1, j1, 1), (i0, j0, 1))
        return "(" + " ".join(str(number[e]) for e in ends) + ")"

    def square(i, j, k):
        ends = ((i, j, k), (i + 1, j, k), (i + 1, j + 1, k), (i, j + 1, k))
        return "(" + " ".join(str(number[e]) for e in ends) + ")"

    blocks, flats = "", ""
    for i, j in ((0, 0), (1, 0), (1, 1)):
        n = [round((s[m + 1] - s[m]) / cell) for s, m in ((xs, i), (ys, j))]
        corners = (square(i, j, 0) + " " + square(i, j, 1)).replace(") (", " ")
        blocks += f"hex {corners} ({n[0]} {n[1]} 1) simpleGrading (1 1 1)\n"
        flats += square(i, j, 0) + " " + square(i, j, 1)
    patches = {
        "left": ("symmetryPlane", side(0, 0, 0, 1)),
        "bottom": ("symmetryPlane", side(0, 0, 1, 0) + side(1, 0, 2, 0)),
        "right": ("patch", side(2, 0, 2, 1) + side(2, 1, 2, 2)),
        "top": ("patch", side(1, 2, 2, 2)),
        "punch": ("wall", side(0, 1, 1, 1)),
        "punchSide": ("wall", side(1, 1, 1, 2)),
        "flat": ("empty", flats),
    }
    write_file(
        case / "system" / "blockMeshDict",
        f"vertices (\n{vertices});\nblocks (\n{blocks});\nboundary (\n"
        + "".join(
            f"{name} {{ type {kind}; faces ({faces}); }}\n"
            for name, (kind, faces) in patches.items()
        )
        + ");\n",
    )
    execute(case, "blockMesh")
    rows = "".join(f"({t:.12g} ({x} {y} {z}))" for t, (x, y, z) in down)
    conditions = {
        "wall": (
            SLIDING,
            f"type uniformFixedValue; uniformValue table ({rows});",
        ),
        "patch": ("type zeroGradient;", "type zeroGradient;"),
        "symmetryPlane": ("type symmetryPlane;",) * 2,
        "empty": ("type empty;",) * 2,
    }
    write_motion_fields(
        case,
        {patch: conditions[kind][0] for patch, (kind, _) in patches.items()},
        {patch: conditions[kind][1] for patch, (kind, _) in patches.items()},
    )
    average_over(case, length)
    fill(case, lambda x, y: (x < SPLIT[0]) & (y < SPLIT[1]))
    write_each(case, end / 12)
    monitor_damage(case)
    solve(case)


def split_block(folder: Path, quick: bool, length: float) -> Findings:
    """The punches drive a central crack; the same measures as notchedBar."""
    found = Findings()
    end = 2.0 if quick else 8.0
    compare(
        found,
        folder,
        lambda case, cell, step: punched(case, cell, step, end, length),
        ("forcePunch", 1),
        (5e-4,) if quick else (5e-4, 2.5e-4, 1.25e-4),
        () if quick else (0.1, 0.05, 0.025),
    )
    return found


@study(
    "splitBlock",
    "D",
    "A block split by opposed punches, plane strain: mesh and step dependence",
    "itself on the finest mesh and step: the abrupt local law has no length",
)
def split_block_local(folder: Path, quick: bool) -> Findings:
    """The local law, as the paper has it."""
    return split_block(folder, quick, 0.0)


@study(
    "splitBlockNonlocal",
    "D",
    "The block, damage by plastic strain averaged over 1 mm",
    "itself on the finest mesh and step",
)
def split_block_nonlocal(folder: Path, quick: bool) -> Findings:
    """The law with a length, which has to converge."""
    return split_block(folder, quick, LENGTH)
