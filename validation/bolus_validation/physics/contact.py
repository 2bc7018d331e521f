# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Group C, contact with walls: friction, platens, separation."""

from pathlib import Path

import numpy as np
from bolus_cases.specimens import (
    HEIGHT,
    SLIDING,
    box,
    compression,
    ramp,
    replace,
    rub,
    solve,
)
from bolus_results.fields import Case
from bolus_results.tables import read_table
from matplotlib import pyplot as plt

from bolus_validation import rheology
from bolus_validation.studies import Findings, study

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
    found.draw(figure, folder / "sliding.png")
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
    found.draw(figure, folder / "platens.png")
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
        remark="the gas's viscosity times the rate at which its cell opens: "
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
    found.draw(figure, folder / "separation.png")
    return found
