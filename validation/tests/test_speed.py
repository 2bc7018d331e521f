# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""./Allrun validate speed: what it reads, and the stock solver beside ours."""

import ctypes.util
import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from bolus_cases.specimens import prepare_compression
from bolus_cases.synthetic import run
from bolus_results.profiling import PHASES, phases, read_profile
from bolus_results.results import write_json
from bolus_results.summary import summary
from bolus_validation import gastric_study, speed_study, stock
from bolus_validation.studies import REGISTRY, ROOT


@pytest.fixture(scope="module")
def profiled(tmp_path_factory):
    """A short run with OpenFOAM's profiling."""
    case = tmp_path_factory.mktemp("speed") / "case"
    prepare_compression(case, strain=0.05, unloadStrain=0, writeStrain=0.05)
    with open(case / "system" / "controlDict", "a") as control:
        control.write("profiling { active true; }\n")
    run(case, "bolusFoam")
    return case


@pytest.fixture(scope="module")
def profile(profiled):
    """Seconds by name of that run."""
    (last,) = profiled.glob("0.5/uniform/profiling")
    return read_profile(last)


def test_the_solver_names_every_phase(profile):
    missing = [
        name
        for names in PHASES.values()
        for name in names
        if profile.get(name, 0) <= 0
    ]
    assert not missing


def test_the_phases_are_within_the_whole(profile):
    known = sum(profile[name] for names in PHASES.values() for name in names)
    total = profile["application::main"]
    # Most of so short a run is its start
    assert 0.2 * total < known < total
    # What equilibrium takes is assembly and the linear system
    inner = sum(
        profile[name]
        for phase in ("assembly", "factorisation", "solve")
        for name in PHASES[phase]
    )
    assert 0.7 * profile["equilibrium"] < inner < profile["equilibrium"]


def test_phases_and_the_rest_are_the_whole(profiled):
    found = phases(profiled)
    total = found.pop("total")
    assert sum(found.values()) == pytest.approx(total)
    assert list(found) == [*PHASES, "the rest"]
    assert min(found.values()) > 0


def test_the_summary_tells_where_the_time_went(profiled):
    write_json(profiled)
    text = summary(profiled)
    assert text.count("where the time went") == 1
    assert re.search(r"^ +factorisation +[\d.]+ s$", text, re.M)
    seconds = phases(profiled)["total"]
    assert f"total         {seconds:8.1f} s" in text


@pytest.mark.parametrize("gave_up", [False, True])
def test_a_whole_run_is_held_against_its_limit(
    profiled, tmp_path, monkeypatch, gave_up
):
    # One that gave up has neither results nor a clock time
    case = tmp_path / "case"
    shutil.copytree(profiled, case)
    if gave_up:
        (case / "stopped").write_text("no convergence at t = 0.4 s")
        (case / "results.json").unlink(missing_ok=True)
    monkeypatch.setattr(speed_study, "kept_run", lambda *_, **__: case)
    found = REGISTRY["whole_D_0.3"].function(tmp_path, quick=False)
    rows = {row.quantity: row for row in found.rows}
    assert rows["within 10 min"].met
    assert rows["to 32 s without a step given up"].met != gave_up
    assert rows["steps"].value > 3
    assert rows["time"].value > 0
    assert rows["factorisation, since the last start"].value > 0


def test_the_gastric_page_takes_a_whole_run_that_is_there(
    tmp_path, monkeypatch
):
    whole = speed_study.whole_run("D", 0.3)
    assert whole["ranks"] == 2 and whole["resolution"] == pytest.approx(3e-4)
    made = []
    monkeypatch.setattr(
        gastric_study,
        "run_folder",
        lambda **arguments: tmp_path if arguments == whole else None,
    )
    monkeypatch.setattr(
        gastric_study,
        "kept_run",
        lambda *_, **settings: made.append(settings) or tmp_path / "other",
    )
    # Not before its end
    assert gastric_study.gastric_run("D", 0.3) == tmp_path / "other"
    (tmp_path / "finished").touch()
    assert gastric_study.gastric_run("D", 0.3) == tmp_path
    # That one has no other settings
    monkeypatch.setattr(
        gastric_study,
        "run_folder",
        lambda **arguments: tmp_path / str(arguments.get("mu")),
    )
    assert gastric_study.gastric_run("D", 0.3, mu=0) == tmp_path / "other"
    assert [m.get("mu") for m in made] == [None, 0]


def test_a_run_without_profile_has_no_phases(tmp_path):
    (tmp_path / "0.5" / "uniform").mkdir(parents=True)
    assert phases(tmp_path) == {}


def test_a_file_that_is_no_profile_is_refused(tmp_path):
    (tmp_path / "profiling").write_text("profiling {}")
    with pytest.raises(ValueError, match="no trigger"):
        read_profile(tmp_path / "profiling")


def test_the_exact_force_is_stress_times_section():
    # At rate 0.1/s 9742 Pa; half the height doubles section and rate
    first, half = stock.exact_force(np.array([0.0, 0.01]), 2e-3)
    assert first == pytest.approx(9742 * np.pi * 1e-4, rel=1e-4)
    assert half == pytest.approx(
        2 * (4100 + 11000 * 0.2**0.29) * np.pi * 1e-4, rel=1e-12
    )


def test_inter_foam_compresses_the_same_cylinder(tmp_path):
    # Found 4.9 % above: the start's inertia, of 25,000 times the density, which
    # falls to 0.6 % at 0.25 s
    case = stock.prepare_compression_case(
        tmp_path / "stock", (7, 9), 2e-3, 0.1, 1e-3, 2.5e4
    )
    times, force, seconds = stock.solve(case)
    assert times[-1] == pytest.approx(0.1)
    exact = stock.exact_force(2e-3 * times[-1:], 2e-3)
    assert stock.SECTORS * force[-1] == pytest.approx(exact[0], rel=0.07)
    assert seconds > 0


def test_openblas_takes_kernels_of_this_processor():
    # OpenBLAS falls back to Prescott's on a processor newer than itself
    library = ctypes.util.find_library("openblas")
    flags = Path("/proc/cpuinfo").read_text().split()
    if library is None or not {"avx2", "fma"} <= set(flags):
        pytest.skip("no OpenBLAS, or a processor as old as that")
    name = (
        f"import ctypes; blas = ctypes.CDLL('{library}');"
        " core = blas.openblas_get_corename;"
        " core.restype = ctypes.c_char_p; print(core().decode())"
    )
    environment = "unset OPENBLAS_CORETYPE; source scripts/environment"
    told = run(ROOT, "bash", "-c", f'{environment}; python3 -c "{name}"')
    assert told.strip() in ("SkylakeX", "Haswell")
