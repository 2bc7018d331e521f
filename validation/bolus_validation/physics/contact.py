# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Group C: friction, platens, separation, converging tube, closed pylorus."""

import re
import shutil
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
    HEIGHT,
    ROOT,
    SLIDING,
    box,
    compression,
    ramp,
    replace,
    rub,
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

STICKING = "type contactWall; friction { type noSlip; }"

# The sliding block, 10 x 5 mm, is pressed by 3 % and then shifted [s, m]
PRESS = 0.3
SLIDE = 1.0
TRAVEL = 2e-3
# Slipping on all of its base from this time on
SLIPPING = 0.6


def flow_stress(rate: float) -> float:
    """Of the tabulated law at a plastic strain rate [1/s]; [Pa]."""
    return float(np.interp(rate, rheology.RATES, rheology.STRESSES))


def push_aside(
    case: Path,
    base: str,
    shifted: str = "upper",
    cell: float = 5e-4,
    travel: float = TRAVEL,
    step: float = 0.02,
):
    """A block pressed on its base, then pushed along it.

    base     condition of the lower wall for U; the upper one sticks
    shifted  the wall that moves sidewards: upper or lower
    cell     size [m]
    travel   [m] sidewards, in SLIDE seconds
    Returns the tables of the forces on lower and upper wall.
    """

    def press(t):
        return -0.03 * 0.005 * min(t / PRESS, 1)

    def shift(t):
        return travel * max(t - PRESS, 0) / SLIDE

    end = PRESS + SLIDE
    up, down = shifted == "upper", shifted == "lower"
    box(
        case,
        (0.020, 0.005),
        (round(0.020 / cell), round(0.005 / cell)),
        {
            "x0": "open",
            "x1": "open",
            "y0": (base, ramp(end, lambda t: (-down * shift(t), 0, 0))),
            "y1": (STICKING, ramp(end, lambda t: (up * shift(t), press(t), 0))),
        },
        end=end,
        step=step,
        block=((0.005, 0.015), 0.005),
        measured=("y0", "y1"),
    )
    solve(case)
    return tuple(
        read_table(case, name, "contactForce")
        for name in ("forceY0", "forceY1")
    )


@study(
    "slidingBlock",
    "C",
    "Coulomb friction of a sliding block",
    "Coulomb: tangential over normal force is mu while it slips, no slip below",
)
def sliding_block(folder: Path, quick: bool) -> Findings:
    """Ratio of the forces on the base, slipping and sticking."""
    found = Findings()
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.5), layout="constrained")
    runs = [(0.3, "upper", 5e-4)]
    if not quick:
        runs += [
            (0.1, "upper", 5e-4),
            (0.3, "lower", 5e-4),
            (0.3, "upper", 2.5e-4),
        ]
    for mu, shifted, cell in runs:
        what = f"mu {mu}, {shifted} wall moves, cells of {1e3 * cell:g} mm"
        lower, upper = push_aside(
            folder / f"slide-{mu}-{shifted}-{1e6 * cell:.0f}",
            rub(mu),
            shifted,
            cell,
        )
        late = lower.time > SLIPPING
        ratio = lower["axial"][late] / lower["normal"][late]
        worst = ratio[np.argmax(abs(ratio - mu))]
        found.row(
            f"shear/normal force, {what}",
            "-",
            worst,
            mu,
            0.005,
            remark="worst step",
        )
        force = abs(lower["axial"] + upper["axial"]).max()
        found.row(
            f"imbalance of the walls' forces, {what}",
            "N",
            force,
            0,
            1e-3,
            scale=lower["normal"].max(),
        )
        pressed = lower.time > 0.05
        axes[0].plot(
            lower.time[pressed],
            lower["axial"][pressed] / lower["normal"][pressed] / mu,
            label=what,
        )
    axes[0].set(xlabel="t [s]", ylabel="shear/normal force/mu")
    axes[0].legend(fontsize=6)

    # Below mu it sticks: the same force as on a wall without any slip, with
    # an elastic slip that is small against the shift
    shift = 2.5e-4
    coulomb = rub(0.9).replace("mu 0.9;", "mu 0.9; elasticSlip 1e-7;")
    sticks = {
        name: push_aside(
            folder / f"stick-{name}", condition, travel=shift, step=0.05
        )[0]
        for name, condition in (("coulomb", coulomb), ("noSlip", STICKING))
    }
    last = {name: table["axial"][-1] for name, table in sticks.items()}
    found.row(
        "shear force below mu (0.9) against that without slip",
        "N",
        last["coulomb"],
        last["noSlip"],
        0.01,
        remark="the edges of the base, where pressure fades, do slip",
    )
    table = sticks["coulomb"]
    found.row(
        "shear/normal force of that",
        "-",
        table["axial"][-1] / table["normal"][-1],
        remark="below 0.9: sticking",
    )
    for name, table in sticks.items():
        axes[1].plot(
            1e3 * shift * np.clip(table.time - PRESS, 0, None) / SLIDE,
            table["axial"],
            "o" if name == "coulomb" else "-",
            label=name,
        )
    axes[1].set(xlabel="shift [mm]", ylabel="shear force [N]")
    axes[1].legend()
    figure.savefig(folder / "sliding.png", dpi=120)
    plt.close(figure)
    found.picture = "sliding.png"
    found.remarks.append(
        "A ratio that is too low points at the half-filled cells at the ends "
        "of the block: their bolus carries load, but friction fades there."
    )
    return found


@study(
    "frictionalPlatens",
    "C",
    "A cylinder squeezed between rough platens",
    "order of the forces; slab theory of upsetting, F/F0 = 1 + 2 mu r/(3 h), "
    "an overestimate; sticking contact",
)
def frictional_platens(folder: Path, quick: bool) -> Findings:
    """Compression tutorial, mu 0 to 0.9 and no slip; the forces must rise."""
    found = Findings()
    strain = 0.1 if quick else 0.5
    mesh = {"nAxial": 14, "nRadial": 36} if quick else {}
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.5), layout="constrained")
    names = ["0", "0.1", "0.3", "0.9", "noSlip"]
    force = {}
    strains = np.arange(0.02, strain + 1e-9, 0.01)
    for name in names:
        friction = {"0": "none", "noSlip": "noSlip"}.get(name, "coulomb")
        run = compression(
            folder / f"mu-{name}",
            strain=strain,
            unloadStrain=0,
            strainStep=0.01,
            friction=friction,
            **({"mu": name} if friction == "coulomb" else {}),
            **mesh,
        )
        force[name] = np.interp(strains, run.strain, run.force)
        axes[0].plot(run.strain, run.force, label=name)
    axes[0].set(xlabel="strain [-]", ylabel="force [N]")
    axes[0].legend()

    for low, high in zip(names, names[1:], strict=False):
        # Over all steps past the elastic ones, not only at the end
        more = force[high] / force[low] - 1
        least = more.min()
        # Equal within 1e-4 where both stick
        found.row(
            f"least rise of the force from mu {low} to {high}",
            "-",
            min(least, 0.0),
            0,
            1e-4,
            scale=1,
            remark=f"at a strain of {strains[more.argmin()]:.2f}; at the end "
            f"{100 * more[-1]:.3g} %",
        )
    found.row(
        "force with mu 0.9 against no slip",
        "N",
        force["0.9"][-1],
        force["noSlip"][-1],
        0.02,
    )
    radius, height = 0.010 * np.exp(strain / 2), HEIGHT * np.exp(-strain)
    for name in ("0.1", "0.3"):
        more = force[name][-1] / force["0"][-1] - 1
        slab = 2 * float(name) * radius / (3 * height)
        found.row(
            f"excess of the force over mu 0, mu {name}",
            "-",
            more,
            remark=f"slab theory, an overestimate: {slab:.3f}",
        )
        found.row(
            f"what of it is beyond slab theory, mu {name}",
            "-",
            max(more - slab, 0.0),
            0,
            1e-3,
            scale=1,
        )
    axes[1].bar(names, [force[n][-1] / force["0"][-1] for n in names])
    axes[1].set(ylim=(0.9, None), ylabel="force/force without friction [-]")
    found.remarks.append(
        "More friction need not mean more force once the cylinder is a barrel: "
        "what sticks keeps the contact small. Up to a strain of 0.1 the order "
        "holds; beyond, it fails by about a per cent."
    )
    figure.savefig(folder / "platens.png", dpi=120)
    plt.close(figure)
    found.picture = "platens.png"
    return found


# Separation: a plane block, 5 mm high, between frictionless walls. It is
# squeezed, let go, flies free, and is squeezed again [s, m, 1/s]
BLOCK = 5e-3
SQUEEZE = 0.1
RETRACT = (2.0, 4.5)
RETURN = (5.5, 8.0)
GAP = 5e-4
LAST = 10.0


def _distance(t):
    """Of the walls at times t [s]; [m]."""
    t = np.asarray(t, dtype=float)
    first, apart = RETRACT
    together, again = RETURN
    closest = BLOCK * np.exp(-SQUEEZE * first)
    return np.select(
        [t < first, t < apart, t < together, t < again],
        [
            BLOCK * np.exp(-SQUEEZE * t),
            closest + 2 * GAP * (t - first) / (apart - first),
            closest + 2 * GAP,
            closest + 2 * GAP * (again - t) / (again - together),
        ],
        closest * np.exp(-SQUEEZE * (t - again)),
    )


@study(
    "separation",
    "C",
    "Separation, free flight, renewed contact",
    "plane strain: a force of 2/sqrt(3) of the flow stress on the section, "
    "none apart; unloading and reloading with E/(1 - nu^2)",
)
def separation(folder: Path, quick: bool) -> Findings:
    """Pull, stress, shape while apart; where and how force returns."""
    found = Findings()
    case = folder / "block"
    cells = (32, 10) if quick else (64, 20)
    step = 0.05 if quick else 0.025

    def away(t):
        return 0.5 * (_distance(t) - BLOCK)

    box(
        case,
        (0.016, BLOCK),
        cells,
        {
            "x0": "symmetryPlane",
            "x1": "open",
            "y0": (SLIDING, ramp(LAST, lambda t: (0, -away(t), 0), 1000)),
            "y1": (SLIDING, ramp(LAST, lambda t: (0, away(t), 0), 1000)),
        },
        end=LAST,
        step=step,
        block=(0.010, BLOCK),
        measured=("y0", "y1"),
    )
    replace(
        case / "system" / "controlDict",
        r"writeInterval[^;]*;",
        "writeInterval 0.5;",
    )
    solve(case)
    table = read_table(case, "forceY1", "contactForce")
    volume = read_table(case, "freeSurface")["volume"]
    time, distance = table.time, _distance(table.time)
    section = volume / distance
    factor = 2 / np.sqrt(3)
    plateau = factor * flow_stress(factor * SQUEEZE)

    before = np.argmin(abs(time - RETRACT[0]))
    traction = table["normal"] / section
    for name, i in (("first", before), ("renewed", -1)):
        found.row(
            f"traction, {name} contact",
            "Pa",
            traction[i],
            plateau,
            0.01,
        )
    pull = max(
        np.max(read_table(case, f, "contactForce")["tensile"] / section)
        for f in ("forceY0", "forceY1")
    )
    found.row(
        "largest pull of a wall, of the yield force",
        "-",
        pull / plateau,
        0,
        0.005,
        scale=1,
        remark="the void's viscosity times the rate at which its cell opens: "
        "grows with the speed of the wall, not with the bolus",
    )
    # The unloading slope from 90 to 30 % of the force
    part = (time > RETRACT[0]) & (time < RETRACT[1])
    down = [
        np.interp(-x, -traction[part] / plateau, np.log(distance[part]))
        for x in (0.8, 0.2)
    ]
    modulus = rheology.E / (1 - rheology.NU**2)
    slope = 0.6 * plateau / (down[1] - down[0])
    found.row("slope of unloading", "Pa", slope, modulus, 0.05)

    # In free flight
    fields = Case(case)
    flight = [t for t in fields.times if RETRACT[1] <= t <= RETURN[0]]
    height, strained = [], []
    for t in flight:
        mesh = fields.mesh(t)
        alpha = fields.field(t, "alpha")
        inner = mesh.cell_centres[:, 0] < 0.005
        bolus = alpha * mesh.cell_volumes
        wide = mesh.points[:, 0].max() * 0.01
        height.append(bolus[inner].sum() / (0.005 * wide / 0.016))
        full = alpha > 0.9
        strained.append(
            np.average(fields.field(t, "sigmaEq")[full], weights=bolus[full])
        )
    found.row(
        "change of the height in free flight",
        "-",
        abs(height[-1] / height[0] - 1),
        0,
        0.005,
        scale=1,
    )
    found.row(
        "mean von Mises stress in free flight, of the plateau",
        "-",
        max(strained) / plateau,
        0,
        0.01 if quick else 0.005,
        scale=1,
    )
    mesh = fields.mesh(flight[-1])
    alpha = fields.field(flight[-1], "alpha")
    touching = mesh.cell_centres[:, 1]
    inner = mesh.cell_centres[:, 0] < 0.008
    found.row(
        "bolus fraction of the cells at the walls in free flight",
        "-",
        max(
            alpha[inner & np.isclose(touching, y, atol=1e-5)].max()
            for y in (touching.min(), touching.max())
        ),
        remark="0: it touches neither wall",
    )
    # Where force comes back: at a tenth of the plateau
    back = (time > RETURN[0]) & (time < RETURN[1])
    where = np.interp(0.1, traction[back] / plateau, distance[back])
    expected = height[-1] * np.exp(-0.1 * plateau / modulus)
    found.row(
        "distance of the walls at a tenth of the plateau, renewed contact",
        "mm",
        1e3 * where,
        1e3 * expected,
        None if quick else 0.01,
        remark="a tenth of a cell",
    )

    figure, axes = plt.subplots(1, 2, figsize=(9, 3.5), layout="constrained")
    axes[0].plot(time, traction)
    axes[0].axhline(plateau, color="k", ls=":")
    axes[0].set(xlabel="t [s]", ylabel="traction on the wall [Pa]")
    axes[1].plot(np.log(BLOCK / distance), traction)
    axes[1].set(
        xlabel="strain of the walls' distance [-]", ylabel="traction [Pa]"
    )
    figure.savefig(folder / "separation.png", dpi=120)
    plt.close(figure)
    found.picture = "separation.png"
    return found


# Converging tube: lengths of container, cone and land [m], radii [m], half
# angle of the cone [rad], way and speed of the piston [m, m/s]
CONTAINER, LAND = 0.010, 0.009
WIDE, NARROW = 0.010, 0.0075
CONE_ANGLE = np.radians(15)
CONE = (WIDE - NARROW) / np.tan(CONE_ANGLE)
WAY, PISTON_SPEED = 3e-3, 1e-3
# Nearly rigid, perfectly plastic [Pa]
YIELD, STIFF = 4100.0, 1e6


def push_through(case: Path, mu: float, cell: float, step: float):
    """A piston pushes bolus through a cone with friction mu; a wedge of 5 deg.

    Container and land are without friction. Returns the tables of piston,
    cone, container and land, and the way of the piston [m].
    """
    end = WAY / PISTON_SPEED
    box(
        case,
        (1, 1),
        (2, 2),
        {k: "open" for k in ("x0", "x1", "y0", "y1")},
        end=end,
        step=step,
        measured=("piston", "cone", "container", "land"),
    )
    control = case / "system" / "controlDict"
    for name in ("piston", "cone", "container", "land"):
        replace(control, f"force{name.upper()}", f"force{name.capitalize()}")
    write_file(
        case / "constant" / "bolusProperties",
        f"rho 1100; elasticity {{ E {STIFF}; nu 0.49; }}\n"
        "flowStress { type tabulated; interpolation linear; "
        f"table ((0 {YIELD}) (1 {1.0001 * YIELD})); }}\n"
        "damage { type none; }\n",
    )
    half = np.radians(2.5)
    ends = np.cumsum([0, CONTAINER, CONE, LAND])
    radii = (WIDE, WIDE, NARROW, NARROW)
    vertices = "".join(f"({x:.12g} 0 0)\n" for x in ends) + "".join(
        f"({x:.12g} {r * np.cos(half):.12g} {s * r * np.sin(half):.12g})\n"
        for s in (-1, 1)
        for x, r in zip(ends, radii, strict=True)
    )
    across = round(WIDE / cell)
    blocks, names = "", ("container", "cone", "land")
    patches = {"front": ["wedge", ""], "back": ["wedge", ""]}
    axis = ""
    for i, name in enumerate(names):
        along = round((ends[i + 1] - ends[i]) / cell)
        a, b, front, back = i, i + 1, 4 + i, 8 + i
        blocks += (
            f"hex ({a} {b} {front + 1} {front} {a} {b} {back + 1} {back}) "
            f"({along} {across} 1) simpleGrading (1 1 1)\n"
        )
        patches["front"][1] += f"({a} {front} {front + 1} {b})"
        patches["back"][1] += f"({a} {b} {back + 1} {back})"
        patches[name] = ["wall", f"({front} {back} {back + 1} {front + 1})"]
        axis += f"({a} {b} {b} {a})"
    patches |= {
        "piston": ["wall", "(0 8 4 0)"],
        "outlet": ["patch", "(3 7 11 3)"],
        "axis": ["empty", axis],
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
    still = "type fixedValue; value uniform (0 0 0);"
    moving = (
        "type uniformFixedValue; uniformValue table "
        f"((0 (0 0 0)) ({end} ({WAY} 0 0)));"
    )
    conditions = {
        "piston": (SLIDING, moving),
        "container": (SLIDING, "type zeroGradient;"),
        "cone": (rub(mu) if mu else SLIDING, still),
        "land": (SLIDING, still),
        "outlet": ("type zeroGradient;", still),
    }
    given = {
        patch: conditions.get(patch, (f"type {kind};",) * 2)
        for patch, (kind, _) in patches.items()
    }
    write_motion_fields(
        case,
        {patch: both[0] for patch, both in given.items()},
        {patch: both[1] for patch, both in given.items()},
    )
    mesh = Case(case).mesh(0)
    full = mesh.cell_centres[:, 0] < ends[2] + 0.0025
    write_field(case, mesh, 0, "alpha", full.astype(float))
    solve(case)
    tables = [
        read_table(case, f"force{name.capitalize()}", "contactForce")
        for name in ("piston", "cone", "container", "land")
    ]
    return *tables, PISTON_SPEED * tables[0].time


@study(
    "convergingTube",
    "C",
    "A bolus pushed through a converging tube",
    "perfectly plastic extrusion: between the ideal work and Avitzur's upper "
    "bound; with friction, equilibrium (exact) and slab theory (an estimate)",
)
def converging_tube(folder: Path, quick: bool) -> Findings:
    """Pressure on the piston with mu 0, 0.1 and 0.2 in the cone."""
    found = Findings()
    area = np.pi * WIDE**2
    cot = 1 / np.tan(CONE_ANGLE)
    ideal = 2 * np.log(WIDE / NARROW)
    # Avitzur: f(alpha) of the cone is 1 within 0.3 %, and two surfaces of shear
    redundant = 2 / np.sqrt(3) * (CONE_ANGLE / np.sin(CONE_ANGLE) ** 2 - cot)

    def slab(mu):
        b = mu * cot
        return (1 + b) / b * ((WIDE / NARROW) ** (2 * b) - 1) if b else ideal

    figure, axes = plt.subplots(1, 2, figsize=(10, 3.5), layout="constrained")
    pressure = {}
    runs = [(0.0, 1e-3)]
    if not quick:
        runs += [(0.1, 1e-3), (0.0, 5e-4), (0.1, 5e-4), (0.2, 5e-4)]
    for mu, cell in runs:
        case = folder / f"mu-{mu}-{1e6 * cell:.0f}"
        piston, cone, container, land, way = push_through(
            case, mu, cell, 0.1 if quick else 0.05
        )
        what = f"mu {mu:g}, cells of {1e3 * cell:g} mm"
        axes[0].plot(1e3 * way, piston["normal"] / area / YIELD, label=what)
        late = way > 0.6 * WAY
        mean = piston["normal"][late].mean() / area / YIELD
        pressure[mu, cell] = mean
        found.row(
            f"ripple of the pressure, {what}",
            "-",
            np.ptp(piston["normal"][late]) / area / YIELD / mean,
            remark="the front passes cells of the land",
        )
        walls = (piston, cone, container, land)
        found.row(
            f"sum of the walls' axial forces, {what}",
            "N",
            abs(sum(wall["axial"] for wall in walls)).max(),
            0,
            1e-3,
            scale=piston["normal"].max(),
        )
        if mu == 0:
            found.row(
                f"pressure/yield stress, {what}",
                "-",
                mean,
                remark=f"ideal work {ideal:.3f}, Avitzur's upper bound "
                f"{ideal + redundant:.3f}",
            )
            found.row(
                f"what is missing to the ideal work, {what}",
                "-",
                max(ideal - mean, 0),
                0,
                0.01,
                scale=ideal,
            )
            found.row(
                f"what is beyond Avitzur's upper bound, {what}",
                "-",
                max(mean - ideal - redundant, 0),
                0,
                0.01,
                scale=ideal,
            )
            continue
        ratio = cone["tangential"][late] / cone["normal"][late]
        found.row(
            f"shear/normal force on the cone, {what}",
            "-",
            ratio[np.argmax(abs(ratio - mu))],
            mu,
            0.005,
            remark="worst step; cone and its neighbours share nodes, whose "
            "force has no one side: first order",
        )
        balance = cone["normal"] * (
            np.sin(CONE_ANGLE) + mu * np.cos(CONE_ANGLE)
        )
        found.row(
            f"piston force against N (sin + mu cos) of the cone, {what}",
            "N",
            piston["normal"][late].mean(),
            balance[late].mean(),
            0.01,
            remark="the same",
        )
        found.row(
            f"pressure/yield stress that friction adds, {what}",
            "-",
            mean - pressure[0.0, cell],
            slab(mu) - ideal,
            0.15,
            remark="slab theory, an estimate: it has no redundant shear, which "
            "raises the pressure on the cone and so its friction (by some "
            f"{100 * (pressure[0.0, cell] / ideal - 1):.0f} %)",
        )
    axes[0].axhline(ideal, color="k", ls=":")
    axes[0].axhline(ideal + redundant, color="k", ls="--")
    axes[0].set(xlabel="way of the piston [mm]", ylabel="pressure/yield [-]")
    axes[0].legend(fontsize=7)
    fields = Case(case)
    end = max(fields.times)
    section = fields.mesh(end).section
    cells = PolyCollection(
        [1e3 * polygon for polygon in section.polygons],
        array=fields.field(end, "epsilonPEq")[section.cells],
        edgecolors="face",
    )
    axes[1].add_collection(cells)
    axes[1].set_aspect("equal")
    axes[1].autoscale()
    axes[1].set_title("plastic strain")
    figure.colorbar(cells, ax=axes[1], shrink=0.6)
    figure.savefig(folder / "tube.png", dpi=120)
    plt.close(figure)
    found.picture = "tube.png"
    return found


# Pylorus: its radius [m] beside the throat, when the waves start [s] and stop
PYLORUS = 0.006
SQUEEZED = (10.0, 19.0)


def press_on_pylorus(case: Path, throat: float, gap: float, cell: float):
    """Case A with a small bolus and a wave that presses it on the pylorus.

    throat  radius [m] of a pylorus that stays open; 0: closed all the time
    gap     residualGap [m], cell size [m]
    """
    shutil.copytree(ROOT / "tutorials" / "gastric" / "caseA", case)
    motility = case / "constant" / "motilityProperties"
    replace(motility, r"residualGap[^;]*;", f"residualGap {gap};")
    text = motility.read_text()
    # The wave goes on through the pylorus
    text = re.sub(r"fadeOut\s*\{\s*wave0\s*\{[^}]*\}\s*\}", "", text)
    trigger = (
        "type none;"
        if throat
        else "type schedule; closeTimes (); openTimes (1000);"
    )
    text, count = re.subn(
        r"trigger\s*\{[^}]*\}", f"trigger {{ {trigger} }}", text
    )
    assert count == 1
    motility.write_text(text)
    if throat:
        replace(
            motility,
            r"relativeOcclusion[^;]*;",
            f"relativeOcclusion {1 - throat / PYLORUS:.9g};",
        )
    replace(
        case / "system" / "meshParameters",
        r"\nresolution[^;]*;",
        f"\nresolution {cell};",
    )
    replace(
        case / "system" / "meshParameters",
        r"\npylorusRefinement[^;]*;",
        "\npylorusRefinement 2.5;",
    )
    alpha = case / "system" / "setAlphaFieldDict"
    replace(alpha, r"radius[^;]*;", f"radius {SMALL};")
    replace(alpha, r"origin[^;]*;", "origin (0.2395 0 0);")
    control = case / "system" / "controlDict"
    start, end = SQUEEZED
    for entry, value in (
        ("startFrom", "startTime"),
        ("startTime", start),
        ("endTime", end),
        ("writeInterval", 1),
        ("closedBetween", f"({start} {end})"),
    ):
        replace(control, rf"\b{entry} [^;]*;", f"{entry} {value};")
    replace(
        case / "system" / "caseParameters",
        r"\nlaw [^;]*;",
        "\nlaw viscoplastic;",
    )
    shutil.copytree(case / "0.orig", case / f"{start:g}")
    execute(case, "python", "system/makeBlockMeshDict.py")
    for command in ("blockMesh", "gastricMesh", "setAlphaField"):
        execute(case, command)
    solve(case)
    return read_table(case, "retainedMass")


# Of the bolus in front of the pylorus [m]
SMALL = 0.007


def leak_factor(throat: float) -> float:
    """Pressure over flow stress at which bolus passes a throat [m].

    Ideal work of the way from PYLORUS to the throat, and sticking friction
    sigma/sqrt(3) on the wall up to it: an estimate, not a bound.
    """
    x = np.linspace(0, 0.002, 20001)
    shape = (x * (0.004 - x) / 0.002**2) ** 2
    radius = PYLORUS - (PYLORUS - throat) * shape
    middle = 0.5 * (1 / radius[1:] + 1 / radius[:-1])
    rubbing = 2 / np.sqrt(3) * np.sum(middle) * x[1]
    return float(2 * np.log(PYLORUS / throat) + rubbing)


@study(
    "closedPylorus",
    "C",
    "The closed pylorus: what leaks through it, and when",
    "closed: nothing passes; open by a radius r: ideal plastic work, 2 ln(6 "
    "mm/r) of the flow stress, and sticking friction on the wall",
)
def closed_pylorus(folder: Path, quick: bool) -> Findings:
    """A wave presses bolus on a pylorus, sealed or open by a little."""
    found = Findings()
    sealed = [(2e-5, 1e-3)]
    if not quick:
        sealed += [(1e-4, 1e-3), (2e-5, 7e-4), (1e-4, 7e-4)]
    opened = [] if quick else [2e-5, 1e-4, 3e-4, 1e-3]
    figure, axes = plt.subplots(1, 2, figsize=(10, 3.5), layout="constrained")
    for gap, throat, cell in [(g, 0.0, c) for g, c in sealed] + [
        (1e-5, r, 1e-3) for r in opened
    ]:
        name = f"gap-{1e6 * gap:.0f}-throat-{1e6 * throat:.0f}-{1e6 * cell:.0f}"
        what = (
            f"throat of {1e3 * throat:g} mm"
            if throat
            else f"closed, residual gap {1e3 * gap:g} mm"
        ) + f", cells of {1e3 * cell:g} mm"
        case = folder / name
        mass = press_on_pylorus(case, throat, gap, cell)
        fields = Case(case)
        times = [t for t in fields.times if t > SQUEEZED[0]]
        pressure = []
        beyond = []
        for t in times:
            mesh = fields.mesh(t)
            alpha = fields.field(t, "alpha")
            x = mesh.cell_centres[:, 0]
            volume = alpha * mesh.cell_volumes
            before = (x > 0.2485) & (x < 0.2505) & (alpha > 0.9)
            stress = fields.field(t, "stress")[:, 0]
            pressure.append(
                np.average(-stress[before], weights=volume[before])
                if before.any()
                else 0.0
            )
            gone = 1 - mass.at("inside", t) / mass["inside"][0]
            beyond.append(volume[x > 0.252].sum() / volume.sum() + gone)
        axes[0].plot(times, np.array(pressure) / 1e3, label=what)
        axes[1].semilogy(times, np.maximum(beyond, 1e-12), label=what)
        if throat:
            # Bolus as long as the throat is wide has passed
            least = 2 * np.pi * throat**3 / (4 / 3 * np.pi * SMALL**3)
            leaks = np.flatnonzero(np.array(beyond) > least)
            reached = pressure[leaks[0]] if leaks.size else max(pressure)
            low, high = (leak_factor(throat) * s for s in (4100, 15200))
            found.row(
                f"axial pressure at the pylorus when {least:.2g} has passed, "
                f"{what}",
                "Pa",
                reached,
                remark=(
                    f"at {times[leaks[0]]:g} s"
                    if leaks.size
                    else "less passed: largest pressure"
                )
                + f"; estimate {low:.0f} (flow at rate 0) to {high:.0f} (1/s); "
                "written each second",
            )
            found.row(
                f"leak below the estimate at rate 0, {what}",
                "-",
                max(1 - reached / low, 0.0) if leaks.size else 0.0,
                0,
                0.05,
                scale=1,
            )
        else:
            found.row(
                f"part of the bolus beyond the throat, {what}",
                "-",
                max(beyond),
                0,
                1e-6,
                scale=1,
                remark=f"axial pressure up to {max(pressure):.0f} Pa",
            )
    axes[0].set(xlabel="t [s]", ylabel="axial pressure at the pylorus [kPa]")
    axes[1].set(xlabel="t [s]", ylabel="part of the bolus beyond the throat")
    axes[1].legend(fontsize=5)
    figure.savefig(folder / "pylorus.png", dpi=120)
    plt.close(figure)
    found.picture = "pylorus.png"
    return found
