# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Group A, stress along a path: shear, relaxation, unloading."""

from pathlib import Path

import numpy as np
from bolus_cases.mapped import (
    GRIP,
    STICK,
    Side,
    build,
    finish,
    material,
    picture,
)

from bolus_validation import rheology
from bolus_validation.studies import Findings, study

SIZE = 0.01  # of the block [m]

# Text of flowStress, and the law
LAWS = {
    "tabulated": (
        "type tabulated; table ((0 4100) (0.01 7000) (0.1 9600) (1 15200));",
        rheology.Tabulated(rheology.RATES, rheology.STRESSES),
    ),
    "tabulated-logarithmic": (
        "type tabulated; interpolation logarithmic; "
        "table ((0 4100) (0.01 7000) (0.1 9600) (1 15200));",
        rheology.Tabulated(rheology.RATES, rheology.STRESSES, True),
    ),
    "Herschel-Bulkley": (
        "type HerschelBulkley; sigma0 4100; k 11000; n 0.29;",
        rheology.HerschelBulkley(),
    ),
    "power-hardening": (
        "type powerHardening; sigmaY 100; H 11780; m 2;",
        rheology.PowerHardening(logarithmic_rate=False),
    ),
}

# --- simple shear ------------------------------------------------------------

# Times [s] at which shearing ends, holding ends, unloading ends; shear rate
SHEARED, HELD, UNLOADED = 6.0, 8.0, 8.6
SHEAR_RATE = 0.1


def shear_at(t):
    """Shear of the block at times t [s]."""
    back = SHEARED - (UNLOADED - HELD)
    return SHEAR_RATE * np.interp(
        t, (0, SHEARED, HELD, UNLOADED), (0, SHEARED, SHEARED, back)
    )


def exact_shear(law, times):
    """Deviators (n, 3, 3) [Pa] along the path, at times (n,) [s]."""
    stresses, state, strain, start = [], None, 0.0, 0.0
    for end, rate in (
        (SHEARED, SHEAR_RATE),
        (HELD, 0.0),
        (UNLOADED, -SHEAR_RATE),
    ):
        here = times[(times > start + 1e-9) & (times < end + 1e-9)]
        s, e = rheology.simple_shear(
            law, rate, np.append(here, end) - start, state, strain
        )
        stresses.append(s[:-1])
        state, strain, start = s[-1], e[-1], end
    return np.concatenate(stresses)


def shear(case: Path, flow: str, step: float, n: int = 6, later=False):
    """Shear a block whose whole boundary moves as in simple shear.

    The mesh inside is uneven. later: the stress turns after equilibrium was
    found (splitRotationBelow), in all steps. Returns times (m,) [s] and, over
    the cells, mean deviators (m, 6) [Pa] and their spread, the largest
    difference.
    """

    def place(unit):
        bump = 0.06 * np.prod(np.sin(np.pi * unit * (2, 1)), axis=1)
        return SIZE * (unit + bump[:, None] * (1, 0.7))

    def move(t, points):
        return np.outer(shear_at(t) * points[:, 1], (1, 0, 0))

    wall = Side(STICK, move)
    build(
        case,
        (n, n),
        place,
        {"x0": wall, "x1": wall, "y0": wall, "y1": wall},
        material(flow, rheology.E, rheology.NU),
        UNLOADED,
        step,
        knots=(0, SHEARED, HELD, UNLOADED),
        write=0.2,
        solver="splitRotationBelow 1;" if later else "",
    )
    if later:
        # As after a step that failed with it, for ever
        memory = case / "0" / "uniform" / "coupledSystem"
        memory.parent.mkdir()
        memory.write_text(
            "FoamFile { version 2.0; format ascii; class dictionary;"
            " object coupledSystem; }\nturnLater 1000000;\n"
        )
    fields, _ = finish(case)
    times = np.array(list(fields.times)[1:])
    found = np.array([fields.field(t, "deviator") for t in times])
    mean = found.mean(axis=1)
    return times, mean, np.ptp(found, axis=1).max()


@study(
    "shear",
    "A",
    "Simple shear of a block: start-up, relaxation, unloading, all laws",
    "Jaumann rate, integrated by Runge and Kutta's method (exact to 1e-6)",
)
def shear_study(folder: Path, quick: bool) -> Findings:
    """Deviator of a block along the path, against the material's."""
    found = Findings()
    steps = (0.1,) if quick else (0.1, 0.05, 0.025)
    drawn = {}
    for name in ("Herschel-Bulkley", "power-hardening") if quick else LAWS:
        flow, law = LAWS[name]
        errors = []
        for step in steps:
            times, got, spread = shear(folder / f"{name}{step}", flow, step)
            want = exact_shear(law, times)
            # xy and xx; the others follow from these
            differ = got[:, [1, 0]] - want[:, [0, 0], [1, 0]]
            largest = np.max(abs(want))
            errors.append(np.sqrt(np.mean(differ**2)) / largest)
        drawn[name] = times, got, want
        found.row(
            f"{name}: deviator, rms over the path",
            "largest stress",
            errors[-1],
            0.0,
            limit=0.02 if quick else 0.01,
            scale=1,
            remark=f"largest {np.max(abs(differ)) / largest:.2%}",
        )
        found.row(
            f"{name}: spread over the cells",
            "largest stress",
            spread / largest,
            0.0,
            limit=0.01,
            scale=1,
        )
        if not quick:
            found.order(f"{name}: deviator", list(steps), errors, least=0.9)

    def paint(*axes):
        for axis, (name, (times, got, want)) in zip(
            axes, drawn.items(), strict=True
        ):
            for i, j, word in ((1, (0, 1), "xy"), (0, (0, 0), "xx")):
                axis.plot(times, got[:, i], "o", ms=3, label=f"{word}, ours")
                axis.plot(times, want[:, j[0], j[1]], "k-", lw=0.8)
            axis.set(title=name, xlabel="time [s]", ylabel="deviator [Pa]")
            axis.legend()

    found.picture = picture(folder, "path.png", paint, len(drawn))
    return found


# --- compression, relaxation, unloading --------------------------------------

# Times [s] at which compression, holding and unloading end; strain rate [1/s]
PRESSED, RELAXED, RELEASED = 3.0, 13.0, 13.3
STRAIN_RATE = 0.1


def strain_at(t):
    """Hencky strain at times t [s], compression > 0."""
    return STRAIN_RATE * np.interp(
        t,
        (0, PRESSED, RELAXED, RELEASED),
        (0, PRESSED, PRESSED, PRESSED - (RELEASED - RELAXED)),
    )


def exact_uniaxial(law, times):
    """Stress (n,) [Pa] at times [s] along that path, by Runge and Kutta."""
    stress, now, start = [], 0.0, 0.0
    for end, rate in (
        (PRESSED, STRAIN_RATE),
        (RELAXED, 0.0),
        (RELEASED, -STRAIN_RATE),
    ):
        here = times[(times > start + 1e-9) & (times < end + 1e-9)]
        path = rheology.uniaxial_rate_law(
            law, rate, np.append(here, end) - start, now
        )
        stress.append(path[:-1])
        now, start = path[-1], end
    return np.concatenate(stress)


def pressed_cylinder(case: Path, flow: str, step: float, n: int = 4):
    """A cylinder between platens without friction, all cells full.

    The side of the mesh follows the bolus, which leaves through it. Returns
    times (m,) [s], mean axial stress [Pa], spread of it [Pa] and stress by
    the platen's force [Pa].
    """

    def move(t, points):
        # A little less wide than the bolus: gas would come in, not bolus
        wide = np.expm1(0.5 * strain_at(t) - 0.004 * min(t, 1) - 0.0005 * t)
        return points * (np.expm1(-strain_at(t)), wide, wide)

    build(
        case,
        (n, n),
        lambda unit: SIZE * unit,
        {
            "x0": Side(GRIP, move),
            "x1": Side(GRIP, move),
            "y1": Side("open", move),
        },
        material(flow, rheology.E, rheology.NU),
        RELEASED,
        step,
        wedge=True,
        knots=[
            *np.linspace(0, PRESSED, 121),
            *np.linspace(PRESSED + 0.1, RELEASED, 103),
        ],
        measured={"push": "patches (x1);"},
        write=0.1,
    )
    fields, force = finish(case, "push")
    times = np.array(list(fields.times)[1:])
    stress = np.array([-fields.field(t, "stress")[:, 0] for t in times])
    volume = np.array([fields.mesh(t).cell_volumes.sum() for t in times])
    section = volume / (SIZE * np.exp(-strain_at(times)))
    by_force = np.interp(times, force.time, force["axial_mesh"]) / section
    return times, stress.mean(axis=1), np.ptp(stress, axis=1).max(), by_force


@study(
    "relaxation",
    "A",
    "Compression, relaxation and unloading of a cylinder",
    "uniaxial rate equation, integrated by Runge and Kutta's method",
)
def relaxation_study(folder: Path, quick: bool) -> Findings:
    """Axial stress along the path, from the field and from the force."""
    found = Findings()
    steps = (0.1,) if quick else (0.1, 0.05, 0.025)
    drawn = {}
    for name in ("tabulated",) if quick else ("tabulated", "Herschel-Bulkley"):
        flow, law = LAWS[name]
        errors = []
        for step in steps:
            times, stress, spread, by_force = pressed_cylinder(
                folder / f"{name}{step}", flow, step
            )
            want = exact_uniaxial(law, times)
            largest = want.max()
            errors.append(np.sqrt(np.mean((stress - want) ** 2)) / largest)
        drawn[name] = times, stress, want
        for label, error, remark in (
            (
                "axial stress, rms over the path",
                errors[-1],
                f"largest {np.max(abs(stress - want)) / largest:.2%}",
            ),
            (
                "stress by the platen's force, rms",
                np.sqrt(np.mean((by_force - want) ** 2)) / largest,
                "",
            ),
            ("spread over the cells", spread / largest, ""),
        ):
            found.row(
                f"{name}: {label}",
                "largest stress",
                error,
                0.0,
                limit=0.02 if quick else 0.01,
                scale=1,
                remark=remark,
            )
        for label, when in (
            ("plateau", PRESSED),
            ("relaxed", RELAXED),
            ("unloaded", RELEASED),
        ):
            found.row(
                f"{name}: {label}",
                "Pa",
                np.interp(when, times, stress),
                np.interp(when, times, want),
                limit=0.02 if quick else 0.01,
            )
        if not quick:
            found.order(f"{name}: axial stress", list(steps), errors, least=0.9)

    def paint(*axes):
        for axis, (name, (times, stress, want)) in zip(
            axes, drawn.items(), strict=True
        ):
            axis.plot(times, stress, "o", ms=3, label="ours")
            axis.plot(times, want, "k-", lw=0.8, label="exact")
            axis.set(title=name, xlabel="time [s]", ylabel="axial stress [Pa]")
            axis.legend()

    found.picture = picture(folder, "path.png", paint, len(drawn))
    return found


# --- rotation and translation ------------------------------------------------
