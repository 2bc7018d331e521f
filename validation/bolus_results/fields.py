# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Meshes and cell fields of an OpenFOAM case as numpy arrays.

Of a serial or reconstructed case; what files may be: foam_files. SI units
throughout.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from bolus_results.foam_files import (
    FoamFileError,
    read_faces,
    read_field,
    read_list,
    read_text,
    stored,
)
from bolus_results.frame import (
    Frame,
    declared_frame,
    other_frame,
    plane_normal,
    wedge_frame,
)


class NoSection(ValueError):
    """A mesh that is neither a wedge nor plane."""


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
    polygons  n arrays (k, 2) of corners: along the axis and across, (x, r) in
              a wedge, (x, y) in a plane
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
    declared   the axis of the case's motility, if it has one
    """

    def __init__(
        self,
        points,
        faces,
        owner,
        neighbour,
        patches,
        declared: Frame | None = None,
    ):
        self.points = points
        self.faces = faces
        self.owner = owner
        self.neighbour = neighbour
        self.patches: dict[str, Patch] = patches
        self.declared = declared
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

    @cached_property
    def frame(self) -> Frame:
        """Where the axis is: see frame.py."""
        planes = self._wedge_planes
        if planes:
            size = float(np.abs(self.points).max())
            return wedge_frame(planes, size, self.declared)
        return other_frame(self._normal, self.declared)

    @property
    def axial(self) -> np.ndarray:
        """x of the cell centres along the axis (nCells,) [m]."""
        return self.frame.axial(self.cell_centres)

    @property
    def radii(self) -> np.ndarray:
        """Distance of the cell centres from the axis (nCells,) [m]."""
        return self.frame.radial(self.cell_centres)

    def _patches_of_type(self, *types: str) -> Iterator[Patch]:
        return (p for p in self.patches.values() if p.type in types and p.size)

    @property
    def axisymmetric(self) -> bool:
        """Is it a wedge?"""
        return any(self._patches_of_type("wedge"))

    @cached_property
    def _wedge_planes(self) -> list[tuple[np.ndarray, np.ndarray]]:
        """Unit normal and a point of each of a wedge's two sides, which may
        be of several patches; empty if it is no wedge."""
        sides: list[list[int]] = []
        normals: list[np.ndarray] = []
        for patch in self._patches_of_type("wedge"):
            normal = self.face_areas[patch.faces].sum(axis=0)
            normal /= np.linalg.norm(normal)
            for side, other in zip(sides, normals, strict=True):
                # Wedges are some degrees wide, and their sides flat
                if normal @ other > 1 - 1e-6:
                    side += patch.faces
                    break
            else:
                sides.append(list(patch.faces))
                normals.append(normal)
        if sides and len(sides) != 2:
            raise FoamFileError(
                f"the wedge patches lie in {len(sides)} planes; valid are two"
            )
        planes = []
        for side in sides:
            area = self.face_areas[side]
            weight = np.linalg.norm(area, axis=1)
            centre = np.average(self.face_centres[side], axis=0, weights=weight)
            normal = area.sum(axis=0)
            planes.append((normal / np.linalg.norm(normal), centre))
        return planes

    @property
    def wedge_angle(self) -> float | None:
        """Angle between the wedge patches [rad]; None if it is no wedge."""
        if not self._wedge_planes:
            return None
        (a, _), (b, _) = self._wedge_planes
        return float(np.pi - np.arccos(np.clip(a @ b, -1, 1)))

    @property
    def _empty(self) -> np.ndarray:
        """Labels of the faces of empty patches."""
        return np.array(
            [i for p in self._patches_of_type("empty") for i in p.faces],
            dtype=int,
        )

    @cached_property
    def _normal(self) -> np.ndarray | None:
        """Unit normal of a plane mesh; None if it is none."""
        if self.axisymmetric or not self._empty.size:
            return None
        return plane_normal(self.face_areas[self._empty])

    def _plane(self, points: np.ndarray) -> np.ndarray:
        """(n, 3) points to (n, 2): (x, r) in a wedge, (x, y) in a plane."""
        if self.axisymmetric:
            across = self.frame.radial(points)
        else:
            up = np.cross(self._normal, self.frame.axis)
            # Up is up: in the x-z plane as well
            up *= np.sign(up[np.abs(up).argmax()])
            across = (points - self.frame.origin) @ up
        return np.column_stack([self.frame.axial(points), across])

    @cached_property
    def section(self) -> Section:
        """The cells as polygons; only of a wedge or plane mesh."""
        if self.axisymmetric:
            labels = np.array(
                [i for p in self._patches_of_type("wedge") for i in p.faces]
            )
            normal = self._wedge_planes[0][0]
        else:
            labels, normal = self._empty, self._normal
        if labels.size == 0:
            raise NoSection(
                "the mesh has no section: it has neither wedge nor empty "
                "patches"
            )
        # One of the two sides
        area = self.face_areas[labels]
        labels = labels[area @ normal > 0.5 * np.linalg.norm(area, axis=1)]
        return Section(
            cells=self.owner[labels],
            polygons=[self._plane(self.points[self.faces[i]]) for i in labels],
            axisymmetric=self.axisymmetric,
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
    patches = {}
    text = read_text(polymesh / "boundary")
    for name, entries in re.findall(r"([\w.:-]+)\s*\{([^}]*)\}", text):
        get = dict(re.findall(r"(\w+)\s+([^;]*);", entries))
        patches[name] = Patch(
            get["type"], int(get["nFaces"]), int(get["startFace"])
        )
    return (
        read_faces(polymesh / "faces"),
        read_list(polymesh / "owner", int),
        read_list(polymesh / "neighbour", int),
        patches,
    )


def _read_points(path: Path) -> np.ndarray:
    """(nPoints, 3) [m]."""
    return read_list(path, float, 3)


def read_mesh(polymesh: Path) -> Mesh:
    """The mesh in a folder polyMesh, without the axis of any motility."""
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
    def declared(self) -> Frame | None:
        """The axis of its motility; None if it has none."""
        return declared_frame(self.path)

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
            if t <= time and stored(folder / name):
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
                _read_points(points / "points"),
                *self._topologies[topology],
                declared=self.declared,
            )
        return self._meshes[points, topology]

    def has(self, time: float, name: str) -> bool:
        """Was this field written at this time?"""
        return stored(self.times[time] / name) is not None

    def field(self, time: float, name: str) -> np.ndarray:
        """A cell field at a written time; shapes: see read_field."""
        return read_field(self.times[time] / name, self.mesh(time).n_cells)
