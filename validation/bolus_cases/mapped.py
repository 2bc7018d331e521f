# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Small cases on mapped meshes: what the studies of groups A and B share.

A structured mesh of the unit square or cube is made by blockMesh and its
points are then moved to where a function says: annuli, O-grids, graded boxes,
meridian planes. Points on curved walls lie on them exactly. SI units.
"""

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from bolus_results.fields import Case, Mesh, read_mesh
from bolus_results.tables import Table, read_table
from matplotlib.collections import PolyCollection

from bolus_cases.specimens import TUTORIAL, replace, solve
from bolus_cases.synthetic import (
    HALF_ANGLE,
    box_mesh,
    run,
    vectors,
    wedge_mesh,
    write_control,
    write_field,
    write_file,
    write_laplacian_motion,
    write_motion_fields,
)

GRIP = "type contactWall; friction { type none; } separation no;"
STICK = "type contactWall; friction { type noSlip; } separation no;"
NOTHING = "type none;"

THICKNESS = 0.01  # of plane meshes [m]


@dataclass
class Side:
    """What a patch is.

    condition   "symmetryPlane", "open", or the condition for U of a wall
    motion      displacement of its points: None (not prescribed), "still",
                or a function of (t [s], points (n, 3) [m]) -> (n, 3) [m],
                linear in t between the case's knots
    """

    condition: str
    motion: str | Callable | None = None


SYMMETRY = Side("symmetryPlane")
OPEN = Side("open")
STILL = Side("open", "still")


def material(
    flow: str,
    youngs: float,
    nu: float = 0.49,
    gas: str = "",
    damage: str = NOTHING,
) -> str:
    """Text of bolusProperties; flow holds the entries of flowStress."""
    return (
        f"rho 1100;\nelasticity {{ E {youngs:.12g}; nu {nu:.12g}; }}\n"
        f"flowStress {{ {flow} }}\ndamage {{ {damage} }}\n"
        f"gasCoeffs {{ {gas} }}\n"
    )


def perfect(stress: float) -> str:
    """Flow stress [Pa] that depends on nothing."""
    return f"type tabulated; table ((0 {stress:.12g}) (1 {stress:.12g}));"


ELASTIC = perfect(1e9)


def _unit_mesh(case: Path, counts, sides: dict, wedge: bool) -> Mesh:
    """blockMesh of the unit square, cube or sector; patches as in sides."""
    kinds = {name: _kind(side.condition) for name, side in sides.items()}
    if wedge:
        patches = [(name, kinds[name]) for name in ("x0", "y1", "x1")]
        return wedge_mesh(case, 1, 1, *counts, patches)
    if len(counts) == 2:
        counts, kinds = (*counts, 1), kinds | {"z0": "empty", "z1": "empty"}
    return box_mesh(case, (1, 1, 1), counts, kinds)


def _kind(condition: str) -> str:
    if condition in ("symmetryPlane", "empty", "wedge"):
        return condition
    return "patch" if condition == "open" else "wall"


def split_patch(case: Path, patch: str, parts: dict) -> None:
    """Divide a patch: {name: (type, function of centres (n, 3) -> bool)}.

    By createPatch, from face sets that are written here.
    """
    mesh = read_mesh(case / "constant" / "polyMesh")
    old = mesh.patches[patch]
    labels = np.array(old.faces)
    text = "pointSync false;\npatches (\n"
    for name, (kind, chosen) in parts.items():
        inside = labels[chosen(mesh.face_centres[labels])]
        write_file(
            case / "constant" / "polyMesh" / "sets" / name,
            f"{len(inside)}\n(\n" + "\n".join(map(str, inside)) + "\n)\n",
            "faceSet",
        )
        text += (
            f"{{ name {name}; patchInfo {{ type {kind}; }} "
            f"constructFrom set; set {name}; }}\n"
        )
    write_file(case / "system" / "createPatchDict", text + ");\n")
    run(case, "createPatch", "-overwrite")


def build(
    case: Path,
    counts,
    place: Callable,
    sides: dict,
    properties: str,
    end: float,
    step: float,
    wedge: bool = False,
    split: dict | None = None,
    knots=None,
    fraction: Callable | None = None,
    measured: dict | None = None,
    solver: str = "",
    transport: str = "",
    write: float | None = None,
    mesh_motion: str | None = None,
    functions: str = "",
    max_courant: float = 2,
    initial: dict | None = None,
) -> Mesh:
    """Write a case on a mapped mesh; returns the mesh.

    counts     cells of the plane or wedge (2) or solid (3) unit mesh
    place      (n, 2 or 3) unit coordinates -> as many (n, ...) [m]; of a
               wedge (x, r), where the unit radius 0 is the axis
    sides      {patch: Side}; patches x0, x1, y0, y1, z0, z1
    split      {patch: {new patch: function of centres}}; sides has the new
    knots      times [s] at which prescribed motions are taken (0 and end)
    fraction   function of cell centres (n, 3) -> alpha; None: full
    initial    {field: function of cell centres -> values}, others are 0
    measured   {function object: entries of contactForce}
    mesh_motion   text of dynamicMeshDict; None: displacementLaplacian
    write      interval of the written times [s]
    """
    case.mkdir(parents=True, exist_ok=True)
    whole = dict(sides)
    for patch in split or {}:
        whole.setdefault(patch, OPEN)
    mesh = _unit_mesh(case, counts, whole, wedge)
    polymesh = case / "constant" / "polyMesh"
    points = mesh.points.copy()
    if wedge:
        side = np.sign(points[:, 2])
        unit = np.column_stack(
            [points[:, 0], np.hypot(points[:, 1], points[:, 2])]
        )
        x, r = place(unit).T
        points = np.column_stack(
            [x, r * np.cos(HALF_ANGLE), side * r * np.sin(HALF_ANGLE)]
        )
    elif len(counts) == 2:
        points[:, :2] = place(points[:, :2])
        points[:, 2] *= THICKNESS
    else:
        points = place(points)
    write_file(polymesh / "points", vectors(points), "vectorField")
    for patch, parts in (split or {}).items():
        split_patch(
            case,
            patch,
            {
                name: (_kind(sides[name].condition), chosen)
                for name, chosen in parts.items()
            },
        )
    mesh = read_mesh(polymesh)
    assert mesh.cell_volumes.min() > 0, "the mapping turns cells inside out"

    velocity, displacement = {}, {}
    for name, patch in mesh.patches.items():
        if patch.size == 0 and name not in sides:
            if patch.type != "empty":
                continue
        if patch.type in ("symmetryPlane", "empty", "wedge"):
            velocity[name] = displacement[name] = f"type {patch.type};"
            continue
        given = sides[name]
        velocity[name] = (
            "type zeroGradient;"
            if given.condition == "open"
            else given.condition
        )
        if given.motion is None:
            displacement[name] = "type zeroGradient;"
        elif given.motion == "still":
            displacement[name] = "type fixedValue; value uniform (0 0 0);"
        else:
            write_motion(case, mesh, name, given.motion, knots or (0, end))
            displacement[name] = (
                "type timeVaryingMappedFixedValue; "
                "setAverage off; perturb 0; mapMethod nearest; "
                "value uniform (0 0 0);"
            )

    text = functions
    for name, entries in (measured or {}).items():
        text += (
            f"{name} {{ type contactForce; {entries} "
            'libs ("libbolusFunctionObjects.so"); }\n'
        )
    write_control(
        case,
        end=f"{end:.12g}",
        functions=text,
        application="bolusFoam",
        deltaT=f"{step:.12g}",
        maxDeltaT=f"{step:.12g}",
        minDeltaT=f"{step / 1000:.12g}",
        maxCourant=max_courant,
        writeControl="adjustableRunTime",
        writeInterval=f"{write or end:.12g}",
        writePrecision=12,
        timePrecision=9,
    )
    shutil.copy(TUTORIAL / "system" / "fvSchemes", case / "system")
    write_file(
        case / "system" / "fvSolution",
        "solvers { cellDisplacement { solver PCG; preconditioner DIC; "
        "tolerance 1e-16; relTol 0; } }\n"
        f"bolus {{ {solver} }}\ntransport {{ {transport} }}\n",
    )
    write_file(case / "constant" / "bolusProperties", properties)
    if mesh_motion is None:
        write_laplacian_motion(case)
    else:
        write_file(case / "constant" / "dynamicMeshDict", mesh_motion)
    alpha = np.ones(mesh.n_cells)
    if fraction is not None:
        alpha = fraction(mesh.cell_centres)
    write_field(case, mesh, 0, "alpha", alpha)
    for name, values in (initial or {}).items():
        write_field(case, mesh, 0, name, values(mesh.cell_centres))
        if name == "deviator":
            replace(
                case / "0" / name,
                r"dimensions [^;]*",
                "dimensions [1 -1 -2 0 0 0 0]",
            )
    write_motion_fields(case, velocity, displacement)
    return mesh


def write_motion(case: Path, mesh: Mesh, name: str, motion, knots) -> None:
    """Displacements of a patch's points at the knots, as boundaryData."""
    labels = np.unique(
        np.concatenate([mesh.faces[i] for i in mesh.patches[name].faces])
    )
    points = mesh.points[labels]
    folder = case / "constant" / "boundaryData" / name

    folder.mkdir(parents=True, exist_ok=True)
    (folder / "points").write_text(vectors(points))
    for t in knots:
        target = folder / f"{t:.9g}"
        target.mkdir(exist_ok=True)
        (target / "pointDisplacement").write_text(vectors(motion(t, points)))


def finish(case: Path, force: str | None = None) -> tuple[Case, Table | None]:
    """Run bolusFoam; its written fields, and a table of contactForce."""
    solve(case)
    table = read_table(case, force, "contactForce") if force else None
    return Case(case), table


def radial(points: np.ndarray) -> np.ndarray:
    """Unit vectors (n, 3) away from the origin."""
    return points / np.linalg.norm(points, axis=1)[:, None]


def components(tensor: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """n . T . n of symmetric tensors (n, 6: xx xy xz yy yz zz)."""
    x, y, z = direction.T
    xx, xy, xz, yy, yz, zz = tensor.T
    return (
        xx * x * x
        + yy * y * y
        + zz * z * z
        + 2 * (xy * x * y + xz * x * z + yz * y * z)
    )


def graded(s: np.ndarray, n: int, ratio: float) -> np.ndarray:
    """Unit coordinates of n equal cells to those of n cells whose sizes grow
    geometrically, the last ratio times as large as the first."""
    if n < 2 or ratio == 1:
        return s
    q = ratio ** (1 / (n - 1))
    return (q ** (s * n) - 1) / (q**n - 1)


def picture(folder: Path, name: str, draw: Callable, panels: int = 1) -> str:
    """Save what draw(axes...) draws; returns the file's name."""
    figure, axes = plt.subplots(
        1, panels, figsize=(5.5 * panels, 4), layout="constrained"
    )
    draw(*np.atleast_1d(axes))
    figure.savefig(folder / name, dpi=120)
    plt.close(figure)
    return name


def draw_cells(axis, mesh: Mesh, values, scale: float, label: str, **options):
    """Cells of a plane or wedge mesh in colour; lengths times 1/scale."""
    section = mesh.section
    cells = PolyCollection(
        [polygon / scale for polygon in section.polygons],
        array=np.asarray(values)[section.cells],
        **options,
    )
    axis.add_collection(cells)
    axis.autoscale_view()
    axis.set_aspect("equal")
    axis.figure.colorbar(cells, ax=axis, label=label, shrink=0.8)
