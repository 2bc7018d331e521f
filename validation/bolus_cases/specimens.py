# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Small cases of the solver: the compression tutorial, and blocks in a box.

All run in a folder of their own, serially unless said. SI units.
"""

import re
import shutil
from pathlib import Path

import numpy as np
from bolus_results.fields import Mesh
from bolus_results.tables import read_table

from bolus_cases.synthetic import (
    box_mesh,
    run,
    write_control,
    write_field,
    write_file,
    write_laplacian_motion,
    write_motion_fields,
)

ROOT = Path(__file__).parents[2]
COMMON = ROOT / "tutorials" / "common"
TUTORIAL = ROOT / "tutorials" / "rheology" / "compression"

HEIGHT = 0.020  # of the tutorial's cylinder [m]

FUNCTIONS = "".join(
    f'{name} {{ type {kind}; libs ("libbolusFunctionObjects.so"); {more} }}\n'
    for name, kind, more in (
        ("retainedMass", "retainedMass", ""),
        ("freeSurface", "freeSurface", ""),
        ("energyBalance", "energyBalance", ""),
    )
)

# A wall's condition for U
SLIDING = "type contactWall; friction { type none; }"
GRIPPING = SLIDING + " separation no;"


def rub(mu: float) -> str:
    """A wall with Coulomb friction mu [-]."""
    return f"type contactWall; friction {{ type coulomb; mu {mu}; }}"


def run_case(*arguments, ok: bool = True) -> str:
    """scripts/runCase, as ./Allrun run calls it; returns what it printed."""
    return run(ROOT, "scripts/runCase", *map(str, arguments), ok=ok)


def replace(path: Path, pattern: str, by: str) -> None:
    """Replace what must be there, once, in a file."""
    text, count = re.subn(pattern, lambda _: by, path.read_text(), count=1)
    assert count == 1, f"{path} has no {pattern}"
    path.write_text(text)


# --- the tutorial ------------------------------------------------------------


def prepare_compression(
    case: Path,
    material: str = "viscoplastic",
    gas: str = "",
    solver: str = "",
    **entries,
) -> Path:
    """A copy of the tutorial with these entries of caseParameters, meshed.

    gas, solver    entries of the sub-dictionaries gas of bolusProperties
                    and bolus of fvSolution
    """
    shutil.copytree(
        TUTORIAL,
        case,
        ignore=shutil.ignore_patterns("[0-9]", "log.*", "postProcessing"),
        dirs_exist_ok=True,
    )
    shutil.copytree(case / "0.orig", case / "0")
    for name, number in entries.items():
        replace(
            case / "system" / "caseParameters",
            rf"\n{name}\s[^;]*;",
            f"\n{name} {number};",
        )
    write_file(
        case / "constant" / "bolusProperties",
        f'#include "{COMMON}/bolusProperties.{material}"\n'
        + (f"gasCoeffs {{ {gas} }}\n" if gas else ""),
    )
    replace(
        case / "system" / "fvSolution",
        r"\nbolus \{\}",
        f"\nbolus {{ {solver} }}" if solver else "\nbolus {}",
    )
    run(case, "python", "system/makeMotion.py")
    run(case, "blockMesh")
    run(case, "topoSet")
    run(case, "setAlphaField")
    return case


class Compression:
    """Tables of a run of the tutorial, each (n,) over the steps.

    time [s], path [-] that the platen has gone, strain [-] (compression > 0),
    force [N] on the moving platen (full cylinder, pressing > 0), section [m2]
    """

    def __init__(self, case, rate=0.1, largest=0.5):
        table = read_table(case, "contactForce")
        surface = read_table(case, "freeSurface")
        self.case = Path(case)
        self.time = table.time
        self.path = rate * self.time
        self.strain = np.copysign(
            np.minimum(self.path, 2 * abs(largest) - self.path), largest
        )
        self.force = table["axial"]
        self.tensile = table["tensile"]
        # Force and volume are both those of the wedge times the same factor,
        # so the wedge's flat sides (0.13 % less volume) cancel
        self.section = surface["volume"] / (HEIGHT * np.exp(-self.strain))
        self.stress = self.force / self.section
        self.steps = read_table(case, "solver", "steps")

    def at(self, name: str, path: float) -> float:
        """A column where the platen has gone this path [-]."""
        return float(np.interp(path, self.path, getattr(self, name)))


def compression(case: Path, *options, **entries) -> Compression:
    """Run the tutorial with these entries, bolusFoam with these options."""
    prepare_compression(case, **entries)
    (case / "log.bolusFoam").write_text(run(case, "bolusFoam", *options))
    return Compression(
        case,
        rate=float(entries.get("strainRate", 0.1)),
        largest=float(entries.get("strain", 0.5)),
    )


# --- blocks in a box ---------------------------------------------------------


def box(
    case: Path,
    size,
    counts,
    patches: dict,
    end: float,
    step: float,
    block=None,
    material: str = "viscoplastic",
    measured=("x1",),
    damaged: bool = False,
    thickness: float = 0.01,
) -> Mesh:
    """Write a case: a block of bolus in a box, of which walls move.

    size     (x, y) [m] of a plane mesh, or (x, y, z)
    counts   numbers of cells, likewise
    patches  {x0, x1, y0, y1[, z0, z1]: what}, where what is
             "symmetryPlane", "open", or the condition for U of a wall, or
             (that condition, table), table the wall's displacements
             [(t [s], (x, y, z) [m]), ...]
    block    size of the block of bolus, from the origin on or ((x0, x1), ...)
             [m], aligned with the cells (None: everything)
    end, step   [s]
    thickness   of a plane mesh [m]
    measured    patches with a function object force<Patch>: contactForce
    """
    plane = len(size) == 2
    size = (*size, thickness) if plane else size
    counts = (*counts, 1) if plane else counts
    what = dict(patches)
    if plane:
        what |= {"z0": "empty", "z1": "empty"}

    kinds, velocity, displacement = {}, {}, {}
    for name, given in what.items():
        condition, table = (given, None) if isinstance(given, str) else given
        if condition in ("symmetryPlane", "empty"):
            kinds[name] = condition
            velocity[name] = displacement[name] = f"type {condition};"
            continue
        kinds[name] = "patch" if condition == "open" else "wall"
        if condition == "open":
            condition = "type zeroGradient;"
        velocity[name] = condition
        displacement[name] = "type zeroGradient;"
        if table:
            rows = "".join(
                f"({t:.12g} ({x:.15g} {y:.15g} {z:.15g}))\n"
                for t, (x, y, z) in table
            )
            displacement[name] = (
                f"type uniformFixedValue; uniformValue table\n(\n{rows});"
            )

    forces = "".join(
        f"force{name.upper()} {{ type contactForce; patches ({name}); "
        'libs ("libbolusFunctionObjects.so"); }\n'
        for name in measured
    )
    write_control(
        case,
        end=end,
        functions=FUNCTIONS + forces,
        application="bolusFoam",
        libs='("libbolusContact.so")',  # U, for decomposePar
        deltaT=step,
        maxDeltaT=step,
        minDeltaT=step / 1000,
        writeControl="adjustableRunTime",
        writeInterval=end,
        writePrecision=12,
        timePrecision=8,
    )
    for name in ("fvSchemes", "fvSolution"):
        shutil.copy(TUTORIAL / "system" / name, case / "system" / name)
    write_file(
        case / "constant" / "bolusProperties",
        f'#include "{COMMON}/bolusProperties.{material}"\n',
    )
    write_laplacian_motion(case)
    mesh = box_mesh(case, size, counts, kinds)

    alpha = np.ones(mesh.n_cells)
    for i, ends in enumerate(block or ()):
        low, high = (0, ends) if np.isscalar(ends) else ends
        x = mesh.cell_centres[:, i]
        alpha *= (x > low) & (x < high)
    write_field(case, mesh, 0, "alpha", alpha)
    if damaged:
        write_field(case, mesh, 0, "D", 1.0)
    write_motion_fields(case, velocity, displacement)
    return mesh


def ramp(end: float, move, n: int = 400):
    """A table of displacements: move(t) -> (x, y, z) [m] from 0 to end [s]."""
    return [(t, move(t)) for t in np.linspace(0, end, n + 1)]


def solve(case: Path) -> None:
    """Run bolusFoam in a case, with a log."""
    (case / "log.bolusFoam").write_text(run(case, "bolusFoam"))
