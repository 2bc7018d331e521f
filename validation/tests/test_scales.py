# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Foods of any strength and tests of any speed: what is artificial follows."""

import pytest
from bolus_cases.specimens import Compression, prepare_compression, replace
from bolus_cases.synthetic import run, write_file
from bolus_results.tables import read_table

# Flow stress [Pa] at strain rates [1/s]: that of tutorials/common
TABLE = ((0, 4100), (0.01, 7000), (0.1, 9600), (1, 15200))


def compression(case, strength=1.0, slow=1.0, typical=None, **entries):
    """Sticking cylinder at 0.1/s over slow, of strength times the oatcake's.

    Its table is slowed down as well, so that the answer is the same in units of
    both; typical: strainRate [1/s] that the case is told, if not its own.
    """
    rate = 0.1 / slow
    prepare_compression(
        case,
        **{"nAxial": 6, "nRadial": 12, "strain": 0.1, "unloadStrain": 0}
        | {"strainStep": 0.01, "writeStrain": 0.1, "friction": "coulomb"}
        | {"strainRate": f"{rate:.12g}"},
        **entries,
    )
    rows = " ".join(f"({r / slow:.12g} {s * strength})" for r, s in TABLE)
    write_file(
        case / "constant" / "bolusProperties",
        f"rho 1100; elasticity {{ E {1e5 * strength}; nu 0.49; }}\n"
        "flowStress { type tabulated; interpolation linear; "
        f"table ({rows}); }}\ndamage {{ type none; }}\n",
    )
    if typical is not None:
        replace(
            case / "system" / "timeParameters",
            r"strainRate [^;]*;",
            f"strainRate {typical:.12g};",
        )
    return run(case, "bolusFoam")


def force(case, slow=1.0):
    """Stress at the end over the oatcake's flow stress at 0.1/s [-]."""
    measured = Compression(case, rate=0.1 / slow, largest=0.1)
    return measured.force[-1] / measured.section[-1] / 9600


@pytest.fixture(scope="module")
def oatcake(tmp_path_factory):
    """(stress over flow stress [-], steps) of the oatcake at 0.1/s."""
    case = tmp_path_factory.mktemp("scales") / "case"
    compression(case)
    return force(case), read_table(case, "solver", "steps")


@pytest.mark.parametrize(
    "strength,slow",
    [(1e-3, 1), (0.1, 1), (100, 1), (1, 1e4), (1, 1e-3), (0.02, 100)],
)
def test_a_food_of_any_strength_at_any_rate_gives_the_same_in_its_units(
    oatcake, tmp_path, strength, slow
):
    compression(tmp_path, strength, slow)
    expected, steps = oatcake
    mine = read_table(tmp_path, "solver", "steps")
    assert len(mine.time) == len(steps.time) == 10
    assert mine["rejected"][-1] == 0
    # To the tolerance of Newton's method
    assert force(tmp_path, slow) / strength == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("typical", [1e-4, 20])
def test_a_strain_rate_that_is_not_the_case_s_is_told(tmp_path, typical):
    said = compression(tmp_path, typical=typical)
    assert f"the case's strainRate (controlDict) is {typical:g} /s" in " ".join(
        said.split()
    )


def test_a_strain_rate_that_is_the_case_s_is_not(tmp_path):
    assert "strainRate" not in compression(tmp_path)


def test_a_bad_strain_rate_is_named(tmp_path):
    with pytest.raises(AssertionError) as failed:
        compression(tmp_path, typical=-1)
    assert "entry strainRate: -1; valid are numbers > 0" in str(failed.value)


def test_what_is_made_for_one_food_follows_another(oatcake, tmp_path):
    # The defaults, said to be for the oatcake, in a food a tenth as strong
    compression(tmp_path / "default", strength=0.1)
    case = tmp_path / "made"
    compression(case, strength=0.1)
    path = case / "constant" / "bolusProperties"
    path.write_text(
        path.read_text()
        + "gasCoeffs { madeFor { stress 9600; strainRate 0.1; } "
        "zeta 20; eta 1; etaDamaged 20; delta 2; }\n"
    )
    for time in case.glob("1*"):
        time.rename(tmp_path / time.name)
    run(case, "bolusFoam")
    assert force(case) == pytest.approx(force(tmp_path / "default"), rel=1e-9)
