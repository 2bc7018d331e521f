# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Bad input, kills, full disks; all of it: ./Allrun validate robustness."""

import os
import random

import pytest
from bolus_validation import robustness as rough
from bolus_validation.robustness_cases import BASES, kill_test
from bolus_validation.specimens import prepare_compression
from bolus_validation.synthetic import run


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
        (1, "--> FOAM FATAL ERROR: bad size", "-1", "unclear"),
        (1, "--> FOAM FATAL ERROR: nu is -1", "-1", "error"),
        (0, "End", "banana", "swallowed"),
        (0, "force nan", "-1", "swallowed"),
        (0, "End", "1e30", "ran"),
    ],
)
def test_faults_are_told_from_right_endings(status, output, text, verdict):
    found, _ = rough.judge(status, output, ("elasticity", "nu"), 0.49, text)
    assert found == verdict


def test_killed_runs_continue_to_the_same_answer(tmp_path):
    # The second one is killed while it writes a time
    assert max(kill_test(tmp_path / "kills", 2, random.Random(1))) < 1e-5


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
