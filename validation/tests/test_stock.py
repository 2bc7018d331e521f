# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""What others' tools make of our cases: pimpleFoam, foamToVTK, ParaView."""

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest
from bolus_cases.specimens import compression, run_case
from bolus_cases.synthetic import run
from bolus_results.tables import read_table

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def meal(tmp_path_factory):
    """The liquid meal on a coarse mesh."""
    out = tmp_path_factory.mktemp("meal") / "liquidMeal"
    run_case(
        "gastric/liquidMeal",
        *("-set", "axialCells=40", "-set", "radialCells=8"),
        *("-set", "endTime=35", "-out", out),
    )
    return out


def test_the_liquid_meal_has_the_published_order_of_magnitude(meal):
    found = json.loads((meal / "liquidMeal.json").read_text())
    # Kozu et al. (2014) 9 mm/s, Ferrua and Singh (2010) 28 mm/s
    assert 9e-3 < found["jet"]["value"] < 28e-3
    # Kozu et al.: the largest below 20/s
    assert 1 < found["shearRateMax"]["value"] < 40


def test_the_liquid_meal_loses_nothing(meal):
    log = (meal / "log.pimpleFoam").read_text()
    errors = [
        abs(float(line.split("global = ")[1].split(",")[0]))
        for line in log.splitlines()
        if "continuity errors" in line
    ]
    assert errors and max(errors) < 1e-8


@pytest.fixture(scope="module")
def squeezed(tmp_path_factory):
    """A short compression."""
    case = tmp_path_factory.mktemp("view") / "case"
    compression(case, strain=0.05)
    assert read_table(case, "solver", "steps").time.size
    return case


def test_foam_to_vtk_reads_every_field_of_a_run(squeezed, meal):
    for case in (squeezed, meal):
        run(case, "foamToVTK", "-latestTime")
        assert list((case / "VTK").rglob("internal.vtu"))


# Coarse and short: each tutorial with a mesh, but those of the fixtures above
TUTORIALS = {
    **{
        f"gastric/case{name}": (
            "resolution=2e-3",
            "pylorusRefinement=4",
            "endTime=0.02",
            "writeInterval=0.02",
        )
        for name in ("A", "A_asReported", "B", "C", "D")
    },
    "cutting/cylinder2D": ("cellSize=1e-3", "travel=2e-4", "writeTravel=2e-4"),
    "cutting/cylinder3D": (
        "cellSize=1e-3",
        "travel=2e-4",
        "writeTravel=2e-4",
        "cellsThrough=6",
        "system/caseParameters:growthAhead=1.3",
        "system/caseParameters:growthSide=1.3",
    ),
    "cutting/wire2D": ("cellSize=1e-4", "travel=2e-5", "writeTravel=2e-5"),
}


@pytest.mark.parametrize("tutorial", TUTORIALS)
def test_foam_to_vtk_reads_every_tutorial(tutorial, tmp_path):
    case = tmp_path / "case"
    settings = [word for s in TUTORIALS[tutorial] for word in ("-set", s)]
    run_case(tutorial, *settings, "-out", case)
    run(case, "foamToVTK", "-latestTime")
    written = list((case / "VTK").rglob("internal.vtu"))
    assert written
    text = written[0].read_bytes()
    assert all(
        f"Name='{n}'".encode() in text for n in ("alpha", "D", "sigmaEq")
    )


def test_every_tutorial_with_a_mesh_is_among_these():
    known = {*TUTORIALS, "gastric/liquidMeal", "rheology/compression"}
    folders = (ROOT / "tutorials").glob("*/*/Allrun")
    found = {f"{f.parent.parent.name}/{f.parent.name}" for f in folders}
    # A variant may take the Allrun of its base
    found |= {
        f"{f.parent.parent.name}/{f.parent.name}"
        for f in (ROOT / "tutorials").glob("*/*/base")
    }
    assert found - known == {"rheology/materialPoint"}


def test_paraview_shows_bolus_wall_and_fields(squeezed):
    pvpython, xvfb = shutil.which("pvpython"), shutil.which("xvfb-run")
    if not pvpython or not xvfb:
        pytest.skip("NO PARAVIEW: pvpython or xvfb-run is not installed")
    # ParaView brings a Python of its own
    plain = {
        k: v
        for k, v in os.environ.items()
        if k not in ("PYTHONPATH", "VIRTUAL_ENV")
    }
    done = subprocess.run(
        [xvfb, "-a", pvpython, ROOT / "scripts" / "viewCase.py", squeezed],
        capture_output=True,
        text=True,
        env=plain,
        timeout=200,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    assert (squeezed / "paraview.png").stat().st_size > 20000
    assert (squeezed / "paraview.pvsm").is_file()
