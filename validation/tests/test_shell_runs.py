# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""./Allrun run: one process in a folder, ends by signals, what is asked wrong.

The solver of these cases sleeps, and makes folders of times.
"""

import os
import signal
import subprocess
import time
from pathlib import Path

import pytest
import shell_case
from shell_case import (
    ROOT,
    run,
    run_case,
    session,
    start,
    wait_for,
    wait_for_time,
)

LOCK = ".bolusFoamLock"


def tree(folder: Path) -> dict:
    """Every file of a folder with its content; not the lock, nor the logs,
    which a run that lives makes longer."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file() and not path.name.startswith((LOCK, "log."))
    }


def end(process: subprocess.Popen) -> str:
    """What it printed, after it ended by itself."""
    printed, _ = process.communicate(timeout=30)
    assert process.returncode == 0, printed
    return printed


@pytest.fixture
def living(tmp_path):
    """(quick case, folder of a run which has written 0.5 and lives on)."""
    case = shell_case.make(tmp_path / "case")
    folder = tmp_path / "run"
    slow = shell_case.make(tmp_path / "slow", 60)
    process = start(slow, "-out", folder)
    wait_for_time(folder)
    yield case, folder
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGKILL)
    process.communicate()


# --- one process in a folder ------------------------------


@pytest.mark.parametrize("options", [(), ("-continue",), ("-np", 2)])
def test_a_second_run_in_a_folder_is_refused_by_name(tmp_path, options):
    case = shell_case.make(tmp_path / "case", 1)
    folder = tmp_path / "run"
    process = start(case, "-out", folder)
    wait_for_time(folder)
    before = tree(folder)
    printed = run_case(case, "-out", folder, *options, ok=False)
    assert f"process {process.pid} (./Allrun run" in printed
    assert "wait for its end" in printed
    assert sorted(p.name for p in tmp_path.iterdir()) == ["case", "run"]
    assert before.items() <= tree(folder).items()
    end(process)
    assert (folder / "1").is_dir()


def test_of_runs_started_together_one_runs(tmp_path):
    case = shell_case.make(tmp_path / "case", 1.5)
    runs = [start(case, "-out", tmp_path / "run") for _ in range(4)]
    printed = [process.communicate(timeout=60)[0] for process in runs]
    codes = sorted(process.returncode for process in runs)
    assert codes == [0, 1, 1, 1], printed
    assert sum("process" in text for text in printed) == 3
    assert sorted(p.name for p in tmp_path.iterdir()) == ["case", "run"]


def test_no_run_is_deleted_as_old_or_moved_with_its_parent(living, tmp_path):
    case, folder = living
    # The next start of run.old's sibling would delete it
    base = tmp_path / "x"
    run_case(case, "-out", base)
    os.rename(folder, tmp_path / "x.old")
    printed = run_case(case, "-out", base, ok=False)
    assert "x.old" in printed and "process" in printed
    # It lives below a folder that would be put aside
    os.rename(tmp_path / "x.old", base / "inner")
    printed = run_case(case, "-out", base, ok=False)
    assert "inner: process" in printed
    assert (base / "inner" / "0.5").is_dir()


def test_the_old_run_is_free_while_the_new_one_lives(living, tmp_path):
    case, folder = living
    run_case(case, "-out", tmp_path / "x")
    process = start(tmp_path / "slow", "-out", tmp_path / "x")
    wait_for((tmp_path / "x.old").is_dir)
    wait_for_time(tmp_path / "x")
    said = run_case(case, "-out", tmp_path / "x.old", "-continue")
    assert "nothing left to do" in said
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate()


@pytest.mark.parametrize("name", ["run.old", "run.new"])
def test_what_is_not_ours_is_not_deleted(tmp_path, name):
    case = shell_case.make(tmp_path / "case")
    run_case(case, "-out", tmp_path / "run")
    mine = tmp_path / name / "thesis"
    mine.parent.mkdir()
    mine.write_text("years")
    printed = run_case(case, "-out", tmp_path / "run", ok=False)
    assert f"{name} is in the way" in printed
    assert mine.read_text() == "years"
    assert (tmp_path / "run" / "1").is_dir()


def test_a_case_is_not_deleted_for_its_copy(tmp_path):
    case = shell_case.make(tmp_path / "case")
    for _ in range(2):
        run_case(case, "-out", tmp_path / "run")
    before = tree(tmp_path)
    for options in (("run.old", "run"), ("case", "case/inner")):
        source, out = (tmp_path / name for name in options)
        run_case(source, "-out", out, ok=False)
    assert tree(tmp_path) == before


def test_a_solver_that_outlives_its_script_keeps_the_folder(tmp_path):
    # And what it left is seen through when it has ended
    case = shell_case.make(tmp_path / "case", 60)
    folder = tmp_path / "run"
    process = start(case, "-out", folder)
    wait_for_time(folder)
    mine = [
        pid
        for pid, command in session(process.pid).items()
        if "Allrun" in command or "runCase" in command
    ]
    assert len(mine) >= 2
    for pid in mine:
        os.kill(pid, signal.SIGKILL)
    process.communicate()
    try:
        printed = run_case(case, "-out", folder, "-continue", ok=False)
        assert f"process {process.pid} " not in printed
        assert "solver" in printed
        printed = run_case(case, "-out", folder, ok=False)
        assert "in use" in printed or "lives" in printed
        assert not (tmp_path / "run.old").exists()
    finally:
        os.killpg(process.pid, signal.SIGKILL)
    wait_for(lambda: not session(process.pid))
    (folder / "solver").write_text("#!/usr/bin/env bash\nmkdir -p 1\n")
    run_case(case, "-out", folder, "-continue")


def test_a_daemon_that_a_run_left_does_not_keep_its_folder(tmp_path):
    daemon = "sleep 30 > daemon.log 2>&1 &\necho $! > daemon\n"
    case = shell_case.make(tmp_path / "case", allrun=shell_case.ALLRUN + daemon)
    for _ in range(2):
        run_case(case, "-out", tmp_path / "run")
    for folder in ("run", "run.old"):
        pid = int((tmp_path / folder / "daemon").read_text())
        os.kill(pid, signal.SIGKILL)  # fails if it is not there any more


@pytest.mark.parametrize("command", ["results", "report", "Allrun"])
def test_nothing_else_writes_into_a_living_run(living, command):
    case, folder = living
    (folder / "postProcessing").mkdir()
    before = tree(folder)
    if command == "Allrun":
        line = f"source {ROOT}/scripts/environment && {folder}/Allrun"
        printed = run("bash", "-c", line, ok=False)
    else:
        printed = run(ROOT / "scripts" / command, folder, ok=False)
    assert "in use by process" in printed
    assert before.items() <= tree(folder).items()
    assert not (folder / "results.json").exists()
    assert not (folder / "report").exists()


def test_clean_all_leaves_living_runs_and_all_else(tmp_path):
    ours = shell_case.clone(tmp_path / "clone")
    case = shell_case.make(tmp_path / "case", 1.5)
    folder = ours / "run" / "gastric" / "x"
    process = start(case, "-out", folder)
    wait_for_time(folder)
    printed = run(ours / "Allrun", "clean", "-all", ok=False)
    assert f"process {process.pid} " in printed
    assert (ours / ".local" / "openfoam").exists()
    end(process)
    run(ours / "Allrun", "clean", "-all")
    assert not (ours / "run").exists()


def test_the_lock_of_a_run_is_no_part_of_a_copy(living, tmp_path):
    # A copy of a living run goes its own way, and has a lock of its own
    case, folder = living
    process = start(folder, "-out", tmp_path / "second")
    wait_for_time(tmp_path / "second")
    said = run_case(case, "-out", tmp_path / "second", ok=False)
    assert f"process {process.pid} " in said
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate()


# --- the end of a run --------------------------------------


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("whom", ["all", "script"])
def test_a_run_that_is_interrupted_tells_how_to_go_on(tmp_path, ranks, whom):
    case = shell_case.make(tmp_path / "case", 1.5)
    folder = tmp_path / "run"
    process = start(case, "-out", folder, "-np", ranks)
    wait_for_time(folder)
    time.sleep(0.3)  # mpirun hands on what its ranks print
    if whom == "all":
        os.killpg(process.pid, signal.SIGINT)
    else:
        os.kill(process.pid, signal.SIGTERM)
    printed, _ = process.communicate(timeout=20)
    assert process.returncode == (130 if whom == "all" else 143), printed
    assert "stopped by you at t = 0.5 s" in printed
    assert "error" not in printed
    assert not session(process.pid)
    line = next(x for x in printed.split("\n") if "-continue" in x).strip()
    assert ("-np 2" in line) == (ranks == 2)
    assert "done" in run("bash", "-c", line)


def test_a_run_that_wrote_nothing_is_not_said_to_go_on(tmp_path):
    case = shell_case.make(
        tmp_path / "case", allrun=shell_case.ALLRUN.replace("true", "sleep 50")
    )
    process = start(case, "-out", tmp_path / "run")
    wait_for((tmp_path / "run" / "log.sleep").exists)
    os.killpg(process.pid, signal.SIGINT)
    printed, _ = process.communicate(timeout=20)
    assert process.returncode == 130, printed
    assert "stopped by you" in printed
    assert "-continue" not in printed and "start it again" in printed


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_solver_that_was_killed_is_said_to_be(tmp_path, ranks):
    case = shell_case.make(tmp_path / "case")
    (case / "solver").write_text("#!/bin/sh\nkill -SEGV $$\n")
    said = run_case(case, "-out", tmp_path / "run", "-np", ranks, ok=False)
    assert "ended by the signal SEGV" in said
    assert "stopped with an error" in said and "by you" not in said


def test_a_finished_run_has_nothing_left_to_do(tmp_path):
    case = shell_case.make(tmp_path / "case")
    folder = tmp_path / "run"
    run_case(case, "-out", folder)
    before = tree(folder)
    log = (folder / "log.solver").read_text()
    printed = run_case(case, "-out", folder, "-continue")
    assert "nothing left to do: the run is at its endTime, 1 s" in printed
    assert "-set endTime=" in printed
    assert tree(folder) == before
    assert (folder / "log.solver").read_text() == log
    # And further is further
    printed = run_case(case, "-out", folder, "-continue", "-set", "endTime=2")
    assert "nothing left" not in printed
    assert (folder / "log.solver").read_text() == 2 * log


@pytest.mark.parametrize(
    "given, meant",
    [
        ("endTme=2", "endTime"),
        ("endtime=2", "endTime"),
        ("system/controldict:endTime=2", "system/controlDict:endTime"),
        ("system/controlDict:endTim=2", "system/controlDict:endTime"),
        ("system/controlDict:stages.frst=2", "system/controlDict:stages.first"),
    ],
)
def test_a_mistyped_entry_is_told_the_nearest(tmp_path, given, meant):
    case = shell_case.make(tmp_path / "case")
    control = case / "system" / "controlDict"
    control.write_text(control.read_text() + "stages { first 1; }\n")
    out = tmp_path / "run"
    printed = run_case(case, "-out", out, "-set", given, ok=False)
    assert f"Did you mean '{meant}'?" in printed.split("\n")[0]
    assert "endTime = system/controlDict:endTime" in printed
    assert sorted(p.name for p in tmp_path.iterdir()) == ["case"]


@pytest.mark.parametrize(
    "tutorial, settings, told, well",
    [
        # No time is written
        (
            "gastric/liquidMeal",
            ("endTime=0.02", "axialCells=20", "radialCells=4"),
            "note: no time after the start was written",
            True,
        ),
        # No step is made
        (
            "rheology/compression",
            ("strain=0.001", "unloadStrain=0", "nAxial=4", "nRadial=8"),
            "no table contactForce.dat",
            False,
        ),
    ],
)
def test_a_run_too_short_for_its_plot_says_so(
    tmp_path, tutorial, settings, told, well
):
    options = [word for entry in settings for word in ("-set", entry)]
    said = run_case(tutorial, "-out", tmp_path / "run", *options, ok=well)
    assert told in said
    assert "Traceback" not in said
