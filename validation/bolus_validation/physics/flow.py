# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Group A: flow through a pipe, and one compression on three kinds of mesh.

The pipe is a wedge whose wall holds the bolus. A wall across the inlet moves in
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
from bolus_cases.mapped import (
    OPEN,
    STICK,
    SYMMETRY,
    Side,
    build,
    finish,
    material,
    picture,
)
from scipy.integrate import cumulative_trapezoid
from scipy.optimize import brentq

from bolus_validation import rheology
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
    for name in ("tabulated",) if quick else LAWS:
        flow, law, speed = LAWS[name]
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


# --- the same compression on three kinds of mesh -----------------------------

SIDE = 0.015  # of the meshes, across; the bolus ends between cells [m]
RADIUS_BOLUS, HEIGHT = 0.010, 0.010  # [m]
STRAIN_RATE = 0.1  # [1/s]
FLOW = LAWS["Herschel-Bulkley"]


def sampled(centres, cell, inside, n: int = 20):
    """Part of each cell (cell sizes [m] in y and z) that inside(y, z) holds."""
    ticks = (np.arange(n) + 0.5) / n - 0.5
    dy, dz = (g.ravel() for g in np.meshgrid(ticks, ticks))
    return inside(
        centres[:, 1:2] + cell * dy, centres[:, 2:3] + cell * dz
    ).mean(axis=1)


def compressed(
    case: Path, kind: str, n: int, friction: str, strain: float, step: float
):
    """Compress a bolus between platens; its free side has gas around it.

    kind    "wedge" and "solid" (a quarter): a cylinder; "plane": a block of
            the cylinder's diameter, half of it
    n       cells along the height, and for as much across
    step    Hencky strain of a step
    Returns strain and mean stress [Pa] over the steps: force times height
    over volume.
    """
    end = strain / STRAIN_RATE
    across = round(n * SIDE / HEIGHT)
    cell = SIDE / across

    def place(unit):
        size = np.full(unit.shape[1], SIDE)
        size[0] = HEIGHT
        return unit * size

    def press(t, points):
        return points * (np.expm1(-STRAIN_RATE * t), 0, 0)

    def fraction(centres):
        if kind == "solid":
            return sampled(
                centres, cell, lambda y, z: y**2 + z**2 < RADIUS_BOLUS**2
            )
        r = centres[:, 1]
        if kind == "wedge":
            r = np.hypot(centres[:, 1], centres[:, 2])
        return (r < RADIUS_BOLUS).astype(float)

    wall = f"type contactWall; friction {{ {friction} }}"
    sides = {"x0": Side(wall, "still"), "x1": Side(wall, press), "y1": OPEN}
    if kind != "wedge":
        sides["y0"] = SYMMETRY
    if kind == "solid":
        sides |= {"z0": SYMMETRY, "z1": OPEN}
    build(
        case,
        (n, across, across) if kind == "solid" else (n, across),
        place,
        sides,
        material(FLOW[0], rheology.E, rheology.NU),
        end,
        step / STRAIN_RATE,
        wedge=kind == "wedge",
        knots=np.linspace(0, end, 101).tolist(),
        fraction=fraction,
        measured={"push": "patches (x1);"},
        write=end / 4,
    )
    fields, force = finish(case, "push")
    times = sorted(fields.times)
    volume = [
        fields.mesh(t).cell_volumes @ fields.field(t, "alpha") for t in times
    ]
    height = HEIGHT * np.exp(-STRAIN_RATE * force.time)
    return (
        STRAIN_RATE * force.time,
        force["axial_mesh"] * height / np.interp(force.time, times, volume),
    )


@study(
    "meshKinds",
    "A",
    "The same compression in a wedge, a plane and a quarter of a cylinder",
    "Runge and Kutta's method for the uniaxial rate equation, 2/sqrt(3) of "
    "the flow stress in plane strain; with friction: the wedge",
)
def mesh_kinds_study(folder: Path, quick: bool) -> Findings:
    """Force against theory; with friction, against the wedge."""
    found = Findings(
        remarks=[
            "Mean stress is force times height over volume. The force of a "
            "step is that on the section at its start: a lag of one step of "
            "strain, 0.5 %."
        ]
    )
    n, strain, step = (4, 0.15, 0.01) if quick else (8, 0.3, 0.005)
    law = FLOW[1]
    factor = 2 / np.sqrt(3)
    plateau = factor * (law.sigma0 + law.k * (factor * STRAIN_RATE) ** law.n)
    curves = {}
    for kind in ("wedge", "plane", "solid"):
        strains, stress = compressed(
            folder / kind, kind, n, "type none;", strain, step
        )
        curves[f"{kind}, no friction"] = strains, stress
        if kind == "plane":
            want = plateau
        else:
            want = rheology.uniaxial_rate_law(
                law, STRAIN_RATE, strains[1:] / STRAIN_RATE
            )[-1]
        found.row(
            f"{kind}, no friction: stress at a strain of {strain}",
            "Pa",
            stress[-1],
            want,
            limit=0.03 if quick else 0.01,
        )
    # With friction the force of a coarse wedge is not yet that of a fine one
    for label, kind, m in (
        ("wedge", "wedge", n),
        ("fine wedge", "wedge", 2 * n),
        ("solid", "solid", n),
    ):
        curves[f"{label}, mu 0.3"] = compressed(
            folder / f"{kind}{m}Friction",
            kind,
            m,
            "type coulomb; mu 0.3;",
            strain,
            step,
        )
    mean, rough = {}, {}
    for kind in ("wedge", "fine wedge", "solid"):
        strains, stress = curves[f"{kind}, mu 0.3"]
        late = strains > 2 / 3 * strain
        mean[kind] = stress[late].mean()
        line = np.polyval(
            np.polyfit(strains[late], stress[late], 1), strains[late]
        )
        rough[kind] = np.max(abs(stress[late] - line)) / mean[kind]
    for kind in ("wedge", "solid"):
        found.row(
            f"{kind}, mu 0.3: mean stress over the last third of the strain",
            "Pa",
            mean[kind],
            mean["fine wedge"],
            limit=None if kind == "wedge" else (0.05 if quick else 0.01),
            remark="against a wedge of half the cell size",
        )
    for kind, value in rough.items():
        found.row(
            f"{kind}, mu 0.3: largest deviation from a straight line there",
            "mean stress",
            value,
            remark="as the free side crosses the cells",
        )

    def paint(axis):
        for label, (strains, stress) in curves.items():
            axis.plot(strains, stress, label=label, lw=1)
        strains = np.linspace(0, strain, 200)
        axis.plot(
            strains,
            rheology.uniaxial_rate_law(law, STRAIN_RATE, strains / STRAIN_RATE),
            "k--",
            lw=0.8,
            label="exact, uniaxial",
        )
        axis.axhline(plateau, color="k", ls=":", label="plateau, plane strain")
        axis.set(xlabel="strain", ylabel="force height / volume [Pa]")
        axis.legend(fontsize=7)

    found.picture = picture(folder, "curves.png", paint)
    return found
