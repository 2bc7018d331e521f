# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Group A: stress along a path: shear, relaxation, unloading, rotation,
translation."""

from pathlib import Path

import numpy as np

from bolus_validation import rheology
from bolus_validation.fields import Case
from bolus_validation.physics.cases import (
    ELASTIC,
    OPEN,
    STICK,
    Side,
    build,
    finish,
    material,
    picture,
)
from bolus_validation.results import read_table
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
        rheology.PowerHardening(),
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


def shear(case: Path, flow: str, step: float, n: int = 6):
    """Shear a block whose whole boundary moves as in simple shear.

    The mesh inside is uneven. Returns times (m,) [s] and, over the cells,
    mean deviators (m, 6) [Pa] and their spread, the largest difference.
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
    laws = ("tabulated", "power-hardening") if quick else LAWS
    for name in laws:
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


# --- rotation and translation ------------------------------------------------

RADIUS = 0.010  # of the disc [m]
PEAK = 2000.0  # its stress at the centre [Pa]
AROUND = 1.0  # time of the motion [s]


def residual_stress(x, y):
    """Stress (n, 6) [Pa] of a disc in equilibrium with a free rim.

    sigma_r = S (1 - rho^2)^2 with rho = r/R, sigma_theta = d(r sigma_r)/dr,
    plane strain: sigma_z = nu (sigma_r + sigma_theta).
    """
    rho2 = np.minimum((x**2 + y**2) / RADIUS**2, 1)
    along = PEAK * (1 - rho2) ** 2
    hoop = along - 4 * PEAK * rho2 * (1 - rho2)
    angle = np.arctan2(y, x)
    c, s = np.cos(angle), np.sin(angle)
    zero = np.zeros_like(x)
    return np.column_stack(
        [
            along * c**2 + hoop * s**2,
            (along - hoop) * c * s,
            zero,
            along * s**2 + hoop * c**2,
            zero,
            rheology.NU * (along + hoop),
        ]
    )


def solid_body(motion: str) -> str:
    """Text of dynamicMeshDict for a mesh that moves as one."""
    return (
        "dynamicFvMesh dynamicMotionSolverFvMesh;\n"
        'motionSolverLibs ("libfvMotionSolvers.so");\n'
        f"motionSolver solidBody;\n{motion}\n"
    )


def disc(case: Path, n: int, length: float, motion: str, steps: int):
    """A disc under residual stress, at rest in a void, while the mesh moves.

    n        cells along its diameter
    length   of the mesh [diameters], 1.5 high
    motion   entries of solidBody in dynamicMeshDict
    The rigid motions of the disc are kept at rest by inertia, its only part.
    Returns the written fields.
    """
    size = 2 * RADIUS * np.array([length, 1.5])
    counts = np.rint(size / (2 * RADIUS / n)).astype(int)
    cell = size / counts
    origin = -0.75 * 2 * RADIUS

    def fraction(centres):
        ticks = (np.arange(20) + 0.5) / 20 - 0.5
        dx, dy = (g.ravel() for g in np.meshgrid(ticks, ticks))
        x = centres[:, :1] + cell[0] * dx
        y = centres[:, 1:2] + cell[1] * dy
        return (x**2 + y**2 < RADIUS**2).mean(axis=1)

    def stress(centres):
        return residual_stress(centres[:, 0], centres[:, 1])

    def pressure(centres):
        return -stress(centres)[:, [0, 3, 5]].mean(axis=1)

    def deviator(centres):
        return stress(centres) + np.outer(pressure(centres), (1, 0, 0, 1, 0, 1))

    build(
        case,
        tuple(counts),
        lambda unit: origin + unit * size,
        {"x0": OPEN, "x1": OPEN, "y0": OPEN, "y1": OPEN},
        material(ELASTIC, rheology.E, rheology.NU),
        AROUND,
        AROUND / steps,
        fraction=fraction,
        initial={"p": pressure, "deviator": deviator},
        solver="inertia 1;",
        write=AROUND / 4,
        mesh_motion=solid_body(motion),
        max_courant=10,
    )
    return finish(case)[0]


INVARIANTS = ("von Mises stress, rms", "pressure, rms")


def invariants(fields: Case, time: float):
    """Mass-weighted rms of von Mises stress and pressure [Pa], second moment
    of the shape over that of a disc [-], and the loads' largest values."""
    mesh = fields.mesh(time)
    alpha = fields.field(time, "alpha")
    weight = mesh.cell_volumes * alpha
    weight = weight / weight.sum()
    s = fields.field(time, "deviator")
    mises2 = 1.5 * s**2 @ (1, 2, 2, 1, 2, 1)
    pressure = fields.field(time, "p")
    centres = mesh.cell_centres[:, :2]
    off = centres - weight @ centres
    return (
        np.sqrt(weight @ mises2),
        np.sqrt(weight @ pressure**2),
        2 * (weight @ np.sum(off**2, axis=1)) / RADIUS**2,
    )


def _compare(found: Findings, name: str, fields: Case, limit) -> np.ndarray:
    """Rows of a disc at the end against its start; relative changes."""
    times = sorted(fields.times)
    start, end = (
        np.array(invariants(fields, t)) for t in (times[0], times[-1])
    )
    for label, a, b, unit in zip(
        (*INVARIANTS, "second moment of the shape"),
        start,
        end,
        ("Pa", "Pa", "-"),
        strict=True,
    ):
        found.row(f"{name}: {label}", unit, b, a, limit=limit)
    steps = read_table(fields.path, "solver", "steps")
    found.row(
        f"{name}: mass error",
        "-",
        np.max(abs(steps["massError"])),
        0.0,
        limit=None if limit is None else 1e-4,
        scale=1,
    )
    return end / start - 1


def turning_block(case: Path, steps: int, n: int = 8):
    """A block is turned once, by walls that hold it; the mesh goes with it.

    Its stress is that of bending and tension, in equilibrium, below yield.
    What is tested is the objective rate. Returns the written fields.
    """

    def place(unit):
        bump = 0.06 * np.prod(np.sin(np.pi * unit * (2, 1)), axis=1)
        return SIZE * (unit - 0.5 + bump[:, None] * (1, 0.7))

    def pressure(centres):
        return -PEAK * (1 + centres[:, 1] / SIZE) / 3

    def deviator(centres):
        return np.outer(pressure(centres), (-2, 0, 0, 1, 0, 1))

    wall = Side(STICK)
    build(
        case,
        (n, n),
        place,
        {"x0": wall, "x1": wall, "y0": wall, "y1": wall},
        material(LAWS["tabulated"][0], rheology.E, rheology.NU),
        AROUND,
        AROUND / steps,
        initial={"p": pressure, "deviator": deviator},
        write=AROUND / 4,
        mesh_motion=solid_body(TURN),
        max_courant=10,
    )
    return finish(case)[0]


TURN = (
    "solidBodyMotionFunction rotatingMotion; origin (0 0 0); axis (0 0 1); "
    f"omega {2 * np.pi / AROUND:.15g};"
)
SHIFT = (
    "solidBodyMotionFunction linearMotion; "
    f"velocity ({-2 * RADIUS / AROUND:.15g} 0 0);"
)
