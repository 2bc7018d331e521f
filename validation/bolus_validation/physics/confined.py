# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Group C, bolus in a narrow place: converging tube, closed pylorus."""

import re
import shutil
from pathlib import Path

import numpy as np
from bolus_cases.mapped import draw_cells
from bolus_cases.specimens import (
    ROOT,
    SLIDING,
    box,
    replace,
    rub,
    solve,
)
from bolus_cases.synthetic import (
    run as execute,
)
from bolus_cases.synthetic import (
    write_blocks,
    write_field,
    write_file,
    write_motion_fields,
)
from bolus_results.fields import Case
from bolus_results.tables import read_table
from matplotlib import pyplot as plt

from bolus_validation.studies import Findings, study

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
    vertices = [(x, 0, 0) for x in ends] + [
        (x, r * np.cos(half), s * r * np.sin(half))
        for s in (-1, 1)
        for x, r in zip(ends, radii, strict=True)
    ]
    across = round(WIDE / cell)
    blocks, names = [], ("container", "cone", "land")
    patches = {"front": ("wedge", []), "back": ("wedge", [])}
    axis = []
    for i, name in enumerate(names):
        along = round((ends[i + 1] - ends[i]) / cell)
        a, b, front, back = i, i + 1, 4 + i, 8 + i
        corners = (a, b, front + 1, front, a, b, back + 1, back)
        blocks.append((corners, (along, across, 1)))
        patches["front"][1].append((a, front, front + 1, b))
        patches["back"][1].append((a, b, back + 1, back))
        patches[name] = "wall", [(front, back, back + 1, front + 1)]
        axis.append((a, b, b, a))
    patches |= {
        "piston": ("wall", [(0, 8, 4, 0)]),
        "outlet": ("patch", [(3, 7, 11, 3)]),
        "axis": ("empty", axis),
    }
    write_blocks(case, vertices, blocks, patches)
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
    draw_cells(
        axes[1],
        fields.mesh(end),
        fields.field(end, "epsilonPEq"),
        1e-3,
        "plastic strain",
        edgecolors="face",
    )
    found.draw(figure, folder / "tube.png")
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
    found.draw(figure, folder / "pylorus.png")
    return found
