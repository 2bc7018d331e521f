# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Small cutting cases for tests and studies. SI units.

The tutorial with other parameters, and a cylinder that moves, embedded,
through a perfectly plastic body, whose force is known exactly.
"""

import re
import shutil
from pathlib import Path

import numpy as np
from bolus_cases import cutting
from bolus_cases.specimens import replace, solve
from bolus_cases.synthetic import run, write_file
from bolus_results.tables import Table, read_table

ROOT = Path(__file__).parents[2]
TUTORIALS = ROOT / "tutorials" / "cutting"

# Force of a rough cylinder over its diameter, thickness and the shear
# strength: Randolph and Houlsby (1984)
ROUGH = 2 * np.pi + 4 * np.sqrt(2)

SHEAR = 5e3  # shear strength of the perfectly plastic body [Pa]


def copy_tutorial(case: Path, tutorial: str = "cylinder2D", **entries) -> Path:
    """A copy of a tutorial with these entries of caseParameters, not meshed.

    law    entry of constant/bolusProperties
    """
    base = TUTORIALS / tutorial / "base"
    if base.exists():
        copy_tutorial(case, Path(base.read_text().strip()).name)
    shutil.copytree(
        TUTORIALS / tutorial,
        case,
        ignore=shutil.ignore_patterns("[0-9]", "log.*", "postProcessing"),
        dirs_exist_ok=True,
    )
    if "law" in entries:
        replace(
            case / "constant" / "bolusProperties",
            r"\nlaw\s[^;]*;",
            f"\nlaw {entries.pop('law')};",
        )
    for name, value in entries.items():
        replace(
            case / "system" / "caseParameters",
            rf"\n{name}\s[^;]*;",
            f"\n{name} {value};",
        )
    return case


def prepare(case: Path, tutorial: str = "cylinder2D", **entries) -> Path:
    """A copy of a tutorial with these entries, meshed."""
    copy_tutorial(case, tutorial, **entries)
    shutil.copytree(case / "0.orig", case / "0")
    run(case, "python", "-m", "bolus_cases.cutting")
    return case


def perfectly_plastic(case: Path, E: float, nu: float, stress: float) -> None:
    """Give a case one flow stress [Pa] at all rates, instead of its law."""
    replace(
        case / "constant" / "bolusProperties",
        r"\n#include \"\$BOLUSFOAM_DIR[^\n]*",
        f"\nrho 1100;\nelasticity {{ E {E:.12g}; nu {nu:.12g}; }}\n"
        "flowStress { type tabulated; table "
        f"((0 {stress:.12g}) (1 {stress:.12g})); }}\n"
        "damage { type none; }\n",
    )


def force(case: Path) -> Table:
    """The table of toolForce."""
    return read_table(case, "toolForce")


def embedded(
    case: Path,
    per_diameter: float,
    travel: float = 1.0,
    steps: int = 100,
    stiffness: float = 1e4,
    far: float = 12.0,
    **entries,
) -> Path:
    """A rough cylinder embedded in a perfectly plastic body, ready to run.

    per_diameter   cells of the size of the mesh around the tool
    travel         of the tool over its radius
    stiffness      E/s_u [-]
    far            half the side of the body over the radius, held at its rim
    """
    radius = 2.5e-3
    size = 2 * radius / per_diameter
    near = int(entries.pop("boxCells", 2))
    case = copy_tutorial(
        case,
        cellSize=size,
        boxCells=near,
        # The axis in the middle of the body
        height=(far - 1) * radius,
        width=far * radius,
        roomSide=0.5 * far * radius,
        roomBehind=(far - 1) * radius - near * size,
        zoneAhead=near * size,
        zoneBehind=near * size,
        cellBehind=size,
        growthAhead=1.08,
        growthBehind=1.08,
        growthSide=1.08,
        travel=travel * radius,
        travelStep=travel * radius / steps,
        writeTravel=travel * radius,
        **entries,
    )
    p = cutting.read_parameters(case / "system" / "caseParameters")
    cutting.write_derived(case, p)
    path = case / "system" / "derivedParameters"
    path.write_text(
        re.sub(r"\ndeltaT[^;]*;", "\ndeltaT $maxDeltaT;", path.read_text())
    )
    mesh = cutting.write_mesh(case, p, cutting.TYPES | {"open": "wall"})
    (case / "0").mkdir()
    cutting.write_alpha(case, mesh, np.ones(mesh.n_cells))
    write_file(
        case / "0" / "U",
        "dimensions [0 1 -1 0 0 0 0];\ninternalField uniform (0 0 0);\n"
        "boundaryField\n{\n"
        "middle { type symmetryPlane; }\nfrontAndBack { type empty; }\n"
        '"tool|platen|open" { type contactWall; friction { type noSlip; } '
        "separation no; }\n}\n",
        "volVectorField",
    )
    write_file(
        case / "constant" / "bolusProperties",
        f"rho 1100;\nelasticity {{ E {stiffness * SHEAR:g}; nu 0.49; }}\n"
        "flowStress { type tabulated; table ("
        f"(0 {np.sqrt(3) * SHEAR:.12g}) (1 {np.sqrt(3) * SHEAR:.12g})); }}\n"
        "damage { type none; }\n",
    )
    replace(
        case / "constant" / "dynamicMeshDict",
        r"patch\s+tool;",
        "patch tool; embedded yes;",
    )
    return case


def embedded_force(case: Path) -> tuple[np.ndarray, np.ndarray]:
    """Run it: travel over radius, force over s_u d and thickness (steps,)."""
    solve(case)
    p = cutting.read_parameters(case / "system" / "caseParameters")
    table = force(case)
    return (
        table["travel"] / p.radius,
        table["axial"] / (SHEAR * p.diameter * p.thickness),
    )
