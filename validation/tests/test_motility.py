# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The motion of the stomach wall, in real meshes, against Eqs. 12 to 15.

The meshes are those of tutorials/gastric/caseA, coarser; moveDynamicMesh, the
stock application, moves them.
"""

import math
import os
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from bolus_results.fields import Case
from bolus_validation.gastric_causes import NARROWER, WIDER
from bolus_validation.motility import Motility
from scipy.interpolate import PchipInterpolator

ROOT = Path(__file__).resolve().parents[2]
CASE_A = ROOT / "tutorials" / "gastric" / "caseA"

# What the issue asks for [m]
WALL_TOLERANCE = 1e-9

# Variants of the motility: changes of the dictionary, and the same in Python
VARIANTS = {
    "centre": ({}, Motility()),
    "tail": ({"waves.reading": "tail"}, Motility(reading="tail")),
    "options": (
        {
            "waves.occlusionBy": "travel",
            "waves.fadeOut.wave0.fadeBy": "position",
            "sphincter.ramp": "linear",
            "profile.interpolation": "linear",
            "residualGap": "2e-4",
            "waves.exponent": "4",
        },
        Motility(
            c_by="travel",
            fade_by="position",
            ramp="linear",
            interpolation="linear",
            gap=2e-4,
            a=4,
        ),
    ),
}

HEADER = "FoamFile {{ version 2.0; format ascii; class {}; object {}; }}\n"

CONTROL = """
application moveDynamicMesh;
startFrom startTime; startTime 0; stopAt endTime; endTime 32; deltaT 0.5;
writeControl timeStep; writeInterval 1; writeFormat ascii;
writePrecision 15; timeFormat general; timePrecision 8;
runTimeModifiable no;
libs ("libbolusMotility.so");
"""

SCHEMES = """
ddtSchemes { default Euler; } gradSchemes { default Gauss linear; }
divSchemes { default none; } snGradSchemes { default corrected; }
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
"""

SOLUTION = """
solvers { "cellDisplacement.*"
{ solver PCG; preconditioner DIC; tolerance 1e-8; relTol 0; } }
"""

# A full cylinder of radius 1 about the x axis: a square core and four blocks
CYLINDER = """
scale 1;
vertices
(
    (0.21 -0.4 -0.4) (0.21 0.4 -0.4) (0.21 0.4 0.4) (0.21 -0.4 0.4)
    (0.21 -{c} -{c}) (0.21 {c} -{c}) (0.21 {c} {c}) (0.21 -{c} {c})
    (0.256 -0.4 -0.4) (0.256 0.4 -0.4) (0.256 0.4 0.4) (0.256 -0.4 0.4)
    (0.256 -{c} -{c}) (0.256 {c} -{c}) (0.256 {c} {c}) (0.256 -{c} {c})
);
blocks
(
    hex (0 1 2 3 8 9 10 11)   (4 4 46) simpleGrading (1 1 1)
    hex (4 5 1 0 12 13 9 8)   (4 4 46) simpleGrading (1 1 1)
    hex (5 6 2 1 13 14 10 9)  (4 4 46) simpleGrading (1 1 1)
    hex (6 7 3 2 14 15 11 10) (4 4 46) simpleGrading (1 1 1)
    hex (7 4 0 3 15 12 8 11)  (4 4 46) simpleGrading (1 1 1)
);
edges
(
    arc 4 5 (0.21 0 -1) arc 5 6 (0.21 1 0)
    arc 6 7 (0.21 0 1)  arc 7 4 (0.21 -1 0)
    arc 12 13 (0.256 0 -1) arc 13 14 (0.256 1 0)
    arc 14 15 (0.256 0 1)  arc 15 12 (0.256 -1 0)
);
boundary
(
    wall
    {{
        type wall;
        faces ((4 5 13 12) (5 6 14 13) (6 7 15 14) (7 4 12 15));
    }}
    shell
    {{
        type wall;
        faces ((0 1 2 3) (4 5 1 0) (5 6 2 1) (6 7 3 2) (7 4 0 3));
    }}
    outlet
    {{
        type patch;
        faces
        (
            (8 9 10 11) (12 13 9 8) (13 14 10 9) (14 15 11 10) (15 12 8 11)
        );
    }}
);
""".format(c=math.sqrt(0.5))


def run(case, *command, ok=True):
    """Run an application in a case; return what it printed."""
    done = subprocess.run(
        command,
        cwd=case,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
        env={**os.environ, "PWD": str(case)},
    )
    if ok:
        assert done.returncode == 0, done.stdout[-3000:]
    else:
        assert done.returncode != 0, f"{command[0]} accepted the bad input"
    return done.stdout


def write_dict(case, name, text, cls="dictionary"):
    path = case / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(HEADER.format(cls, path.name) + text)


def set_entry(case, name, entry, value):
    """Set an entry a.b.c of a dictionary file."""
    text = run(
        case, "foamDictionary", name, "-entry", entry, "-set", str(value)
    )
    assert "FOAM FATAL" not in text, text


def make_case(case, changes=None, resolution=1e-3, **control):
    """Dictionaries of a case: the motility of caseA with changes."""
    shutil.copytree(CASE_A / "constant", case / "constant")
    (case / "system").mkdir()
    for name in ("meshParameters", "makeBlockMeshDict.py"):
        shutil.copy(CASE_A / "system" / name, case / "system")
    write_dict(case, "system/controlDict", CONTROL)
    write_dict(case, "system/fvSchemes", SCHEMES)
    write_dict(case, "system/fvSolution", SOLUTION)
    set_entry(case, "system/meshParameters", "resolution", resolution)
    for entry, value in (changes or {}).items():
        set_entry(case, "constant/motilityProperties", entry, value)
    for entry, value in control.items():
        set_entry(case, "system/controlDict", entry, value)
    return case


def make_mesh(case):
    run(case, "python3", "system/makeBlockMeshDict.py")
    run(case, "blockMesh")
    run(case, "gastricMesh")
    return case


def radii(points):
    return np.hypot(points[:, 1], points[:, 2])


def wall_points(case, time):
    """Positions x and radii of the points on the wall (n,), (n,) [m]."""
    mesh = case.mesh(time)
    faces = [mesh.faces[i] for i in mesh.patches["wall"].faces]
    points = mesh.points[np.unique(np.concatenate(faces))]
    return points[:, 0], radii(points)


def wall_error(case, time, motility):
    """Largest distance of the wall in the mesh from the equations [m]."""
    x, r = wall_points(case, time)
    assert x.size
    return np.abs(r - motility.radius(x, time)).max()


@pytest.fixture(scope="module", params=VARIANTS)
def moved(request, tmp_path_factory):
    """(case moved for 32 s, its log, the same motility in Python)"""
    changes, motility = VARIANTS[request.param]
    case = make_case(tmp_path_factory.mktemp(request.param) / "case", changes)
    make_mesh(case)
    log = run(case, "moveDynamicMesh")
    return Case(case), log, motility


def test_wall_follows_equations_12_to_15_to_1e_9_m(moved):
    case, _, motility = moved
    times = [t for t in case.times if t > 0]
    assert len(times) == 64
    for t in [0.0, *times]:
        assert wall_error(case, t, motility) < WALL_TOLERANCE, t


def test_wall_follows_equations_while_the_sphincter_moves(moved, tmp_path):
    """A run that starts there also shows that nothing is remembered."""
    case, _, motility = moved
    new = tmp_path / "case"
    for folder in ("constant", "system"):
        shutil.copytree(case.path / folder, new / folder)
    for event in (motility.arrival(wave, 0.240) for wave in (0, 1)):
        start = round(event - 0.02, 2)
        for name, value in {
            "startTime": start,
            "endTime": start + 0.14,
            "deltaT": 0.02,
        }.items():
            set_entry(new, "system/controlDict", name, value)
        run(new, "moveDynamicMesh")
        written = Case(new)
        times = [t for t in written.times if start < t < start + 0.141]
        assert len(times) >= 7
        closures = [motility.closure(t) for t in times]
        assert min(closures) < 0.2 and max(closures) > 0.8
        for t in times:
            assert wall_error(written, t, motility) < WALL_TOLERANCE, t


def test_inner_points_keep_their_share_of_the_radius(moved):
    case, _, motility = moved
    before = case.mesh(0.0).points
    share = radii(before) / motility.radius(before[:, 0], 0.0)
    for t in (7.5, 16.5, 29.0):
        points = case.mesh(t).points
        # Radial motion: to the digits that are written, x does not change
        assert np.abs(points[:, 0] - before[:, 0]).max() < 1e-14
        r = share * motility.radius(points[:, 0], t)
        assert np.abs(radii(points) - r).max() < WALL_TOLERANCE


def test_volume_of_the_lumen_stays_positive_and_exact(moved):
    case, log, motility = moved
    x = np.unique(case.mesh(0.0).points[:, 0])
    # Points in one plane x = const agree to the ten digits of blockMesh
    x = x[np.concatenate([[True], np.diff(x) > 1e-7])]
    for t in (0.0, 9.0, 16.0, 18.0, 24.0, 29.0, 32.0):
        volumes = case.mesh(t).cell_volumes
        assert volumes.min() > 0
        # The mesh is a polyhedron: exact, up to the digits of its points
        expected = motility.sector_volume(x, t, math.radians(5))
        assert volumes.sum() == pytest.approx(expected, rel=1e-6)
    # and checkMesh, which moveDynamicMesh runs at every step, agrees
    assert log.count("Cell volumes OK.") == 64
    assert log.count("Face pyramids OK.") == 64


def timeline(log):
    """What the motion solver says: text -> time [s]."""
    lines = re.findall(r"^    t = (\S+) s: (.*)$", log, flags=re.M)
    return {text: float(time) for time, text in lines}


def test_timeline_of_the_paper_in_both_readings(tmp_path):
    expected = {
        # Times of facts.md; "centre" is the reading that meets the paper's
        # own, 18 s, 25.5 s and 32 s
        "centre": (16.0, 18.0, 25.6, 32.0),
        "tail": (17.5, None, 27.1, None),
    }
    for reading, times in expected.items():
        closes, fades, opens, leaves = times
        case = make_case(
            tmp_path / reading,
            {"waves.reading": reading},
            resolution=2e-3,
            endTime=0.5,
        )
        said = timeline(run(make_mesh(case), "moveDynamicMesh"))
        motility = Motility(reading=reading)

        # Exact up to the six digits of the log
        exact = pytest.approx
        assert said["sphincter closes"] == exact(closes, abs=1e-4)
        assert said["sphincter closed"] == exact(closes + 0.1, abs=1e-4)
        assert said["sphincter opens"] == exact(opens, abs=1e-4)
        assert said["sphincter open"] == exact(opens + 0.1, abs=1e-4)
        if fades:
            text = "wave 0 faded out, tip at x = 0.245 m"
            assert said[text] == exact(fades, abs=1e-4)
        left = said["wave 1 leaves, tip at x = 0.256 m"]
        if leaves:
            assert left == exact(leaves, abs=1e-4)
        else:
            # It "never gets to x_2 by 32 s"
            assert left > 33

        # and the equations say the same
        assert motility.arrival(0, 0.240) == exact(closes, abs=1e-9)
        assert motility.arrival(1, 0.240) == exact(opens, abs=1e-9)
        assert motility.arrival(1, 0.256) == exact(left, abs=1e-4)


@pytest.mark.parametrize("moved", ["centre"], indirect=True)
def test_wall_passes_the_stations_of_the_paper(moved):
    """In the mesh, not in the log: facts.md, contradiction 3."""
    case, _, motility = moved

    def open_share(t):
        x, r = wall_points(case, t)
        return x, r / motility.open_radius(x)

    # 16.0 s: the tip of wave 0 at x_m, the strongest occlusion, 0.9. Points
    # lie up to 0.5 mm from x_m: 1 - 0.9 (1 - (0.5/6.25)^2)^5 = 0.128
    x, share = open_share(16.0)
    assert abs(x[share.argmin()] - 0.240) <= 0.5e-3
    assert 0.1 - 1e-9 < share.min() < 0.128

    # 18.0 s: nothing is left of wave 0; the sphincter is closed
    x, share = open_share(18.0)
    beyond = (x > 0.235) & (x < 0.250)
    assert np.abs(share[beyond] - 1).max() < 1e-6
    assert share[x > 0.250].min() * 1.5e-3 == pytest.approx(2e-5, rel=1e-6)

    # 25.5 s: still closed; 26 s: open, wave 1 just past x_m
    assert open_share(25.5)[1].min() * 1.5e-3 == pytest.approx(2e-5, rel=1e-6)
    x, share = open_share(26.0)
    assert abs(x[share.argmin()] - 0.241) <= 0.5e-3
    assert share[(x > 0.251) & (x < 0.253)].min() == pytest.approx(1, 1e-6)

    # 29 s: the wave is in the sphincter; 32 s: its tip at x_2
    x, share = open_share(29.0)
    inside = (x > 0.250) & (x < 0.253)
    assert share[inside].max() < 1 - 1e-3
    x, share = open_share(32.0)
    assert share[np.isclose(x, 0.256)] == pytest.approx(0.1, abs=1e-6)


def test_stomach_holds_0_88_l_and_the_bolus_fits():
    motility = Motility()
    x = np.linspace(0, 0.250, 200001)
    volume = np.trapezoid(np.pi * motility.profile(x) ** 2, x)
    # The paper gives two digits
    assert volume == pytest.approx(0.88e-3, rel=1e-3)
    assert motility.profile(0.250) == pytest.approx(6e-3, abs=1e-12)

    radius, centre = 12.8e-3, 0.2228
    x = np.linspace(centre - radius, centre + radius, 20001)
    sphere = np.sqrt(np.maximum(radius**2 - (x - centre) ** 2, 0))
    assert np.all(motility.open_radius(x) > sphere)
    assert centre - radius == pytest.approx(0.210)

    # facts.md: the wave first touches it "at about 6.9 s". That is the time
    # when the occlusion is taken at the tip; with Eq. 15's C(x) it is earlier
    times = np.arange(5, 9, 0.05)
    for by, expected in (("travel", 6.95), ("position", 6.65)):
        wall = Motility(c_by=by)
        touched = [np.any(wall.radius(x, t) < sphere) for t in times]
        assert times[np.argmax(touched)] == pytest.approx(expected, abs=0.051)


@pytest.mark.parametrize("stomach", [WIDER, NARROWER])
def test_other_stomachs_hold_0_88_l_and_the_bolus_fits(stomach):
    (text,) = stomach.values()
    x, r = np.array(re.findall(r"\(([\d.]+) ([\d.]+)\)", text), float).T
    radius = PchipInterpolator(x, r)
    assert (x[-1], r[-1]) == (0.250, 6e-3)
    x = np.linspace(0, 0.250, 20001)
    volume = np.trapezoid(np.pi * radius(x) ** 2, x)
    assert volume == pytest.approx(0.88e-3, rel=1e-3)
    x = np.linspace(0.210, 0.2356, 2001)
    sphere = np.sqrt(np.maximum(12.8e-3**2 - (x - 0.2228) ** 2, 0))
    assert np.all(radius(x) > sphere)


def patch_condition(folder):
    """A case with lumenDisplacement under a Laplacian motion solver."""
    case = make_mesh(make_case(folder, deltaT=1, endTime=3))
    write_dict(
        case,
        "constant/dynamicMeshDict",
        "dynamicFvMesh dynamicMotionSolverFvMesh;"
        'motionSolverLibs ("libfvMotionSolvers.so");'
        "motionSolver displacementLaplacian;"
        "displacementLaplacianCoeffs { diffusivity uniform; }",
    )
    write_dict(
        case,
        "0/pointDisplacement",
        "dimensions [0 1 0 0 0 0 0]; internalField uniform (0 0 0);"
        "boundaryField {"
        "wall { type lumenDisplacement; value uniform (0 0 0); }"
        '"shell|outlet" { type slip; } "wedge.*" { type wedge; }'
        "axis { type empty; } }",
        "pointVectorField",
    )
    return case


def test_patch_condition_beside_the_axis_of_the_wedge_is_refused(tmp_path):
    case = patch_condition(tmp_path / "case")
    run(case, "transformPoints", "-translate", "(0 0 1e-4)")
    said = " ".join(run(case, "moveDynamicMesh", ok=False).split())
    assert "away from the axis of the wedge mesh" in said


def test_patch_condition_gives_the_wall_of_the_motion_solver(tmp_path):
    """lumenDisplacement under a Laplacian motion solver, and its restart."""
    case = patch_condition(tmp_path / "case")
    run(case, "moveDynamicMesh")

    # A restart must count from the same points, not from the moved ones
    for name, value in {
        "startFrom": "latestTime",
        "deltaT": 2,
        "endTime": 13,
    }.items():
        set_entry(case, "system/controlDict", name, value)
    run(case, "moveDynamicMesh")

    case = Case(case)
    assert {2.0, 3.0, 5.0, 13.0} <= set(case.times)
    for t in case.times:
        if t > 0:
            assert wall_error(case, t, Motility()) < WALL_TOLERANCE, t
    # The wall did move
    x, r = wall_points(case, 13.0)
    assert np.abs(r - Motility().radius(x, 0.0)).max() > 1e-3


def test_three_dimensional_mesh_moves_with_any_axis(tmp_path):
    """A whole stomach along z, away from the origin of the mesh."""
    case = make_case(tmp_path / "case", deltaT=4)
    write_dict(case, "system/blockMeshDict", CYLINDER)
    run(case, "blockMesh")
    run(case, "transformPoints", "-rotate", "((1 0 0) (0 0 1))")
    run(case, "transformPoints", "-translate", "(0.5 -0.2 -0.1)")
    for entry, value in {
        "axis": "(0 0 2)",
        "origin": "(0.5 -0.2 -0.1)",
    }.items():
        name = "constant/motilityProperties"
        run(case, "foamDictionary", name, "-entry", entry, "-add", value)
    run(case, "gastricMesh")
    log = run(case, "moveDynamicMesh")
    assert log.count("Cell volumes OK.") == 8
    assert log.count("Face pyramids OK.") == 8

    motility = Motility()
    case = Case(case)
    for t in (4.0, 16.0, 20.0, 28.0, 32.0):
        mesh = case.mesh(t)
        faces = [mesh.faces[i] for i in mesh.patches["wall"].faces]
        p = mesh.points[np.unique(np.concatenate(faces))]
        r = np.hypot(p[:, 0] - 0.5, p[:, 1] + 0.2)
        error = r - motility.radius(p[:, 2] + 0.1, t)
        assert np.abs(error).max() < WALL_TOLERANCE
        assert mesh.cell_volumes.min() > 0


def test_two_processors_give_the_same_wall(tmp_path):
    case = make_mesh(make_case(tmp_path / "case", deltaT=4))
    write_dict(
        case,
        "system/decomposeParDict",
        "numberOfSubdomains 2; method simple;"
        "simpleCoeffs { n (2 1 1); delta 0.001; }",
    )
    run(case, "decomposePar")
    run(case, "mpirun", "-np", "2", "moveDynamicMesh", "-parallel")
    for t in (16.0, 28.0):
        for rank in (0, 1):
            part = Case(case / f"processor{rank}")
            assert wall_error(part, t, Motility()) < WALL_TOLERANCE


# A change of the dictionary: (entry, value), and words that the one message
# must contain: the entry, the value, what would be valid
BAD_MOTILITY = {
    "profile_does_not_cover_mesh": (
        ("profile.radius", "((0.22 0.015) (0.25 0.006))"),
        ["profile.radius", "does not cover the mesh", "0.21"],
    ),
    "profile_ends_before_sphincter": (
        ("profile.radius", "((0.2 0.015) (0.24 0.006))"),
        ["position", "0.25", "0.24"],
    ),
    "profile_unsorted": (
        ("profile.radius", "((0.2 0.02) (0.19 0.02) (0.25 0.006))"),
        ["radius", "not sorted", "0.19"],
    ),
    "profile_too_short": (
        ("profile.radius", "((0.2 0.02))"),
        ["radius", "1 point", "at least 2"],
    ),
    "profile_empty": (
        ("profile.radius", "()"),
        ["radius", "0 point", "at least 2"],
    ),
    "profile_negative": (
        ("profile.radius", "((0.2 0.02) (0.22 -0.01) (0.25 0.006))"),
        ["radius", "-0.01", "> 0"],
    ),
    "interpolation_unknown": (
        ("profile.interpolation", "spline"),
        ["interpolation", "spline", "linear", "monotoneCubic"],
    ),
    "wave_inverts_cells": (
        ("waves.occlusion", "((0.21 0) (0.24 1))"),
        ["occlusion", "< 1", "0.24"],
    ),
    "wave_pushes_out": (
        ("waves.occlusion", "((0.21 -0.1) (0.24 0.9))"),
        ["occlusion", "-0.1", ">= 0"],
    ),
    "waves_overlap": (
        ("waves.spacing", "0.015"),
        ["spacing", "0.015", "0.02"],
    ),
    "wave_does_not_move": (
        ("waves.speed", "0"),
        ["speed", "is 0;", "> 0"],
    ),
    "wavelength_negative": (
        ("waves.wavelength", "((0.21 0.02) (0.25 -0.01))"),
        ["wavelength", "-0.01", "> 0"],
    ),
    "wavelength_steep": (
        ("waves.wavelength", "((0.21 0.02) (0.211 0.01))"),
        ["wavelength", "slope", "between -1 and 1"],
    ),
    "reading_unknown": (
        ("waves.reading", "head"),
        ["reading", "head", "centre", "tail"],
    ),
    "fade_of_no_wave": (
        ("waves.fadeOut", "{ wave2 { from 0.24; to 0.245; } }"),
        ["wave2", "(wave0 wave1)"],
    ),
    "fade_backwards": (
        ("waves.fadeOut.wave0.to", "0.23"),
        ["to", "0.23", "beyond 'from'", "> 0.24"],
    ),
    "misspelt_entry": (
        ("waves.spacng", "0.024"),
        ["spacng", "spacing"],
    ),
    "misspelt_optional_entry": (
        ("sphincter.rmp", "linear"),
        ["rmp", "ramp"],
    ),
    "misspelt_section": (
        ("sphinctr", "{}"),
        ["sphinctr", "sphincter"],
    ),
    "sphincter_closes_at_once": (
        ("sphincter.closingRate", "-10"),
        ["closingRate", "-10", "> 0"],
    ),
    "sphincter_open_is_closed": (
        ("sphincter.relativeOcclusion", "1"),
        ["relativeOcclusion", "< 1"],
    ),
    "trigger_unknown": (
        ("sphincter.trigger.type", "clock"),
        ["type", "clock", "schedule", "wave", "none"],
    ),
    "trigger_by_no_wave": (
        ("sphincter.trigger.openWave", "2"),
        ["openWave", "2", ">= 0 and <= 1"],
    ),
    "schedule_out_of_order": (
        (
            "sphincter.trigger",
            "{ type schedule; closeTimes (5 6); openTimes (); }",
        ),
        ["closings", "5", "6", "alternate"],
    ),
    "schedule_too_close": (
        (
            "sphincter.trigger",
            "{ type schedule; closeTimes (5); openTimes (5.05); }",
        ),
        ["opening", "5.05", "5.1"],
    ),
    "gap_closes_open_lumen": (
        ("residualGap", "2e-3"),
        ["residualGap", "0.002", "0.0015"],
    ),
    "gap_zero": (
        ("residualGap", "0"),
        ["residualGap", "> 0"],
    ),
}


@pytest.fixture(scope="module")
def good_case(tmp_path_factory):
    case = tmp_path_factory.mktemp("good") / "case"
    return make_mesh(make_case(case, resolution=2e-3, endTime=0.5))


def fails_with(output, words):
    """One fatal message, with these words, before the first step."""
    assert output.count("FOAM FATAL") == 1, output[-2000:]
    assert "\nTime = " not in output
    message = output[output.index("FOAM FATAL") :]
    for word in words:
        assert word in message, f"'{word}' is missing in:\n{message}"


@pytest.mark.parametrize("name", BAD_MOTILITY)
def test_bad_motility_is_one_clear_error(name, good_case):
    (entry, value), words = BAD_MOTILITY[name]
    path = good_case / "constant" / "motilityProperties"
    shutil.copy(CASE_A / "constant" / "motilityProperties", path)
    run(
        good_case,
        "foamDictionary",
        "constant/motilityProperties",
        "-entry",
        entry,
        "-set",
        value,
    )
    fails_with(run(good_case, "moveDynamicMesh", ok=False), words)
    shutil.copy(CASE_A / "constant" / "motilityProperties", path)


def test_missing_entry_is_named(good_case):
    path = good_case / "constant" / "motilityProperties"
    original = path.read_text()
    path.write_text(re.sub(r"\n    speed [^\n]*", "", original))
    output = run(good_case, "moveDynamicMesh", ok=False)
    path.write_text(original)
    fails_with(output, ["Missing entry 'speed'", "wavelength"])


def test_mesh_without_the_shape_is_refused(tmp_path):
    case = make_case(tmp_path / "case", resolution=2e-3)
    fails_with(
        run(case, "gastricMesh", ok=False), ["No mesh", "run blockMesh first"]
    )
    run(case, "python3", "system/makeBlockMeshDict.py")
    run(case, "blockMesh")
    fails_with(
        run(case, "moveDynamicMesh", ok=False),
        ["outermost points", "Run gastricMesh"],
    )
    run(case, "gastricMesh")
    # Twice would squeeze it twice
    fails_with(run(case, "gastricMesh", ok=False), ["0.017", "must be 1"])


def test_inverted_cells_are_found_before_the_first_step(tmp_path):
    """The check of the cells works: here on a mesh that is inside out."""
    case = make_mesh(make_case(tmp_path / "case", resolution=2e-3))
    points = case / "constant" / "polyMesh" / "points"
    text = points.read_text()
    # Pull one inner point of the first plane beyond its neighbour
    mesh = Case(case).mesh(0.0)
    inner = np.flatnonzero(
        (radii(mesh.points) > 4e-3) & (radii(mesh.points) < 5.5e-3)
    )[0]
    first = text.index("(", text.index(str(len(mesh.points)) + "\n")) + 1
    lines = text[first:].split("\n")
    x, y, z = mesh.points[inner].tolist()
    lines[inner + 1] = f"({x!r} {2 * y!r} {2 * z!r})"
    points.write_text(text[:first] + "\n".join(lines))
    fails_with(
        run(case, "moveDynamicMesh", ok=False),
        ["inverts cells", "face pyramid", "greater than 0"],
    )


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("resolution 0;", ["resolution", "is 0", "1e-05 to 0.005 m"]),
        ("resolutoin 1e-3;", ["resolutoin", "resolution"]),
        ("", ["missing", "resolution"]),
    ],
)
def test_bad_mesh_parameters_are_named(change, words, tmp_path):
    case = make_case(tmp_path / "case")
    path = case / "system" / "meshParameters"
    path.write_text(re.sub(r"resolution[^;\n]*;", change, path.read_text()))
    output = run(case, "python3", "system/makeBlockMeshDict.py", ok=False)
    for word in words:
        assert word in output


def test_resolution_entry_sets_the_cell_size(tmp_path):
    for resolution in (1e-3, 0.5e-3):
        case = make_case(tmp_path / str(resolution), resolution=resolution)
        make_mesh(case)
        points = Case(case).mesh(0.0).points
        x = np.unique(np.round(points[:, 0], 9))
        assert x[1] - x[0] == pytest.approx(resolution, rel=0.05)
        # Half a round of rounding to whole cells in the pylorus
        assert x[-1] - x[-2] == pytest.approx(resolution / 1.25, rel=0.1)
        # The throat, x = 0.252 m, is a plane of the mesh
        assert np.abs(x - 0.252).min() < 1e-8
        # Sizes change by less than 15 % from cell to cell
        sizes = np.diff(x)
        assert np.abs(np.diff(np.log(sizes))).max() < 0.15
