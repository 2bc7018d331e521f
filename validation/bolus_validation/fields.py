# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Meshes and cell fields of an OpenFOAM case as numpy arrays.

Reads ASCII files, plain or gzipped, of a serial or reconstructed case. SI
units throughout. PyFoam's parser would take minutes for the meshes of a run;
this one hands the numbers to numpy in one piece.
"""

import gzip
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

# Brackets to blanks: what is left is a plain sequence of numbers
_FLATTEN = bytes.maketrans(b"()", b"  ")


class FoamFileError(ValueError):
    """A file that cannot be read, and what would be valid."""


def _read_bytes(path: Path) -> bytes:
    """Content of an ASCII file of OpenFOAM or of its .gz."""
    if path.is_file():
        data = path.read_bytes()
    elif path.with_name(path.name + ".gz").is_file():
        data = gzip.decompress(path.with_name(path.name + ".gz").read_bytes())
    else:
        raise FoamFileError(f"{path}: no such file, nor one with .gz")
    form = re.search(rb"\bformat\s+(\w+)\s*;", data[:2000])
    if form and form.group(1) != b"ascii":
        raise FoamFileError(
            f"{path}: format is {form.group(1).decode()}; valid is ascii "
            "(writeFormat in system/controlDict, or foamFormatConvert)"
        )
    return data


def _numbers(data: bytes, dtype: type, path: Path) -> np.ndarray:
    """All the numbers of a bracketed list, flat."""
    try:
        return np.array(data.translate(_FLATTEN).split(), dtype=dtype)
    except ValueError as error:
        raise FoamFileError(f"{path}: {error}") from None


def _body(data: bytes) -> bytes:
    """The content behind the FoamFile header, without comments."""
    data = re.sub(rb"/\*.*?\*/|//[^\n]*", b"", data, flags=re.DOTALL)
    header = re.search(rb"FoamFile\s*\{[^}]*\}", data)
    return data[header.end() :] if header else data


def _read_list(path: Path, dtype: type) -> tuple[int, np.ndarray]:
    """Size and flat numbers of a file that is one list, N ( ... )."""
    body = _body(_read_bytes(path))
    head = re.match(rb"\s*(\d+)\s*\(", body)
    if not head:
        raise FoamFileError(f"{path}: not a list 'N ( ... )'")
    flat = _numbers(body[head.end() : body.rindex(b")")], dtype, path)
    return int(head.group(1)), flat


def read_field(path: Path, size: int) -> np.ndarray:
    """The internal field of a file.

    Returns (size,) for a scalar, (size, 3) for a vector, (size, 6) for a
    symmetric tensor (xx xy xz yy yz zz), in the unit of the field.
    """
    data = _read_bytes(path)
    start = re.search(rb"\binternalField\s+", data)
    if not start:
        raise FoamFileError(f"{path}: has no internalField")
    entry = data[start.end() : data.index(b";", start.end())]

    uniform = re.match(rb"uniform\s+(.*)", entry, flags=re.DOTALL)
    if uniform:
        value = _numbers(uniform.group(1), float, path)
        value = value[0] if value.size == 1 else value
        return np.broadcast_to(value, (size, *np.shape(value))).copy()

    head = re.match(rb"nonuniform\s+List<\w+>\s*(\d+)\s*([({])", entry)
    if not head:
        raise FoamFileError(f"{path}: internalField is no list of numbers")
    count = int(head.group(1))
    if count != size:
        raise FoamFileError(
            f"{path}: {count} values, but the mesh has {size} cells"
        )
    if head.group(2) == b"{":  # N{value}: all the same
        value = _numbers(entry[head.end() : entry.rindex(b"}")], float, path)
        flat = np.tile(value, count)
    else:
        flat = _numbers(entry[head.end() : entry.rindex(b")")], float, path)
    if flat.size % count:
        raise FoamFileError(f"{path}: {flat.size} numbers in {count} values")
    return flat if flat.size == count else flat.reshape(count, -1)


@dataclass
class Patch:
    """A patch: the faces start to start + size of the mesh."""

    type: str
    size: int
    start: int

    @property
    def faces(self) -> range:
        """The labels of its faces."""
        return range(self.start, self.start + self.size)


@dataclass
class Section:
    """The cells of a wedge or plane mesh as polygons.

    cells     (n,) cell labels
    polygons  n arrays (k, 2) of corners: (x, r) in a wedge, (x, y) in a plane
    """

    cells: np.ndarray
    polygons: list[np.ndarray]
    axisymmetric: bool


class Mesh:
    """A polyMesh.

    points     (nPoints, 3) [m]
    faces      nFaces arrays of point labels
    owner      (nFaces,), neighbour (nInternalFaces,) cell labels
    patches    by name
    """

    def __init__(self, points, faces, owner, neighbour, patches):
        self.points = points
        self.faces = faces
        self.owner = owner
        self.neighbour = neighbour
        self.patches: dict[str, Patch] = patches
        self.n_cells = int(owner.max()) + 1

    @cached_property
    def _face_geometry(self) -> tuple[np.ndarray, np.ndarray]:
        """Centres (nFaces, 3) [m] and area vectors (nFaces, 3) [m2]."""
        centre = np.empty((len(self.faces), 3))
        area = np.empty((len(self.faces), 3))
        sizes = np.array([len(face) for face in self.faces])
        for k in np.unique(sizes):
            which = np.flatnonzero(sizes == k)
            corners = self.points[np.array([self.faces[i] for i in which])]
            middle = corners.mean(axis=1, keepdims=True)
            nxt = np.roll(corners, -1, axis=1)
            triangles = 0.5 * np.cross(nxt - corners, middle - corners)
            area[which] = triangles.sum(axis=1)
            weight = np.linalg.norm(triangles, axis=2)
            weight /= np.maximum(weight.sum(axis=1, keepdims=True), 1e-300)
            thirds = (corners + nxt + middle) / 3
            centre[which] = (weight[..., None] * thirds).sum(axis=1)
        return centre, area

    @cached_property
    def _cell_geometry(self) -> tuple[np.ndarray, np.ndarray]:
        """Centres (nCells, 3) [m] and volumes (nCells,) [m3]."""
        face_centre, face_area = self._face_geometry
        n_internal = len(self.neighbour)
        cell = np.concatenate([self.owner, self.neighbour])
        face = np.concatenate([np.arange(len(self.faces)), range(n_internal)])
        sign = np.where(np.arange(cell.size) < len(self.faces), 1.0, -1.0)

        count = np.bincount(cell, minlength=self.n_cells)
        guess = np.empty((self.n_cells, 3))
        for i in range(3):
            guess[:, i] = np.bincount(cell, face_centre[face, i]) / count

        # Pyramids from an inner point to each face
        arm = face_centre[face] - guess[cell]
        pyramid = sign * np.einsum("ij,ij->i", arm, face_area[face]) / 3
        volume = np.bincount(cell, pyramid)
        centre = np.empty_like(guess)
        for i in range(3):
            centre[:, i] = guess[:, i] + np.bincount(
                cell, 0.75 * pyramid * arm[:, i]
            ) / np.where(volume != 0, volume, 1)
        return centre, volume

    @property
    def cell_centres(self) -> np.ndarray:
        """(nCells, 3) [m]."""
        return self._cell_geometry[0]

    @property
    def cell_volumes(self) -> np.ndarray:
        """(nCells,) [m3]."""
        return self._cell_geometry[1]

    @property
    def face_centres(self) -> np.ndarray:
        """(nFaces, 3) [m]."""
        return self._face_geometry[0]

    @property
    def face_areas(self) -> np.ndarray:
        """Area vectors, out of the owner (nFaces, 3) [m2]."""
        return self._face_geometry[1]

    @property
    def radii(self) -> np.ndarray:
        """Distance of the cell centres from the x axis (nCells,) [m]."""
        return np.hypot(self.cell_centres[:, 1], self.cell_centres[:, 2])

    def _patches_of_type(self, *types: str) -> Iterator[Patch]:
        return (p for p in self.patches.values() if p.type in types and p.size)

    @property
    def axisymmetric(self) -> bool:
        """Is it a wedge?"""
        return any(self._patches_of_type("wedge"))

    @property
    def wedge_angle(self) -> float | None:
        """Angle between the wedge patches [rad]; None if it is no wedge."""
        normals = [
            self.face_areas[patch.faces].sum(axis=0)
            for patch in self._patches_of_type("wedge")
        ]
        if len(normals) != 2:
            return None
        a, b = (n / np.linalg.norm(n) for n in normals)
        return float(np.pi - np.arccos(np.clip(a @ b, -1, 1)))

    def _plane(self, points: np.ndarray) -> np.ndarray:
        """(n, 3) points to (n, 2): (x, r) in a wedge, (x, y) in a plane."""
        if self.axisymmetric:
            radius = np.hypot(points[:, 1], points[:, 2])
            return np.column_stack([points[:, 0], radius])
        return points[:, :2]

    @cached_property
    def section(self) -> Section:
        """The cells as polygons; only of a wedge or plane mesh."""
        wedge = next(self._patches_of_type("wedge"), None)
        if wedge:
            labels = np.array(wedge.faces)
        else:
            labels = np.array(
                [i for p in self._patches_of_type("empty") for i in p.faces],
                dtype=int,
            )
            # One of the two sides of the plane
            labels = labels[self.face_areas[labels, 2] > 0]
        if labels.size == 0:
            raise ValueError(
                "the mesh has no section: it has neither wedge patches nor "
                "empty ones across z"
            )
        return Section(
            cells=self.owner[labels],
            polygons=[self._plane(self.points[self.faces[i]]) for i in labels],
            axisymmetric=wedge is not None,
        )

    def wall_lines(self) -> list[np.ndarray]:
        """Walls of a wedge or plane mesh: arrays (2, 2) of (x, r) [m]."""
        lines = []
        for patch in self._patches_of_type("wall"):
            for i in patch.faces:
                corners = self._plane(self.points[self.faces[i]])
                # Front and back coincide: keep the two that are furthest apart
                apart = np.linalg.norm(corners[:, None] - corners, axis=2)
                a, b = np.unravel_index(apart.argmax(), apart.shape)
                lines.append(corners[[a, b]])
        return lines

    def fragments(self, inside: np.ndarray, weight: np.ndarray) -> np.ndarray:
        """The connected pieces of a set of cells: their weights, largest first.

        inside  (nCells,) bool. Cells are connected through common faces.
        weight  (nCells,) say the volume of bolus [m3]
        Returns (nPieces,) sums of weight.
        """
        a = self.owner[: len(self.neighbour)]
        b = self.neighbour
        both = inside[a] & inside[b]
        graph = coo_matrix(
            (np.ones(both.sum()), (a[both], b[both])),
            shape=(self.n_cells, self.n_cells),
        )
        _, label = connected_components(graph, directed=False)
        sums = np.bincount(label[inside], weight[inside])
        return np.sort(sums[sums > 0])[::-1]


def _read_topology(polymesh: Path) -> tuple:
    """Faces, owner, neighbour and patches: see Mesh."""
    n_faces, flat = _read_list(polymesh / "faces", int)
    faces = []
    i = 0
    while i < flat.size:
        n = flat[i]
        faces.append(flat[i + 1 : i + 1 + n])
        i += 1 + n
    if len(faces) != n_faces:
        raise FoamFileError(
            f"{polymesh / 'faces'}: {len(faces)} faces, {n_faces} announced"
        )

    owner = _read_list(polymesh / "owner", int)[1]
    neighbour = _read_list(polymesh / "neighbour", int)[1]

    patches = {}
    text = _body(_read_bytes(polymesh / "boundary")).decode()
    for name, entries in re.findall(r"([\w.:-]+)\s*\{([^}]*)\}", text):
        get = dict(re.findall(r"(\w+)\s+([^;]*);", entries))
        patches[name] = Patch(
            get["type"], int(get["nFaces"]), int(get["startFace"])
        )

    return faces, owner, neighbour, patches


def _read_points(path: Path) -> np.ndarray:
    """(nPoints, 3) [m]."""
    n_points, flat = _read_list(path, float)
    return flat.reshape(n_points, 3)


def read_mesh(polymesh: Path) -> Mesh:
    """The mesh in a folder polyMesh."""
    return Mesh(_read_points(polymesh / "points"), *_read_topology(polymesh))


class Case:
    """A case: its times, meshes and cell fields."""

    def __init__(self, path):
        self.path = Path(path)
        if not (self.path / "constant").is_dir():
            raise FoamFileError(
                f"{self.path}: not a case of OpenFOAM (no folder constant)"
            )
        # By their folders: the points of a moving mesh change, not its faces
        self._meshes: dict[tuple[Path, Path], Mesh] = {}
        self._topologies: dict[Path, tuple] = {}

    @cached_property
    def times(self) -> dict[float, Path]:
        """The written times [s] and their folders, in order."""
        found = {}
        for folder in self.path.iterdir():
            if folder.is_dir():
                try:
                    found[float(folder.name)] = folder
                except ValueError:
                    continue
        return dict(sorted(found.items()))

    def nearest(self, time: float, tolerance: float) -> float | None:
        """The written time nearest to one, None if none is that near [s]."""
        if not self.times:
            return None
        best = min(self.times, key=lambda t: abs(t - time))
        return best if abs(best - time) <= tolerance else None

    def _instance(self, time: float, name: str) -> Path:
        """The folder polyMesh that holds a mesh file at a time."""
        for t in sorted(self.times, reverse=True):
            folder = self.times[t] / "polyMesh"
            if t <= time and any(
                (folder / (name + end)).is_file() for end in ("", ".gz")
            ):
                return folder
        return self.path / "constant" / "polyMesh"

    def mesh(self, time: float) -> Mesh:
        """The mesh at a written time; all that were asked for are kept."""
        points = self._instance(time, "points")
        topology = self._instance(time, "faces")
        if topology not in self._topologies:
            self._topologies[topology] = _read_topology(topology)
        if (points, topology) not in self._meshes:
            self._meshes[points, topology] = Mesh(
                _read_points(points / "points"), *self._topologies[topology]
            )
        return self._meshes[points, topology]

    def has(self, time: float, name: str) -> bool:
        """Was this field written at this time?"""
        folder = self.times[time]
        return any((folder / (name + end)).is_file() for end in ("", ".gz"))

    def field(self, time: float, name: str) -> np.ndarray:
        """A cell field at a written time; shapes: see read_field."""
        return read_field(self.times[time] / name, self.mesh(time).n_cells)
