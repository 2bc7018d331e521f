# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""A case whose solver only sleeps, for tests of Allrun and scripts/."""

import os
import shutil
import subprocess
import time
from pathlib import Path

from bolus_cases.synthetic import write_file

ROOT = Path(__file__).resolve().parents[2]

ALLRUN = """#!/usr/bin/env bash
source "${BOLUSFOAM_DIR:?}/scripts/caseFunctions"
caseDistribute() { :; }  # there is no mesh to cut
initialFields
prepare true
solve ./solver
finish true
"""
# Writes times, with a pause after each but the last; of ranks the first does
SOLVER = """#!/usr/bin/env python3
import os, time
names, pause = %r, %r
if os.environ.get("OMPI_COMM_WORLD_RANK", "0") != "0":
    time.sleep(pause * (len(names) - 1))
    names = ()
for name in names:
    print("t ", name, "s  dt 0.1", flush=True)
    os.makedirs(name + "/uniform", exist_ok=True)
    open(name + "/uniform/complete", "w").close()
    if name != names[-1]:
        time.sleep(pause)
"""


def make(folder: Path, pause=0.0, times=("0.5", "1"), allrun=ALLRUN) -> Path:
    """The case: it writes these times, with a pause [s] between them."""
    write_file(
        folder / "system" / "controlDict",
        "startTime 0; endTime 1; deltaT 0.1; writeInterval 0.5;\n",
    )
    write_file(folder / "0.orig" / "U", "")
    (folder / "entries").write_text("endTime system/controlDict endTime\n")
    for name, text in (("Allrun", allrun), ("solver", SOLVER % (times, pause))):
        (folder / name).write_text(text)
        (folder / name).chmod(0o755)
    return folder


def run(*command, env=None, cwd=ROOT, ok=True) -> str:
    """Run a command; what it printed. It ends well if ok, else not; None: it
    does not matter."""
    done = subprocess.run(
        [str(word) for word in command],
        cwd=cwd,
        env=os.environ | (env or {}),
        capture_output=True,
        text=True,
        timeout=100,
    )
    printed = done.stdout + done.stderr
    assert ok in (None, done.returncode == 0), f"{done.returncode}\n{printed}"
    return printed


def run_case(*arguments, **options) -> str:
    """scripts/runCase, as ./Allrun run calls it."""
    return run(ROOT / "scripts" / "runCase", *arguments, **options)


def start(*arguments) -> subprocess.Popen:
    """scripts/runCase in a group of its own; it goes on."""
    return subprocess.Popen(
        [
            # Even if the tests run where an interrupt is ignored
            *("env", "--default-signal=INT", ROOT / "scripts" / "runCase"),
            *map(str, arguments),
        ],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )


def wait_for(condition, seconds=20):
    """Until it holds."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it did not come"
        time.sleep(0.05)


def wait_for_time(folder: Path, name="0.5"):
    """Until the run has written this time."""
    wait_for((folder / name / "uniform" / "complete").exists)


def session(leader: int) -> dict[int, str]:
    """{process: its command} of those that live in a session."""
    found = {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            stat = (folder / "stat").read_text().rpartition(")")[2].split()
            command = (folder / "cmdline").read_bytes().replace(b"\0", b" ")
        except OSError:
            continue
        if int(stat[3]) == leader and stat[0] != "Z":
            found[int(folder.name)] = command.decode()
    return found


def clone(folder: Path) -> Path:
    """A clone of the scripts, without anything to build."""
    shutil.copytree(ROOT / "scripts", folder / "scripts")
    shutil.copy(ROOT / "Allrun", folder)
    shutil.copy(ROOT / "requirements.txt", folder)
    for name in ("src", "applications", "validation", "tutorials", ".local"):
        (folder / name).mkdir()
    (folder / ".local" / "openfoam").symlink_to(ROOT / ".local" / "openfoam")
    (folder / ".local" / "venv").symlink_to(ROOT / ".local" / "venv")
    return folder
