# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The example of doc/adding-a-phase.md, built and run as it stands.

A box is pressed along x by plates that all slides on; y1 is open. Plane
extension of a liquid: sigma_xx - sigma_yy = 4 viscosity rate, sigma_yy = 0.
"""

import re

import pytest
from bolus_cases.page_library import blocks, built, is_formatted
from bolus_cases.specimens import SLIDING, box, ramp, replace
from bolus_cases.synthetic import run
from bolus_results.tables import read_table

PAGE = "adding-a-phase"
LENGTH, HEIGHT, DEPTH = 0.01, 0.01, 0.01  # [m]
RATE = 0.1  # [1/s]
END = 0.2  # [s]
(CASE,) = blocks(PAGE, "foam")


@pytest.fixture(scope="module", autouse=True)
def library(tmp_path_factory):
    """The page's library, where programs look for it."""
    with built(PAGE, "syrup", tmp_path_factory.mktemp("phase")):
        yield


def prepare(case, properties, filled):
    """The lower part of the box, filled, is bolus; not yet run."""
    box(
        case,
        (LENGTH, HEIGHT),
        (6, 8),
        {
            "x0": "symmetryPlane",
            "x1": (SLIDING, ramp(END, lambda t: (-RATE * LENGTH * t, 0, 0))),
            "y0": "symmetryPlane",
            "y1": "open",
        },
        end=END,
        step=0.05,
        block=(LENGTH, filled * HEIGHT),
    )
    replace(
        case / "0" / "pointDisplacement",
        r"y1 \{ type zeroGradient;",
        "y1 { type fixedNormalSlip; n (0 1 0);",
    )
    replace(
        case / "system" / "controlDict",
        r'libs  \("',
        'libs ("libmyPhases.so" "',
    )
    with open(case / "constant" / "bolusProperties", "a") as file:
        file.write(properties)
    return case


def force(case):
    """On the plate at the end [N]; the last of what was printed."""
    said = run(case, "bolusFoam", "-checkTangent")
    return -read_table(case, "forceX1", "contactForce")["axial"][-1], said


def exact(viscosity, height):
    """The same of a liquid: 4 viscosity rate, over its section now."""
    now = RATE / (1 - RATE * END)
    return 4 * viscosity * now * height * DEPTH


def thick(viscosity):
    """The page's case with another viscosity [Pa s]."""
    return CASE.replace("50;", f"{viscosity};")


def test_the_code_of_the_page_has_the_form_that_is_checked():
    assert is_formatted(PAGE)


@pytest.mark.parametrize("filled", [0.125, 0.5])
def test_beside_bolus_it_adds_its_own_stress(tmp_path, filled):
    viscosity = 2e4
    alone, _ = force(prepare(tmp_path / "gas", "", filled))
    both, said = force(prepare(tmp_path / "syrup", thick(viscosity), filled))
    # The bolus has grown into the next cells by 2 %
    height = HEIGHT * (1 - filled * (1 + RATE * END))
    assert abs(both - alone) == pytest.approx(
        exact(viscosity, height), rel=0.02
    )
    differences = [
        float(x) for x in re.findall(r"finite differences: (\S+)", said)
    ]
    assert max(differences) < 1e-5


def test_the_energy_balance_closes_with_it(tmp_path):
    force(prepare(tmp_path, thick(2e4), filled=0.5))
    balance = read_table(tmp_path, "energyBalance")
    assert abs(balance["relative"][-1]) < 1e-6
    assert balance["gas"][-1] > 0.2 * balance["work"][-1]


def test_an_unknown_phase_is_one_clear_error(tmp_path):
    case = prepare(tmp_path, "phases (bolus honey);", filled=0.5)
    said = run(case, "bolusFoam", ok=False).replace("\n", " ")
    assert re.search(r"phases.*honey.*gas.*syrup", said)
    assert said.count("FOAM FATAL") == 1
