# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Small cases with known fields, to test what reads and measures them.

The meshes are blockMesh's; the fields are written here. A stock solver
(laplacianFoam) or postProcess runs the function objects on them: the solver
of the bolus is not needed.
"""

import os
import subprocess
from pathlib import Path

import numpy as np
from bolus_results.fields import Mesh, read_mesh

HALF_ANGLE = np.radians(2.5)

_HEADER = """FoamFile
{{
    version     2.0;
    format      ascii;
    class       {cls};
    object      {name};
}}
"""

_DIMENSIONS = {
    "wallForce": "[1 1 -2 0 0 0 0]",
    "wallPower": "[1 2 -3 0 0 0 0]",
    "massFlux": "[0 3 -1 0 0 0 0]",
    "U": "[0 1 -1 0 0 0 0]",
    "p": "[1 -1 -2 0 0 0 0]",
    "sigmaEq": "[1 -1 -2 0 0 0 0]",
}


def write_laplacian_motion(case: Path, of: str = "displacement") -> None:
    """Motion of the mesh by a stock Laplacian: displacement or velocity."""
    write_file(
        case / "constant" / "dynamicMeshDict",
        "dynamicFvMesh dynamicMotionSolverFvMesh;\n"
        'motionSolverLibs ("libfvMotionSolvers.so");\n'
        f"motionSolver {of}Laplacian;\ndiffusivity uniform;\n",
    )


def run(case: Path, *command: str, ok: bool = True) -> str:
    """Run a command in a case; returns what it printed."""
    done = subprocess.run(
        command,
        cwd=case,
        # OpenFOAM warns where it is not that of the folder
        env=os.environ | {"PWD": str(Path(case).resolve())},
        capture_output=True,
        text=True,
        check=False,
    )
    output = done.stdout + done.stderr
    if ok:
        assert done.returncode == 0, f"{' '.join(command)}\n{output[-3000:]}"
    else:
        assert done.returncode != 0, f"{' '.join(command)} did not fail"
    return output


def run_parallel(case: Path, *command: str, ranks: int = 2) -> str:
    """Cut a case into slices along x, and run a command on them."""
    write_file(
        case / "system" / "decomposeParDict",
        f"numberOfSubdomains {ranks};\nmethod simple;\n"
        f"simpleCoeffs {{ n ({ranks} 1 1); delta 0.001; }}\n",
    )
    run(case, "decomposePar")
    return run(
        case,
        *("mpirun", "--oversubscribe", "-np", str(ranks)),
        *(*command, "-parallel"),
    )


def write_file(path: Path, text: str, cls: str = "dictionary") -> None:
    """Write a file of OpenFOAM below its header."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(_HEADER.format(cls=cls, name=path.name) + text)


def _listed(rows) -> str:
    """Rows of numbers in the words of OpenFOAM."""
    return "\n".join(
        "(" + " ".join(f"{x:.17g}" for x in row) + ")" for row in rows
    )


def vectors(rows) -> str:
    """A list of OpenFOAM with its length, of (n, 3)."""
    return f"{len(rows)}\n(\n{_listed(rows)}\n)\n"


def write_blocks(case: Path, vertices, blocks, patches: dict) -> Mesh:
    """Make a mesh by blockMesh.

    vertices   (x, y, z) [m] of each
    blocks     (corners, counts) of each: eight vertices, cells along its sides
    patches    {name: (type, faces)}, of each face its vertices
    """
    write_file(
        case / "system" / "blockMeshDict",
        f"vertices (\n{_listed(vertices)}\n);\nblocks (\n"
        + "".join(
            f"hex {_listed([corners])} {_listed([counts])} "
            "simpleGrading (1 1 1)\n"
            for corners, counts in blocks
        )
        + ");\nboundary (\n"
        + "".join(
            f"{name} {{ type {kind}; faces ({_listed(faces)}); }}\n"
            for name, (kind, faces) in patches.items()
        )
        + ");\n",
    )
    if not (case / "system" / "controlDict").exists():
        write_control(case)
    run(case, "blockMesh")
    return read_mesh(case / "constant" / "polyMesh")


def box_mesh(case: Path, size, counts, kinds: dict) -> Mesh:
    """A box from the origin on; kinds: type of each patch x0, x1, y0, ..."""
    corners = [
        (x, y, z)
        for z in (0, size[2])
        for y in (0, size[1])
        for x in (0, size[0])
    ]
    faces = {
        "x0": (0, 4, 6, 2),
        "x1": (1, 3, 7, 5),
        "y0": (0, 1, 5, 4),
        "y1": (2, 6, 7, 3),
        "z0": (0, 2, 3, 1),
        "z1": (4, 5, 7, 6),
    }
    return write_blocks(
        case,
        corners,
        [((0, 1, 3, 2, 4, 5, 7, 6), counts)],
        {name: (kinds[name], [face]) for name, face in faces.items()},
    )


def wedge_mesh(
    case: Path,
    length: float,
    radius: float,
    nx: int,
    nr: int,
    patches=(("shell", "wall"), ("wall", "wall"), ("outlet", "patch")),
) -> Mesh:
    """Cylinder about x from 0 to length: a wedge of 5 degrees.

    patches   names and types at x = 0, r = radius, x = length
    """
    y, z = radius * np.cos(HALF_ANGLE), radius * np.sin(HALF_ANGLE)
    vertices = [
        (0, 0, 0),
        (length, 0, 0),
        (length, y, -z),
        (0, y, -z),
        (length, y, z),
        (0, y, z),
    ]
    faces = [[(0, 5, 3, 0)], [(3, 5, 4, 2)], [(1, 2, 4, 1)]]
    return write_blocks(
        case,
        vertices,
        [((0, 1, 2, 3, 0, 1, 4, 5), (nx, nr, 1))],
        {
            name: (kind, face)
            for (name, kind), face in zip(patches, faces, strict=True)
        }
        | {
            "wedge0": ("wedge", [(0, 3, 2, 1)]),
            "wedge1": ("wedge", [(0, 1, 4, 5)]),
            "axis": ("empty", [(0, 1, 1, 0)]),
        },
    )


def octant_mesh(case: Path, size: float, n: int) -> Mesh:
    """A cube with symmetry planes x0, y0, z0 and walls x1, y1, z1."""
    kinds = {f"{axis}0": "symmetryPlane" for axis in "xyz"}
    kinds |= {f"{axis}1": "wall" for axis in "xyz"}
    return box_mesh(case, (size,) * 3, (n,) * 3, kinds)


def plane_mesh(case: Path, size: tuple, counts: tuple) -> Mesh:
    """A plane mesh, 1 m thick: walls y0, y1, patches x0, x1."""
    kinds = {"x0": "patch", "x1": "patch", "y0": "wall", "y1": "wall"}
    kinds |= {"z0": "empty", "z1": "empty"}
    return box_mesh(case, (*size, 1.0), (*counts, 1), kinds)


def write_control(case: Path, end: float = 1, functions: str = "", **entries):
    """controlDict of a case; further entries as keywords."""
    control = {
        "application": "laplacianFoam",
        "startFrom": "latestTime",
        "startTime": "0",
        "stopAt": "endTime",
        "endTime": end,
        "deltaT": 1,
        "writeControl": "runTime",
        "writeInterval": 1,
        "runTimeModifiable": "false",
    } | entries
    text = "".join(f"{key}  {value};\n" for key, value in control.items())
    write_file(
        case / "system" / "controlDict",
        text + f"functions\n{{\n{functions}\n}}\n",
    )


def _values(array: np.ndarray) -> str:
    """A list of OpenFOAM."""
    array = np.asarray(array, dtype=float)
    if array.ndim == 1:
        rows = "\n".join(f"{x:.17g}" for x in array)
        return f"List<scalar> {len(array)}\n(\n{rows}\n)"
    kind = {3: "vector", 6: "symmTensor"}[array.shape[1]]
    return f"List<{kind}> {len(array)}\n(\n{_listed(array)}\n)"


def write_field(case: Path, mesh: Mesh, time, name: str, cells, faces=None):
    """Write a cell field, or with cells None a face field (of zero inside).

    cells  (nCells,), (nCells, 3) or (nCells, 6), or one value for all
    faces  {patch: (patch size,) or (patch size, 3)} boundary values; other
           patches have zeroGradient
    """
    surface = cells is None
    cells = (
        np.zeros(len(mesh.neighbour)) if surface else np.asarray(cells, float)
    )
    if not surface and cells.shape in ((), (3,), (6,)):
        cells = np.broadcast_to(cells, (mesh.n_cells, *cells.shape))
    kind = {1: "Scalar", 3: "Vector", 6: "SymmTensor"}[
        1 if cells.ndim == 1 else cells.shape[1]
    ]

    text = f"dimensions {_DIMENSIONS.get(name, '[0 0 0 0 0 0 0]')};\n"
    text += f"internalField nonuniform {_values(cells)};\nboundaryField\n{{\n"
    for patch, info in mesh.patches.items():
        text += f"    {patch} {{ type "
        if info.type in ("wedge", "empty", "symmetryPlane"):
            text += info.type + ";"
            if surface and info.type == "wedge":
                text += " value uniform 0;"
        elif faces and patch in faces:
            text += f"calculated; value nonuniform {_values(faces[patch])};"
        elif surface:
            text += "calculated; value uniform 0;"
        else:
            text += "zeroGradient;"
        text += " }\n"
    cls = ("surface" if surface else "vol") + kind + "Field"
    write_file(case / str(time) / name, text + "}\n", cls)


def write_motion_fields(case: Path, velocity: dict, displacement: dict):
    """Write 0/U and 0/pointDisplacement, zero inside.

    velocity, displacement   {patch: entries of its condition}
    """
    for name, cls, dims, conditions in (
        ("U", "volVectorField", "[0 1 -1 0 0 0 0]", velocity),
        (
            "pointDisplacement",
            "pointVectorField",
            "[0 1 0 0 0 0 0]",
            displacement,
        ),
    ):
        rows = "".join(f"{p} {{ {text} }}\n" for p, text in conditions.items())
        write_file(
            case / "0" / name,
            f"dimensions {dims};\ninternalField uniform (0 0 0);\n"
            f"boundaryField\n{{\n{rows}}}\n",
            cls,
        )


def sphere_fraction(mesh: Mesh, centre, radius: float) -> np.ndarray:
    """Volume fraction of a sphere in the cells of a box or wedge mesh.

    Cut cells are sampled at 10 points a direction, which is far finer than
    the cut itself; in a wedge each sample weighs its radius.
    """
    corner_min = np.full((mesh.n_cells, 3), np.inf)
    corner_max = np.full((mesh.n_cells, 3), -np.inf)
    wedge = mesh.axisymmetric
    points = mesh.points
    if wedge:
        radii = np.hypot(points[:, 1], points[:, 2])
        points = np.column_stack([points[:, 0], radii, 0 * radii])
    for cell_of in (mesh.owner, mesh.neighbour):
        for cell, face in zip(cell_of, mesh.faces, strict=False):
            corner_min[cell] = np.minimum(
                corner_min[cell], points[face].min(axis=0)
            )
            corner_max[cell] = np.maximum(
                corner_max[cell], points[face].max(axis=0)
            )

    middle = 0.5 * (corner_min + corner_max)
    size = corner_max - corner_min
    distance = np.linalg.norm(middle - centre, axis=1) - radius
    alpha = (distance < 0).astype(float)
    cut = np.flatnonzero(abs(distance) < 0.51 * np.linalg.norm(size, axis=1))

    ticks = (np.arange(10) + 0.5) / 10
    third = ticks[:1] if wedge else ticks
    unit = np.stack(
        np.meshgrid(ticks, ticks, third, indexing="ij"), axis=-1
    ).reshape(-1, 3)
    for cell in cut:
        sample = corner_min[cell] + unit * size[cell]
        inside = np.linalg.norm(sample - centre, axis=1) < radius
        weight = sample[:, 1] if wedge else np.ones(len(sample))
        alpha[cell] = (inside * weight).sum() / weight.sum()
    return alpha


def laplacian_case(case: Path, mesh: Mesh, rho: float = 1000) -> None:
    """What laplacianFoam and the function objects need beside the fields."""
    write_file(case / "constant" / "bolusProperties", f"rho {rho};\n")
    write_file(
        case / "constant" / "transportProperties",
        "DT DT [0 2 -1 0 0 0 0] 1e-9;\n",
    )
    write_file(
        case / "system" / "fvSchemes",
        "ddtSchemes { default Euler; }\n"
        "gradSchemes { default Gauss linear; }\n"
        "divSchemes { default none; }\n"
        "laplacianSchemes { default Gauss linear corrected; }\n"
        "interpolationSchemes { default linear; }\n"
        "snGradSchemes { default corrected; }\n",
    )
    write_file(
        case / "system" / "fvSolution",
        "solvers { T { solver PCG; preconditioner DIC; tolerance 1e-6; } }\n"
        "SIMPLE { nNonOrthogonalCorrectors 0; }\n",
    )
    write_field(case, mesh, 0, "T", 0.0)
