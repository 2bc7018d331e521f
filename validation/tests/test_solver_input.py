# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Bad input to bolusFoam, and a step that cannot converge."""

import re
import shutil

import numpy as np
import pytest
from bolus_cases.specimens import (
    box,
    prepare_compression,
    replace,
)
from bolus_cases.synthetic import run, write_field
from bolus_results.tables import read_table


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    """Where the cases of this file run."""
    return tmp_path_factory.mktemp("solver")


# --- bad input, and a step that fails ----------------------------------------


@pytest.fixture(scope="session")
def sound(folder):
    """A small case that is in order, not yet run."""
    case = prepare_compression(
        folder / "sound",
        nAxial=6,
        nRadial=12,
        strain=0.1,
        unloadStrain=0,
        strainStep=0.01,
        writeStrain=0.02,
    )
    # Self-contained, to be edited
    text = run(case, "foamDictionary", "constant/bolusProperties", "-expand")
    properties = case / "constant" / "bolusProperties"
    properties.write_text(text[text.index("FoamFile") :])
    return case


def spoilt(sound, target):
    """A copy of the case that is in order."""
    shutil.copytree(sound, target)
    return target


def fatal(case) -> str:
    """The error message of bolusFoam, which must be one, before any step."""
    output = run(case, "bolusFoam", ok=False)
    assert output.count("FOAM FATAL") == 1, output[-2000:]
    assert "Newton" not in output
    assert not [p for p in case.glob("0.[0-9]*") if p.is_dir()]
    message = output[output.index("FOAM FATAL") :]
    return " ".join(message.split())


def test_the_case_in_order_runs(sound, tmp_path):
    # Else the tests below would show nothing
    run(spoilt(sound, tmp_path / "case"), "bolusFoam")


BAD = {
    # what: file, pattern, replacement, words that the message must have
    "missing modulus": (
        "constant/bolusProperties",
        r"\n\s*E\s+\S+;",
        "",
        ["Missing entry 'E'", "Young's modulus"],
    ),
    "misspelt modulus": (
        "constant/bolusProperties",
        r"\n\s*nu\s+0.49;",
        "\nnu 0.49; poisson 0.3;",
        ["poisson", "valid entries", "nu"],
    ),
    "half a layer of gas": (
        "system/fvSolution",
        r"bolus \{\}",
        "bolus { gasLayers 2.5; }",
        ["Entry 'gasLayers'", "2.5", "whole number"],
    ),
    "a linear solver that need not solve": (
        "system/fvSolution",
        r"bolus \{\}",
        "bolus { linearTolerance 1; }",
        ["Entry 'linearTolerance'", "1;", "> 0 and <= 0.1"],
    ),
    "negative modulus": (
        "constant/bolusProperties",
        r"\n\s*E\s+\S+;",
        "\nE -1e5;",
        ["Entry 'E'", "-100000", "> 0"],
    ),
    "incompressible": (
        "constant/bolusProperties",
        r"\n\s*nu\s+0.49;",
        "\nnu 0.5;",
        ["Entry 'nu'", "0.5", "< 0.5"],
    ),
    "unknown law": (
        "constant/bolusProperties",
        r"type\s+tabulated;",
        "type Bingham;",
        ["Bingham", "tabulated", "HerschelBulkley", "powerHardening"],
    ),
    "unknown damage": (
        "constant/bolusProperties",
        r"type\s+none;",
        "type brittle;",
        ["brittle", "none", "triaxialOnset"],
    ),
    "condition of U": (
        "0/U",
        r"side\s*\{[^}]*\}",
        "side { type fixedValue; value uniform (0 0 0); }",
        ["side", "fixedValue", "contactWall", "zeroGradient"],
    ),
    "contact on a patch that is no wall": (
        "0/U",
        r"side\s*\{[^}]*\}",
        "side { type contactWall; friction { type none; } "
        "value uniform (0 0 0); }",
        ["side", "contactWall", "type patch", "valid is type wall"],
    ),
    "linear solver": (
        "system/fvSolution",
        r"bolus \{",
        "bolus { linearSolver magic;",
        ["linearSolver", "magic", "direct", "schwarz"],
    ),
    "axis of the subdomains": (
        "system/fvSolution",
        r"bolus \{",
        "bolus { subdomainAxis radial;",
        ["subdomainAxis", "radial", "x", "z", "none"],
    ),
    "unknown friction": (
        "0/U",
        r"type \$friction;",
        "type glue;",
        ["glue", "coulomb", "none", "noSlip"],
    ),
    "negative friction": (
        "0/U",
        r"friction\s*\{[^}]*\}",
        "friction { type coulomb; mu -0.3; }",
        ["mu", "-0.3", ">= 0"],
    ),
    "missing friction": (
        "0/U",
        r"friction\s*\{[^}]*\}",
        "",
        ["friction"],
    ),
    "maxCourant": (
        "system/controlDict",
        r"maxCourant\s+2;",
        "maxCourant 0;",
        ["maxCourant", "0", "> 0"],
    ),
    "tolerance": (
        "system/fvSolution",
        r"bolus \{\}",
        "bolus { tolerance -1; }",
        ["tolerance", "-1", "> 0"],
    ),
    "hourglass": (
        "system/fvSolution",
        r"bolus \{\}",
        "bolus { hourglass -1; }",
        ["hourglass", "-1", ">= 0"],
    ),
    "transport": (
        "system/fvSolution",
        r"transport \{\}",
        "transport { maxCourant 0; }",
        ["maxCourant", "0", "> 0"],
    ),
    "gas": (
        "constant/bolusProperties",
        r"\nrho\s",
        "\ngasCoeffs { zeta -1; }\nrho ",
        ["zeta", "-1", "> 0"],
    ),
    "misspelt entry of the solver": (
        "system/fvSolution",
        r"bolus \{\}",
        "bolus { tolerence 1e-8; }",
        ["tolerence", "tolerance"],
    ),
    "misspelt entry of the gas": (
        "constant/bolusProperties",
        r"\nrho\s",
        "\ngasCoeffs { zetta 10; }\nrho ",
        ["zetta", "zeta"],
    ),
    "entry of the solver by its old name": (
        "system/fvSolution",
        r"bolus \{\}",
        "bolus { fullSteps 3; }",
        ["fullSteps", "is now called undampedSteps"],
    ),
    "the gas by its old name": (
        "constant/bolusProperties",
        r"\nrho\s",
        "\nvoid { zeta 10; }\nrho ",
        ["void", "is now called gasCoeffs"],
    ),
    "misspelt entry of the wall": (
        "0/U",
        r"separation\s",
        "seperation ",
        ["seperation", "separation"],
    ),
    "bolus too thick": (
        "0/alpha",
        r"(?s)internalField.*?\nboundary",
        "internalField uniform 2;\nboundary",
        ["alpha", "2", "0 (gas) to 1 (bolus)"],
    ),
    "no bolus": (
        "0/alpha",
        r"(?s)internalField.*?\nboundary",
        "internalField uniform 0;\nboundary",
        ["no bolus", "alpha"],
    ),
}


@pytest.mark.parametrize("what", BAD)
def test_bad_input_is_one_clear_error_before_the_first_step(
    sound, tmp_path, what
):
    file, pattern, by, words = BAD[what]
    case = spoilt(sound, tmp_path / "case")
    replace(case / file, pattern, by)
    message = fatal(case)
    assert [word for word in words if word not in message] == [], message


def test_a_case_without_mesh_is_one_clear_error(sound, tmp_path):
    case = spoilt(sound, tmp_path / "case")
    shutil.rmtree(case / "constant" / "polyMesh")
    message = fatal(case)
    assert "polyMesh" in message
    assert "points" in message or "faces" in message


def test_a_step_that_cannot_converge_ends_the_run_and_keeps_what_was_written(
    sound, tmp_path
):
    case = spoilt(sound, tmp_path / "case")
    replace(case / "system" / "timeParameters", "endTime [^;]*", "endTime 0.4")
    run(case, "bolusFoam")
    before = sorted(p.name for p in case.glob("0.[0-9]*"))
    assert before == ["0.2", "0.4"]
    kept = (case / "0.4" / "p").read_bytes()

    # No step converges within one iteration to a residual of 1e-14
    replace(case / "system" / "timeParameters", "endTime [^;]*", "endTime 1")
    replace(
        case / "system" / "fvSolution",
        r"bolus \{\}",
        "bolus { maxIterations 1; tolerance 1e-14; }",
    )
    replace(
        case / "system" / "controlDict",
        "maxCourant",
        "minDeltaT 0.01;\nmaxCourant",
    )
    output = run(case, "bolusFoam", ok=False)
    message = " ".join(output[output.index("FOAM FATAL") :].split())
    assert "no convergence at t = 0.4" in message
    assert re.search(r"worst at \([-\d.e ]+\)", message)
    assert re.search(r"last written time \D{0,20}0\.4", message)
    assert "minDeltaT 0.01" in message
    assert sorted(p.name for p in case.glob("0.[0-9]*")) == before
    assert (case / "0.4" / "p").read_bytes() == kept


@pytest.mark.parametrize("bulk_moduli", [99, 101])
def test_a_solution_with_a_pressure_of_100_bulk_moduli_is_rejected(
    tmp_path, bulk_moduli
):
    # Bolus at rest in a closed box, in equilibrium at any pressure
    wall = "type contactWall; friction { type none; } separation no;"
    walls = dict.fromkeys(("x0", "x1", "y0", "y1"), wall)
    mesh = box(tmp_path, (0.01, 0.01), (4, 4), walls, end=0.2, step=0.1)
    bulk_modulus = 100e3 / (3 * (1 - 2 * 0.49))  # [Pa], of tutorials/common
    pressure = np.full(mesh.n_cells, bulk_moduli * bulk_modulus)
    write_field(tmp_path, mesh, 0, "p", pressure)
    reason = "(pressureOf100BulkModuli, "
    if bulk_moduli < 100:
        assert reason not in run(tmp_path, "bolusFoam")
    else:
        output = run(tmp_path, "bolusFoam", ok=False)
        assert output.count(reason) > 2
        message = " ".join(output[output.index("FOAM FATAL") :].split())
        assert "no convergence at t = " in message
        assert "): pressureOf100BulkModuli, worst at" in message


def test_a_flow_too_fast_to_be_moved_is_rejected_and_loses_nothing(
    sound, tmp_path
):
    # Sub-steps of a thousandth of a cell, at most ten: the steps get shorter
    case = spoilt(sound, tmp_path / "case")
    replace(case / "system" / "timeParameters", "endTime [^;]*", "endTime 0.2")
    replace(
        case / "system" / "fvSolution",
        r"transport \{\}",
        "transport { maxCourant 1e-3; maxSubSteps 10; }",
    )
    output = run(case, "bolusFoam")
    assert "flow too fast for maxSubSteps" in output
    steps = read_table(case, "solver", "steps")
    assert steps["rejected"][-1] > 0
    assert steps["subSteps"].max() <= 10
    assert abs(steps["massError"]).max() < 1e-12
