# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""A run is read the same whatever way its axis points and goes through."""

import shutil

import numpy as np
import pytest
from bolus_cases.synthetic import plane_mesh, wedge_mesh, write_file
from bolus_results import plots
from bolus_results.fields import Case
from bolus_results.foam_files import FoamFileError
from bolus_results.state import state
from matplotlib import image
from scipy.spatial.transform import Rotation
from test_results import broken_bolus

DIAGONAL = np.array([1, 1, 0]) / np.sqrt(2)
OBLIQUE = np.array([2, -3, 6]) / 7
# Axis, and where x = 0 goes [m]
FRAMES = {
    "z": ((0, 0, 1), (0, 0, 0)),
    "-x": ((-1, 0, 0), (0, 0, 0)),
    "-y, aside": ((0, -1, 0), (0.1, 0.03, -0.2)),
    "aside": ((1, 0, 0), (0, 0.1, 0)),
    "further on": ((1, 0, 0), (0.3, 0, 0)),
    "hardly aside": ((1, 0, 0), (0, 1e-9, 0)),
    "diagonal": (DIAGONAL, (0, 0, 0)),
    "oblique": (OBLIQUE, (0.5, -0.2, 0.1)),
    "most along -y": (np.array([0.6, -0.8, 0]), (0, 0, 0)),
}


def write_points(case, points, digits=17):
    rows = "".join(
        "(" + " ".join(f"{x:.{digits}g}" for x in p) + ")\n" for p in points
    )
    write_file(
        case / "constant" / "polyMesh" / "points",
        f"{len(points)}\n(\n{rows})\n",
        "vectorField",
    )


def vector(v):
    return "(" + " ".join(f"{x:.17g}" for x in v) + ")"


def moved(case, target, axis, origin, declared=True, digits=17):
    """A copy of a case about x, its axis turned and shifted; declared: it has
    motilityProperties that say so."""
    shutil.copytree(case, target)
    axis, x = np.array(axis, float), np.array([1.0, 0, 0])
    turn = Rotation.align_vectors([axis], [x])[0]
    # And about itself, so that the section is in no plane of coordinates
    turn = Rotation.from_rotvec(0.7 * axis) * turn
    mesh = Case(case).mesh(0)
    write_points(target, turn.apply(mesh.points) + origin, digits)
    velocity = Case(case).field(1.0, "U")
    rows = "".join(f"{vector(u)}\n" for u in turn.apply(velocity))
    write_file(
        target / "1" / "U",
        f"internalField nonuniform List<vector> {len(velocity)}\n({rows});\n",
        "volVectorField",
    )
    if declared:
        write_file(
            target / "constant" / "motilityProperties",
            f"length 2; a $length;\naxis {vector(2 * axis)};\n"
            f"origin {vector(origin)};\n",
        )
    return target


@pytest.fixture(scope="module")
def straight(tmp_path_factory):
    """A broken bolus about x, with what is read of it."""
    case = tmp_path_factory.mktemp("straight") / "case"
    broken_bolus(case)
    return case, state(Case(case), 1.0).numbers


def flat(numbers):
    return {
        f"{name}.{key}": x
        for name, number in numbers.items()
        for key, x in number.items()
        if key != "unit"
    }


@pytest.mark.parametrize("name", FRAMES)
def test_results_do_not_depend_on_the_axis(straight, tmp_path, name):
    case, expected = straight
    turned = moved(case, tmp_path / "turned", *FRAMES[name])
    found = flat(state(Case(turned), 1.0).numbers)
    # Coordinates of up to 0.5 m in 16 digits: 1e-15 of cells of 1 mm
    assert found == pytest.approx(flat(expected), rel=1e-9, abs=1e-14)
    assert found["jetForward.value"] == pytest.approx(0.01)
    assert found["triaxialityMaxCore.value"] == 1.7


@pytest.mark.parametrize("name", ["-x", "oblique"])
def test_sections_and_pictures_do_not_depend_on_the_axis(
    straight, tmp_path, name
):
    case, _ = straight
    turned = moved(case, tmp_path / "turned", *FRAMES[name])
    meshes = [Case(path).mesh(1.0) for path in (case, turned)]
    for a, b in zip(*(mesh.section.polygons for mesh in meshes), strict=True):
        assert b == pytest.approx(a, abs=1e-9)
    for a, b in zip(*(mesh.wall_lines() for mesh in meshes), strict=True):
        # Either end first
        assert np.sort(b, axis=0) == pytest.approx(np.sort(a, axis=0), abs=1e-9)
    quantity = plots.Quantity("alpha", "x", "-", 1, "Greens", (0, 1))
    pictures = []
    for path in (case, turned):
        target = path / "alpha.png"
        # Without the case's name
        assert plots.contour_page(Case(path), quantity, target, (1.0,))
        pictures.append(image.imread(target)[60:, :, :3])
    # Of a million pixels some are at the edge of a cell
    differs = np.abs(pictures[0] - pictures[1]).max(axis=2) > 0.2
    assert differs.mean() < 1e-3


@pytest.mark.parametrize("name", ["z", "aside", "diagonal", "most along -y"])
def test_without_motility_the_wedge_tells_the_axis(straight, tmp_path, name):
    case, expected = straight
    turned = moved(case, tmp_path / "turned", *FRAMES[name], declared=False)
    found = flat(state(Case(turned), 1.0).numbers)
    assert found == pytest.approx(flat(expected), rel=1e-9, abs=1e-14)


def test_points_of_six_digits_tell_the_axis_too(straight, tmp_path):
    case, expected = straight
    for declared in (True, False):
        target = tmp_path / f"turned{declared}"
        moved(case, target, *FRAMES["aside"], declared=declared, digits=6)
        found = state(Case(target), 1.0)
        # 5e-8 m, over the sine of 2.5 degrees, of a third of 10 mm
        for name in ("jetForward", "triaxialityMaxCore"):
            assert found[name] == pytest.approx(expected[name]["value"])


@pytest.mark.parametrize(
    ("motility", "says"),
    [
        ("axis (0 0 1);", r"meet in the axis \(1 0 0\) through \(0 0 0\)"),
        ("origin (0 0.001 0);", "meet in the axis"),
        ("origin (0 0 -0.1);", "meet in the axis"),
        ("axis (1 1e-3 1e-3);", "meet in the axis"),
        ("axis (0 0 0);", "any length but zero"),
        ("axis x;", "axis is x; valid is a vector"),
        ("origin (0 0);", "origin is .*0 0.*; valid is a vector"),
        ("axis (1 0", "motilityProperties"),
    ],
)
def test_an_axis_that_is_not_the_wedges_is_refused(tmp_path, motility, says):
    wedge_mesh(tmp_path, 0.04, 0.02, 4, 2)
    path = tmp_path / "constant" / "motilityProperties"
    write_file(path, motility)
    with pytest.raises(FoamFileError, match=says):
        Case(tmp_path).mesh(0).radii  # noqa: B018


def test_sides_of_a_wedge_may_be_of_several_patches(tmp_path):
    wedge_mesh(tmp_path, 0.04, 0.02, 4, 2)
    whole = Case(tmp_path).mesh(0)
    first = whole.patches["wedge0"]
    boundary = tmp_path / "constant" / "polyMesh" / "boundary"
    part = "{ type wedge; nFaces 4; startFace %d; }\n"
    text = boundary.read_text()
    begin = text.index("wedge0")
    end = text.index("}", begin) + 1
    boundary.write_text(
        text[:begin]
        + f"front {part % first.start} more {part % (first.start + 4)}"
        + text[end:]
    )
    mesh = Case(tmp_path).mesh(0)
    assert mesh.wedge_angle == pytest.approx(whole.wedge_angle)
    assert sorted(mesh.section.cells) == list(range(8))


# A cyclic permutation of the coordinates, and what is along and across then
@pytest.mark.parametrize("shift", [0, 1, 2])
def test_plane_meshes_may_lie_across_any_coordinate(tmp_path, shift):
    plane_mesh(tmp_path, (0.04, 0.01), (4, 3))
    points = np.roll(Case(tmp_path).mesh(0).points, shift, axis=1)
    write_points(tmp_path, points)
    mesh = Case(tmp_path).mesh(0)
    corners = np.vstack(mesh.section.polygons)
    assert len(mesh.section.polygons) == 12
    # x-y: x along; y-z: y along; z-x: x along, which is the short side
    size = (0.01, 0.04) if shift == 2 else (0.04, 0.01)
    assert np.ptp(corners, axis=0) == pytest.approx(size)
    assert corners.min() == pytest.approx(0, abs=1e-12)


def test_an_axis_across_a_plane_mesh_is_refused(tmp_path):
    plane_mesh(tmp_path, (0.04, 0.01), (4, 3))
    write_file(tmp_path / "constant" / "motilityProperties", "axis (0 0 1);")
    with pytest.raises(FoamFileError, match="valid is an axis in its plane"):
        Case(tmp_path).mesh(0).section  # noqa: B018
