# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Where a case has its axis: all that is axial or radial is taken from here.

The axis of a wedge is where its two planes meet. Which way it points, and
where on it x = 0 is, says constant/motilityProperties (axis, origin; see
lumenMotion.H). Without that file it rises along the first coordinate along
which it goes more than half as far as along any, and x = 0 is its point nearest
to (0 0 0): along a coordinate axis x is that coordinate. The function objects
do the same.

Other meshes have the axis of motilityProperties, or else that of x (in a plane
mesh across x: that of y).
"""

import re
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bolus_results.foam_files import (
    FoamFileError,
    entries,
    expanded,
    read_list,
    read_text,
    stored,
)

# What an axis may be off the planes of the wedge, of the mesh's size: points
# are written with 6 digits at least
TOLERANCE = 1e-5

MOTILITY = "constant/motilityProperties"


@dataclass(frozen=True)
class Frame:
    """An axis: a point on it where x = 0 [m], and its unit vector."""

    origin: np.ndarray
    axis: np.ndarray

    def axial(self, points: np.ndarray) -> np.ndarray:
        """x of points (n, 3): (n,) [m]."""
        return self.along(points - self.origin)

    def along(self, vectors: np.ndarray) -> np.ndarray:
        """Components of vectors (n, 3) along the axis: (n,)."""
        return vectors @ self.axis

    def radial(self, points: np.ndarray) -> np.ndarray:
        """Distance of points (n, 3) from the axis: (n,) [m]."""
        away = points - self.origin
        return np.linalg.norm(
            away - np.outer(away @ self.axis, self.axis), axis=1
        )


def _vector(given: dict, name: str, default: tuple) -> np.ndarray:
    """A vector of the entries of motilityProperties."""
    if name not in given:
        return np.array(default, float)
    found = re.fullmatch(r"\(\s*(\S+)\s+(\S+)\s+(\S+)\s*\)", given[name])
    try:
        vector = np.array(found.groups() if found else [], dtype=float)
    except ValueError:
        vector = np.empty(0)
    if vector.size != 3 or not np.isfinite(vector).all():
        raise FoamFileError(
            f"{MOTILITY}: {name} is {given[name]}; valid is a vector, as in "
            "(1 0 0)"
        )
    return vector


def _read_vector(case: Path, name: str, default: tuple) -> np.ndarray:
    """A vector of a case's motilityProperties, includes and macros expanded."""
    vector = _vector(expanded(case, MOTILITY), name, default)
    # foamDictionary prints 6 digits; as a rule all of them are in the file
    text = re.sub(r"^\s*#.*", "", read_text(case / MOTILITY), flags=re.M)
    try:
        exact = _vector(entries(text), name, default)
    except FoamFileError:
        return vector
    return exact if np.allclose(exact, vector, rtol=1e-5, atol=0) else vector


def declared_frame(case: Path) -> Frame | None:
    """The axis of a case's motility; None if it has none."""
    if stored(case / MOTILITY) is None:
        return None
    axis = _read_vector(case, "axis", (1, 0, 0))
    length = np.linalg.norm(axis)
    if length == 0:
        raise FoamFileError(
            f"{MOTILITY}: axis is (0 0 0); valid is a vector of any length "
            "but zero"
        )
    return Frame(_read_vector(case, "origin", (0, 0, 0)), axis / length)


def _upward(vector: np.ndarray) -> np.ndarray:
    """A vector, or its opposite: the first of its large components is
    positive, as in src/space/wedgeFrame."""
    large = np.abs(vector) > 0.5 * np.abs(vector).max()
    return vector * np.sign(vector[large.argmax()])


def _text(vector: np.ndarray) -> str:
    # Without what is rounding
    return "(" + " ".join(f"{x:.6g}" for x in np.round(vector, 9) + 0.0) + ")"


def _lies_in(frame: Frame, planes, size: float) -> bool:
    """Does an axis lie in planes: see wedge_frame."""
    return all(
        abs(normal @ frame.axis) < TOLERANCE
        and abs(normal @ (frame.origin - point)) < TOLERANCE * size
        for normal, point in planes
    )


def wedge_frame(planes, size: float, declared: Frame | None) -> Frame:
    """The axis of a wedge.

    planes   (normal, point) [m] of its two sides
    size     of the mesh and of its coordinates [m]
    """
    # Rather exactly what was meant than what the points are rounded to
    meant = (
        [declared]
        if declared
        else [Frame(np.zeros(3), axis) for axis in np.eye(3)]
    )
    for frame in meant:
        if _lies_in(frame, planes, size):
            return frame
    (n0, p0), (n1, p1) = planes
    axis = np.cross(n0, n1)
    axis = _upward(axis / np.linalg.norm(axis))
    # In both planes, and nearest to (0 0 0)
    origin = np.linalg.solve([n0, n1, axis], [n0 @ p0, n1 @ p1, 0.0])
    if declared:
        raise FoamFileError(
            f"{MOTILITY}: axis {_text(declared.axis)}, origin "
            f"{_text(declared.origin)}: the planes of the mesh's wedge meet in "
            f"the axis {_text(axis)} through {_text(origin)}"
        )
    return Frame(origin, axis)


def other_frame(normal: np.ndarray | None, declared: Frame | None) -> Frame:
    """The axis in a plane mesh with this normal, or (None) in any other."""
    if declared is not None:
        if normal is not None and abs(normal @ declared.axis) > TOLERANCE:
            raise FoamFileError(
                f"{MOTILITY}: axis {_text(declared.axis)}: the plane mesh has "
                f"the normal {_text(normal)}; valid is an axis in its plane"
            )
        return declared
    axis = np.array([1.0, 0, 0])
    if normal is not None:
        for axis in np.eye(3):
            if abs(normal @ axis) < 0.9:
                break
        axis = axis - (axis @ normal) * normal
        axis /= np.linalg.norm(axis)
    return Frame(np.zeros(3), axis)


def plane_normal(areas: np.ndarray) -> np.ndarray:
    """Unit normal of a plane mesh from the areas (n, 3) of its two sides."""
    normal = np.linalg.eigh(areas.T @ areas)[1][:, -1]
    return _upward(normal)


def longest_side(case: Path) -> int:
    """Along which coordinate, 0 to 2, the mesh of a case is longest."""
    path = case / "constant" / "polyMesh" / "points"
    if stored(path) is None:
        raise FoamFileError(f"{case}: there is no constant/polyMesh/points")
    return int(np.argmax(np.ptp(read_list(path, float, 3), axis=0)))


if __name__ == "__main__":
    print(longest_side(Path(sys.argv[1])))
