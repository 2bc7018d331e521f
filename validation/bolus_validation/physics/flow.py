# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Group A: flow through a pipe, for laws with rate dependence.

A wedge of a pipe whose wall holds the bolus. A wall across the inlet moves in
with a blunt profile, which is not the answer; the outlet is open. The body is
made so stiff (E = 40,000 yield stresses) that it flows from the first
thousandth of a radius on, and the shape of the domain stays as it is.

The pipe has to be long: where inlet or outlet are faster or slower than the
plug, they push or pull it, it passes that on as a rod would, up to its yield
stress, and the pressure gradient differs from that of an endless pipe by
parts of yield stress/length. A pipe of 5 radii is off by 2 %.
"""

from pathlib import Path

import numpy as np
from scipy.integrate import cumulative_trapezoid
from scipy.optimize import brentq

from bolus_validation import rheology
from bolus_validation.physics.cases import (
    OPEN,
    STICK,
    Side,
    build,
    finish,
    material,
    picture,
)
from bolus_validation.studies import Findings, study

RADIUS = 0.005  # [m]
BLUNT = 5  # exponent of the profile at the inlet [-]
LENGTH = 20  # of the pipe [radii]
STIFFNESS = 1.64e8  # Young's modulus [Pa]
WAY = 0.01  # mean, of the flow [radii]

# Text of flowStress, law, and mean velocity [radii/s]; the tabulated law has
# no rate dependence above 1/s, so its flow is slow enough to stay below
LAWS = {
    "Herschel-Bulkley": (
        "type HerschelBulkley; sigma0 4100; k 11000; n 0.29;",
        rheology.HerschelBulkley(),
        5.0,
    ),
    "tabulated": (
        "type tabulated; table ((0 4100) (0.01 7000) (0.1 9600) (1 15200));",
        rheology.Tabulated(rheology.RATES, rheology.STRESSES),
        0.1,
    ),
}


def exact(law, mean: float, n: int = 20001):
    """Fully developed flow: pressure gradient [Pa/m] and profile.

    mean   velocity [m/s]
    Returns the gradient, radii (n,) [m] and velocities (n,) [m/s], by
    quadrature of the shear rate sqrt(3) r(sqrt(3) tau) at tau = gradient r/2.
    """
    r = np.linspace(0, RADIUS, n)

    def profile(gradient):
        rate = [
            np.sqrt(3) * law.rate(np.sqrt(3) * 0.5 * gradient * x) for x in r
        ]
        inner = cumulative_trapezoid(rate, r, initial=0)
        return inner[-1] - inner

    def excess(gradient):
        u = profile(gradient)
        return 2 * np.trapezoid(u * r, r) / RADIUS**2 - mean

    least = 2 * 4100 / np.sqrt(3) / RADIUS
    found = brentq(excess, least * 1.001, least * 8, rtol=1e-10)
    return found, r, profile(found)


def pipe(case: Path, flow: str, mean: float, n: int, steps: int = 10):
    """Flow at a mean velocity [m/s], n cells along the radius.

    Returns the pressure gradient [Pa/m] of the middle of the pipe and, of
    its section, the node radii (n, 2) [m] and axial velocity (n,) [m/s] of
    the cells.
    """

    def place(unit):
        return RADIUS * unit * (LENGTH, 1)

    end = WAY * RADIUS / mean

    def enter(t, points):
        r = np.hypot(points[:, 1], points[:, 2]) / RADIUS
        peak = mean * (1 + 2 / BLUNT)
        return np.outer(peak * t * (1 - np.minimum(r, 1) ** BLUNT), (1, 0, 0))

    build(
        case,
        (3 * n, n),
        place,
        {
            "x0": Side(STICK, enter),
            "x1": OPEN,
            "y1": Side(STICK, "still"),
        },
        material(flow, STIFFNESS),
        end,
        end / steps,
        wedge=True,
    )
    fields, _ = finish(case)
    end = max(fields.times)
    mesh = fields.mesh(end)
    x, r = mesh.cell_centres[:, 0] / RADIUS, mesh.radii
    middle = (x > 0.35 * LENGTH) & (x < 0.65 * LENGTH)
    slope = np.polyfit(
        mesh.cell_centres[middle, 0], fields.field(end, "p")[middle], 1
    )[0]
    nearest = x[np.argmin(abs(x - 0.5 * LENGTH))]
    column = np.flatnonzero(abs(x - nearest) < 0.01)
    column = column[np.argsort(r[column])]
    edges = np.arange(n + 1) * RADIUS / n
    return (
        -slope,
        np.column_stack([edges[:-1], edges[1:]]),
        fields.field(end, "U")[column, 0],
    )


@study(
    "pipe",
    "A",
    "Flow through a pipe",
    "fully developed flow, by quadrature of the law",
)
def pipe_study(folder: Path, quick: bool) -> Findings:
    """Pressure gradient and velocity profile."""
    found = Findings(
        remarks=[
            "Near 0.1 % of the gradient is left by the ends of the pipe, at "
            "any mesh."
        ]
    )
    meshes = (8,) if quick else (4, 8, 16)
    drawn = {}
    for name, (flow, law, speed) in LAWS.items():
        mean = speed * RADIUS
        gradient, radii, profile = exact(law, mean)
        errors, profile_errors = [], []
        for n in meshes:
            slope, edges, velocity = pipe(folder / f"{name}{n}", flow, mean, n)
            # A cell's velocity is the mean of its nodes'
            expected = np.interp(edges, radii, profile).mean(axis=1)
            errors.append(slope / gradient - 1)
            profile_errors.append(
                np.sqrt(np.mean((velocity - expected) ** 2)) / profile[0]
            )
        drawn[name] = radii, profile, edges.mean(axis=1), velocity, expected
        found.row(
            f"{name}: pressure gradient",
            "Pa/m",
            slope,
            gradient,
            limit=0.03 if quick else 0.01,
        )
        found.row(
            f"{name}: profile, rms",
            "largest velocity",
            profile_errors[-1],
            0.0,
            limit=0.03 if quick else 0.01,
            scale=1,
            remark="largest "
            f"{np.max(abs(velocity - expected)) / profile[0]:.2%}",
        )
        if not quick:
            sizes = [RADIUS / n for n in meshes]
            found.order(f"{name}: pressure gradient", sizes, errors, least=1.5)
            found.order(f"{name}: profile", sizes, profile_errors)

    def paint(*axes):
        for axis, (name, values) in zip(axes, drawn.items(), strict=True):
            radii, profile, r, velocity, _ = values
            axis.plot(radii / RADIUS, profile * 1e3, "k-", label="exact")
            axis.plot(r / RADIUS, velocity * 1e3, "o", ms=3, label="ours")
            axis.set(title=name, xlabel="r / R", ylabel="velocity [mm/s]")
            axis.legend()

    found.picture = picture(folder, "profiles.png", paint, len(drawn))
    return found
