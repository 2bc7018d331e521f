# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""What can befall a run of the solver: another run in its folder, a signal,
fields that are no numbers, a mesh that turns inside out, settings that change.
"""

import fcntl
import os
import re
import shutil
import signal
import struct
import subprocess
import time

import numpy as np
import pytest
from bolus_cases.specimens import prepare_compression, replace
from bolus_cases.synthetic import (
    run,
    run_parallel,
    write_field,
    write_laplacian_motion,
)
from bolus_results.fields import read_mesh
from bolus_results.tables import read_table


@pytest.fixture(scope="module")
def prepared(tmp_path_factory):
    """A small compression, not yet run: 20 steps, written every five."""
    return prepare_compression(
        tmp_path_factory.mktemp("runs") / "prepared",
        nAxial=6,
        nRadial=12,
        strain=0.2,
        unloadStrain=0,
        strainStep=0.01,
        writeStrain=0.05,
    )


@pytest.fixture
def case(prepared, tmp_path):
    """A copy of it."""
    return shutil.copytree(prepared, tmp_path / "case")


def message(output: str) -> str:
    """The one error message of OpenFOAM in an output."""
    assert output.count("FOAM FATAL") == 1, output[-3000:]
    return " ".join(output[output.index("FOAM FATAL") :].split())


def control(case, entry: str, value) -> None:
    """Change an entry of controlDict, or of what it includes."""
    for name in ("controlDict", "timeParameters"):
        path = case / "system" / name
        text, n = re.subn(
            rf"(?m)^{entry}\s[^;]*;", f"{entry} {value};", path.read_text()
        )
        if n:
            # At once: a run may be reading it
            path.with_name("new").write_text(text)
            path.with_name("new").replace(path)
            return
    path = case / "system" / "controlDict"
    path.write_text(path.read_text() + f"\n{entry} {value};\n")


def start(case):
    """bolusFoam in the background."""
    return subprocess.Popen(
        ["bolusFoam"],
        cwd=case,
        env=os.environ | {"PWD": str(case)},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


def long_run(case) -> None:
    """Make it last: short steps, and a time written soon."""
    control(case, "deltaT", 1e-3)
    control(case, "maxDeltaT", 1e-3)
    control(case, "writeInterval", 0.01)


def wait_for(path) -> None:
    """Wait for a file that a run writes."""
    for _ in range(600):
        if path.exists():
            return
        time.sleep(0.05)
    raise AssertionError(f"no {path} within 30 s")


# --- one run in a folder -----------------------------------------------------


def test_a_second_run_in_the_folder_of_a_living_one_is_refused(case):
    long_run(case)
    first = start(case)
    try:
        wait_for(case / "0.01" / "uniform" / "complete")
        said = message(run(case, "bolusFoam", ok=False))
        assert f"in use by process {first.pid} bolusFoam" in said
    finally:
        first.kill()
        first.communicate()
    # The dead one holds nothing
    for folder in case.glob("0.[0-9]*"):
        shutil.rmtree(folder)
    control(case, "endTime", 0.01)
    run(case, "bolusFoam")


def test_the_owner_of_the_folder_may_start_the_solver_in_it(case):
    control(case, "endTime", 0.1)
    with (case / ".bolusFoamLock").open("w") as lock:
        lock.write("1 a script\n")
        lock.flush()
        fcntl.flock(lock, fcntl.LOCK_EX)
        said = message(run(case, "bolusFoam", ok=False))
        assert "in use by process 1 a script" in said
        run(case, "env", f"BOLUSFOAM_LOCK={case.resolve()}", "bolusFoam")


# --- signals, and what is no number ------------------------------------------


@pytest.mark.parametrize("name", ["SIGFPE", "SIGSEGV", "SIGTERM", "SIGINT"])
def test_a_signal_tells_time_and_last_written_time(case, name):
    long_run(case)
    running = start(case)
    wait_for(case / "0.02" / "uniform" / "complete")
    running.send_signal(getattr(signal, name))
    output, _ = running.communicate(timeout=60)
    # OpenFOAM's handler may hang where it prints the stack: then the alarm
    assert -running.returncode in (getattr(signal, name), signal.SIGALRM)
    told = re.search(
        rf"stopped by {name}.* in the step after t = ([\d.]+) s.*"
        r"complete time is ([\d.]+) s",
        output,
    )
    assert told, output[-1500:]
    assert 0.02 <= float(told[2]) <= float(told[1]) <= float(told[2]) + 0.02
    assert (case / told[2] / "uniform" / "complete").exists()
    if name in ("SIGFPE", "SIGSEGV") and running.returncode != -signal.SIGALRM:
        # OpenFOAM's own handler has had its turn
        assert "printStack" in output


FIELDS = ("alpha", "U", "p", "mass", "deviator", "pointU", "phiRel", "stress")


@pytest.fixture(scope="module")
def stopped(prepared, tmp_path_factory):
    """A run that may go on from 0.5 s, with binary fields."""
    case = tmp_path_factory.mktemp("stopped") / "case"
    shutil.copytree(prepared, case)
    control(case, "endTime", 0.5)
    control(case, "writeFormat", "binary")
    run(case, "bolusFoam")
    control(case, "endTime", 2)
    return case


@pytest.mark.parametrize(
    ("name", "value"), [("U", np.inf), *((name, np.nan) for name in FIELDS)]
)
def test_a_field_with_what_is_no_number_is_named(
    stopped, tmp_path, name, value
):
    case = tmp_path / "case"
    shutil.copytree(stopped, case)
    path = case / "0.5" / name
    data = bytearray(path.read_bytes())
    # The third value of the internal field
    begin = re.search(rb"internalField\s+nonuniform[^(]*\(", bytes(data)).end()
    data[begin + 16 : begin + 24] = struct.pack("<d", value)
    path.write_bytes(data)
    said = message(run(case, "bolusFoam", ok=False))
    assert re.search(
        rf"field {name} of time 0.5: \d values are no finite numbers", said
    )


@pytest.mark.parametrize("alpha", [1.09, 1.001, -0.005])
def test_a_start_with_more_or_less_than_a_full_cell_is_refused(case, alpha):
    text = (case / "0" / "alpha").read_text()
    begin = re.search(r"internalField\s+nonuniform[^(]*\(\s*", text).end()
    end = text.index("\n", begin)
    (case / "0" / "alpha").write_text(text[:begin] + str(alpha) + text[end:])
    said = message(run(case, "bolusFoam", ok=False))
    assert f"{alpha:g}" in said
    assert "valid are 0 (gas) to 1 (bolus)" in said


@pytest.mark.parametrize(
    "name,value", [("D", 1.5), ("epsilonPEq", -0.1), ("tensileStrain", -1)]
)
def test_a_start_with_a_memory_that_cannot_be_is_refused(case, name, value):
    mesh = read_mesh(case / "constant" / "polyMesh")
    write_field(case, mesh, 0, name, value)
    said = message(run(case, "bolusFoam", ok=False))
    assert f"field {name}: values from {value:g} to {value:g}" in said


# --- what makes a restart another run ----------------------------------------


@pytest.mark.parametrize("digits", [6, 9])
def test_fields_that_would_lose_digits_are_refused_at_the_start(case, digits):
    control(case, "writePrecision", digits)
    said = message(run(case, "bolusFoam", ok=False))
    assert f"entry writePrecision: {digits}" in said
    assert "valid are 10 and more, or writeFormat binary" in said
    # Binary fields lose none, and what is written beside them neither
    control(case, "writeFormat", "binary")
    control(case, "endTime", 1)
    whole = shutil.copytree(case, case.with_name("whole"))
    run(whole, "bolusFoam")
    control(case, "endTime", 0.5)
    run(case, "bolusFoam")
    control(case, "endTime", 1)
    run(case, "bolusFoam")
    for name, columns in (
        ("contactForce", ("axial", "total")),
        ("energyBalance", ("work", "plastic", "elastic")),
    ):
        one, other = read_table(case, name), read_table(whole, name)
        for column in columns:
            # To the digits of the tables
            assert one[column][-1] == pytest.approx(
                other[column][-1], rel=1e-8, abs=1e-13
            ), (name, column)


@pytest.mark.parametrize("time_digits", [3, 8])
def test_a_time_between_the_outputs_is_found_again(case, time_digits):
    # Steps whose times have many digits, stopped in the middle, and gone on
    control(case, "timePrecision", time_digits)
    control(case, "deltaT", 0.00123456789)
    control(case, "maxDeltaT", 0.00123456789)
    control(case, "endTime", 0.3)
    control(case, "writeInterval", 0.3)
    replace(
        case / "system" / "controlDict",
        r"functions\s*\{",
        'functions { stop { type abort; libs ("libutilityFunctionObjects.so");'
        ' file "$FOAM_CASE/stop"; action writeNow; }\n',
    )
    whole = shutil.copytree(case, case.with_name("whole"))
    run(whole, "bolusFoam")

    running = start(case)
    steps = case / "postProcessing" / "solver" / "0" / "steps.dat"
    wait_for(steps)
    # The first step is done: the function object has forgotten older files
    while steps.read_text().count("\n") < 3:
        time.sleep(0.01)
    running.send_signal(signal.SIGSTOP)
    (case / "stop").touch()
    running.send_signal(signal.SIGCONT)
    said, _ = running.communicate(timeout=60)
    written = [p.name for p in case.glob("0.[0-9]*") if p.is_dir()]
    assert len(written) == 1, said[-1000:]
    stopped = float(written[0])
    # The name is the time, to a billionth of the step
    steps = read_table(case, "solver", "steps")
    assert stopped < 0.29
    assert stopped == pytest.approx(steps.time[-1], abs=2e-12)
    run(case, "bolusFoam")
    times = {p.name for p in case.iterdir() if re.fullmatch(r"[\d.]+", p.name)}
    assert times == {"0", written[0], "0.3"}
    one, other = (read_table(c, "contactForce") for c in (case, whole))
    # Other steps from there to the end
    assert one["axial"][-1] == pytest.approx(other["axial"][-1], rel=1e-5)


# --- settings that change while it runs --------------------------------------


def test_controlDict_may_change_while_a_run_goes_on(case):
    long_run(case)
    control(case, "runTimeModifiable", "yes")
    # By their times OpenFOAM takes files of the last 10 s for unchanged
    control(
        case,
        "OptimisationSwitches { fileModificationSkew 0; } dummy",
        "0",
    )
    running = start(case)
    wait_for(case / "0.01" / "uniform" / "complete")
    control(case, "maxDeltaT", -1)
    time.sleep(1)
    control(case, "writePrecision", 6)
    control(case, "strainRate", 0.2)
    control(case, "maxDeltaT", 0.1)
    control(case, "writeInterval", 0.5)
    output, _ = running.communicate(timeout=100)
    assert running.returncode == 0, output[-1000:]
    assert "is not taken over: Entry 'maxDeltaT' is -1; largest step" in output
    assert "maxDeltaT 0.1 s" in output
    told = " ".join(output.split())
    assert "strainRate has changed. It counts from the next start on" in told
    assert "writePrecision is 6 now: written with 10 digits" in told
    steps = read_table(case, "solver", "steps")
    assert steps["deltaT"][-1] > 0.05
    late = [p.name for p in case.glob("[01].[0-9]*") if float(p.name) > 1]
    assert sorted(late) == ["1.5"]


def test_what_counts_from_the_next_start_on_is_told(case):
    long_run(case)
    control(case, "runTimeModifiable", "yes")
    control(case, "OptimisationSwitches { fileModificationSkew 0; } dummy", "0")
    running = start(case)
    wait_for(case / "0.01" / "uniform" / "complete")
    path = case / "system" / "fvSolution"
    new = path.with_name("new")
    new.write_text(
        path.read_text().replace("bolus {}", "bolus { hourglass 0.1; }")
    )
    new.replace(path)
    path = case / "system" / "controlDict"
    new.write_text(
        path.read_text().replace("outlets", "closedBetween (1 2); outlets")
    )
    new.replace(path)
    time.sleep(1)
    control(case, "endTime", 0.1)
    output, _ = running.communicate(timeout=100)
    assert running.returncode == 0, output[-1000:]
    told = " ".join(output.split())
    assert "entries bolus or transport of fvSolution have changed" in told
    assert "entries of retainedMass have changed" in told
    assert told.count("They count from the next start on") == 2


def test_a_finished_run_that_goes_on_says_that_nothing_is_left_to_do(case):
    control(case, "endTime", 0.5)
    first = run(case, "bolusFoam")
    again = run(case, "bolusFoam")
    assert "Nothing left to do: the last written time, 0.5 s" in again
    # The same state of the bolus, not numbers of no step
    line = r"alpha +[-\d.e]+ to ([\d.]+)"
    assert re.findall(line, again)[-1][:5] == re.findall(line, first)[-1][:5]
    assert "e+15" not in again


# --- meshes ------------------------------------------------------------------


def test_cells_turned_inside_out_by_any_motion_are_one_error(case):
    # displacementLaplacian below half the height: its errors grow
    write_laplacian_motion(case)
    replace(
        case / "system" / "caseParameters", r"\nstrain\s[^;]*;", "\nstrain 2;"
    )
    run(case, "python", "system/makeMotion.py")
    said = message(run(case, "bolusFoam", ok=False))
    assert re.search(r"cells are turned inside out .* to t = 1\d\.\d+ s", said)
    assert re.search(r"the worst at \([-\d.e ]+\) m", said)
    assert re.search(r"the last written time is 1\d", said)


def test_compression_reaches_a_strain_of_one_and_a_half(tmp_path):
    case = prepare_compression(
        tmp_path / "case",
        nAxial=8,
        nRadial=18,
        strain=1.5,
        unloadStrain=0,
        strainStep=0.01,
        writeStrain=0.5,
    )
    run(case, "bolusFoam")
    force, surface = (
        read_table(case, "contactForce"),
        read_table(case, "freeSurface"),
    )
    stress = force["axial"][-1] * 0.02 * np.exp(-1.5) / surface["volume"][-1]
    # Flow stress at 0.1/s; 8 x 18 cells are 0.5 % low
    assert stress == pytest.approx(9600, rel=0.01)


def test_a_step_that_is_done_again_moves_the_mesh_from_its_start(case):
    # A stock solver that moves on from where the mesh is
    write_laplacian_motion(case, of="velocity")
    text = (case / "0" / "pointDisplacement").read_text()
    text = text.replace("pointDisplacement", "pointMotionU")
    text = text.replace("[0 1 0 0 0 0 0]", "[0 1 -1 0 0 0 0]")
    text = re.sub(
        r"movingPlaten\s*\{.*?\)\s*;\s*\}",
        "movingPlaten { type fixedValue; value uniform (-2e-3 0 0); }",
        text,
        flags=re.S,
    )
    (case / "0" / "pointMotionU").write_text(text)
    replace(
        case / "system" / "fvSolution",
        "cellDisplacement",
        '"cell(Displacement|MotionU)"',
    )
    # One iteration more than the first steps need: the step at 0 is cut
    replace(
        case / "system" / "fvSolution",
        r"bolus \{\}",
        "bolus { maxIterations 3; }",
    )
    control(case, "endTime", 0.5)
    control(case, "minDeltaT", 1e-6)
    run(case, "bolusFoam")
    assert read_table(case, "solver", "steps")["rejected"][-1] > 0
    points = (case / "0.5" / "polyMesh" / "points").read_text()
    x = [float(p) for p in re.findall(r"\n\(([-\d.e]+) ", points)]
    assert max(x) == pytest.approx(0.02 - 0.5 * 2e-3, abs=1e-10)


def test_a_rank_without_cells_is_refused_before_the_mesh_is_read(tmp_path):
    case = prepare_compression(
        tmp_path / "case", nAxial=2, nRadial=4, strain=0.2, unloadStrain=0
    )
    with pytest.raises(AssertionError) as failed:
        run_parallel(case, "bolusFoam", ranks=9)
    said = str(failed.value)
    assert "ranks have no cells" in said
    assert "take fewer (-np)" in " ".join(said.split())
