# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The stomach elsewhere in space: the same forces, work and flow.

Case A on 2 mm until 8.5 s, when the wave breaks the bolus. The mesh is moved
or turned after it was made, the fields stay: the numbers of the cells do.
"""

import shutil

import numpy as np
import pytest
from bolus_cases.specimens import ROOT, replace, run_case
from bolus_cases.synthetic import run, run_parallel
from bolus_results.tables import read_table

CASE_A = ROOT / "tutorials" / "gastric" / "caseA"
COARSE = (
    *("-set", "resolution=2e-3", "-set", "pylorusRefinement=2.5"),
    *("-set", "endTime=8.5", "-set", "writeInterval=8.5"),
)

# Each table in what must be the same, and its largest value in this run
TABLES = {
    "contactForce": ("axial", "total", "tangential"),
    "externalWork": ("work",),
    "retainedMass": ("inside", "upstream"),
    "damagedVolume": ("damaged",),
    "jets": ("back", "out"),
    "bolusStatistics": ("eta95", "eps95", "pMax", "xMin", "xMax"),
    "wallEnergy": ("energy", "hoopMin"),
}


@pytest.fixture(scope="module")
def straight(tmp_path_factory):
    """Case A where it is."""
    case = tmp_path_factory.mktemp("axis") / "straight"
    run_case(CASE_A, "-out", case, *COARSE)
    return case


def elsewhere(straight, case, motility, *transform):
    """That case at its start with its points transformed."""
    shutil.copytree(
        straight,
        case,
        ignore=shutil.ignore_patterns(
            "[1-9]*", "postProcessing", "pictures", "log.*"
        ),
    )
    run(case, "transformPoints", *transform)
    replace(
        case / "constant" / "motilityProperties",
        r"\nresidualGap",
        f"\n{motility}\nresidualGap",
    )
    return case


def assert_same(case, straight, tolerance):
    """All tables agree, in parts of the largest value of a column."""
    for name, columns in TABLES.items():
        one, other = read_table(case, name), read_table(straight, name)
        assert one.time == pytest.approx(other.time, abs=1e-9)
        for column in columns:
            scale = np.abs(other[column]).max()
            assert one[column] == pytest.approx(
                other[column], abs=tolerance * scale
            ), (name, column)


# What moves the points, and what motilityProperties then has to say
PLACES = {
    "sideways": (("-translate", "(0 0.1 0)"), "origin (0 0.1 0);"),
    "across the slice": (("-translate", "(0 0 3)"), "origin (0 0 3);"),
    "along itself": (("-translate", "(-7 0 0)"), "origin (-7 0 0);"),
    "by less than a hair": (("-translate", "(0 1e-9 0)"), ""),
    "to z": (("-rotate", "((1 0 0) (0 0 1))"), "axis (0 0 1);"),
    "to -x": (("-rollPitchYaw", "(0 0 180)"), "axis (-1 0 0);"),
    "in its plane": (
        ("-rollPitchYaw", "(0 0 -45)"),
        "axis (0.7071067811865476 -0.7071067811865476 0);",
    ),
}


@pytest.mark.parametrize("place", PLACES)
def test_case_a_elsewhere_in_space_is_case_a(straight, tmp_path, place):
    transform, motility = PLACES[place]
    case = elsewhere(straight, tmp_path / "case", motility, *transform)
    run(case, "bolusFoam")
    # Points are written with 12 digits: 3e-12 m at 3 m, 1e-8 of a cell in the
    # throat. The axis dropped by a hair took 3.5e-3
    assert_same(case, straight, 2e-6)


def test_an_axis_elsewhere_is_the_same_on_two_ranks(straight, tmp_path):
    case = elsewhere(
        straight,
        tmp_path / "case",
        "origin (0 0.1 0);",
        *("-translate", "(0 0.1 0)"),
    )
    run_parallel(case, "bolusFoam")
    assert_same(case, straight, 1e-5)


@pytest.mark.parametrize("offset", ["(0 1e-4 0)", "(0 0 1e-4)", "(0 -1e-3 0)"])
def test_a_motility_beside_the_axis_of_the_wedge_is_refused(
    straight, tmp_path, offset
):
    case = elsewhere(
        straight, tmp_path / "case", f"origin {offset};", "-scale", "(1 1 1)"
    )
    message = " ".join(run(case, "bolusFoam", ok=False).split())
    assert message.count("FOAM FATAL") == 1
    assert "'origin'" in message
    assert "away from the axis of the wedge mesh" in message


def test_a_function_object_may_have_an_origin_of_its_own(straight, tmp_path):
    # Its throat is 0.252 m from there, where the mesh ends
    case = elsewhere(straight, tmp_path / "case", "", "-scale", "(1 1 1)")
    replace(
        case / "system" / "controlDict",
        r"throat  ",
        "origin (0.1 0 0); axis (1 0 0); throat  ",
    )
    message = " ".join(run(case, "bolusFoam", ok=False).split())
    assert "'throat' is 0.252 m; valid are places in the mesh, from 0.11 m" in (
        message
    )


def test_an_axis_of_a_function_object_across_the_wedge_is_refused(
    straight, tmp_path
):
    case = elsewhere(straight, tmp_path / "case", "", "-scale", "(1 1 1)")
    replace(
        case / "system" / "controlDict",
        r"pylorus  ",
        "axis (0 1 0); pylorus  ",
    )
    message = " ".join(run(case, "bolusFoam", ok=False).split())
    assert "Entry 'axis' is (0 1 0), not along the axis of the wedge" in message
