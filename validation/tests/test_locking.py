# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""One process at a time writes into a folder; the other one is told which."""

import fcntl
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from bolus_cases.synthetic import wedge_mesh
from bolus_results import page, plots, results, summary
from bolus_results.locking import NAME, FolderBusy, alone_in
from bolus_validation import paper, studies

STUDIES = Path(__file__).parents[1] / "studies"

HOLD = """
import sys, time
from bolus_results.locking import alone_in
with alone_in(sys.argv[1]):
    print("held", flush=True)
    time.sleep(60)
"""


@pytest.fixture
def hold():
    """Start a process that holds a folder until the test ends."""
    started = []

    def start(folder):
        process = subprocess.Popen(
            [sys.executable, "-c", HOLD, str(folder)],
            stdout=subprocess.PIPE,
            text=True,
        )
        started.append(process)
        assert process.stdout.readline() == "held\n"
        return process

    yield start
    for process in started:
        process.kill()
        process.wait()


def test_the_second_process_is_refused_and_told_of_the_first(tmp_path, hold):
    process = hold(tmp_path)
    with pytest.raises(FolderBusy) as error, alone_in(tmp_path):
        pass
    assert f"process {process.pid} (" in str(error.value)
    assert str(tmp_path) in str(error.value)
    # By another way to the same folder, too
    (tmp_path.parent / "link").symlink_to(tmp_path)
    with pytest.raises(FolderBusy), alone_in(tmp_path.parent / "link"):
        pass
    # Who was refused does not overwrite who is at work
    assert (tmp_path / NAME).read_text().startswith(f"{process.pid} ")


def test_a_process_that_was_killed_leaves_no_lock(tmp_path, hold):
    process = hold(tmp_path)
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert str(process.pid) in (tmp_path / NAME).read_text()
    with alone_in(tmp_path):
        assert str(os.getpid()) in (tmp_path / NAME).read_text()


def test_a_folder_of_which_the_caller_has_the_lock_is_free(
    tmp_path, hold, monkeypatch
):
    hold(tmp_path)
    monkeypatch.setenv("BOLUSFOAM_LOCK", str(tmp_path.resolve()))
    (tmp_path / "link").symlink_to(tmp_path)
    for way in (tmp_path, tmp_path / "link"):
        with alone_in(way):
            pass
    # That folder only
    (tmp_path / "other").mkdir()
    hold(tmp_path / "other")
    with pytest.raises(FolderBusy), alone_in(tmp_path / "other"):
        pass


@pytest.mark.parametrize("module", [results, plots, paper, summary])
def test_commands_that_write_into_a_run_leave_a_living_one_alone(
    tmp_path, hold, capsys, module
):
    wedge_mesh(tmp_path, 0.04, 0.02, 4, 2)
    results.write_json(tmp_path)
    before = {p: p.stat().st_mtime_ns for p in tmp_path.rglob("*")}
    process = hold(tmp_path)
    assert module.main([str(tmp_path)]) == 1
    assert f"process {process.pid} (" in capsys.readouterr().err
    after = {p: p.stat().st_mtime_ns for p in tmp_path.rglob("*")}
    del after[tmp_path / NAME]
    assert after == before


def test_paraview_leaves_a_living_run_alone(tmp_path, hold):
    case = tmp_path / "case"
    wedge_mesh(case, 0.04, 0.02, 4, 2)
    # Without ParaView: it must not get as far as to use it
    (tmp_path / "paraview").mkdir()
    (tmp_path / "paraview" / "simple.py").touch()
    process = hold(case)
    done = subprocess.run(
        [sys.executable, STUDIES.parents[1] / "scripts" / "viewCase.py", case],
        env=os.environ | {"PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 1
    assert f"process {process.pid} (" in done.stderr
    assert not (case / "case.foam").exists()


def test_two_reports_do_not_mix_in_one_folder(tmp_path, hold, capsys):
    wedge_mesh(tmp_path, 0.04, 0.02, 4, 2)
    (tmp_path / "postProcessing").mkdir()
    (tmp_path / "report").mkdir()
    process = hold(tmp_path / "report")
    assert page.main([str(tmp_path)]) == 1
    assert f"process {process.pid} (" in capsys.readouterr().err


def test_a_folder_that_is_no_case_is_left_as_it_is(tmp_path, capsys):
    for module in (results, plots, paper, summary, page):
        assert module.main([str(tmp_path)]) == 1
        assert module.main([str(tmp_path / "missing")]) == 1
    assert not list(tmp_path.iterdir())


def test_a_page_of_studies_is_made_by_one_command_at_a_time(
    tmp_path, hold, monkeypatch, capsys
):
    monkeypatch.setattr(studies, "ROOT", tmp_path)
    monkeypatch.setattr(studies, "REGISTRY", {})
    base = tmp_path / "run" / "validate" / "page"
    base.mkdir(parents=True)
    process = hold(base)
    assert studies.run_all("page", "") == 2
    assert f"process {process.pid} (" in capsys.readouterr().err
    assert [p.name for p in base.iterdir()] == [NAME]


@pytest.mark.parametrize("name", ["mutations", "robustness"])
def test_studies_with_a_folder_of_their_own_are_alone_in_it(name):
    # The first one: this test, wherever it is run
    base = STUDIES.parents[1] / "run" / "validate" / name
    base.mkdir(parents=True, exist_ok=True)
    with open(base / NAME, "a+") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            pytest.skip(f"{name} is at work")
        start = time.monotonic()
        done = subprocess.run(
            [sys.executable, STUDIES / f"{name}.py"],
            capture_output=True,
            text=True,
            timeout=60,
        )
    assert done.returncode != 0
    assert "is at work in it" in done.stderr
    # It has not begun: a mutation takes minutes
    assert time.monotonic() - start < 30


def test_workers_of_a_study_end_with_it(tmp_path):
    # Else they would keep its lock, and write into its folder
    script = tmp_path / "parent.py"
    script.write_text(
        "import os, sys, time\n"
        "from concurrent.futures import ProcessPoolExecutor\n"
        "from bolus_validation.studies import _end_with_parent\n"
        "with ProcessPoolExecutor(1, initializer=_end_with_parent) as pool:\n"
        "    print(pool.submit(os.getpid).result(), flush=True)\n"
        "    time.sleep(60)\n"
    )
    parent = subprocess.Popen(
        [sys.executable, script], stdout=subprocess.PIPE, text=True
    )
    worker = int(parent.stdout.readline())
    parent.kill()
    parent.wait()
    for _ in range(50):
        status = Path(f"/proc/{worker}/status")
        if not status.exists() or "State:\tZ" in status.read_text():
            return
        time.sleep(0.1)
    os.kill(worker, signal.SIGKILL)
    pytest.fail("the worker lives on")
