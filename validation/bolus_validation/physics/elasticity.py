# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Group A: thick-walled cylinder and sphere, elastic and elastic-plastic.

The inner wall moves outwards by a prescribed way, the outer surface is free.
Strains are kept below 1e-3, because the exact solutions are for small ones.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from bolus_cases.mapped import (
    ELASTIC,
    GRIP,
    STILL,
    SYMMETRY,
    THICKNESS,
    Side,
    build,
    components,
    finish,
    material,
    perfect,
    picture,
    radial,
)
from bolus_cases.synthetic import HALF_ANGLE
from bolus_results.fields import Case
from bolus_results.tables import read_table

from bolus_validation.studies import Findings, study

A, B = 0.005, 0.010  # inner and outer radius [m]
E = 100e3  # [Pa]
END = 1e-3  # short, so that rates are well above the solver's tolerance [s]


@dataclass
class Shell:
    """A cylinder (plane strain, d = 2) or a sphere (d = 3) with its solution.

    nu        of the material
    strength  yield stress [Pa]; None: elastic
    """

    d: int
    nu: float
    strength: float | None = None

    def __post_init__(self):
        self.shear = E / (2 * (1 + self.nu))
        self.bulk = E / (3 * (1 - 2 * self.nu))
        # Of in-plane dilation: lambda + G, 3 K
        self.modulus = (
            2 * (self.bulk + self.shear / 3) if self.d == 2 else 3 * self.bulk
        )

    # Elastic: u = p r + q r^(1-d)

    def _constants(self, way: float, inner: float = A):
        """p and q where u(inner) = way and the outer surface is free."""
        factor = 2 * (self.d - 1) * self.shear / self.modulus / B**self.d
        q = way / (factor * inner + inner ** (1 - self.d))
        return factor * q, q

    def elastic(self, way: float, r):
        """Radial and hoop stress [Pa] at radii r for a way of the wall."""
        p, q = self._constants(way)
        sink = 2 * self.shear * q / np.asarray(r) ** self.d
        return (
            self.modulus * p - (self.d - 1) * sink,
            self.modulus * p + sink,
        )

    # Elastic-plastic, with the front at radius c

    @property
    def _limit(self) -> float:
        """Difference of hoop and radial stress at yield [Pa]."""
        return self.strength * (2 / np.sqrt(3) if self.d == 2 else 1)

    def pressure(self, c):
        """Inner pressure [Pa], Hill (1950), chapter V."""
        d, y = self.d, self._limit
        return y * ((d - 1) * np.log(c / A) + (d - 1) / d * (1 - (c / B) ** d))

    def way(self, c: float) -> float:
        """Displacement [m] of the inner wall."""
        if self.d == 2:
            # Incompressible: u r is the same everywhere
            assert self.nu > 0.4998
            return self._limit * c**2 / (4 * self.shear * A)
        ratio = c / A
        return (
            self.strength
            * A
            / E
            * (
                (1 - self.nu) * ratio**3
                - 2
                / 3
                * (1 - 2 * self.nu)
                * (1 + 3 * np.log(ratio) - (c / B) ** 3)
            )
        )

    def plastic(self, c: float, r):
        """Radial and hoop stress [Pa] at radii r."""
        d, y = self.d, self._limit
        r = np.asarray(r)
        edge = -y * (d - 1) / d * (1 - (c / B) ** d)
        inside = edge - (d - 1) * y * np.log(c / r)
        share = y / d * (c / B) ** d
        outside = share * (d - 1) * (1 - (B / r) ** d)
        radial_stress = np.where(r < c, inside, outside)
        hoop = np.where(r < c, inside + y, share * ((d - 1) + (B / r) ** d))
        return radial_stress, hoop


@dataclass
class Run:
    """What a run gave: way [m] of the wall over the steps, inner pressure [Pa]
    by the wall's power and by its force, and the written fields."""

    way: np.ndarray
    pressure: np.ndarray
    by_force: np.ndarray
    case: Case

    def profile(self, time: float):
        """Radii [m], radial and hoop stresses [Pa] of the cells."""
        mesh = self.case.mesh(time)
        stress = self.case.field(time, "stress")
        centres = mesh.cell_centres
        outwards = radial(centres * (1, 1, 0 if not mesh.axisymmetric else 1))
        radius = np.sum(centres * outwards, axis=1)
        # The hoop direction that lies in the plane or meridian
        along = np.cross(outwards, (0, 0, 1.0))
        along /= np.linalg.norm(along, axis=1)[:, None]
        return (
            radius,
            components(stress, outwards),
            components(stress, along),
        )


def expand(case: Path, shell: Shell, n: int, ways, steps: int, **options):
    """Expand a shell: n cells across its wall, to the ways [m] in turn."""

    def place(unit):
        if shell.d == 2:
            angle = 0.5 * np.pi * (1 - unit[:, 0])
            r = A + (B - A) * unit[:, 1]
        else:
            r, angle = A + (B - A) * unit[:, 0], 0.5 * np.pi * unit[:, 1]
        return np.column_stack([r * np.cos(angle), r * np.sin(angle)])

    def move(t, points):
        outwards = (
            radial(points * (1, 1, 0)) if shell.d == 2 else radial(points)
        )
        return np.interp(t, knots, [0, *ways]) * outwards

    knots = [0, *(END * (i + 1) / len(ways) for i in range(len(ways)))]
    inner, outer = Side(GRIP, move), STILL
    flow = ELASTIC if shell.strength is None else perfect(shell.strength)
    wedge = shell.d == 3
    patch = "x0" if wedge else "y0"
    mesh = build(
        case,
        (n, 2 * n) if wedge else (2 * n, n),
        place,
        {"x0": inner, "x1": outer, "y0": SYMMETRY, "y1": SYMMETRY}
        if wedge
        else {"x0": SYMMETRY, "x1": SYMMETRY, "y0": inner, "y1": outer},
        material(flow, E, shell.nu),
        END,
        END / steps,
        wedge=wedge,
        knots=knots,
        write=END / len(ways),
        measured={"push": f"patches ({patch});"},
        functions=f"work {{ type externalWork; patches ({patch}); "
        'libs ("libbolusFunctionObjects.so"); }',
        **options,
    )
    fields, force = finish(case, "push")
    way = np.interp(force.time, knots, [0, *ways])
    power = read_table(case, "work", "externalWork")["power_mesh"]
    # Volume that the inner surface of the mesh sweeps for a way of the wall
    faces = list(mesh.patches[patch].faces)
    flux = mesh.face_centres[faces] * mesh.face_areas[faces]
    if not wedge:
        flux = flux[:, :2]
    speed = np.diff(way, prepend=0) / np.diff(force.time, prepend=-END)
    sweep = abs(flux.sum()) / A * np.maximum(speed, 1e-30)
    # Projection of that surface along the force
    area = 0.5 * A**2 * np.sin(2 * HALF_ANGLE) if wedge else A * THICKNESS
    return Run(way, power / sweep, -force["axial_mesh"] / area, fields)


NAMES = {2: "cylinder", 3: "sphere"}
FORCE_REMARK = (
    "The force on the wall is that of the function object contactForce, along "
    "x, over the projection of the wall; the pressure is by the wall's power."
)


@study(
    "shellElastic",
    "A",
    "Thick-walled cylinder and sphere, elastic",
    "Lame (1852), b/a = 2, nu = 0.49",
)
def elastic_study(folder: Path, quick: bool) -> Findings:
    """Inner pressure and stress profile for a way of the wall of 1e-4 a."""
    found = Findings(remarks=[FORCE_REMARK])
    way = 1e-4 * A
    profiles = {}
    meshes = (8,) if quick else (4, 8, 16)
    for d, name in NAMES.items():
        shell = Shell(d, 0.49)
        exact = -shell.elastic(way, A)[0]
        errors, stress_errors = [], []
        for n in meshes:
            run = expand(folder / f"{name}{n}", shell, n, [way], 2)
            r, along, hoop = run.profile(END)
            expected = shell.elastic(way, r)
            differ = np.concatenate([along - expected[0], hoop - expected[1]])
            errors.append(run.pressure[-1] / exact - 1)
            stress_errors.append(np.sqrt(np.mean(differ**2)) / exact)
        profiles[name] = shell, exact, r, along, hoop
        found.row(
            f"{name}: inner pressure", "Pa", run.pressure[-1], exact, limit=0.01
        )
        found.row(
            f"{name}: inner pressure by force",
            "Pa",
            run.by_force[-1],
            exact,
            limit=None if quick else 0.01,
        )
        found.row(
            f"{name}: stress, largest error of a cell",
            "p",
            np.max(abs(differ)) / exact,
            0.0,
            limit=0.01,
            scale=1,
        )
        if not quick:
            sizes = [(B - A) / n for n in meshes]
            found.order(f"{name}: inner pressure", sizes, errors, least=1.5)
            found.order(f"{name}: stress, rms", sizes, stress_errors, least=1.5)

    def paint(*axes):
        for axis, (name, values) in zip(axes, profiles.items(), strict=True):
            shell, exact, r, along, hoop = values
            line = np.linspace(A, B, 200)
            for got, want, word in zip(
                (along, hoop),
                shell.elastic(way, line),
                ("radial", "hoop"),
                strict=True,
            ):
                axis.plot(r / A, got / exact, ".", ms=4, label=f"{word}, ours")
                axis.plot(line / A, want / exact, "k-", lw=0.8)
            axis.set(
                title=name, xlabel="r / a", ylabel="stress / inner pressure"
            )
            axis.legend()

    found.picture = picture(folder, "profiles.png", paint, 2)
    return found


@study(
    "shellPlastic",
    "A",
    "Thick-walled cylinder and sphere with a plastic front",
    "Hill (1950), b/a = 2; sphere: nu = 0.49, cylinder: incompressible, "
    "nu = 0.4999; E = 1e4 yield stresses",
)
def plastic_study(folder: Path, quick: bool) -> Findings:
    """Inner pressure and stress profile while the front goes outwards."""
    found = Findings(remarks=[FORCE_REMARK])
    fronts = A * np.array([1.2, 1.4, 1.6, 1.8])
    meshes = (8,) if quick else (8, 16, 32)
    drawn = {}
    for d, name in NAMES.items():
        shell = Shell(d, 0.4999 if d == 2 else 0.49, E / 1e4)
        ways = [shell.way(c) for c in fronts]
        exact = shell.pressure(fronts)
        errors = []
        for n in meshes:
            run = expand(
                folder / f"{name}{n}", shell, n, ways, 20 if quick else 80
            )
            got = np.interp(ways, run.way, run.pressure)
            errors.append(np.sqrt(np.mean((got / exact - 1) ** 2)))
        drawn[name] = shell, run
        for c, p, want in zip(fronts, got, exact, strict=True):
            found.row(
                f"{name}: inner pressure at a front of {c / A:.1f} a",
                "Pa",
                p,
                want,
                limit=0.02 if quick else 0.01,
            )
        found.row(
            f"{name}: the same by force, at {c / A:.1f} a",
            "Pa",
            np.interp(ways[-1], run.way, run.by_force),
            want,
            limit=None if quick else 0.01,
        )
        times = list(run.case.times)[1:]
        for c, time in zip(fronts, times, strict=True):
            r, along, hoop = run.profile(time)
            expected = shell.plastic(c, r)
            differ = np.concatenate([along - expected[0], hoop - expected[1]])
            found.row(
                f"{name}: stress at a front of {c / A:.1f} a, rms",
                "p",
                np.sqrt(np.mean(differ**2)) / shell.pressure(c),
                0.0,
                limit=0.01,
                scale=1,
                remark=f"largest {np.max(abs(differ)) / shell.pressure(c):.2%}",
            )
        if not quick:
            found.order(
                f"{name}: inner pressure",
                [(B - A) / n for n in meshes],
                errors,
                least=1.5,
            )

    def paint(*axes):
        for i, (name, (shell, run)) in enumerate(drawn.items()):
            left, right = axes[2 * i : 2 * i + 2]
            line = np.linspace(1, 2, 200) * A
            unit = shell.strength
            left.plot(
                [shell.way(c) / A * 1e3 for c in line],
                shell.pressure(line) / unit,
                "k-",
                lw=0.8,
                label="exact, from yield on",
            )
            left.plot(run.way / A * 1e3, run.pressure / unit, ".", label="ours")
            left.set(
                title=name,
                xlabel="way of the wall / a [1e-3]",
                ylabel="inner pressure / yield stress",
            )
            left.legend()
            for c, time in zip(fronts, list(run.case.times)[1:], strict=True):
                r, _, hoop = run.profile(time)
                right.plot(r / A, hoop / unit, ".", ms=3, label=f"{c / A:.1f}")
                right.plot(
                    line / A, shell.plastic(c, line)[1] / unit, "k-", lw=0.8
                )
            right.set(
                title=f"{name}, hoop stress for fronts c / a",
                xlabel="r / a",
                ylabel="hoop stress / yield stress",
            )
            right.legend()

    found.picture = picture(folder, "fronts.png", paint, 4)
    return found
