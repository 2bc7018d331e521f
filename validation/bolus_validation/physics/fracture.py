# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Group D: where and when bolus breaks, and what the pieces carry."""

from pathlib import Path

import numpy as np
from bolus_cases.mapped import draw_cells, write_motion
from bolus_cases.specimens import (
    box,
    compression,
    prepare_compression,
    ramp,
    replace,
    solve,
)
from bolus_cases.synthetic import (
    write_field,
)
from bolus_results.fields import Case
from bolus_results.tables import read_table
from matplotlib import pyplot as plt

from bolus_validation import rheology
from bolus_validation.studies import Findings, study

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
    bolus = case.field(time, "alpha") > least
    draw_cells(
        axes,
        mesh,
        np.where(bolus, case.field(time, name), np.nan),
        1e-3,
        f"{name}, t = {time:g} s",
        cmap="magma_r",
        edgecolors="face",
        linewidths=0.1,
        clim=limits,
    )
    axes.tick_params(labelsize=6)


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
    found.draw(figure, folder / "bar.png")
    return found


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
    for side in ("x0", "x1"):
        write_motion(
            case,
            mesh,
            side,
            lambda time, points: np.outer(points[:, 1] * time, (1, 0, 0)),
            (0, gamma),
        )
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
    found.draw(figure, folder / "unbroken.png")
    found.remarks.append(
        f"The cylinder was compressed to {run.strain[-1]:.2f}."
    )
    return found
