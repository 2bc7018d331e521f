# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Bad input, kills, full disks; all of it: ./Allrun validate robustness."""

import os
import random

import pytest
from bolus_cases.specimens import prepare_compression, replace
from bolus_cases.synthetic import run
from bolus_validation import robustness as rough
from bolus_validation.robustness_cases import BASES, kill_test


@pytest.mark.parametrize("law", ["viscoplasticDamage", "HerschelBulkley"])
def test_a_spoilt_law_ends_in_a_clear_error_or_a_right_run(tmp_path, law):
    command, files = BASES[f"point-{law}"](tmp_path / "point")
    found = [
        outcome
        for file, only in files
        for outcome in rough.fuzz(tmp_path / "point", file, command, only)
    ]
    assert len(found) > 80
    assert [o for o in found if o.fault] == []
    assert sum(o.verdict == "error" for o in found) > 70


@pytest.mark.parametrize(
    "status, output, text, verdict",
    [
        (None, "", "-1", "hung"),
        (139, "Segmentation fault", "-1", "crashed"),
        (1, "--> FOAM FATAL ERROR:\nbad size of numbers", "-1", "unclear"),
        (1, "--> FOAM FATAL ERROR: nu\nbad size", "-1", "unclear"),
        (1, "--> FOAM FATAL ERROR:\nEntry nu is -1", "-1", "error"),
        (1, "--> FOAM FATAL ERROR:\nno convergence", "-1", "gaveUp"),
        (0, "End", "banana", "swallowed"),
        (0, "force nan", "-1", "swallowed"),
        (0, "End", "1e30", "ran"),
    ],
)
def test_faults_are_told_from_right_endings(status, output, text, verdict):
    found, _ = rough.judge(status, output, ("elasticity", "nu"), 0.49, text)
    assert found == verdict


def test_killed_runs_continue_to_the_same_answer(tmp_path):
    kills = kill_test(tmp_path / "kills", 2, random.Random(1))
    # Restarts agree within what Newton's tolerance of 1e-6 leaves
    assert max(kill.difference for kill in kills) < 1e-5
    assert kills[1].writing


def test_function_object_that_cannot_be_read_stops_the_run(case):
    replace(
        case / "system" / "controlDict",
        r"type\s+externalWork;",
        "type externalwork;",
    )
    output = run(case, "bolusFoam", ok=False)
    message = output[output.index("FOAM FATAL") :]
    assert "externalWork" in message and "could not be read" in message
    assert "\nt " not in output


def test_function_object_that_is_switched_off_does_not(case):
    replace(
        case / "system" / "controlDict",
        r"type\s+externalWork;",
        "type externalwork; enabled no;",
    )
    run(case, "bolusFoam")


@pytest.fixture
def case(tmp_path):
    """The cylinder, compressed in 10 steps, written after the fifth."""
    return prepare_compression(
        tmp_path / "case",
        strain=0.05,
        unloadStrain=0,
        writeStrain=0.025,
        nAxial=6,
        nRadial=18,
    )


def test_a_full_disk_is_reported(case):
    # No file may be longer than 4 KiB
    output = run(
        case,
        *("bash", "-c", "trap '' XFSZ; ulimit -f 4; exec bolusFoam"),
        ok=False,
    )
    assert "FOAM FATAL" in output and "0.25/" in output


def test_a_time_that_cannot_be_written_is_reported(case):
    # Also root, whom no permission stops, cannot make this folder
    (case / "0.25").write_text("in the way")
    output = run(case, "bolusFoam", ok=False)
    assert "FOAM FATAL" in output and "0.25" in output


def test_a_read_only_case_is_reported(case):
    command = ["bolusFoam"]
    if os.geteuid() == 0:
        # Root without the right to override permissions
        drop = "--bounding-set=-dac_override"
        command = ["setpriv", drop, *command]
    case.chmod(0o555)
    try:
        output = run(case, *command, ok=False)
    finally:
        case.chmod(0o755)
    assert "FOAM FATAL" in output


def test_a_time_that_was_not_written_to_its_end_is_refused(case):
    run(case, "bolusFoam")
    (case / "0.5" / "uniform" / "complete").unlink()
    output = run(case, "bolusFoam", ok=False)
    assert "0.5" in output and "not complete" in output
