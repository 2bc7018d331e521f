# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The example of doc/adding-a-force.md, built and run as it stands.

Bolus stands on the plate x0, between walls that it slides on.
"""

import re

import pytest
from bolus_cases.page_library import blocks, built, is_formatted
from bolus_cases.specimens import SLIDING, box
from bolus_cases.specimens import replace as replace_in
from bolus_cases.synthetic import run
from bolus_results.tables import read_table

PAGE = "adding-a-force"
LENGTH, HEIGHT, DEPTH = 0.02, 0.005, 0.01  # [m]
FILLED = 0.5  # of the length
RHO, GRAVITY = 1100, 9.81
(CASE,) = blocks(PAGE, "foam")


@pytest.fixture(scope="module", autouse=True)
def library(tmp_path_factory):
    """The page's library, where programs look for it."""
    with built(PAGE, "weight", tmp_path_factory.mktemp("force")):
        yield


def prepare(case, properties):
    """Not yet run."""
    box(
        case,
        (LENGTH, HEIGHT),
        (12, 3),
        {"x0": SLIDING, "x1": "open", "y0": SLIDING, "y1": "symmetryPlane"},
        end=0.2,
        step=0.05,
        block=(FILLED * LENGTH, HEIGHT),
        measured=("x0",),
    )
    replace_in(
        case / "system" / "controlDict",
        r'libs  \("',
        'libs ("libmyForces.so" "',
    )
    with open(case / "constant" / "bolusProperties", "a") as file:
        file.write(properties)
    return case


@pytest.fixture(scope="module")
def standing(tmp_path_factory):
    """The page's case."""
    case = prepare(tmp_path_factory.mktemp("standing"), CASE)
    run(case, "bolusFoam")
    return case


def test_the_code_of_the_page_has_the_form_that_is_checked():
    assert is_formatted(PAGE)


def test_bolus_presses_on_its_floor_with_its_weight(standing):
    mass = RHO * FILLED * LENGTH * HEIGHT * DEPTH
    axial = read_table(standing, "forceX0", "contactForce")["axial"]
    # To the tolerance of equilibrium, 1e-6 of 1e4 Pa over the floor
    assert abs(axial[-1]) == pytest.approx(mass * GRAVITY, rel=1e-3)


def test_what_the_weight_gives_is_stored_or_lost_in_the_bolus(standing):
    balance = read_table(standing, "energyBalance")
    gives = -balance["weight"][-1]
    assert gives > 0
    others = sum(
        balance[name][-1]
        for name in ("elastic", "plastic", "relaxation", "gas", "hourglass")
    )
    assert others == pytest.approx(gives, rel=1e-2)


@pytest.mark.parametrize(
    ("properties", "message"),
    [
        ("forces (wind);", r"forces.*wind.*weight"),
        ("forces (weight weight);", r"forces.*weight twice"),
    ],
)
def test_a_force_that_cannot_be_is_one_clear_error(
    tmp_path, properties, message
):
    case = prepare(tmp_path, properties)
    said = run(case, "bolusFoam", ok=False).replace("\n", " ")
    assert re.search(message, said)
    assert said.count("FOAM FATAL") == 1
