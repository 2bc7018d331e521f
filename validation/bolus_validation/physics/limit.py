# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Group B: forces at plastic collapse, known exactly from slip lines."""

from pathlib import Path

import numpy as np
from bolus_cases.mapped import (
    OPEN,
    STICK,
    SYMMETRY,
    THICKNESS,
    Side,
    build,
    draw_cells,
    finish,
    graded,
    material,
    perfect,
    picture,
)

from bolus_validation.studies import Findings, study

# Shear strength [Pa] and its von Mises stress; time of the push [s]
SHEAR = 5e3
YIELD = np.sqrt(3) * SHEAR
END = 1.0

# Half the width of the punch, radius of the cylinder [m]
HALF = 0.005

PRANDTL = 2 + np.pi
CYLINDER = 2 * np.pi + 4 * np.sqrt(2)


def punch(case: Path, n: int, stiffness: float, push: float, **options):
    """A rough rigid punch pressed into a half space, half of it meshed.

    n           cells under half the punch
    stiffness   E/s_u [-]
    push        way of the punch over half its width [-]
    Returns way/half width and force/(width thickness s_u), both (steps,),
    and the written fields.
    """
    left, right, down = n, n, 2 * n
    split = left / (left + right)

    def place(unit):
        x, y = unit.T
        inner = 1 - graded(1 - x / split, left, 8)
        outer = 1 + 4 * graded((x - split) / (1 - split), right, 64)
        depth = 3 * graded(1 - y, down, 32)
        xx = np.where(x < split + 1e-9, inner, outer)
        return HALF * np.column_stack([xx, -depth])

    def move(t, points):
        return np.tile((0, -push * HALF * t / END, 0), (len(points), 1))

    steps = options.pop("steps", 20)
    build(
        case,
        (left + right, down),
        place,
        {
            "x0": SYMMETRY,
            "x1": Side(STICK, "still"),
            "y0": Side(STICK, "still"),
            "punch": Side(STICK, move),
            "free": OPEN,
        },
        material(perfect(YIELD), stiffness * SHEAR, **options.pop("law", {})),
        END,
        END / steps,
        split={
            "y1": {
                "punch": lambda c: c[:, 0] < HALF,
                "free": lambda c: c[:, 0] > HALF,
            }
        },
        measured={"push": "patches (punch); axis (0 1 0);"},
        **options,
    )
    fields, force = finish(case, "push")
    way = push * force.time / END
    return way, force["axial_mesh"] / (HALF * THICKNESS * SHEAR), fields


def cylinder(case: Path, n: int, stiffness: float, push: float, **options):
    """A rough cylinder pushed sideways, half of it meshed by an O-grid.

    n           cells along a quarter of its circumference
    stiffness, push   as of the punch, over its radius
    Returns way/radius and force/(diameter thickness s_u), both (steps,),
    and the written fields.
    """
    far = options.pop("far", 16.0)
    # Thin cells at the cylinder: they carry the slip along it, and their
    # centres are the radius at which it happens
    across = round(options.pop("across", 1.0) * n * np.log(far))
    thin = options.pop("thin", 16)

    def place(unit):
        r = far ** graded(unit[:, 0], across, thin)
        angle = np.pi * unit[:, 1]
        return HALF * np.column_stack([r * np.cos(angle), r * np.sin(angle)])

    def move(t, points):
        return np.tile((push * HALF * t / END, 0, 0), (len(points), 1))

    steps = options.pop("steps", 20)
    build(
        case,
        (across, 2 * n),
        place,
        {
            "x0": Side(STICK, move),
            "x1": Side(STICK, "still"),
            "y0": SYMMETRY,
            "y1": SYMMETRY,
        },
        material(perfect(YIELD), stiffness * SHEAR, **options.pop("law", {})),
        END,
        END / steps,
        measured={"push": "patches (x0); axis (1 0 0);"},
        **options,
    )
    fields, force = finish(case, "push")
    way = push * force.time / END
    return way, -force["axial_mesh"] / (HALF * THICKNESS * SHEAR), fields


def collapse(
    folder: Path, quick: bool, run, exact: float, name: str, window, way_name
) -> Findings:
    """Force at collapse on several meshes and for several E/s_u.

    run      punch or cylinder
    window   (x, y) limits of the picture, in half widths
    """
    found = Findings()
    meshes = (8,) if quick else (8, 16, 32)
    curves, last = {}, {}
    for n in meshes:
        way, force, fields = run(folder / f"mesh{n}", n, 1e4, 0.01)
        curves[f"{n} cells, E/s_u 1e4"] = way, force
        last[n] = force[-1]
        found.row(
            f"{name}, {n} cells",
            "s_u d",
            force[-1],
            exact,
            # The coarser ones are for the order
            limit=0.02 if n == 32 else (0.07 if quick else None),
        )
    if not quick:
        found.order(
            name,
            [HALF / n for n in meshes],
            [last[n] / exact - 1 for n in meshes],
        )
        stiff = {1e4: last[16]}
        for stiffness, push in ((100, 0.2), (1e3, 0.05), (1e5, 0.01)):
            way, force, _ = run(
                folder / f"stiffness{stiffness:g}", 16, stiffness, push
            )
            stiff[stiffness] = force[-1]
            curves[f"16 cells, E/s_u {stiffness:.0e}"] = way, force
        for stiffness in sorted(stiff):
            found.row(
                f"16 cells, E/s_u = {stiffness:.0e}",
                "s_u d",
                stiff[stiffness],
                stiff[1e5],
                limit=0.005 if stiffness == 1e4 else None,
                remark="against E/s_u = 1e5",
            )
        found.remarks.append(
            "Velocities jump along slip lines: first order in h is what "
            "there is to expect. At E/s_u of 1e3 and below the shape changes "
            "before the force has settled."
        )

    def paint(left, right):
        for label, (way, force) in curves.items():
            stiffness = float(label.split()[-1])
            left.plot(way * stiffness, force, label=label, lw=1)
        left.axhline(exact, color="k", ls="--", label="exact")
        left.set(
            xlim=(0, 150),
            xlabel=f"{way_name} times E/s_u",
            ylabel="force / (d s_u thickness)",
        )
        left.legend(fontsize=7)
        end = max(fields.times)
        speed = np.linalg.norm(fields.field(end, "U"), axis=1)
        draw_cells(
            right,
            fields.mesh(end),
            speed / speed.max(),
            HALF,
            "speed / largest",
        )
        right.set(xlim=window[0], ylim=window[1])

    found.picture = picture(folder, "collapse.png", paint, 2)
    return found


@study(
    "punch",
    "B",
    "Rough punch on a half space",
    "Prandtl (1920): force per width and thickness (2 + pi) s_u",
)
def punch_study(folder: Path, quick: bool) -> Findings:
    """See collapse."""
    return collapse(
        folder,
        quick,
        punch,
        PRANDTL,
        "force of the punch",
        ((0, 3.5), (-2, 0.2)),
        "way / half width",
    )


@study(
    "cylinder",
    "B",
    "Rough cylinder pushed sideways",
    "Randolph and Houlsby (1984): force per diameter and thickness "
    "(2 pi + 4 sqrt 2) s_u = 11.94 s_u",
)
def cylinder_study(folder: Path, quick: bool) -> Findings:
    """See collapse."""
    return collapse(
        folder,
        quick,
        cylinder,
        CYLINDER,
        "force of the cylinder",
        ((-4, 4), (0, 4)),
        "way / radius",
    )
