# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Group D, mesh and step dependence: a notched bar, a block that is split."""

from pathlib import Path

import numpy as np
from bolus_cases.specimens import (
    GRIPPING,
    SLIDING,
    box,
    ramp,
    replace,
    solve,
)
from bolus_cases.synthetic import (
    write_blocks,
    write_field,
    write_motion_fields,
)
from bolus_results.fields import Case
from bolus_results.tables import read_table
from matplotlib import pyplot as plt

from bolus_validation.physics.fracture import (
    first,
    monitor_damage,
    paint,
    write_each,
)
from bolus_validation.studies import Findings, study


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
    found.draw(figure, folder / "broken.png")


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
    vertices = [(xs[i], ys[j], 0.01 * k) for i, j, k in number]

    def side(i0, j0, i1, j1):
        """A face over the edge from (i0, j0) to (i1, j1)."""
        ends = ((i0, j0, 0), (i1, j1, 0), (i1, j1, 1), (i0, j0, 1))
        return tuple(number[e] for e in ends)

    def square(i, j, k):
        ends = ((i, j, k), (i + 1, j, k), (i + 1, j + 1, k), (i, j + 1, k))
        return tuple(number[e] for e in ends)

    blocks, flats = [], []
    for i, j in ((0, 0), (1, 0), (1, 1)):
        n = [round((s[m + 1] - s[m]) / cell) for s, m in ((xs, i), (ys, j))]
        blocks.append((square(i, j, 0) + square(i, j, 1), (*n, 1)))
        flats += square(i, j, 0), square(i, j, 1)
    patches = {
        "left": ("symmetryPlane", [side(0, 0, 0, 1)]),
        "bottom": (
            "symmetryPlane",
            [side(0, 0, 1, 0), side(1, 0, 2, 0)],
        ),
        "right": ("patch", [side(2, 0, 2, 1), side(2, 1, 2, 2)]),
        "top": ("patch", [side(1, 2, 2, 2)]),
        "punch": ("wall", [side(0, 1, 1, 1)]),
        "punchSide": ("wall", [side(1, 1, 1, 2)]),
        "flat": ("empty", flats),
    }
    write_blocks(case, vertices, blocks, patches)
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
