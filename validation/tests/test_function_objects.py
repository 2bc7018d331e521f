# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The function objects measure what they say, on fields that are known."""

import shutil

import numpy as np
import pytest
from bolus_cases.synthetic import (
    HALF_ANGLE,
    laplacian_case,
    octant_mesh,
    plane_mesh,
    run,
    run_parallel,
    sphere_fraction,
    wedge_mesh,
    write_control,
    write_field,
)
from bolus_results.tables import read_table

# Mesh and sums agree to round-off of some thousand additions, written with
# ten digits
ROUND_OFF = 1e-8

LIBS = 'libs ("libbolusFunctionObjects.so");'


def function(kind: str, entries: str = "") -> str:
    """A function object's dictionary, named after its type."""
    return f"{kind} {{ type {kind}; {LIBS} {entries} }}"


def post_process(case, fields: str, functions: str, ok: bool = True) -> str:
    """Run function objects on the written times of a case."""
    write_control(case, startFrom="startTime", functions=functions)
    return run(case, "postProcess", "-fields", f"({fields})", ok=ok)


def bolus_everywhere(case, mesh, times=(0,)) -> None:
    """alpha = mass = 1 at these times."""
    for time in times:
        write_field(case, mesh, time, "alpha", 1.0)
        write_field(case, mesh, time, "mass", 1.0)


# --- free surface ---------------------------------------------------------

R = 12.5e-3  # a sphere of 25 cells radius in the meshes below
SPHERE = 4 * np.pi * R**2


def surface(case, mesh, alpha, entries="") -> dict:
    """The row of freeSurface for a field alpha."""
    laplacian_case(case, mesh)
    write_field(case, mesh, 0, "alpha", alpha)
    write_field(case, mesh, 0, "mass", alpha)
    post_process(case, "alpha mass", function("freeSurface", entries))
    table = read_table(case, "freeSurface")
    return {name: column[-1] for name, column in table.columns.items()}


def test_area_of_a_sphere_in_a_wedge_within_2_percent(tmp_path):
    # Issue 2 asks for 2 %; found 0.15 %, of which 0.03 % are the flat faces
    mesh = wedge_mesh(tmp_path, 0.04, 0.02, 80, 40)
    row = surface(tmp_path, mesh, sphere_fraction(mesh, (0.02, 0, 0), R))
    assert row["freeArea"] == pytest.approx(SPHERE, rel=0.02)
    assert row["contactArea"] == 0
    assert row["externalArea"] == row["freeArea"]
    # A flat-faced wedge of 5 degrees has 0.13 % less volume than a round one
    assert row["volume"] == pytest.approx(4 / 3 * np.pi * R**3, rel=0.002)
    assert row["surfaceToVolume"] == pytest.approx(3 / R, rel=0.02)


def test_area_of_a_sphere_in_3d_within_2_percent(tmp_path):
    # One octant, so the entry geometryFactor is tried as well
    mesh = octant_mesh(tmp_path, 0.015, 30)
    alpha = sphere_fraction(mesh, (0, 0, 0), R)
    row = surface(tmp_path, mesh, alpha, "geometryFactor 8;")
    assert row["externalArea"] == pytest.approx(SPHERE, rel=0.02)
    assert row["volume"] == pytest.approx(4 / 3 * np.pi * R**3, rel=0.002)


def test_hemisphere_on_a_wall_has_its_disc_as_contact_area(tmp_path):
    mesh = wedge_mesh(tmp_path, 0.02, 0.02, 40, 40)
    row = surface(tmp_path, mesh, sphere_fraction(mesh, (0, 0, 0), R))
    # As good as the sphere's area itself
    assert row["contactArea"] == pytest.approx(np.pi * R**2, rel=0.02)
    assert row["freeArea"] == pytest.approx(2 * np.pi * R**2, rel=0.02)
    assert row["externalArea"] == pytest.approx(3 * np.pi * R**2, rel=0.02)


# --- contact force --------------------------------------------------------


def test_force_of_a_known_traction_on_a_tube_wall(tmp_path):
    """Pressure 2000 Pa and shear 500 Pa along x on r = 10 mm, 30 mm long."""
    mesh = wedge_mesh(tmp_path, 0.03, 0.01, 12, 4)
    laplacian_case(tmp_path, mesh)
    bolus_everywhere(tmp_path, mesh)
    wall = mesh.face_areas[mesh.patches["wall"].faces]
    area = np.linalg.norm(wall, axis=1)
    force = 2000 * wall
    force[:, 0] += 500 * area
    write_field(tmp_path, mesh, 0, "wallForce", np.zeros(3), {"wall": force})
    post_process(tmp_path, "mass wallForce", function("contactForce"))
    row = {
        name: column[-1]
        for name, column in read_table(tmp_path, "contactForce").columns.items()
    }

    # The chord of the flat face for the arc
    chord = np.sin(HALF_ANGLE) / HALF_ANGLE
    side = 2 * np.pi * 0.01 * 0.03 * chord
    assert row["axial"] == pytest.approx(500 * side, rel=ROUND_OFF)
    assert row["normal"] == pytest.approx(2000 * side, rel=ROUND_OFF)
    assert row["tangential"] == pytest.approx(500 * side, rel=ROUND_OFF)
    both = np.hypot(2000, 500) * side
    assert row["total"] == pytest.approx(both, rel=ROUND_OFF)
    # One flat face around the sector: nothing cancels
    assert row["resultant"] == pytest.approx(both, rel=ROUND_OFF)
    # Nothing pulls; faces are flat to round-off only
    assert row["tensile"] == pytest.approx(0, abs=1e-12)
    assert row["total"] / row["total_mesh"] == pytest.approx(72, rel=ROUND_OFF)
    grams = 1e6 * mesh.cell_volumes.sum() * 72  # at 1000 kg/m3
    assert row["total_perMass"] == pytest.approx(both / grams, rel=ROUND_OFF)


def test_pulling_counts_as_tensile_and_lowers_the_normal_force(tmp_path):
    mesh = plane_mesh(tmp_path, (0.02, 0.01), (2, 1))
    laplacian_case(tmp_path, mesh)
    bolus_everywhere(tmp_path, mesh)
    # Up is outward on y1: one face is pressed with 3 N, one pulled with 1 N
    force = np.array([[0, 3.0, 0], [0, -1.0, 0]])
    write_field(tmp_path, mesh, 0, "wallForce", np.zeros(3), {"y1": force})
    post_process(
        tmp_path,
        "mass wallForce",
        function("contactForce", "patches (y1); axis (0 2 0);"),
    )
    row = read_table(tmp_path, "contactForce").columns
    found = [row[name][-1] for name in ("axial", "normal", "total", "tensile")]
    assert found == pytest.approx([2, 2, 4, 1], rel=ROUND_OFF)
    # A plane mesh is not scaled
    assert row["total"][-1] == row["total_mesh"][-1]


# --- work, mass, damage: sums over time ------------------------------------


def test_work_is_the_power_of_each_step_times_its_length(tmp_path):
    mesh = wedge_mesh(tmp_path, 0.03, 0.01, 6, 2)
    laplacian_case(tmp_path, mesh)
    powers = {0: 5.0, 0.5: 2.0, 2: -1.0, 2.25: 4.0}
    bolus_everywhere(tmp_path, mesh, powers)
    for time, power in powers.items():
        write_field(
            tmp_path,
            mesh,
            time,
            "wallPower",
            0.0,
            {"wall": np.full(6, power / 6)},
        )
    post_process(tmp_path, "mass wallPower", function("externalWork"))
    table = read_table(tmp_path, "externalWork").columns
    work = np.cumsum([0, 2.0 * 0.5, -1.0 * 1.5, 4.0 * 0.25])
    assert table["work_mesh"] == pytest.approx(work, rel=ROUND_OFF)
    assert table["work"] == pytest.approx(72 * work, rel=ROUND_OFF)
    assert table["power"] == pytest.approx(
        72 * np.array(list(powers.values())), rel=ROUND_OFF
    )
    mass = 1000 * 72 * mesh.cell_volumes.sum()
    assert table["work_perMass"] == pytest.approx(
        72 * work / mass, rel=ROUND_OFF
    )


def emptying_case(case):
    """A row of 4 cells; the contents move on by one cell a second.

    At 0 s the first three are full; what leaves does so through x1.
    """
    mesh = plane_mesh(case, (0.04, 0.01), (4, 1))
    laplacian_case(case, mesh)
    volume = 0.01 * 0.01 * 1.0
    row = np.array([1, 1, 0.5, 0])
    for time in range(5):
        out = np.roll(row, time - 1)[-1] if time else 0
        now = np.concatenate([np.zeros(time), row])[:4]
        write_field(case, mesh, time, "alpha", now)
        write_field(case, mesh, time, "mass", now)
        write_field(case, mesh, time, "massFlux", None, {"x1": [out * volume]})
    return mesh


def test_mass_inside_and_emptied_balance_and_the_throat_is_watched(tmp_path):
    emptying_case(tmp_path)
    post_process(
        tmp_path,
        "alpha mass massFlux",
        function(
            "retainedMass", "throat 0.03; closedBetween (1.5 3); outlets (x1);"
        ),
    )
    table = read_table(tmp_path, "retainedMass").columns
    full = 1000 * 1e-4  # kg in a full cell
    inside = np.array([2.5, 2.5, 2, 1, 0])
    assert table["inside"] == pytest.approx(inside * full, abs=1e-12)
    assert table["emptied"] == pytest.approx((2.5 - inside) * full, abs=1e-12)
    assert table["retained"] == pytest.approx(inside / 2.5, abs=1e-12)
    assert table["balanceError"] == pytest.approx(np.zeros(5), abs=1e-12)
    # The last cell is beyond the throat
    assert table["upstream"] == pytest.approx(
        np.array([2.5, 2, 1, 0, 0]) / 2.5, abs=1e-12
    )
    # Half of the step from 1 to 2 s, in which 1 passes, and that to 3 s
    assert table["passedWhileClosed"] == pytest.approx(
        np.array([0, 0, 0.5, 1.5, 1.5]) / 2.5, abs=1e-12
    )
    assert table["alphaMax"] == pytest.approx([1, 1, 1, 1, 0])
    assert table["alphaMin"] == pytest.approx([0, 0, 0, 0, 0])


def test_a_leak_beside_the_outlet_shows_as_balance_error(tmp_path):
    emptying_case(tmp_path)
    post_process(
        tmp_path,
        "alpha mass massFlux",
        function("retainedMass", "outlets (x0);"),
    )
    table = read_table(tmp_path, "retainedMass").columns
    assert table["balanceError"][-1] == pytest.approx(-1)


def test_damaged_volume_is_damage_times_bolus(tmp_path):
    mesh = plane_mesh(tmp_path, (0.04, 0.01), (4, 1))
    laplacian_case(tmp_path, mesh)
    write_field(tmp_path, mesh, 0, "alpha", [1, 0.5, 1, 0])
    write_field(tmp_path, mesh, 0, "mass", [1, 0.5, 1, 0])
    write_field(tmp_path, mesh, 0, "D", [0, 1, 0.4, 1])
    post_process(tmp_path, "alpha mass D", function("damagedVolume"))
    table = read_table(tmp_path, "damagedVolume").columns
    assert table["bolus"][-1] == pytest.approx(2.5e-4, rel=ROUND_OFF)
    assert table["damaged"][-1] == pytest.approx(0.9e-4, rel=ROUND_OFF)
    assert table["fraction"][-1] == pytest.approx(0.36, rel=ROUND_OFF)


# --- restart and parallel -------------------------------------------------

STEADY = ("alpha", "mass", "massFlux", "wallForce", "wallPower", "D")


def steady_case(case):
    """A run of laplacianFoam beside constant fields of a bolus."""
    mesh = wedge_mesh(case, 0.04, 0.02, 16, 8)
    laplacian_case(case, mesh)
    alpha = sphere_fraction(mesh, (0.02, 0, 0), R)
    faces = mesh.patches["wall"].size
    across = np.linspace(0.5, 1.5, mesh.patches["outlet"].size)
    write_field(case, mesh, 0, "alpha", alpha)
    write_field(case, mesh, 0, "mass", alpha)
    write_field(case, mesh, 0, "D", alpha > 0.9)
    write_field(case, mesh, 0, "massFlux", None, {"outlet": 1e-9 * across})
    write_field(
        case,
        mesh,
        0,
        "wallPower",
        0.0,
        {"wall": np.linspace(-1e-6, 3e-6, faces)},
    )
    write_field(
        case,
        mesh,
        0,
        "wallForce",
        np.zeros(3),
        {"wall": np.random.default_rng(1).normal(size=(faces, 3))},
    )
    return mesh


def control(case, end):
    """0.3 s steps to end, with all the function objects."""
    functions = f"""
    bolusFields
    {{
        type readFields;
        libs ("libfieldFunctionObjects.so");
        fields ({" ".join(STEADY)});
    }}
    {function("contactForce")}
    {function("externalWork")}
    {function("retainedMass", "closedBetween (0.5 2.0);")}
    {function("freeSurface")}
    {function("damagedVolume")}
    """
    write_control(
        case,
        end,
        functions,
        deltaT=0.3,
        writeControl="timeStep",
        writeInterval=1,
    )


KINDS = (
    "contactForce",
    "externalWork",
    "retainedMass",
    "freeSurface",
    "damagedVolume",
)


def test_a_restarted_run_goes_on_and_overwrites_no_table(tmp_path):
    whole, parts = tmp_path / "whole", tmp_path / "parts"
    steady_case(whole)
    shutil.copytree(whole, parts)
    # The mass in the fields does not change while the flux leaves: the books
    # are out of balance on purpose, and must stay so over a restart
    control(whole, 3)
    run(whole, "laplacianFoam")

    control(parts, 1.2)
    run(parts, "laplacianFoam")
    work = parts / "postProcessing" / "externalWork"
    before = (work / "0" / "externalWork.dat").read_bytes()

    def go_on_from_1_2():
        for time in parts.glob("[1-3]*"):
            if float(time.name) > 1.25:
                shutil.rmtree(time)
        for name in STEADY:
            shutil.copy(parts / "0" / name, parts / "1.2" / name)
        control(parts, 3)
        run(parts, "laplacianFoam")

    go_on_from_1_2()
    go_on_from_1_2()
    assert (work / "0" / "externalWork.dat").read_bytes() == before
    assert (work / "1.2" / "externalWork.dat").exists()
    assert (work / "1.2" / "externalWork_2.dat").exists()
    for kind in KINDS:
        a = read_table(whole, kind).columns
        b = read_table(parts, kind).columns
        assert len(a["Time"]) == 11 and a["Time"][0] == 0
        for name in a:
            # 16 digits are handed on; sums differ by round-off
            assert b[name] == pytest.approx(a[name], rel=1e-9, abs=1e-15)
    # Not trivially equal: the sums did grow
    work = read_table(parts, "externalWork").columns["work"]
    assert work[-1] == pytest.approx(72 * 3 * 16 * 1e-6, rel=ROUND_OFF)
    closed = read_table(parts, "retainedMass").columns["passedWhileClosed"]
    assert closed[-1] > 0


def test_two_ranks_measure_what_one_does(tmp_path):
    serial, parallel = tmp_path / "serial", tmp_path / "parallel"
    steady_case(serial)
    shutil.copytree(serial, parallel)
    control(serial, 0.6)
    control(parallel, 0.6)
    run(serial, "laplacianFoam")
    # Both ranks have wall, one has the outlet
    run_parallel(parallel, "laplacianFoam")
    for kind in KINDS:
        a = read_table(serial, kind).columns
        b = read_table(parallel, kind).columns
        for name in a:
            assert b[name] == pytest.approx(a[name], rel=ROUND_OFF, abs=1e-15)


# --- bad input --------------------------------------------------------------


@pytest.mark.parametrize(
    ("kind", "entries", "says"),
    [
        ("contactForce", "patches (gut);", ("patches", "gut", "shell wall")),
        ("contactForce", "patch (wall);", ("'patch'", "patches")),
        ("contactForce", "axis (0 0 0);", ("axis", "length > 0")),
        ("externalWork", "geometryFactor -1;", ("geometryFactor", "> 0")),
        (
            "externalWork",
            "executeControl timeStep; executeInterval 2;",
            ("executeInterval 2", "writeControl"),
        ),
        (
            "retainedMass",
            "closedBetween (3 1);",
            ("closedBetween", "the first before the second"),
        ),
        ("freeSurface", "isoValue 1.5;", ("isoValue", "1.5", "< 1")),
    ],
)
def test_bad_input_names_entry_value_and_what_is_valid(
    tmp_path, kind, entries, says
):
    mesh = wedge_mesh(tmp_path, 0.04, 0.02, 4, 2)
    laplacian_case(tmp_path, mesh)
    write_control(tmp_path, functions=function(kind, entries))
    output = run(tmp_path, "laplacianFoam", ok=False)
    assert "FOAM FATAL IO ERROR" in output
    for words in says:
        assert words in output
    assert "Time = 1" not in output  # before the first step


def test_a_bolus_without_density_is_refused(tmp_path):
    mesh = wedge_mesh(tmp_path, 0.04, 0.02, 4, 2)
    laplacian_case(tmp_path, mesh, rho=-1100)
    write_control(tmp_path, functions=function("externalWork"))
    output = run(tmp_path, "laplacianFoam", ok=False)
    assert "Entry 'rho'" in output and "-1100" in output
