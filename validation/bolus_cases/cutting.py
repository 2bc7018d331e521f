# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Mesh, initial field and times of the cutting tutorials.

A cylinder (or wire) is pressed downwards (-y) into a block of bolus on a
platen (y = 0). Half of it is meshed, x >= 0; the tool's long axis is z.

    python -m bolus_cases.cutting      in the case's folder

reads system/caseParameters and writes constant/polyMesh (by gmsh and
gmshToFoam), 0/alpha and system/derivedParameters. SI units.

    python -m bolus_cases.cutting tool.stl

only checks that a surface is closed. Entry toolSurface makes the mesh around
one (see tool_surface); the motion solver rigidTool moves any patch.
"""

import math
import re
import subprocess
import sys
from dataclasses import dataclass, fields, replace
from pathlib import Path

import gmsh
import numpy as np
from bolus_results.fields import Mesh, read_mesh
from scipy.spatial import cKDTree

from bolus_cases.synthetic import write_file
from bolus_cases.tool_surface import check_surface, divide, outline


@dataclass
class Parameters:
    """The entries of system/caseParameters [m, s, -]; see the tutorial's."""

    speed: float
    travel: float
    travelStep: float
    writeTravel: float
    diameter: float
    height: float
    width: float
    thickness: float
    cellSize: float
    boxCells: int
    nearCells: int
    nearGrowth: float
    cellBehind: float
    growthAhead: float
    growthBehind: float
    growthSide: float
    roomSide: float
    roomBehind: float
    zoneAhead: float
    zoneBehind: float
    cellsThrough: int
    roomThrough: float
    ends: int
    startGap: float
    gasStress: float
    # STL file, and its outline (see tool_surface) at the axis (n, 2)
    toolSurface: Path | None = None
    outline: np.ndarray | None = None

    @property
    def radius(self) -> float:
        """Largest distance of the tool's surface from its axis [m]."""
        if self.outline is None:
            return 0.5 * self.diameter
        return np.linalg.norm(self.outline, axis=1).max()

    @property
    def front(self) -> float:
        """How far the tool reaches ahead of its axis [m]."""
        if self.outline is None:
            return 0.5 * self.diameter
        return -self.outline[:, 1].min()

    @property
    def box(self) -> float:
        """Half the side of the square around the tool's O-grid [m]."""
        return self.radius + self.boxCells * self.cellSize

    @property
    def around(self) -> int:
        """Cells of the O-grid to each half side of the square."""
        return max(1, round(self.box / self.cellSize))

    @property
    def centre(self) -> float:
        """Height of the tool's axis at the start [m]."""
        return self.height + self.startGap + self.front

    @property
    def top(self) -> float:
        """Height of the mesh [m]."""
        return self.centre + self.box + self.roomBehind

    @property
    def depth(self) -> float:
        """Of the mesh along the tool [m]."""
        if self.plane:
            return self.thickness
        return self.ends * (0.5 * self.thickness + self.roomThrough)

    @property
    def factor(self) -> int:
        """The whole tool and block in terms of what is meshed."""
        return 2 if self.plane else 4 // self.ends

    @property
    def plane(self) -> bool:
        """Whether the mesh is plane (one layer of cells)."""
        return self.cellsThrough == 0


# What may be 0; everything else is > 0
_ZERO = {"cellsThrough", "roomThrough", "startGap"}


def read_parameters(path: Path) -> Parameters:
    """Read system/caseParameters; one clear error for what is wrong."""
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", path.read_text(), flags=re.S)
    found = dict(re.findall(r"(\w+)\s+([^\s;]+)\s*;", text))
    values = {}
    for entry in fields(Parameters):
        if entry.name in ("toolSurface", "outline"):
            continue
        word = found.get(entry.name)
        if word is None:
            raise SystemExit(f"{path}: entry {entry.name} is missing")
        try:
            number = entry.type(word)
        except ValueError:
            number = math.nan
        least = "at least 0" if entry.name in _ZERO else "greater than 0"
        if not (number > 0 or (number == 0 and entry.name in _ZERO)):
            raise SystemExit(
                f"{path}: entry {entry.name} is {word}; valid are numbers "
                f"{least}"
            )
        values[entry.name] = number
    given = Parameters(**values)
    if given.ends not in (1, 2):
        raise SystemExit(
            f"{path}: entry ends is {given.ends}; valid are 1 and 2"
        )
    if given.ends == 1 and given.cellsThrough % 2:
        raise SystemExit(
            f"{path}: entry cellsThrough is {given.cellsThrough}; valid with "
            "ends 1 are even numbers"
        )
    surface = found.get("toolSurface", "none").strip('"')
    if surface != "none":
        given = around_surface(given, path.parents[1] / surface)
    if given.diameter < 3 * given.cellSize:
        raise SystemExit(
            f"{path}: entry diameter is {given.diameter:g}, thinner than three "
            f"cells of cellSize {given.cellSize:g}; valid are tools of at "
            "least 3 cells"
        )
    room = given.height + given.startGap - given.zoneAhead
    if given.travel >= room:
        raise SystemExit(
            f"{path}: entry travel is {given.travel:g}: the tool with its "
            f"zoneAhead, {given.zoneAhead:g}, would reach the platen; valid "
            f"are travels less than {room:g}"
        )
    if given.box >= 0.5 * given.width:
        raise SystemExit(
            f"{path}: entry width is {given.width:g}; valid are blocks wider "
            f"than the cells around the tool, {2 * given.box:g}"
        )
    return given


def around_surface(p: Parameters, path: Path) -> Parameters:
    """The same with the tool of an STL file."""
    length = p.depth if p.plane else 2 * p.depth / p.ends
    p = replace(p, toolSurface=path, outline=outline(path, length))
    width = 2 * p.outline[:, 0].max()
    if abs(width - p.diameter) > 0.01 * width:
        raise SystemExit(
            f"entry diameter is {p.diameter:g}, but the tool of {path} is "
            f"{width:g} wide; valid is its width"
        )
    return p


# --- mesh --------------------------------------------------------------------


def count(length: float, first: float, growth: float) -> int:
    """Cells over a length, the first given, each growth times the last one."""
    if growth == 1:
        return max(1, round(length / first))
    n = math.log1p(length * (growth - 1) / first) / math.log(growth)
    return max(1, round(n))


class _Sketch:
    """Structured quadrilateral blocks in gmsh, sharing their edges."""

    def __init__(self):
        self._lines: dict[tuple[int, int], int] = {}
        self.blocks: list[int] = []

    @staticmethod
    def point(x: float, y: float) -> int:
        return gmsh.model.geo.addPoint(x, y, 0)

    def line(self, a, b, n, growth=1.0, centre=None):
        """Edge from a to b of n cells, each growth times the one before."""
        add = gmsh.model.geo
        tag = add.addCircleArc(a, centre, b) if centre else add.addLine(a, b)
        add.mesh.setTransfiniteCurve(tag, n + 1, "Progression", growth)
        self._lines[a, b] = tag
        self._lines[b, a] = -tag

    def block(self, *corners):
        """The block between four corners, whose edges are there already."""
        edges = [
            self._lines[a, b]
            for a, b in zip(corners, corners[1:] + corners[:1], strict=True)
        ]
        add = gmsh.model.geo
        tag = add.addPlaneSurface([add.addCurveLoop(edges)])
        add.mesh.setTransfiniteSurface(tag, cornerTags=list(corners))
        add.mesh.setRecombine(2, tag)
        self.blocks.append(tag)


def _draw(p: Parameters) -> _Sketch:
    """The section: an O-grid around half the tool, Cartesian blocks beyond."""
    sketch = _Sketch()
    around = p.around
    x = [0, p.box, 0.5 * p.width, 0.5 * p.width + p.roomSide]
    y = [0, p.centre - p.box, p.centre + p.box, p.top]
    grid = [[sketch.point(a, b) for b in y] for a in x]

    side = count(x[2] - x[1], p.cellSize, p.growthSide)
    last = p.cellSize * p.growthSide**side
    columns = [
        (around, 1.0),
        (side, p.growthSide),
        (max(1, round(p.roomSide / last)), 1.0),
    ]
    ahead = count(y[1], p.cellSize, p.growthAhead)
    behind = count(p.roomBehind, p.cellBehind, p.growthBehind)
    rows = [
        (ahead, 1 / p.growthAhead),
        (2 * around, 1.0),
        (behind, p.growthBehind),
    ]
    for i in range(4):
        for j in range(4):
            if i < 3:
                sketch.line(grid[i][j], grid[i + 1][j], *columns[i])
            if j < 3 and (i, j) != (0, 1):
                sketch.line(grid[i][j], grid[i][j + 1], *rows[j])

    centre = sketch.point(0, p.centre)
    angles = np.radians([-90, -45, 45, 90])
    tool = [
        sketch.point(
            p.radius * math.cos(a) if abs(math.cos(a)) > 1e-9 else 0,
            p.centre + p.radius * math.sin(a),
        )
        for a in angles
    ]
    outer = [grid[0][1], grid[1][1], grid[1][2], grid[0][2]]
    for inside, outside in zip(tool, outer, strict=True):
        sketch.line(inside, outside, p.nearCells, p.nearGrowth)
    for k, n in enumerate((around, 2 * around, around)):
        sketch.line(tool[k], tool[k + 1], n, centre=centre)
        sketch.block(tool[k], outer[k], outer[k + 1], tool[k + 1])
    for i in range(3):
        for j in range(3):
            if (i, j) != (0, 1):
                sketch.block(
                    grid[i][j],
                    grid[i + 1][j],
                    grid[i + 1][j + 1],
                    grid[i][j + 1],
                )
    return sketch


def _fit_tool(p: Parameters) -> None:
    """Move the nodes of the O-grid from the circle to the tool's outline."""
    n, m = p.around, np.arange(p.nearCells + 1)
    v = (p.nearGrowth**m - 1) if p.nearGrowth != 1 else m
    v = (v / v[-1])[None, :, None]
    angles = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 4 * n + 1)
    circle = p.radius * np.column_stack([np.cos(angles), np.sin(angles)])
    side = p.box * np.linspace(-1, 1, 2 * n + 1)
    half = p.box * np.linspace(0, 1, n + 1)
    square = np.array(
        [(x, -p.box) for x in half]
        + [(p.box, y) for y in side[1:]]
        + [(x, p.box) for x in half[-2::-1]]
    )[:, None, :]
    tool = divide(p.toolSurface, p.outline, 4 * n)
    was, will = (
        ((1 - v) * inner[:, None, :] + v * square).reshape(-1, 2)
        + (0, p.centre)
        for inner in (circle, tool)
    )

    tags, points, _ = gmsh.model.mesh.getNodes()
    points = points.reshape(-1, 3)
    distance, which = cKDTree(was).query(points[:, :2])
    for i in np.flatnonzero(distance < 1e-6 * p.radius):
        place = [*will[which[i]], points[i, 2]]
        gmsh.model.mesh.setNode(tags[i], place, [])


def _layers(p: Parameters) -> tuple[list[int], list[float], float, float]:
    """Layers of cells along z: numbers, relative heights, start and depth."""
    if p.plane:
        return [1], [1.0], 0.0, p.thickness
    inside = p.cellsThrough * p.ends // 2
    outside = round(p.roomThrough * p.cellsThrough / p.thickness)
    if p.roomThrough > 0:
        outside = max(1, outside)
    room = p.roomThrough / p.depth
    # From the middle, or from the other end, to this one
    layers = [(inside, 1 - room), (outside, 1.0)]
    if p.ends == 2:
        layers.insert(0, (outside, room))
    layers = [layer for layer in layers if layer[0]]
    numbers, heights = map(list, zip(*layers, strict=True))
    return numbers, heights, 0.5 * p.depth * (1 - p.ends), p.depth


def _name(box, p: Parameters) -> str:
    """The patch of a boundary surface, from its bounding box."""
    low, high = np.array(box[:3]), np.array(box[3:])
    near = 1e-6 * p.top
    if high[2] - low[2] < near:
        if p.plane:
            return "frontAndBack"
        return "section" if p.ends == 1 and high[2] < near else "open"
    if high[0] < near:
        return "middle"
    if high[1] < near:
        return "platen"
    right = 0.5 * p.width + p.roomSide
    if low[0] > right - near or low[1] > p.top - near:
        return "open"
    return "tool"


TYPES = {
    "frontAndBack": "empty",
    "middle": "symmetryPlane",
    "section": "symmetryPlane",
    "platen": "wall",
    "tool": "wall",
    "open": "patch",
}


def write_mesh(case: Path, p: Parameters, types=TYPES) -> Mesh:
    """Write constant/polyMesh with these types of patches; returns the mesh."""
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Verbosity", 2)
        sketch = _draw(p)
        numbers, heights, start, depth = _layers(p)
        add = gmsh.model.geo
        add.translate([(2, s) for s in sketch.blocks], 0, 0, start)
        add.extrude(
            [(2, s) for s in sketch.blocks],
            0,
            0,
            depth,
            numElements=numbers,
            heights=heights,
            recombine=True,
        )
        add.synchronize()
        groups: dict[str, list[int]] = {}
        for _, tag in gmsh.model.getEntities(2):
            if len(gmsh.model.getAdjacencies(2, tag)[0]) == 1:
                # Bounding boxes of gmsh are wider than the surface by 1e-7
                points = [
                    gmsh.model.getValue(0, t, [])
                    for _, t in gmsh.model.getBoundary(
                        [(2, tag)], recursive=True
                    )
                ]
                box = [*np.min(points, axis=0), *np.max(points, axis=0)]
                groups.setdefault(_name(box, p), []).append(tag)
        for name, tags in groups.items():
            gmsh.model.addPhysicalGroup(2, tags, name=name)
        volumes = [tag for _, tag in gmsh.model.getEntities(3)]
        gmsh.model.addPhysicalGroup(3, volumes, name="domain")
        gmsh.model.mesh.generate(3)
        if p.outline is not None:
            _fit_tool(p)
        gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
        gmsh.write(str(case / "constant" / "cutting.msh"))
    finally:
        gmsh.finalize()

    command = ["gmshToFoam", "constant/cutting.msh"]
    done = subprocess.run(command, cwd=case, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"gmshToFoam failed:\n{done.stdout}{done.stderr}")
    (case / "constant" / "cutting.msh").unlink()

    boundary = case / "constant" / "polyMesh" / "boundary"
    text = boundary.read_text()
    for name, kind in types.items():
        text = re.sub(
            rf"(\n\s*{name}\s*\{{\s*type\s+)\w+;(\s*physicalType\s+\w+;)?",
            rf"\g<1>{kind};",
            text,
        )
    boundary.write_text(text)
    mesh = read_mesh(case / "constant" / "polyMesh")
    if mesh.cell_volumes.min() <= 0:
        raise SystemExit("cutting: the mesh has cells that are inside out")
    return mesh


# --- initial field -----------------------------------------------------------


def clip(polygon: np.ndarray, axis: int, limit: float) -> np.ndarray:
    """The part of a polygon (n, 2) whose coordinate is below a limit."""
    kept = []
    for a, b in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        if a[axis] <= limit:
            kept.append(a)
        if (a[axis] - limit) * (b[axis] - limit) < 0:
            part = (limit - a[axis]) / (b[axis] - a[axis])
            kept.append(a + part * (b - a))
    return np.array(kept).reshape(-1, 2)


def area(polygon: np.ndarray) -> float:
    """Area of a polygon (n, 2), positive [m2]."""
    if len(polygon) < 3:
        return 0.0
    x, y = (polygon - polygon[0]).T
    return 0.5 * abs(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def block_fraction(mesh: Mesh, p: Parameters) -> np.ndarray:
    """Volume fraction of the block in each cell (nCells,), exact."""
    normal = mesh.face_areas
    across = abs(normal[:, 2]) > 0.999 * np.linalg.norm(normal, axis=1)
    alpha = np.zeros(mesh.n_cells)
    half = 0.5 * p.width
    slack = 1e-9 * p.height
    done = np.zeros(mesh.n_cells, bool)
    for i in np.flatnonzero(across):
        for cells in (mesh.owner, mesh.neighbour):
            if i >= len(cells) or done[cells[i]]:
                continue
            done[cells[i]] = True
            polygon = mesh.points[mesh.faces[i], :2]
            low, high = polygon.min(axis=0), polygon.max(axis=0)
            if high[0] <= half + slack and high[1] <= p.height + slack:
                alpha[cells[i]] = 1
            elif low[0] < half - slack and low[1] < p.height - slack:
                inside = clip(clip(polygon, 0, half), 1, p.height)
                alpha[cells[i]] = area(inside) / area(polygon)
    if not p.plane:
        alpha[abs(mesh.cell_centres[:, 2]) > 0.5 * p.thickness] = 0
    return alpha


def write_alpha(case: Path, mesh: Mesh, alpha: np.ndarray) -> None:
    """Write 0/alpha: as 0.orig/alpha with these values."""
    rows = "".join(f"{a:.12g}\n" for a in alpha)
    text = (case / "0.orig" / "alpha").read_text()
    new, found = re.subn(
        r"internalField\s+uniform\s+0;",
        f"internalField nonuniform List<scalar>\n{len(alpha)}\n(\n{rows})\n;",
        text,
    )
    if found != 1:
        raise SystemExit("0.orig/alpha: there is no internalField uniform 0;")
    (case / "0" / "alpha").write_text(new)


def write_derived(case: Path, p: Parameters) -> None:
    """Write what other dictionaries take from system/caseParameters."""
    end = p.travel / p.speed
    step = p.travelStep / p.speed
    scale = p.diameter / p.speed
    write_file(
        case / "system" / "derivedParameters",
        "// By bolus_cases.cutting, from caseParameters\n"
        f"endTime         {end:.12g};\n"
        f"maxDeltaT       {step:.12g};\n"
        f"deltaT          {0.1 * step:.12g};\n"
        f"minDeltaT       {1e-4 * step:.12g};\n"
        f"writeInterval   {p.writeTravel / p.speed:.12g};\n"
        f"surfaceInterval {0.1 * p.writeTravel / p.speed:.12g};\n"
        # A fifth of the tool's way in diameters, far from it less
        f"strainRate      {0.2 / scale:.12g};\n"
        # The gas resists as little at any speed and size
        f"gasZeta        {p.gasStress * scale:.12g};\n"
        f"gasEta         {0.05 * p.gasStress * scale:.12g};\n"
        f"overshootTime    {0.02 * scale:.12g};\n"
        f"elasticSlip     {0.02 * p.cellSize:.12g};\n"
        f"modelFactor     {p.factor};\n"
        f"toolOrigin      (0 {p.centre:.12g} 0);\n"
        f"toolZone        ({p.zoneAhead:.12g} {p.zoneBehind:.12g});\n",
    )


def main(arguments=None) -> int:
    """Command line: work in the current folder, or check surfaces."""
    surfaces = sys.argv[1:] if arguments is None else arguments
    for surface in surfaces:
        count = len(check_surface(Path(surface)))
        print(f"cutting: {surface} is closed, {count} triangles")
    if surfaces:
        return 0
    case = Path()
    p = read_parameters(case / "system" / "caseParameters")
    write_derived(case, p)
    mesh = write_mesh(case, p)
    alpha = block_fraction(mesh, p)
    (case / "0").mkdir(exist_ok=True)
    write_alpha(case, mesh, alpha)
    volume = alpha @ mesh.cell_volumes
    print(
        f"cutting: {mesh.n_cells} cells, bolus {volume:.9g} m3 of 1/{p.factor}"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
