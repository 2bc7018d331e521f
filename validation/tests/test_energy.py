# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The energy balance: each column against what it must be, and the residual.

Part E of issue 3. Small cases; the meaning of the columns is in
energyBalance.H. Seen to fail: each power of stepPower times 1.05 (walls,
elastic, plastic, relaxation, fracture, gas, debris, hourglass, overfill,
friction, slipEnergy, inertia, one at a time) in coupledSystemEnergy.C.
"""

import json
import shutil

import numpy as np
import pytest
from bolus_cases.specimens import (
    GRIPPING,
    HEIGHT,
    box,
    compression,
    prepare_compression,
    ramp,
    rub,
    run_case,
    solve,
)
from bolus_cases.synthetic import run, write_control, write_field
from bolus_results import curves, results
from bolus_results.fields import Case
from bolus_results.results import energy_shares
from bolus_results.tables import read_table
from bolus_validation import rheology

# An identity of the discrete equations: what is left is Newton's tolerance
IDENTITY = 1e-6


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    """Where the cases of this file run."""
    return tmp_path_factory.mktemp("energy")


def balance(case):
    """The table of a case, after the checks that hold for every case."""
    table = read_table(case, "energyBalance")
    parts = set(table.columns) - {
        "Time",
        "work",
        "closure",
        "residual",
        "relative",
    }
    work = table["work"] + table["closure"]
    rest = work - sum(table[part] for part in parts)
    largest = np.abs(work).max()
    # The columns are the balance: nothing is hidden in another sum
    assert rest == pytest.approx(table["residual"], abs=1e-8 * largest)
    assert np.abs(rest).max() < IDENTITY * largest
    # What can only be lost is never won
    for name in (
        "plastic",
        "relaxation",
        "fracture",
        "damagedViscosity",
        "hourglass",
    ):
        assert np.diff(table[name]).min() > -1e-9 * largest, name
    return table


def bolus_volume(case) -> float:
    """At the end, full geometry [m3]."""
    return read_table(case, "freeSurface")["volume"][-1]


# --- compression -------------------------------------------------------------

RATE = 0.1


@pytest.fixture(scope="session")
def pressed(folder):
    """Without friction, to 0.5 and back by 0.2: exact but for the gas."""
    return compression(
        folder / "pressed",
        strainRate=RATE,
        unloadStrain=0.2,
        strainStep=0.005,
        nAxial=20,
        nRadial=36,
    )


@pytest.fixture(scope="session")
def exact():
    """Stress [Pa] and plastic strain over the strain, uniaxial, at RATE."""
    law = rheology.Tabulated(rheology.RATES, rheology.STRESSES)
    strain = np.linspace(0, 0.5, 5001)
    stress = rheology.uniaxial_tabulated(law, RATE, strain / RATE)
    return strain, stress, strain - stress / rheology.E


def test_compression_dissipates_stress_times_plastic_strain(pressed, exact):
    # Found 0.3 % above: the step of 0.5 % strain in which stress still rises
    _, stress, plastic = exact
    table = balance(pressed.case)
    expected = np.trapezoid(stress, plastic) * bolus_volume(pressed.case)
    found = np.interp(0.5 / RATE, table.time, table["plastic"])
    assert found == pytest.approx(expected, rel=0.01)


def test_compression_stores_half_stress_squared_over_youngs_modulus(
    pressed, exact
):
    _, stress, _ = exact
    table = balance(pressed.case)
    expected = stress[-1] ** 2 / 2 / rheology.E * bolus_volume(pressed.case)
    found = np.interp(0.5 / RATE, table.time, table["elastic"])
    assert found == pytest.approx(expected, rel=0.01)


def test_work_is_stress_times_strain(pressed, exact):
    strain, stress, _ = exact
    table = balance(pressed.case)
    expected = np.trapezoid(stress, strain) * bolus_volume(pressed.case)
    found = np.interp(0.5 / RATE, table.time, table["work"])
    assert found == pytest.approx(expected, rel=0.01)


def test_unloading_returns_the_elastic_energy_that_was_stored(pressed):
    # Part of it flows plastically until the stress is below the static yield
    # stress (4.1 of 9.6 kPa); what is then left comes back
    table = balance(pressed.case)
    stored = np.interp(0.5 / RATE, table.time, table["elastic"])
    assert table["elastic"][-1] < 0.02 * stored
    i = int(np.argmin(np.abs(table.time - 0.5 / RATE)))
    returned = table["work"][i] - table["work"][-1]
    spent = sum(
        table[name][-1] - table[name][i]
        for name in ("plastic", "relaxation", "gas", "hourglass", "transport")
    )
    assert returned + spent == pytest.approx(stored, rel=0.03)
    assert returned > 0.7 * stored


def test_the_rest_of_a_smooth_compression_is_small(pressed):
    # 0.01 asked for by issue 3 (gas and stabilisation: 0.02)
    table = balance(pressed.case)
    shares = {n: s[-1] for n, s in energy_shares(table).items()}
    assert shares["gas"] < 0.01
    assert shares["stabilisation"] < 0.01
    assert shares["transport"] < 0.01
    for name in ("closure", "kinetic", "inertiaLoss", "friction", "fracture"):
        assert np.abs(table[name]).max() < 1e-9 * table["work"].max(), name


def test_the_loss_of_the_time_step_is_first_order_in_it(folder):
    # (change of stress)^2 in a number of steps that grows as 1/step
    found = []
    for step in (0.02, 0.01):
        case = compression(
            folder / f"step{step}",
            strain=0.2,
            unloadStrain=0,
            strainStep=step,
            nAxial=6,
            nRadial=18,
        )
        found.append(balance(case.case)["relaxation"][-1])
    assert found[0] / found[1] == pytest.approx(2, rel=0.2)


def test_a_looser_newton_leaves_a_larger_residual(folder):
    # The residual is measured, not made: it is what was not solved
    found = []
    for tolerance in ("1e-2", "1e-6"):
        case = compression(
            folder / f"tolerance{tolerance}",
            friction="coulomb",
            solver=f"tolerance {tolerance};",
            strain=0.2,
            unloadStrain=0,
            strainStep=0.01,
            nAxial=6,
            nRadial=18,
        )
        table = read_table(case.case, "energyBalance")
        found.append(np.abs(table["relative"][-1]))
    assert found[0] > 30 * found[1]


# --- friction ----------------------------------------------------------------

PRESS, SLIDE, SHIFT = 0.3, 1.0, 0.002


@pytest.fixture(scope="session")
def slid(folder):
    """A block pressed by 3 % on a wall (mu 0.3), dragged 2 mm by the other."""
    case = folder / "slid"
    end = PRESS + SLIDE
    box(
        case,
        (0.020, 0.005),
        (40, 10),
        {
            "x0": "open",
            "x1": "open",
            "y0": (rub(0.3), ramp(end, lambda t: (0, 0, 0))),
            "y1": (
                "type contactWall; friction { type noSlip; }",
                ramp(
                    end,
                    lambda t: (
                        SHIFT * max(t - PRESS, 0) / SLIDE,
                        -0.03 * 0.005 * min(t / PRESS, 1),
                        0,
                    ),
                ),
            ),
        },
        end=end,
        step=0.02,
        block=((0.005, 0.015), 0.005),
        measured=("y0", "y1"),
    )
    solve(case)
    return case


def test_friction_takes_mu_times_the_normal_force_times_the_slip(slid):
    table = balance(slid)
    force = read_table(slid, "forceY0", "contactForce")
    # Slipping all along and steady from 0.6 s on: the block moves as the wall
    late = table.time > 0.6
    way = np.diff(table.time[late]) * SHIFT / SLIDE
    expected = np.sum(0.3 * force["normal"][late][1:] * way)
    found = np.ptp(table["friction"][late])
    # 2 %: as the ratio of the forces, see test_solver.py
    assert found == pytest.approx(expected, rel=0.02)
    # and by the tangential force, that is without the half empty cells
    expected = np.sum(np.abs(force["axial"][late][1:]) * way)
    assert found == pytest.approx(expected, rel=0.005)


def test_what_the_contact_stores_is_half_force_times_elastic_slip(slid):
    # Slip of 1e-5 m at which sticking ends, all of the face slipping
    table = balance(slid)
    force = read_table(slid, "forceY0", "contactForce")
    expected = 0.5 * np.abs(force["axial"][-1]) * 1e-5
    assert table["slip"][-1] == pytest.approx(expected, rel=0.01)


# --- fracture ----------------------------------------------------------------


@pytest.fixture(scope="session")
def torn(folder):
    """The cylinder pulled until it breaks, all of it at once."""
    return compression(
        folder / "torn",
        material="viscoplasticDamage",
        strain=-0.45,
        unloadStrain=0,
        separation="no",
        nAxial=10,
        nRadial=48,
    )


def test_a_breaking_bar_loses_the_elastic_energy_it_had(torn):
    # sigma^2/(2 E), volume change included, and before that the plastic
    # strain of onset times the flow stress
    table = balance(torn.case)
    volume = bolus_volume(torn.case)
    elastic = 9600**2 / 2 / rheology.E * volume
    assert table["elastic"].max() == pytest.approx(elastic, rel=0.01)
    assert table["fracture"][-1] == pytest.approx(elastic, rel=0.01)
    assert table["elastic"][-1] < 1e-3 * elastic
    # in the step after the break
    after = -torn.strain > 0.37
    assert np.ptp(table["fracture"][after]) < 0.01 * elastic
    assert table["fracture"][-torn.strain < 0.34].max() == 0


def test_broken_bolus_costs_what_its_viscosity_says(torn):
    # 2 eta dev D : D = 3 eta rate^2 of uniaxial flow, eta 20 Pa s, unless the
    # gas in it takes the strain: then less
    table = balance(torn.case)
    after = -torn.strain > 0.37
    spent = np.ptp(table["damagedViscosity"][after])
    time = np.ptp(table.time[after])
    most = 3 * 20 * RATE**2 * bolus_volume(torn.case) * time
    assert 0.3 * most < spent < 1.01 * most


def test_a_break_beside_sound_bolus_sets_its_energy_free_too(folder):
    """A bar of which the middle breaks; the rest springs back in one step.

    What it had is booked as the loss of the time step: there is no inertia
    that could carry it on.
    """
    case = folder / "notched"
    box(
        case,
        (0.020, 0.010),
        (20, 10),
        {
            "x0": (GRIPPING, ramp(2, lambda t: (0, 0, 0), 1)),
            "x1": (GRIPPING, ramp(2, lambda t: (1e-4 * t, 0, 0))),
            "y0": "symmetryPlane",
            "y1": "symmetryPlane",
        },
        end=2,
        step=0.05,
        material="viscoplasticDamage",
    )
    # Two columns of cells have flowed before, and break at the first tension
    mesh = Case(case).mesh(0)
    middle = np.abs(mesh.cell_centres[:, 0] - 0.010) < 0.001
    write_field(case, mesh, 0, "epsilonPEq", np.where(middle, 0.3, 0.0))
    # At rest after the break: what Newton's method leaves would add up
    fv = case / "system" / "fvSolution"
    fv.write_text(fv.read_text().replace("bolus {}", "bolus {tolerance 1e-9;}"))
    solve(case)
    table = balance(case)
    # The first step loads it, and loses as much as it stores (backward Euler
    # from zero); after it the two columns break, and all is free in the next
    assert table["fracture"][1] == 0
    assert table["relaxation"][1] == pytest.approx(table["elastic"][1], 0.01)
    fracture, relaxation = (
        table[name][-1] - table[name][1] for name in ("fracture", "relaxation")
    )
    # By their volumes: 2 of 20 columns, of which the gas takes 1 %
    assert fracture == pytest.approx(0.1 * table["elastic"][1], rel=0.02)
    assert relaxation == pytest.approx(0.9 * table["elastic"][1], rel=0.03)


# --- pressure ----------------------------------------------------------------


def test_confined_compression_stores_pressure_times_volume(folder):
    """Bolus squeezed by 1 % where it cannot give way: mostly pressure."""
    case = folder / "confined"
    steps = 20
    box(
        case,
        (0.020, 0.010),
        (10, 8),
        {
            "x0": (GRIPPING, ramp(1, lambda t: (0, 0, 0), 1)),
            "x1": (GRIPPING, ramp(1, lambda t: (-2e-4 * t, 0, 0))),
            "y0": "symmetryPlane",
            "y1": "symmetryPlane",
        },
        end=1,
        step=1 / steps,
    )
    solve(case)
    table = balance(case)
    strain = np.log(0.99)
    density = 0.5 * (rheology.K + 4 / 3 * rheology.G) * strain**2
    # Per volume as it is now
    volume = 0.02 * 0.99 * 0.01 * 0.01
    assert table["elastic"][-1] == pytest.approx(density * volume, rel=0.005)
    # Backward Euler: the stress of a step is that at its end
    expected = table["elastic"][-1] / steps
    assert table["relaxation"][-1] == pytest.approx(expected, rel=0.02)
    assert table["work"][-1] == pytest.approx(
        density * volume * (1 + 1 / steps), rel=0.01
    )


# --- inertia -----------------------------------------------------------------


def test_with_inertia_kinetic_energy_is_in_the_balance(folder):
    case = compression(
        folder / "inertia",
        solver="inertia 1e4;",
        strain=0.2,
        unloadStrain=0,
        strainStep=0.005,
        nAxial=6,
        nRadial=18,
    )
    table = balance(case.case)
    # A cylinder that is pressed at the rate e: the axial velocity falls
    # linearly from e L to 0, the radial one is e r/2
    length = HEIGHT * np.exp(-0.2)
    radius2 = bolus_volume(case.case) / np.pi / length
    density = 1e4 * 1100 * RATE**2 * (length**2 / 6 + radius2 / 16)
    assert table["kinetic"][-1] == pytest.approx(
        density * bolus_volume(case.case), rel=0.05
    )


# --- parallel, restart, results ----------------------------------------------


@pytest.fixture(scope="session")
def chain(folder):
    """The tutorial with friction by its own Allrun, and what was set."""
    options = [
        word
        for name, x in {
            "nAxial": 14,
            "nRadial": 36,
            "friction": "coulomb",
            "strain": 0.2,
            "unloadStrain": 0.05,
        }.items()
        for word in ("-set", f"{name}={x}")
    ]
    case = folder / "chain"
    run_case("rheology/compression", *options, "-out", case)
    return case, options


def same(one, other, since: float = 0) -> None:
    """Every column within 1e-6 of the largest work."""
    a, b = balance_of_rows(one, since), balance_of_rows(other, since)
    largest = np.abs(a["work"]).max()
    assert set(a) == set(b)
    for name in a:
        if name != "relative":
            assert b[name] == pytest.approx(a[name], abs=1e-6 * largest), name


def balance_of_rows(case, since):
    """Columns of the table from a time [s] on."""
    table = read_table(case, "energyBalance")
    rows = table.time > since
    return {
        name: column[rows]
        for name, column in table.columns.items()
        if name != "Time"
    }


def test_two_ranks_keep_the_same_books(chain, folder):
    case, options = chain
    other = folder / "chain-np2"
    run_case("rheology/compression", *options, "-np", 2, "-out", other)
    same(case, other)


def test_a_restarted_run_goes_on_with_the_books(chain, folder):
    case, _ = chain
    other = folder / "chain-restarted"
    shutil.copytree(case, other)
    for time, path in Case(other).times.items():
        if time > 1.01:
            shutil.rmtree(path)
    shutil.rmtree(other / "postProcessing")
    run_case("rheology/compression", "-continue", "-out", other)
    same(case, other, since=1.01)
    # The first part is not in the second's table, but in its sums
    assert balance_of_rows(other, 1.01)["plastic"][0] > 0


def test_the_residual_is_printed_and_in_results_json(chain):
    case, _ = chain
    log = (case / "log.bolusFoam").read_text()
    printed = float(log.split("energy residual")[1].split()[0])
    assert abs(printed) < IDENTITY
    found = json.loads(json.dumps(results.collect(case)))
    energy = found["results"]["energyBalance"]
    assert energy["relative"]["final"]["value"] == pytest.approx(
        printed, rel=1e-3
    )
    assert energy["work"]["final"]["unit"] == "J"
    assert energy["shares"]["gas"]["value"] < 0.01
    assert found["run"]["overfullSteps"] == {"value": 0, "unit": "-"}
    assert found["run"]["spilled"]["value"] == 0


def test_there_is_a_picture_of_the_balance(chain, tmp_path):
    case, _ = chain
    assert curves.energy(case, tmp_path / "energy.png")
    assert (tmp_path / "energy.png").stat().st_size > 10_000
    assert not curves.energy(tmp_path, tmp_path / "none.png")


def test_other_solvers_have_no_books(folder):
    case = prepare_compression(folder / "other", nAxial=6, nRadial=12)
    write_control(
        case,
        end=1,
        functions="energyBalance { type energyBalance;"
        ' libs ("libbolusFunctionObjects.so"); }',
    )
    write_field(case, Case(case).mesh(0), 0, "mass", 1.0)
    said = run(case, "postProcess", "-fields", "(mass)", "-time", "0", ok=False)
    assert "FOAM FATAL" in said
    assert "energyLedger" in said
