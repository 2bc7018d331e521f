# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The example of doc/adding-a-carried-field.md, built and run as it stands.

A piston pushes a bar of bolus, half as high as the channel, which has a dye in
its rear half: see test_transport. Its age is the time.
"""

import re
import shutil

import numpy as np
import pytest
from bolus_cases.page_library import blocks, built, is_formatted
from bolus_cases.specimens import (
    GRIPPING,
    SLIDING,
    box,
    ramp,
    replace,
    solve,
)
from bolus_cases.synthetic import run, run_parallel, write_field
from bolus_results.fields import Case
from bolus_results.tables import read_table

PAGE = "adding-a-carried-field"
LENGTH, HEIGHT = 0.030, 0.005  # of the channel [m]
BAR = (0.008, 0.0025)  # [m]
WAY = 0.004  # of the piston in 1 s [m]


FIELDS, MEAN = blocks(PAGE, "foam")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Where the cases of this file run."""
    return tmp_path_factory.mktemp("fields")


@pytest.fixture(scope="module", autouse=True)
def library(folder):
    """The page's library, where programs look for it."""
    with built(PAGE, "age", folder):
        yield


def prepare(case, fields=FIELDS, wall=SLIDING, numerics=""):
    """A bar goes with the piston for 1 s, in 10 steps; not yet run."""
    box(
        case,
        (LENGTH, HEIGHT),
        (30, 8),
        {
            "x0": (SLIDING, ramp(1, lambda t: (WAY * t, 0, 0), 1)),
            "x1": "open",
            "y0": wall,
            "y1": SLIDING,
        },
        end=1,
        step=0.1,
        block=BAR,
        measured=(),
    )
    replace(
        case / "0" / "pointDisplacement",
        r"x1 \{ type zeroGradient;",
        "x1 { type fixedValue; value uniform (0 0 0);",
    )
    control = case / "system" / "controlDict"
    replace(control, r'libs  \("', 'libs ("libmyFields.so" "')
    replace(control, r"functions\s*\{", "functions\n{\n" + MEAN)
    with open(case / "constant" / "bolusProperties", "a") as file:
        file.write(fields)
    with open(case / "system" / "fvSolution", "a") as file:
        file.write(f"transport {{ {numerics} }}\n")
    mesh = Case(case).mesh(0)
    rear = mesh.cell_centres[:, 0] < BAR[0] / 2
    write_field(case, mesh, 0, "dye", np.where(rear, 1.0, 0.0))
    return case


@pytest.fixture(scope="module")
def pushed(folder):
    """The page's case."""
    case = prepare(folder / "pushed")
    solve(case)
    return case


def amount(case, time, name):
    """Mass times a field, summed over the cells [m3 its unit]."""
    files = Case(case)
    mass = files.field(time, "mass") * files.mesh(time).cell_volumes
    return np.sum(mass * files.field(time, name)), np.sum(mass)


def amount_at_the_start():
    """The same of the dye at rest: its half of the bar, 0.01 m thick [m3]."""
    return 0.5 * BAR[0] * BAR[1] * 0.01


def test_the_code_of_the_page_has_the_form_that_is_checked():
    assert is_formatted(PAGE)


def test_the_mean_age_is_the_time(pushed):
    (path,) = pushed.glob("postProcessing/meanAge/0/*.dat")
    time, mean = np.loadtxt(path, unpack=True)
    assert len(time) == 10
    # The table has 12 digits
    assert mean == pytest.approx(time, rel=1e-11)


def test_bolus_is_as_old_in_every_cell_whatever_was_mixed(pushed):
    files = Case(pushed)
    age = files.field(1, "age")[files.field(1, "mass") > 1e-6]
    assert age == pytest.approx(1, rel=1e-11)


def test_a_dye_without_a_source_is_kept_to_round_off(pushed):
    kept, mass = amount(pushed, 1, "dye")
    # Fields have 12 digits; the mass itself is kept as well
    assert kept == pytest.approx(amount_at_the_start(), rel=1e-11)
    assert mass == pytest.approx(2 * amount_at_the_start(), rel=1e-11)


def test_a_dye_comes_as_far_as_the_piston_and_stays_within_0_and_1(pushed):
    files = Case(pushed)
    dye = files.field(1, "dye")
    assert dye.min() >= 0 and dye.max() <= 1 + 1e-12
    mesh = files.mesh(1)
    mass = files.field(1, "mass") * mesh.cell_volumes
    where = np.average(mesh.cell_centres[:, 0], weights=mass * dye)
    # A twentieth of a cell
    assert where == pytest.approx(BAR[0] / 4 + WAY, abs=5e-5)


def test_a_run_that_goes_on_has_the_same_fields(folder, pushed):
    case = prepare(folder / "goesOn")
    control = case / "system" / "controlDict"
    replace(control, r"endTime  1;", "endTime 0.5;")
    replace(control, r"writeInterval  1;", "writeInterval 0.5;")
    solve(case)
    replace(control, r"endTime 0.5;", "endTime 1;")
    solve(case)
    for name in ("age", "dye"):
        # 12 digits are written
        assert Case(case).field(1, name) == pytest.approx(
            Case(pushed).field(1, name), abs=1e-9
        )


def test_two_ranks_give_the_serial_fields(folder, pushed):
    case = prepare(folder / "ranks")
    run_parallel(case, "bolusFoam")
    run(case, "reconstructPar", "-latestTime")
    for name in ("age", "dye"):
        assert Case(case).field(1, name) == pytest.approx(
            Case(pushed).field(1, name), abs=1e-7
        )


def test_a_step_that_is_done_again_gives_the_fields_back(folder):
    # Bolus that sticks to the wall is compressed, and cells end fuller
    case = prepare(
        folder / "again", wall=GRIPPING, numerics="maxAlpha 1.00000001;"
    )
    solve(case)
    assert read_table(case, "solver", "steps")["rejected"].max() > 0
    kept, mass = amount(case, 1, "dye")
    assert kept == pytest.approx(amount_at_the_start(), rel=1e-11)
    old, _ = amount(case, 1, "age")
    assert old == pytest.approx(mass, rel=1e-11)


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ("fields (smell);", "smell.*age.*tracer"),
        ("fields (age age);", "age is the name of another field"),
        ("fields (D);", "D is the name of another field.*epsilonPEq"),
        ("fields age;", "fields"),
        ("fields (age); agCoeffs {}", r"agCoeffs.*age"),
        ("fields (age); ageCoeffs { start 1; }", "start"),
        ("fields (dye); dyeCoeffs { type tracer; star 1; }", "star"),
    ],
)
def test_a_field_that_cannot_be_is_one_clear_error(
    folder, pushed, tmp_path, fields, message
):
    case = tmp_path / "case"
    for part in ("0", "constant", "system"):
        shutil.copytree(pushed / part, case / part)
    replace(case / "constant" / "bolusProperties", r"fields \([^\0]*", fields)
    said = run(case, "bolusFoam", ok=False)
    assert re.search(message, said.replace("\n", " "))
    assert said.count("FOAM FATAL") == 1
