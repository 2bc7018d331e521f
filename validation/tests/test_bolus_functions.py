# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Pieces, jets, statistics of the bolus and the wall's energy, on fields that
are known."""

import shutil

import numpy as np
import pytest
from bolus_cases.synthetic import (
    HALF_ANGLE,
    laplacian_case,
    run,
    run_parallel,
    sphere_fraction,
    wedge_mesh,
    write_control,
    write_field,
)
from bolus_results.tables import read_table
from scipy.optimize import minimize_scalar

RHO = 1000
LIBS = 'libs ("libbolusFunctionObjects.so");'
# Centres on the axis and radii [m] of three spheres, the last one a crumb
SPHERES = ((0.012, 0.010), (0.031, 0.006), (0.039, 0.0009))


def post_process(case, kind: str, fields: str, entries: str = "", np=1) -> dict:
    """The last row of a function object on the written time 0."""
    functions = f"{kind} {{ type {kind}; {LIBS} {entries} }}"
    write_control(case, startFrom="startTime", functions=functions)
    command = ("postProcess", "-fields", f"({fields})")
    if np > 1:
        run_parallel(case, *command, ranks=np)
    else:
        run(case, *command)
    return {k: v[-1] for k, v in read_table(case, kind).columns.items()}


@pytest.fixture
def spheres(tmp_path):
    """A wedge with three spheres of bolus; the cut of two processors goes
    through the first one."""
    mesh = wedge_mesh(tmp_path, 0.042, 0.014, 168, 56)
    laplacian_case(tmp_path, mesh, RHO)
    alpha = sum(sphere_fraction(mesh, (x, 0, 0), r) for x, r in SPHERES)
    for name in ("alpha", "mass"):
        write_field(tmp_path, mesh, 0, name, alpha)
    return tmp_path, mesh


@pytest.mark.parametrize("ranks", [1, 2])
def test_three_spheres_are_two_pieces_and_a_crumb(spheres, ranks):
    case, _ = spheres
    row = post_process(case, "fragments", "alpha mass", np=ranks)
    assert (row["pieces"], row["smallFragments"]) == (2, 1)
    for i, (_, radius) in enumerate(SPHERES[:2], 1):
        # Cells with alpha > 0.5 hold all but the rim's thin ones
        mass = RHO * 4 / 3 * np.pi * radius**3
        assert row[f"mass{i}"] == pytest.approx(mass, rel=0.03)
        area = 4 * np.pi * radius**2
        assert row[f"area{i}"] == pytest.approx(area, rel=0.03)
    assert row["mass3"] == row["area3"] == 0
    assert row["smallFragmentMass"] > 0


def test_surface_at_the_cut_of_processors_is_that_of_one(spheres):
    # To the digits written: a point there has cells on both sides
    case, _ = spheres
    one, two = (
        post_process(case, "fragments", "alpha mass", np=n) for n in (1, 2)
    )
    assert two["area1"] == pytest.approx(one["area1"], rel=1e-8)


def test_broken_bolus_connects_nothing_where_only_intact_counts(spheres):
    case, mesh = spheres
    x = mesh.cell_centres[:, 0]
    # A broken band through the middle of the first sphere
    write_field(case, mesh, 0, "D", 1.0 * (abs(x - SPHERES[0][0]) < 0.001))
    whole = post_process(case, "fragments", "alpha mass D")
    intact = post_process(case, "fragments", "alpha mass D", "intact yes;")
    assert (whole["pieces"], intact["pieces"]) == (2, 3)


def test_jets_are_those_of_the_bolus_on_their_side(spheres):
    case, mesh = spheres
    x = mesh.cell_centres[:, 0]
    # 1 cell of the first sphere flows back at 0.5 m/s, all of it at 0.02; the
    # second sphere goes out at 0.03; the gas is faster
    u = np.where(x < 0.024, -0.02, 0.03)
    gas = np.zeros_like(x, dtype=bool)
    for centre, radius in SPHERES:
        gas |= np.hypot(x - centre, mesh.radii) < 1.2 * radius
    u[~gas] = 9
    u[np.argmin(np.hypot(x - SPHERES[0][0], mesh.radii))] = -0.5
    velocity = np.outer(u, (1, 0, 0))
    write_field(case, mesh, 0, "U", velocity)
    row = post_process(case, "jets", "alpha mass U", "pylorus (0.024 0.0375);")
    assert row["back"] == pytest.approx(0.5)
    assert row["back99"] == pytest.approx(0.02)
    assert row["out"] == row["out99"] == pytest.approx(0.03)


@pytest.mark.parametrize("ranks", [1, 2])
def test_quantiles_weigh_by_volume(spheres, ranks):
    case, mesh = spheres
    x = mesh.cell_centres[:, 0]
    first = x < 0.024  # 82 % of the bolus
    for name, values in (
        ("D", 0 * x),
        ("triaxiality", np.where(first, -0.3, 0.5)),
        ("sigmaEq", 1000 + 0 * x),
        ("epsilonPEq", np.where(first, 0.1, 0.9)),
        ("p", 1000 * x),
    ):
        write_field(case, mesh, 0, name, values)
    row = post_process(
        case,
        "bolusStatistics",
        "alpha mass D triaxiality sigmaEq epsilonPEq p",
        "loaded 410;",
        np=ranks,
    )
    assert row["eta05"] == row["eta50"] == -0.3
    assert row["eta95"] == 0.5
    assert (row["eps50"], row["eps95"], row["eps100"]) == (0.1, 0.9, 0.9)
    cell = 0.042 / 168
    assert row["xMin"] == pytest.approx(SPHERES[0][0] - SPHERES[0][1], abs=cell)
    assert row["pMin"] == pytest.approx(1000 * row["xMin"])
    assert row["pMax"] == pytest.approx(1000 * row["xMax"])


def van_der_waals(*stretches) -> float:
    """Eq. 6 of the paper with its constants, by hand [J/m3]."""
    psi, locking, a, bulk = 1e5, 100, 0.5, 2e6
    stretches = np.array(stretches)
    volume = stretches.prod()
    excess = volume ** (-2 / 3) * np.sum(stretches**2) - 3
    zeta = np.sqrt(excess / (locking**2 - 3))
    chains = -(locking**2 - 3) * (np.log(1 - zeta) + zeta)
    return psi * (chains - 2 / 3 * a * (excess / 2) ** 1.5) + bulk / 2 * (
        (volume**2 - 1) / 2 - np.log(volume)
    )


# The wall below: area of its facets, which are narrower than its arc [m2], and
# thickness [m]
WALL = 2 * np.pi * 0.02 * np.sin(HALF_ANGLE) / HALF_ANGLE * 0.04
THICKNESS = 1e-3


def stretched_wall(case, hoop: float, axial: float) -> dict:
    """Last row of wallEnergy of a tube, 40 mm long and 20 mm in radius."""
    mesh = wedge_mesh(case, 0.04, 0.02, 8, 4)
    laplacian_case(case, mesh, RHO)
    for name in ("alpha", "mass"):
        write_field(case, mesh, 0, name, 1.0)
    points = case / "constant" / "polyMesh" / "points"
    shutil.copy(points, case / "relaxed")
    run(case, "transformPoints", "-scale", f"({axial} {hoop} {hoop})")
    moved = case / "0" / "polyMesh" / "points"
    moved.parent.mkdir()
    shutil.move(points, moved)
    shutil.move(case / "relaxed", points)
    return post_process(
        case,
        "wallEnergy",
        "alpha mass",
        f"patches (wall); thickness {THICKNESS};",
    )


def test_energy_of_a_stretched_wall_is_that_of_eq_6(tmp_path):
    hoop, axial = 0.8, 1.1
    row = stretched_wall(tmp_path, hoop, axial)
    assert row["hoopMax"] == pytest.approx(hoop, rel=1e-8)
    assert row["hoopMin"] == pytest.approx(hoop, rel=1e-8)
    # The thickness is free
    law = minimize_scalar(
        lambda t: van_der_waals(hoop, axial, t), bounds=(0.9, 1.4)
    ).fun
    assert row["energy"] == pytest.approx(law * THICKNESS * WALL, rel=1e-6)
    assert row["beyondLaw"] == 0


def test_energy_of_a_wall_beyond_its_law_is_the_largest_of_the_law(tmp_path):
    # A ring closed to 0.11 of its radius, as the wave does: by the formula -1 J
    row = stretched_wall(tmp_path, 0.11, 1)
    assert van_der_waals(0.11, 1, 1 / 0.11) < 0
    # At constant volume; the formula's highest point, found on a fine scale
    tubes = np.linspace(0.15, 1, 20001)
    most = max(van_der_waals(r, 1, 1 / r) for r in tubes)
    assert row["energy"] == pytest.approx(most * THICKNESS * WALL, rel=1e-6)
    assert row["beyondLaw"] == pytest.approx(1)


@pytest.mark.parametrize(
    ("kind", "entries", "names"),
    [
        ("fragments", "isoValue 2;", ("isoValue", "2", "< 1")),
        ("fragments", "largest 0;", ("largest", "0", "> 0")),
        ("jets", "pylorus (2 1);", ("pylorus", "2 1", "lower")),
        ("bolusStatistics", "", ("Missing entry 'loaded'", "[Pa]")),
        ("wallEnergy", "thickness -1;", ("thickness", "-1", "> 0")),
        ("wallEnergy", "thickness 1; K 0;", ("Entry 'K'", "0", "> 0")),
    ],
)
def test_bad_entries_are_named(spheres, kind, entries, names):
    case, mesh = spheres
    write_field(case, mesh, 0, "U", np.zeros((mesh.n_cells, 3)))
    functions = f"{kind} {{ type {kind}; {LIBS} {entries} }}"
    write_control(case, startFrom="startTime", functions=functions)
    said = run(case, "postProcess", "-fields", "(alpha mass U)", ok=False)
    assert said.count("FOAM FATAL") == 1
    for name in names:
        assert name in said
