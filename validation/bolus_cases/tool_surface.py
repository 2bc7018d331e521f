# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Tools given as closed surfaces (STL), for the mesher of the cutting cases.

The surface is in metres; its origin is on the tool's axis, z runs along the
axis and -y is the tool's way. Half of the tool is meshed, x >= 0, so that it
has to be symmetric; and its section has to be the same along z and to be seen
whole from the axis (star-shaped): wedges, blades, teeth, bars.
"""

from pathlib import Path

import meshio
import numpy as np

# A corner of the outline turns by more than this [degree]
CORNER = 25.0


def check_surface(path: Path) -> np.ndarray:
    """Triangles of an STL file that must be closed (n, 3, 3).

    Closed: each edge belongs to two triangles, which pass it in opposite
    directions.
    """
    if not path.is_file():
        raise SystemExit(f"{path}: there is no such file; valid is an STL file")
    try:
        with np.errstate(over="ignore"):
            mesh = meshio.read(path, "stl")
        triangles = mesh.points[mesh.cells_dict["triangle"]].astype(float)
    except (meshio.ReadError, ValueError, KeyError, IndexError) as error:
        raise SystemExit(f"{path}: no STL file of triangles: {error}") from None
    size = np.ptp(triangles.reshape(-1, 3), axis=0).max()
    # Corners agree to the precision of binary STL
    corners = np.round(triangles.reshape(-1, 3) / (1e-6 * size)).astype(int)
    _, label = np.unique(corners, axis=0, return_inverse=True)
    label = label.reshape(-1, 3)
    edges = np.concatenate([label[:, [i, (i + 1) % 3]] for i in range(3)])
    have = {}
    for a, b in edges:
        have[a, b] = have.get((a, b), 0) + 1
    loose = sum(
        n != 1 or have.get((b, a), 0) != 1 for (a, b), n in have.items()
    )
    if loose:
        raise SystemExit(
            f"{path}: the surface is open: {loose} of its edges do not belong "
            "to two triangles of opposite sense; valid is a closed surface"
        )
    return triangles


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Of vectors in the plane (..., 2)."""
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def section(triangles: np.ndarray, z: float) -> np.ndarray:
    """Segments (n, 2, 2) in which a plane of constant z cuts a surface; their
    ends in no order."""
    found = []
    for triangle in triangles[
        (triangles[:, :, 2].min(axis=1) < z)
        & (triangles[:, :, 2].max(axis=1) > z)
    ]:
        ends = []
        for a, b in zip(triangle, np.roll(triangle, -1, axis=0), strict=True):
            if (a[2] < z) != (b[2] < z):
                # From the lower end: the same point for both its triangles
                low, high = (a, b) if a[2] < b[2] else (b, a)
                part = (z - low[2]) / (high[2] - low[2])
                ends.append((low + part * (high - low))[:2])
        found.append(ends)
    return np.array(found).reshape(-1, 2, 2)


def reach(segments: np.ndarray, angle: float) -> np.ndarray:
    """Distances from the axis at which a ray meets the segments (n,) [m].

    angle    of the ray against +x [rad]
    """
    ray = np.array([np.cos(angle), np.sin(angle)])
    a, b = segments[:, 0], segments[:, 1]
    side_a, side_b = cross(ray, a), cross(ray, b)
    meets = (side_a < 0) != (side_b < 0)
    a, b = a[meets], b[meets]
    part = side_a[meets] / (side_a[meets] - side_b[meets])
    r = (a + part[:, None] * (b - a)) @ ray
    return r[r > 0]


def outline(path: Path, depth: float) -> np.ndarray:
    """Right half of the tool's section, from below the axis to above (n, 2).

    depth    of the mesh along z, which the tool must reach through; with a
             plane of symmetry at z = 0 that of both halves [m]
    """
    triangles = check_surface(path)
    low, high = triangles[..., 2].min(), triangles[..., 2].max()
    if min(-low, high) < 0.5 * depth:
        raise SystemExit(
            f"{path}: the tool reaches from z = {low:g} to {high:g}; valid are "
            f"tools that end outside of the mesh, +-{0.5 * depth:g}"
        )
    # Not through corners of the triangles
    heights = 0.499 * depth * np.array([0.0012, -0.9987, 0.9978])
    cuts = [section(triangles, z) for z in heights]
    middle = cuts[0]
    size = np.linalg.norm(middle, axis=2).max()

    # A ray just beside each corner, on either side, and through the axis
    ends = middle.reshape(-1, 2)
    angles = np.arctan2(ends[:, 1], ends[:, 0])
    probes = np.concatenate([angles - 1e-5, angles + 1e-5])
    for angle in probes:
        seen = [reach(cut, a) for cut in cuts for a in (angle, np.pi - angle)]
        here = f"{path}: at {np.degrees(angle) % 360:.1f} degrees from +x"
        if any(len(r) != 1 for r in seen):
            raise SystemExit(
                f"{here} a ray from the axis meets the tool "
                f"{max(len(r) for r in seen)} times; valid are tools around "
                "the axis x = y = 0 whose section is seen whole from there"
            )
        radii = np.concatenate(seen)
        if np.ptp(radii[1::2]) + np.ptp(radii[::2]) > 1e-3 * size:
            raise SystemExit(
                f"{here} the tool's section changes along z; valid are tools "
                "of constant section"
            )
        if np.ptp(radii) > 1e-3 * size:
            raise SystemExit(
                f"{here} the tool is not symmetric: {radii[0]:g} and "
                f"{radii[1]:g} m on its sides; valid are tools symmetric in x"
            )

    right = ends[np.argsort(angles)]
    right = right[right[:, 0] > 1e-6 * size]
    # Each is the end of two segments
    apart = np.linalg.norm(np.diff(right, axis=0), axis=1) > 1e-6 * size
    right = right[[True, *apart]]
    middle_ends = [
        (0.0, sign * reach(middle, sign * (0.5 * np.pi - 1e-9))[0])
        for sign in (-1, 1)
    ]
    points = np.array([middle_ends[0], *right, middle_ends[1]])
    # Without those on straight lines, of which the triangulation has many
    step = np.diff(points, axis=0)
    turn = cross(step[:-1], step[1:])
    scale = np.linalg.norm(step, axis=1)
    bends = abs(turn) > 1e-6 * scale[:-1] * scale[1:]
    return points[[True, *bends, True]]


def divide(path: Path, points: np.ndarray, n: int) -> np.ndarray:
    """Divide an outline into n parts whose ends include its corners (n + 1, 2).

    The parts are about equal in length and in the angle at the axis, half and
    half.
    """
    fine = np.concatenate(
        [
            np.linspace(a, b, 50, endpoint=False)
            for a, b in zip(points[:-1], points[1:], strict=True)
        ]
        + [points[-1:]]
    )
    way = np.cumsum([0, *np.linalg.norm(np.diff(fine, axis=0), axis=1)])
    angle = np.arctan2(fine[:, 1], fine[:, 0])
    angle[[0, -1]] = -0.5 * np.pi, 0.5 * np.pi
    t = 0.5 * (way / way[-1] + (angle + 0.5 * np.pi) / np.pi)

    step = np.diff(points, axis=0)
    heading = np.degrees(np.arctan2(step[:, 1], step[:, 0]))
    turn = (np.diff(heading) + 180) % 360 - 180
    corners = 50 * (1 + np.flatnonzero(abs(turn) > CORNER))
    numbers = np.array([0, *np.round(n * t[corners]).astype(int), n])
    if np.any(np.diff(numbers) < 1):
        raise SystemExit(
            f"{path}: the tool has {len(corners)} corners in its half, some "
            f"closer than the {n} cells around it; valid is a smaller cellSize"
        )
    at = np.interp(np.arange(n + 1), numbers, [0, *t[corners], 1])
    return np.column_stack([np.interp(at, t, x) for x in fine.T])
