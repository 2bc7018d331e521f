# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""materialPoint, and with it src/rheology, against bolus_validation.rheology.

The tolerance of 0.1 % is the project's own (issue 2). Backward Euler with the
default strain increment of 1e-5 stays below it by a factor of 7 (first order).
"""

import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from bolus_results.material_point import read_segments, run_material_point
from bolus_validation import rheology as theory

COMMON = Path(__file__).parents[2] / "tutorials" / "common"

TABLE = theory.Tabulated(theory.RATES, theory.STRESSES)
LOG_TABLE = theory.Tabulated(theory.RATES, theory.STRESSES, logarithmic=True)
HB = theory.HerschelBulkley()
J_LAW = theory.PowerHardening()

LAWS = {
    "tabulated": (TABLE, "viscoplastic", ""),
    "logarithmic": (
        LOG_TABLE,
        "viscoplastic",
        "flowStress { interpolation logarithmic; }",
    ),
    "HerschelBulkley": (HB, "HerschelBulkley", ""),
    "JLaw": (J_LAW, "JLaw", ""),
    # The comparison of its tangent with differences, within 1e-6, is noisy in
    # perfect plasticity: 0.9e-6 with an end at 0.3, 2e-6 at 0.5, and 4e-6 for a
    # table of one stress, 5.8 kPa
    "JLawThatEnds": (
        theory.PowerHardening(ends=0.25),
        "JLaw",
        "flowStress { hardensUntil 0.25; }",
    ),
}

RATES = [0.01, 0.1, 1.0]


def dictionary(properties, segments, extra="", override=""):
    """Text of a materialPointDict with a bolus of tutorials/common."""
    return f"""
        bolusProperties
        {{
            #include "{COMMON}/bolusProperties.{properties}"
            {override}
        }}
        segments {{ {segments} }}
        {extra}
    """


def run(folder, *args, **options):
    """Segments of the table that materialPoint makes of a dictionary."""
    done = run_material_point(dictionary(*args, **options), folder)
    assert done.returncode == 0, done.stderr + done.stdout
    return read_segments(Path(folder) / "point.dat")


def assert_within(actual, expected, tolerance=1e-3, floor=0.02):
    """Relative to the value, but at least to floor times the largest one.

    With floor 1 relative to the largest: for an unloading, whose stress ends
    at zero.
    """
    scale = np.maximum(np.abs(expected), floor * np.max(np.abs(expected)))
    error = np.max(np.abs(actual - expected) / scale)
    assert error < tolerance, f"{error:.2e}"


def uniaxial(law, strain_rate, times, sigma=0.0):
    """Reference stress [Pa] of loading or relaxation of any law."""
    if isinstance(law, theory.Tabulated):
        return theory.uniaxial_tabulated(law, strain_rate, times, sigma)
    if isinstance(law, theory.HerschelBulkley):
        if strain_rate == 0:
            return theory.relaxation_herschel_bulkley(law, times, sigma)
        return theory.uniaxial_rate_law(law, strain_rate, times, sigma)
    if strain_rate == 0:
        return np.full(len(times), sigma)
    return theory.uniaxial_power_hardening(law, strain_rate * times)


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("name", LAWS)
def test_compression_relaxation_and_unloading_follow_theory_within_0_1_percent(
    tmp_path, name, rate
):
    law, properties, override = LAWS[name]
    table = run(
        tmp_path,
        properties,
        f"""
        load {{ mode uniaxial; rate {rate}; strain -1.2; }}
        hold {{ mode uniaxial; duration 600; }}
        back {{ mode uniaxial; rate {rate}; unload yes; }}
        """,
        override=override,
    )

    load, hold, back = table["load"], table["hold"], table["back"]
    t_load, t_hold = 1.2 / rate, 600.0

    loading = uniaxial(law, rate, load["time"])
    assert_within(-load["axialStress"], loading)
    assert_within(load["sigmaEq"], loading)
    assert_within(load["p"], loading / 3)
    assert_within(load["axialStrain"], -rate * load["time"], 1e-9)
    assert_within(load["epsilonPEq"], rate * load["time"] - loading / theory.E)
    # Hooke's law across, with no plastic volume change
    assert_within(
        load["lateralStrain"],
        0.5 * load["epsilonPEq"] + theory.NU * loading / theory.E,
    )
    # Free lateral surfaces
    assert np.max(np.abs(load["lateralStress"])) < 1e-6 * np.max(loading)

    assert hold["time"][-1] == pytest.approx(t_load + t_hold, rel=1e-9)
    relaxing = uniaxial(law, 0.0, hold["time"] - t_load, loading[-1])
    assert_within(-hold["axialStress"], relaxing)

    # Unloading is elastic: Young's modulus down to zero stress
    unloaded = back["axialStrain"] + 1.2
    assert_within(
        -back["axialStress"], relaxing[-1] - theory.E * unloaded, floor=1
    )
    assert abs(back["axialStress"][-1]) < 1e-6 * relaxing[-1]
    # (but for the end of the relaxation, 1e-7 in the slowest case)
    assert_within(back["epsilonPEq"], hold["epsilonPEq"][-1], 1e-6)


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("name", LAWS)
def test_shear_relaxation_and_unloading_follow_theory_within_0_1_percent(
    tmp_path, name, rate
):
    law, properties, override = LAWS[name]
    gamma_rate = np.sqrt(3) * rate
    table = run(
        tmp_path,
        properties,
        f"""
        load {{ mode simpleShear; rate {gamma_rate:.15g}; strain 2; }}
        hold {{ mode simpleShear; duration 60; }}
        back {{ mode simpleShear; rate {gamma_rate:.15g}; unload yes; }}
        """,
        extra="rows 25;",
        override=override,
    )

    state = None, 0.0
    for segment, signed in (("load", 1), ("hold", 0), ("back", -1)):
        rows = table[segment]
        start = {"load": 0.0, "hold": 2 / gamma_rate}.get(
            segment, 2 / gamma_rate + 60
        )
        stresses, strains = theory.simple_shear(
            law, signed * gamma_rate, rows["time"] - start, *state
        )
        state = stresses[-1], strains[-1]

        q = np.sqrt(1.5 * np.sum(stresses**2, axis=(1, 2)))
        floor = 1 if segment == "back" else 0.02
        assert_within(rows["shearStress"], stresses[:, 0, 1], floor=floor)
        assert_within(rows["axialStress"], stresses[:, 0, 0], floor=floor)
        assert_within(rows["lateralStress"], stresses[:, 1, 1], floor=floor)
        assert_within(rows["sigmaEq"], q, floor=floor)
        assert_within(rows["epsilonPEq"], strains)

    # Shear has no volume change, so no pressure
    assert np.max(np.abs(table["load"]["p"])) < 1e-6


@pytest.mark.parametrize("rate", RATES)
def test_steady_shear_is_the_flow_stress_turned_by_the_jaumann_rate(
    tmp_path, rate
):
    # The exact steady state: a table of one point, the flow stress at rate
    flow = np.interp(rate, theory.RATES, theory.STRESSES)
    load = run(
        tmp_path,
        "viscoplastic",
        f"load {{ mode simpleShear; rate {rate * 3**0.5:.15g}; strain 10; }}",
        override=f"flowStress {{ table ((0 {flow})); }}",
    )["load"]
    shear, ratio = theory.steady_shear(flow)

    # 1e-5: the approach to the steady state, and roundoff; the discrete
    # rotation makes it exact otherwise
    assert load["sigmaEq"][-1] == pytest.approx(flow, rel=1e-9)
    assert load["shearStress"][-1] == pytest.approx(shear, rel=1e-5)
    growth = np.diff(load["epsilonPEq"][-2:]) / np.diff(load["time"][-2:])
    assert growth[0] == pytest.approx(rate * ratio, rel=1e-5)


def test_elastic_shear_follows_the_jaumann_rate_exactly(tmp_path):
    # Jaumann's hypoelastic shear: tau = G sin(gamma), s_xx = G (1 - cos)
    load = run(
        tmp_path,
        "viscoplastic",
        "load { mode simpleShear; rate 1; strain 6; }",
        override="flowStress { table ((0 1e9)); }",
    )["load"]
    gamma = load["shearStrain"]

    # 1e-4: first order in the increment of 1e-5, gathered over gamma = 6
    scale = theory.G
    assert np.allclose(
        load["shearStress"] / scale, np.sin(gamma), rtol=0, atol=1e-4
    )
    assert np.allclose(
        load["axialStress"] / scale, 1 - np.cos(gamma), rtol=0, atol=1e-4
    )


def test_elastic_shear_by_the_logarithmic_rate_is_that_of_hencky(tmp_path):
    # With sinh h = gamma/2: tau = 2 G h/cosh h, s_xx = 2 G h tanh h; the
    # principal stresses differ by 4 G h. Two terms of the series: at gamma 1.5
    # (x = 2.8) the modulus is 4 % too high. Found 1.6e-4 and 3.5e-4 of G below
    # 0.8, where Jaumann's rate is 6.7e-3 off, and 7.7e-3 and 8.3e-3 at the end
    load = run(
        tmp_path,
        "viscoplastic",
        "load { mode simpleShear; rate 1; strain 1.5; }",
        override="flowStress { table ((0 1e9)); }"
        " elasticity { objectiveRate logarithmic; }",
    )["load"]
    h = np.arcsinh(load["shearStrain"] / 2)
    shear = load["shearStress"] / theory.G
    axial = load["axialStress"] / theory.G
    early = load["shearStrain"] < 0.8
    assert np.allclose(shear[early], (2 * h / np.cosh(h))[early], atol=1e-3)
    assert np.allclose(axial[early], (2 * h * np.tanh(h))[early], atol=1e-3)
    assert np.allclose(shear, 2 * h / np.cosh(h), atol=1.2e-2)
    assert np.allclose(axial, 2 * h * np.tanh(h), atol=1.2e-2)


def test_j_law_reaches_20_kpa_at_a_strain_of_1_5(tmp_path):
    # Eq. 11 of the paper with H rounded to 11.78 kPa: that is 0.04 %
    load = run(
        tmp_path, "JLaw", "load { mode uniaxial; rate 0.01; strain -1.5; }"
    )["load"]
    assert load["sigmaEq"][-1] == pytest.approx(20e3, rel=1e-3)


def test_herschel_bulkley_fits_the_table_within_150_pa(tmp_path):
    for rate, stress in zip(theory.RATES[1:], theory.STRESSES[1:], strict=True):
        load = run(
            tmp_path,
            "HerschelBulkley",
            f"load {{ mode uniaxial; rate {rate}; strain -3; }}",
            extra="maxStrainIncrement 1e-3;",
        )["load"]
        assert abs(load["sigmaEq"][-1] - stress) < 150


def test_time_integration_converges_with_first_order(tmp_path):
    def error(increment):
        load = run(
            tmp_path,
            "HerschelBulkley",
            "load { mode uniaxial; rate 0.1; strain -0.2; }",
            extra=f"maxStrainIncrement {increment}; rows 10;",
        )["load"]
        exact = uniaxial(HB, 0.1, load["time"])
        return np.max(np.abs(-load["axialStress"] - exact))

    # Backward Euler: the error halves with the step (10 % for higher orders)
    assert error(1e-3) / error(5e-4) == pytest.approx(2, rel=0.1)
    assert error(5e-4) / error(2.5e-4) == pytest.approx(2, rel=0.1)


@pytest.mark.parametrize("increment", [1e-3, 0.1])
@pytest.mark.parametrize("rate", [1e-6, 1e-2, 1.0, 1e3, 1e6])
@pytest.mark.parametrize(
    "law",
    [
        "type tabulated; table ((0 4100) (0.01 7000) (0.1 9600) (1 15200));",
        "type tabulated; table ((0 4100) (1e-8 8e3) (1 8e3) (1.001 2e4));",
        "type HerschelBulkley; sigma0 4100; k 11000; n 0.29;",
        "type HerschelBulkley; sigma0 0; k 11000; n 0.05;",
    ],
)
def test_return_mapping_holds_from_1e_6_to_1e6_per_second(
    tmp_path, law, rate, increment
):
    # Steps of 1e-9 s to 1e5 s; the plateau is the flow stress
    (tmp_path / "law").write_text("")
    done = run_material_point(
        f"""
        bolusProperties
        {{
            rho 1100;
            elasticity {{ E 100e3; nu 0.49; }}
            flowStress {{ {law} }}
            damage {{ type none; }}
        }}
        maxStrainIncrement {increment};
        segments {{ load {{ mode uniaxial; rate {rate}; strain -18; }} }}
        """,
        tmp_path,
    )
    assert done.returncode == 0, done.stderr
    load = read_segments(tmp_path / "point.dat")["load"]

    words = dict(re.findall(r"(\w+) ([\d.e+-]+);", law))
    if "HerschelBulkley" in law:
        plateau = float(words["sigma0"]) + float(words["k"]) * rate ** float(
            words["n"]
        )
    else:
        points = np.array(
            re.findall(r"\(([\d.e+-]+) ([\d.e+-]+)\)", law), float
        )
        plateau = np.interp(rate, points[:, 0], points[:, 1])

    # 0.1 %: the most viscous case approaches its plateau like exp(-10)
    assert load["sigmaEq"][-1] == pytest.approx(plateau, rel=1e-3)


@pytest.mark.parametrize(
    "properties, override",
    [(properties, override) for _, properties, override in LAWS.values()]
    + [("viscoplasticDamage", "")],
    ids=[*LAWS, "viscoplasticDamage"],
)
def test_tangent_equals_finite_differences_within_1e_6(
    tmp_path, properties, override
):
    # materialPoint compares at each row, with all components of gradU and
    # rotations up to 0.3 rad, and fails by itself beyond 1e-6. In tension the
    # damage comes on the way, so the damaged tangent is among them.
    run(
        tmp_path,
        properties,
        """
        pull { mode uniaxial; rate 0.1; strain 0.5; }
        shear { mode simpleShear; rate 0.5; strain 1; }
        hold { mode simpleShear; duration 10; }
        back { mode simpleShear; rate 1; unload yes; }
        press { mode uniaxialStrain; rate 2; strain -0.1; }
        """,
        extra="checkTangent yes;",
        override=override,
    )
    lines = (tmp_path / "point.dat").read_text().splitlines()
    rows = sum(not line.startswith("#") for line in lines) - 1
    last = lines[-1].split()
    # 18 directions a row; hardly any may be left out
    assert last[:2] == ["#", "tangent"]
    assert rows > 300 and int(last[-2]) > 0.97 * 18 * rows


def test_damage_begins_at_plastic_strain_0_25_in_tension(tmp_path):
    pull = run(
        tmp_path,
        "viscoplasticDamage",
        "pull { mode uniaxial; rate 0.1; strain 0.5; }",
        extra="rows 500;",
    )["pull"]
    first = int(np.argmax(pull["D"]))
    before = pull["D"] == 0

    # Until then the intact curve; the onset within one row (strain 0.001)
    stress = theory.uniaxial_tabulated(TABLE, 0.1, pull["time"])
    assert_within(pull["axialStress"][before], stress[before])
    onset = np.argmax(0.1 * pull["time"] - stress / theory.E > 0.25)
    assert abs(first - onset) <= 1
    assert pull["triaxiality"][first - 1] == pytest.approx(1 / 3, rel=1e-6)

    # Afterwards nothing but the residual strength of 1e-4, for good
    assert np.all(pull["D"][first:] == 1)
    assert np.max(np.abs(pull["axialStress"][first + 1 :])) < 2e-4 * 9600


@pytest.mark.parametrize(
    "segment",
    [
        "load { mode uniaxial; rate 0.1; strain -1.2; }",
        "load { mode simpleShear; rate 0.1; strain 2; }",
    ],
)
def test_no_damage_without_tension(tmp_path, segment):
    load = run(tmp_path, "viscoplasticDamage", segment)["load"]
    assert load["epsilonPEq"][-1] > 1
    assert np.all(load["D"] == 0)


@pytest.mark.parametrize(
    "override",
    ["damage { eta0 0.34; }", "damage { epsilonPEq0 0.5; }"],
)
def test_damage_needs_both_thresholds(tmp_path, override):
    # Uniaxial tension has a triaxiality of 1/3; 0.5 is not reached
    pull = run(
        tmp_path,
        "viscoplasticDamage",
        "pull { mode uniaxial; rate 0.1; strain 0.5; }",
        override=override,
    )["pull"]
    assert np.all(pull["D"] == 0)
    assert pull["axialStress"][-1] > 9000


@pytest.mark.parametrize("needed", [0, 0.1, 0.4])
def test_damage_waits_for_plastic_strain_under_tension(tmp_path, needed):
    # Squeezed beyond the threshold, then pulled: 0 breaks with the first
    # tension above eta0, the others when so much has come on top
    load = run(
        tmp_path,
        "viscoplasticDamage",
        """
        press { mode uniaxial; rate 0.1; strain -0.6; }
        pull { mode uniaxial; rate 0.1; strain 0.3; }
        """,
        extra="rows 500;",
        override=f"damage {{ tensileStrain {needed}; }}",
    )
    assert np.all(load["press"]["D"] == 0)
    pull = load["pull"]
    # The row before: in that of the break the elastic strain, too, is lost
    last = int(np.argmax(pull["D"])) - 1
    begin = int(np.argmax(pull["triaxiality"] > 0.2)) - 1
    came = pull["epsilonPEq"][last] - pull["epsilonPEq"][begin]
    assert came == pytest.approx(needed, abs=0.004)
    assert needed > 0 or last == begin


@pytest.mark.parametrize("needed", [0.1, 0.25, 0.4])
def test_a_bar_in_tension_breaks_at_the_larger_strain(tmp_path, needed):
    pull = run(
        tmp_path,
        "viscoplasticDamage",
        "pull { mode uniaxial; rate 0.1; strain 0.8; }",
        extra="rows 800;",
        override=f"damage {{ tensileStrain {needed}; }}",
    )["pull"]
    last = int(np.argmax(pull["D"])) - 1
    assert pull["epsilonPEq"][last] == pytest.approx(
        max(needed, 0.25), abs=0.002
    )


def test_damaged_material_carries_pressure_but_no_tension(tmp_path):
    table = run(
        tmp_path,
        "viscoplasticDamage",
        """
        break { mode uniaxial; rate 0.1; strain 0.4; }
        close { mode uniaxial; rate 0.1; strain 0; }
        press { mode uniaxialStrain; rate 0.1; strain -0.1; }
        pull { mode uniaxialStrain; rate 0.1; strain 0.1; }
        again { mode uniaxialStrain; rate 0.1; strain -0.1; }
        """,
    )
    assert table["break"]["D"][-1] == 1

    # In the die, the volume is the axial strain: pressure K times it. The
    # smallest pressures, near the zero, are left out.
    for name in ("press", "again"):
        rows = table[name]
        closed = rows["axialStrain"] < -0.01
        assert np.count_nonzero(closed) > 40
        assert_within(
            rows["p"][closed], -theory.K * rows["axialStrain"][closed]
        )

    # Opening costs the viscosity of the opening times the rate (10 Pa) and
    # the residual strength; intact material would pull with 0.1 K = 167 kPa
    pull = table["pull"]
    opened = pull["axialStrain"] > 0.01
    assert np.max(np.abs(pull["axialStress"][opened])) < 20

    # It never heals
    for name in ("close", "press", "pull", "again"):
        assert np.all(table[name]["D"] == 1)


def test_density_plays_no_part(tmp_path):
    segments = "load { mode uniaxial; rate 0.1; strain -0.3; }"
    light = run(tmp_path, "viscoplastic", segments)["load"]
    heavy = run(tmp_path, "viscoplastic", segments, override="rho 110e3;")
    assert np.array_equal(light["sigmaEq"], heavy["load"]["sigmaEq"])


GOOD = """
bolusProperties
{
    rho 1100;
    elasticity { E 100e3; nu 0.49; }
    flowStress { type tabulated; table ((0 4100) (0.01 7000)); }
    damage { type triaxialOnset; epsilonPEq0 0.25; eta0 0.2; }
}
segments { load { mode uniaxial; rate 0.1; strain -0.01; } }
"""

HB_ENTRIES = "type HerschelBulkley; sigma0 4100; k 11000; n 0.29;"
J_ENTRIES = "type powerHardening; sigmaY 100; H 11780; m 2;"
TABLE_ENTRIES = "type tabulated; table ((0 4100) (0.01 7000));"


@pytest.mark.parametrize(
    "old, new, says",
    [
        # elasticity and density: entry, value, what is valid
        ("E 100e3;", "", ["E", "Young", "> 0"]),
        ("E 100e3;", "E -5;", ["'E' is -5", "> 0"]),
        ("E 100e3;", "E 0;", ["'E' is 0", "> 0"]),
        ("E 100e3;", "E soft;", ["'E' is soft", "number"]),
        ("E 100e3;", "E 1 2;", ["'E' is 1 2", "number"]),
        ("E 100e3;", "E {}", ["'E' is a dictionary", "number"]),
        ("nu 0.49;", "nu 0.5;", ["'nu' is 0.5", ">= 0 and < 0.5"]),
        ("nu 0.49;", "nu -0.1;", ["'nu' is -0.1", ">= 0 and < 0.5"]),
        (
            "nu 0.49;",
            "nu 0.49; mu 1;",
            ["Unknown entry 'mu'", "(E nu objectiveRate)"],
        ),
        ("rho 1100;", "", ["Missing entry 'rho'", "kg/m3", "> 0"]),
        ("rho 1100;", "rho 0;", ["'rho' is 0", "> 0"]),
        ("elasticity {", "elastic {", ["elasticity", "elastic"]),
        # flow stress
        ("flowStress {", "flow {", ["Missing dictionary 'flowStress'"]),
        (
            "tabulated;",
            "tabular;",
            ["'type' is tabular", "(HerschelBulkley powerHardening tabulated)"],
        ),
        ("type tabulated;", "", ["Missing entry 'type'"]),
        ("table ((0 4100) (0.01 7000));", "", ["Missing entry 'table'"]),
        ("((0 4100) (0.01 7000))", "()", ["table is empty", "at least one"]),
        ("(0 4100) ", "", ["table begins at the rate 0.01", "rate 0"]),
        ("(0.01 7000)", "(0.1 9600) (0.01 7000)", ["not sorted", "0.01"]),
        ("(0.01 7000)", "(0.01 7000) (0.01 8000)", ["not sorted", "0.01"]),
        ("(0.01 7000)", "(0.01 4000)", ["table softens", "4000"]),
        ("(0 4100)", "(0 -1)", ["stress -1 Pa", ">= 0"]),
        ("(0.01 7000)", "(0.01 high)", ["table", "high"]),
        (
            "type tabulated;",
            "type tabulated; interpolation cubic;",
            ["'interpolation' is cubic", "(linear logarithmic)"],
        ),
        (
            "type tabulated;",
            "type tabulated; interpolate linear;",
            ["Unknown entry 'interpolate'", "interpolation table type"],
        ),
        (
            TABLE_ENTRIES,
            HB_ENTRIES.replace("n 0.29", "n 0"),
            ["'n' is 0", "> 0"],
        ),
        (
            TABLE_ENTRIES,
            HB_ENTRIES.replace("11000", "-1"),
            ["'k' is -1", ">= 0"],
        ),
        (
            TABLE_ENTRIES,
            HB_ENTRIES.replace("sigma0", "tau0"),
            ["Missing entry 'sigma0'", "Pa"],
        ),
        (TABLE_ENTRIES, J_ENTRIES.replace("m 2", "m -2"), ["'m' is -2", "> 0"]),
        (
            TABLE_ENTRIES,
            J_ENTRIES.replace("11780", "-1"),
            ["'H' is -1", ">= 0"],
        ),
        (
            TABLE_ENTRIES,
            J_ENTRIES.replace("100", "-100"),
            ["'sigmaY' is -100", ">= 0"],
        ),
        (
            TABLE_ENTRIES,
            J_ENTRIES + " hardensUntil 0;",
            ["'hardensUntil' is 0", "> 0"],
        ),
        # damage
        ("damage {", "damages {", ["Missing dictionary 'damage'"]),
        (
            "triaxialOnset;",
            "triaxial;",
            ["'type' is triaxial", "(none triaxialOnset)"],
        ),
        ("eta0 0.2;", "", ["Missing entry 'eta0'"]),
        ("eta0 0.2;", "eta0 -1;", ["'eta0' is -1", ">= 0"]),
        ("0.25;", "-0.25;", ["'epsilonPEq0' is -0.25", ">= 0"]),
        (
            "eta0 0.2;",
            "eta0 0.2; residualStrength 0;",
            ["'residualStrength' is 0", "> 0 and <= 1"],
        ),
        (
            "eta0 0.2;",
            "eta0 0.2; residualStrenght 1e-4;",
            ["Unknown entry 'residualStrenght'", "residualStrength"],
        ),
        # the programme
        (
            "mode uniaxial;",
            "mode biaxial;",
            ["'mode' is biaxial", "simpleShear"],
        ),
        ("rate 0.1;", "", ["Missing entry 'rate'", "> 0"]),
        ("rate 0.1;", "rate -0.1;", ["'rate' is -0.1", "> 0"]),
        ("strain -0.01;", "", ["load has 0 goals", "exactly one"]),
        ("strain -0.01;", "strain 1; duration 1;", ["2 goals", "exactly one"]),
        ("strain -0.01;", "duration 1;", ["Unknown entry 'rate'"]),
        ("segments {", "segments {} old {", ["Unknown entry 'old'"]),
        ("load { mode uniaxial; rate 0.1; strain -0.01; }", "", ["is empty"]),
        ("segments", "rows 0; segments", ["'rows' is 0", ">= 1"]),
    ],
)
def test_bad_input_dies_with_one_clear_error(tmp_path, old, new, says):
    assert old in GOOD
    done = run_material_point(GOOD.replace(old, new, 1), tmp_path)
    message = " ".join(done.stderr.split())

    assert done.returncode != 0
    assert message.count("FOAM FATAL") == 1
    assert "point" in message  # the file
    for words in says:
        assert words in message


def test_good_input_passes(tmp_path):
    # The base of the bad ones
    assert run_material_point(GOOD, tmp_path).returncode == 0


def test_missing_file_is_named(tmp_path):
    done = run_material_point(GOOD, tmp_path)
    os.remove(tmp_path / "point")
    done = subprocess.run(
        ["materialPoint", "-dict", "nowhere/atAll"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert done.returncode != 0
    assert "nowhere/atAll" in done.stderr and "-dict" in done.stderr


def test_rheology_includes_no_mesh():
    source = Path(__file__).parents[2] / "src" / "rheology"
    files = [*source.rglob("*.[HC]")]
    files = [file for file in files if "lnInclude" not in file.parts]
    assert len(files) > 15
    for file in files:
        includes = re.findall(r'#include "(.*)"', file.read_text())
        mesh = [name for name in includes if re.search("Mesh|fvC|vol", name)]
        assert not mesh, f"{file}: {mesh}"
