# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""What is read from a run, drawn of it and said about it is what is there."""

import gzip
import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from bolus_cases.synthetic import (
    HALF_ANGLE,
    octant_mesh,
    plane_mesh,
    wedge_mesh,
    write_field,
    write_file,
)
from bolus_results import curves, markdown, plots, results
from bolus_results.fields import Case
from bolus_results.foam_files import FoamFileError, read_field
from bolus_results.measure import Measure, measure_of
from bolus_results.state import state
from bolus_results.tables import read_table
from bolus_validation import paper
from matplotlib import image

REPOSITORY = Path(__file__).resolve().parents[2]

# --- meshes and fields ------------------------------------------------------


def test_wedge_mesh_has_its_volume_angle_and_section(tmp_path):
    wedge_mesh(tmp_path, 0.04, 0.02, 8, 4)
    mesh = Case(tmp_path).mesh(0)
    # A prism of two flat-faced triangles: exact up to the ten digits or so
    # of blockMesh's points
    volume = 0.04 * 0.02**2 * np.sin(HALF_ANGLE) * np.cos(HALF_ANGLE)
    assert mesh.n_cells == 32
    assert mesh.cell_volumes.sum() == pytest.approx(volume, rel=1e-6)
    assert (mesh.cell_volumes > 0).all()
    assert np.degrees(mesh.wedge_angle) == pytest.approx(5, rel=1e-6)
    assert mesh.radii.max() < 0.02

    section = mesh.section
    assert sorted(section.cells) == list(range(32))
    area = 0.0
    for polygon in section.polygons:
        x, r = polygon.T
        area += 0.5 * abs(x @ np.roll(r, 1) - r @ np.roll(x, 1))
    assert area == pytest.approx(0.04 * 0.02, rel=1e-6)
    # A quad's centre in the section is near that of the cell it belongs to
    centres = mesh.cell_centres[section.cells]
    for polygon, centre in zip(section.polygons, centres, strict=True):
        assert polygon[:, 0].mean() == pytest.approx(centre[0], abs=1e-9)

    ends = np.vstack(mesh.wall_lines())
    assert ends[:, 1].max() == pytest.approx(0.02, rel=1e-6)
    assert ends[:, 0].min() == pytest.approx(0, abs=1e-9)


def test_plane_and_3d_meshes_have_their_volumes(tmp_path):
    plane_mesh(tmp_path / "plane", (0.04, 0.01), (4, 3))
    mesh = Case(tmp_path / "plane").mesh(0)
    assert mesh.cell_volumes.sum() == pytest.approx(4e-4, rel=1e-9)
    assert len(mesh.section.polygons) == 12
    assert mesh.wedge_angle is None
    octant_mesh(tmp_path / "box", 0.015, 3)
    mesh = Case(tmp_path / "box").mesh(0)
    assert mesh.cell_volumes == pytest.approx(np.full(27, 0.005**3), rel=1e-9)
    with pytest.raises(ValueError, match="no section"):
        mesh.section  # noqa: B018


def test_fields_of_all_kinds_come_back_as_written(tmp_path):
    mesh = plane_mesh(tmp_path, (0.04, 0.01), (4, 3))
    random = np.random.default_rng(0)
    case = Case(tmp_path)
    for name, shape in (("p", (12,)), ("U", (12, 3)), ("stress", (12, 6))):
        data = random.normal(size=shape)
        write_field(tmp_path, mesh, 1, name, data)
        assert (case.field(1.0, name) == data).all()
    plain = tmp_path / "1" / "U"
    with gzip.open(tmp_path / "1" / "U.gz", "wb") as packed:
        packed.write(plain.read_bytes())
    before = case.field(1.0, "U")
    plain.unlink()
    assert case.has(1.0, "U")
    assert (case.field(1.0, "U") == before).all()


@pytest.mark.parametrize(
    ("entry", "expected"),
    [
        ("uniform 2.5", np.full(4, 2.5)),
        ("uniform (1 2 3)", np.tile([1.0, 2, 3], (4, 1))),
        ("nonuniform List<scalar> 4(1 2 3 4)", np.arange(1.0, 5)),
        ("nonuniform List<scalar> 4{7}", np.full(4, 7.0)),
        ("nonuniform List<vector> 4{(0 1 0)}", np.tile([0.0, 1, 0], (4, 1))),
    ],
)
def test_short_forms_of_fields_are_read(tmp_path, entry, expected):
    path = tmp_path / "f"
    write_file(path, f"internalField {entry};\nboundaryField {{}}\n")
    found = read_field(path, 4)
    assert found.shape == expected.shape
    assert (found == expected).all()


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("FoamFile { format hex; }\ninternalField", "valid are ascii and"),
        ("internalField nonuniform List<scalar> 3(1 2 3);", "4 cells"),
        ("boundaryField {}", "no internalField"),
    ],
)
def test_a_field_that_cannot_be_read_says_why(tmp_path, text, says):
    (tmp_path / "f").write_text(text)
    with pytest.raises(FoamFileError, match=says):
        read_field(tmp_path / "f", 4)


def test_the_mesh_of_a_time_is_the_one_last_written_before_it(tmp_path):
    mesh = plane_mesh(tmp_path, (0.04, 0.01), (4, 1))
    points = (tmp_path / "constant" / "polyMesh" / "points").read_text()
    for time in (1, 2, 3):
        write_field(tmp_path, mesh, time, "alpha", 1.0)
    moved = tmp_path / "2" / "polyMesh" / "points"
    moved.parent.mkdir()
    moved.write_text(points.replace("0.01", "0.02"))
    case = Case(tmp_path)
    assert case.mesh(1.0).cell_volumes.sum() == pytest.approx(4e-4)
    assert case.mesh(2.0).cell_volumes.sum() == pytest.approx(8e-4)
    assert case.mesh(3.0) is case.mesh(2.0)


# --- fragments and the state of the bolus -----------------------------------


def test_pieces_touch_by_faces_only_and_are_sorted_by_size(tmp_path):
    mesh = plane_mesh(tmp_path, (0.04, 0.04), (4, 4))
    pattern = np.array(
        [
            [1, 1, 0, 0],
            [1, 0, 1, 0],  # (2, 1) touches (1, 0) by a corner
            [0, 0, 0, 0],
            [0, 0, 1, 1],
        ],
        dtype=bool,
    )
    cell = 0.01 * 0.01
    found = mesh.fragments(pattern.ravel(), mesh.cell_volumes)
    assert found == pytest.approx(np.array([3, 2, 1]) * cell)
    assert mesh.fragments(np.zeros(16, bool), mesh.cell_volumes).size == 0


def broken_bolus(case, time=1, gap="gas"):
    """A bar of bolus in a wedge, broken in the middle by gas or damage."""
    mesh = wedge_mesh(case, 0.04, 0.02, 40, 20)
    x = mesh.cell_centres[:, 0]
    r = mesh.radii
    alpha = ((abs(x - 0.02) < 0.015) & (r < 0.01)).astype(float)
    middle = abs(x - 0.02) < 0.002
    damage = np.zeros(mesh.n_cells)
    if gap == "gas":
        alpha[middle] = 0.3
    elif gap == "damage":
        damage[middle] = 1
    crumb = np.argmin((x - 0.039) ** 2 + (r - 0.018) ** 2)
    alpha[crumb] = 0.51
    write_field(case, mesh, time, "alpha", alpha)
    write_field(case, mesh, time, "D", damage)
    velocity = np.zeros((mesh.n_cells, 3))
    velocity[alpha > 0.5, 0] = np.where(x[alpha > 0.5] < 0.02, -0.02, 0.01)
    velocity[alpha < 0.5, 0] = 9  # of the gas: does not count
    write_field(case, mesh, time, "U", velocity)
    sigma = np.where(r < 0.01, 5000.0, 0)
    eta = np.where(x > 0.02, 1.5, -4.0)
    hottest = np.argmin((x - 0.03) ** 2 + r**2)
    sigma[hottest], eta[hottest] = 6000, 1.7
    eta[crumb] = -900  # unloaded: hardly any stress
    write_field(case, mesh, time, "sigmaEq", sigma)
    write_field(case, mesh, time, "triaxiality", eta)
    write_field(case, mesh, time, "epsilonPEq", np.where(alpha > 0.5, 3, 50))
    write_field(case, mesh, time, "p", -eta * sigma)
    return mesh


@pytest.mark.parametrize(
    ("gap", "whole", "intact"),
    [("none", 1, 1), ("damage", 1, 2), ("gas", 2, 2)],
)
def test_fragments_are_told_apart_by_void_and_by_damage(
    tmp_path, gap, whole, intact
):
    broken_bolus(tmp_path, gap=gap)
    bolus = state(Case(tmp_path), 1.0)
    assert (bolus["pieces"], bolus["piecesIntact"]) == (whole, intact)
    assert (bolus["smallFragments"], bolus["smallFragmentsIntact"]) == (1, 1)


def test_state_looks_at_bolus_only(tmp_path):
    broken_bolus(tmp_path)
    bolus = state(Case(tmp_path), 1.0)
    assert bolus["jetForward"] == pytest.approx(0.01)
    assert bolus["jetBackward"] == pytest.approx(0.02)
    assert bolus["epsilonPEqMax"] == 3
    assert bolus["triaxialityMin"] == -900
    assert bolus["triaxialityMinIntact"] == -4
    assert bolus["triaxialityMaxCore"] == 1.7
    core = bolus.numbers["triaxialityMaxCore"]
    assert core["x"] == pytest.approx(0.03, abs=0.6e-3)
    assert core["sigmaEq"] == 6000
    assert bolus["damagedFraction"] == 0


# --- tables of a run that was continued -------------------------------------


def write_table(case, name, start, head, rows, file=None):
    """A table as a function object of a run from a time writes it."""
    path = case / "postProcessing" / name / start / f"{file or name}.dat"
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = ["# Some title", "# full geometry / mesh [-]: 7.2e+01"]
    lines.append("# " + "\t".join(head))
    lines += ["\t".join(f"{x:.9e}" for x in row) for row in rows]
    path.write_text("\n".join(lines) + "\n")
    return path


def test_a_continued_table_takes_the_place_of_the_rest(tmp_path):
    head = ("Time [s]", "work [J]")
    write_table(tmp_path, "w", "0", head, [(t, t) for t in range(6)])
    write_table(tmp_path, "w", "3", head, [(4, 40), (5, 50)])
    path = write_table(
        tmp_path, "w", "3", head, [(4, 400), (6, 600)], file="w_2"
    )
    with path.open("a") as cut:
        cut.write("7.0000")  # killed while writing
    table = read_table(tmp_path, "w")
    assert table.time.tolist() == [0, 1, 2, 3, 4, 6]
    assert table["work"].tolist() == [0, 1, 2, 3, 400, 600]
    assert table.units == {"Time": "s", "work": "J"}
    assert table.at("work", 5) == 500
    assert table.at("work", 7) is None
    with pytest.raises(FoamFileError, match="no table"):
        read_table(tmp_path, "nothing")


def test_tables_of_nanoseconds_are_continued_and_read_alike(tmp_path):
    head = ("Time [s]", "work [J]")
    write_table(tmp_path, "w", "0", head, [(t * 1e-10, t) for t in range(6)])
    write_table(tmp_path, "w", "3e-10", head, [(4e-10, 40), (5e-10, 50)])
    table = read_table(tmp_path, "w")
    assert table["work"].tolist() == [0, 1, 2, 3, 40, 50]
    assert table.at("work", 4.5e-10) == pytest.approx(45)
    assert table.at("work", 6e-10) is None


def write_solver_table(case):
    """Two starts of the solver: its counts go on, its clock does not."""
    head = (
        "time [s]",
        "deltaT [s]",
        "NewtonIterations [-]",
        "rejected [-]",
        "courant [-]",
        "subSteps [-]",
        "massError [-]",
        "alphaMin [-]",
        "alphaMax [-]",
        "cpuTime [s]",
    )
    first = [
        (1, 1, 4, 0, 0.1, 1, 1e-6, 0, 1, 10),
        (2, 1, 5, 2, 0.2, 1, -3e-6, -1e-7, 1.001, 21),
    ]
    second = [(32, 1, 6, 3, 0.1, 1, 2e-6, 0, 1, 7)]
    write_table(case, "solver", "0", head, first, file="steps")
    write_table(case, "solver", "2", head, second, file="steps")
    (case / "log.bolusFoam").write_text(
        "Exec   : bolusFoam\nnProcs : 1\n    clock time       12.5 s\n"
        "Exec   : bolusFoam -parallel\nnProcs : 2\n"
        "    clock time       8 s\n"
    )


def test_cost_of_a_run_is_summed_over_its_starts(tmp_path):
    wedge_mesh(tmp_path, 0.04, 0.02, 8, 4)
    write_solver_table(tmp_path)
    write_file(tmp_path / "system" / "controlDict", "endTime 32;\n")
    cost = results.run_numbers(tmp_path)
    expected = {
        "simulatedTime": 32,
        "steps": 3,
        "newtonIterations": 15,
        "rejectedSteps": 3,
        "maxMassError": 3e-6,
        "alphaMin": -1e-7,
        "alphaMax": 1.001,
        "cpuTime": 28,
        "clockTime": 20.5,
        "cores": 2,
        "cells": 32,
        "givenUpSteps": 0,
    }
    found = {name: cost[name]["value"] for name in expected}
    assert found == pytest.approx(expected)
    assert cost["finished"] is True

    with (tmp_path / "log.bolusFoam").open("a") as log:
        log.write(
            "Exec   : bolusFoam\n--> FOAM FATAL ERROR: \n"
            "no convergence at t = 3 s with the smallest step\n"
        )
    assert results.run_numbers(tmp_path)["givenUpSteps"]["value"] == 1


# --- a whole run: results.json, comparison, pictures ------------------------

FORCE = [
    (0, 0),
    (7.5, 5),
    (10.5, 1),
    (12.5, 30),
    (14, 60),
    (18, 3),
    (25.4, 90),
    (32, 10),
]


def paper_run(case):
    """A run whose tables and fields do what the paper reports of case A."""
    mesh = broken_bolus(case, 10.5)
    write_solver_table(case)
    write_file(case / "system" / "controlDict", "endTime 32;\n")
    ones = np.ones(mesh.n_cells)
    for time, pieces in ((9, 2), (18, 1), (25.5, 1)):
        alpha = ones.copy()
        if pieces == 2:
            alpha[abs(mesh.cell_centres[:, 0] - 0.02) < 0.001] = 0
        write_field(case, mesh, time, "alpha", alpha)
    write_field(case, mesh, 10.5, "sigmaEq", 10 * ones)
    core = np.where(mesh.radii < 0.004, 1.4, 0.1)
    for time, eta, backward in (
        (7.5, core, 0),
        (12.5, core, 0.022),
        (14, core, 0.01),
    ):
        write_field(case, mesh, time, "alpha", ones)
        write_field(case, mesh, time, "D", 0 * ones)
        write_field(case, mesh, time, "sigmaEq", 5000 * ones)
        eta = eta.copy()
        if time == 12.5:
            eta[[0, 1]] = (3.65, -2220)
        write_field(case, mesh, time, "triaxiality", eta)
        write_field(case, mesh, time, "epsilonPEq", 15 * ones)
        write_field(case, mesh, time, "p", -5000 * eta)
        velocity = np.zeros((mesh.n_cells, 3))
        velocity[:2, 0] = (0.018, -backward)
        write_field(case, mesh, time, "U", velocity)

    force = [(t, *([f] * 8)) for t, f in FORCE]
    columns = results._COLUMNS["contactForce"]
    write_table(
        case,
        "contactForce",
        "0",
        ["Time [s]"]
        + [f"{c} [{'N/g' if 'perMass' in c else 'N'}]" for c in columns],
        force,
    )
    write_table(
        case,
        "externalWork",
        "0",
        ("Time [s]", "power [W]", "work [J]", "work_perMass [mJ/g]"),
        [(t, 1, w, w) for t, w in ((0, 0), (10.5, 2), (12.5, 9), (32, 40))],
    )
    write_table(
        case,
        "retainedMass",
        "0",
        ["Time [s]"] + [f"{c} [-]" for c in results._COLUMNS["retainedMass"]],
        [
            (t, m, 1 - m, m, m, error, 1e-6)
            for t, m, error in (
                (0, 1, 0),
                (12.3, 1, 1e-5),
                (12.6, 0.99, -2e-5),
                (18, 0.8, 0),
                (25.5, 0.8, 0),
                (29, 0.6, 0),
                (32, 0.51, 1e-6),
            )
        ],
    )
    write_table(
        case,
        "freeSurface",
        "0",
        ["Time [s]"] + [f"{c} [m2]" for c in results._COLUMNS["freeSurface"]],
        [(t, 1, a, 0, a, a) for t, a in ((0, 2.0), (7.5, 2.0), (32, 1.64))],
    )
    write_table(
        case,
        "damagedVolume",
        "0",
        ("Time [s]", "bolus [m3]", "damaged [m3]", "fraction [-]"),
        [(0, 1, 0, 0), (7.3, 1, 0, 0), (7.4, 1, 0.1, 0.1), (32, 1, 0.2, 0.2)],
    )
    return mesh


@pytest.fixture(scope="module")
def run_as_in_the_paper(tmp_path_factory):
    """The case, with its results.json."""
    case = tmp_path_factory.mktemp("run") / "caseA"
    paper_run(case)
    results.write_json(case, paper.MEASURE)
    return case


def test_results_json_has_final_and_peak_values_with_units(run_as_in_the_paper):
    found = json.loads((run_as_in_the_paper / "results.json").read_text())
    force = found["results"]["contactForce"]["total_perMass"]
    assert force["peak"] == {"value": 90, "unit": "N/g", "time": 25.4}
    assert force["final"] == {"value": 10, "unit": "N/g"}
    mass = found["results"]["retainedMass"]
    assert mass["retainedOfReference"]["value"] == pytest.approx(0.51)
    surface = found["results"]["freeSurface"]
    assert surface["changeSinceStart"]["value"] == pytest.approx(-0.18)
    damage = found["results"]["damagedVolume"]
    assert damage["firstDamage"] == {"value": 7.4, "unit": "s"}
    assert found["times"]["10.5"]["pieces"] == {"value": 2, "unit": "-"}
    assert "23" not in found["times"]  # was not written


def test_a_run_of_any_case_is_measured_at_its_own_times(run_as_in_the_paper):
    found = results.collect(run_as_in_the_paper)
    written = [t for t in Case(run_as_in_the_paper).times if t > 0]
    assert list(found["times"]) == [f"{t:g}" for t in written][:10]
    assert "retainedOfReference" not in found["results"]["retainedMass"]
    kept = measure_of(run_as_in_the_paper)
    assert kept == paper.MEASURE != Measure()


def test_a_run_that_does_as_the_paper_says_agrees_in_every_row(
    run_as_in_the_paper,
):
    text = paper.comparison(run_as_in_the_paper)
    rows = [line.split(" | ") for line in text.splitlines() if "| " in line]
    verdicts = [row[-1].rstrip(" |") for row in rows[2:]]
    assert len(verdicts) == len(paper.CASE_A)
    assert verdicts == ["yes"] * len(verdicts), text
    assert "32 s simulated on 800 cells, 3 steps, 20.5 s on 2 core" in text


def test_a_run_that_does_otherwise_is_said_to(run_as_in_the_paper, tmp_path):
    """The same run with the comparison's numbers changed one by one."""
    run = paper.Run(run_as_in_the_paper)
    times = run.results["times"]

    def verdict(find):
        return find(run)[1]

    times["7.5"]["triaxialityMaxCore"]["value"] = 0.6
    assert verdict(paper._core_triaxiality) is False
    del times["7.5"]["triaxialityMaxCore"]
    assert paper._core_triaxiality(run) == ("no loaded bolus there", False)
    del run.results["results"]["damagedVolume"]["firstDamage"]
    assert paper._first_damage(run) == ("no damage until 32 s", False)
    times["10.5"]["pieces"]["value"] = 1
    assert verdict(paper._fragments) == "in part"
    assert verdict(paper._sticking) is False
    times["10.5"]["piecesIntact"]["value"] = 1
    assert verdict(paper._fragments) is False
    times["12.5"]["jetBackward"]["value"] = 0.005
    assert verdict(paper._jet("jetBackward")) is False
    times["12.5"]["triaxialityMinIntact"]["value"] = -2
    assert verdict(paper._compression) is False


def test_what_a_run_did_not_reach_is_neither_right_nor_wrong(tmp_path):
    wedge_mesh(tmp_path, 0.04, 0.02, 4, 2)
    results.write_json(tmp_path, paper.MEASURE)
    run = paper.Run(tmp_path)
    for row in paper.CASE_A:
        assert row.find(run) == paper.NOTHING, row.paper
    assert "23 cannot be told" in paper.comparison(tmp_path)


def test_comparison_goes_between_the_markers_and_nowhere_else(tmp_path):
    readme = tmp_path / "README.md"
    text = f"before\n{paper.BEGIN}\nold\n{paper.END}\nafter\n"
    readme.write_text(text)
    markdown.put(readme, paper.BEGIN, paper.END, "new")
    once = readme.read_text()
    assert once == f"before\n{paper.BEGIN}\n\nnew\n\n{paper.END}\nafter\n"
    markdown.put(readme, paper.BEGIN, paper.END, "new")
    assert readme.read_text() == once
    readme.write_text("no markers")
    with pytest.raises(FoamFileError, match="each once"):
        markdown.put(readme, paper.BEGIN, paper.END, "new")


def test_contours_show_the_bolus_mirrored_and_nothing_elsewhere(tmp_path):
    """Colour above the axis has its mirror image below; gas has none."""
    broken_bolus(tmp_path)
    case = Case(tmp_path)
    target = tmp_path / "eps.png"
    bolus = plots.Quantity("alpha", "x", "-", 1, "Greens", (0, 1))
    assert plots.contour_page(case, bolus, target, (1.0,))
    picture = image.imread(target)[:, :, :3]
    # Cells of alpha 1 are of the map's darkest green, (0, 0.27, 0.11)
    green = np.abs(picture - (0, 0.267, 0.106)).max(axis=2) < 0.02
    # Leave out the colour bar below the panel
    green = green[: int(0.75 * green.shape[0])]
    rows = np.flatnonzero(green.any(axis=1))
    columns = np.flatnonzero(green.any(axis=0))
    # 30 mm long and, with its mirror image, 20 mm high; to a pixel or two
    shape = np.ptp(rows) / np.ptp(columns)
    assert shape == pytest.approx(20 / 30, rel=0.02)
    middle = (rows[0] + rows[-1]) // 2
    above = green[rows[0] : middle].sum()
    below = green[middle + 1 : rows[-1] + 1].sum()
    assert below == pytest.approx(above, rel=0.03)
    # Two pieces: a gap of gas between coloured columns
    columns = green[middle - 20 : middle + 20].any(axis=0)
    edges = np.flatnonzero(np.diff(columns.astype(int)))
    assert edges.size == 4


def test_a_page_without_written_fields_is_not_drawn(tmp_path):
    broken_bolus(tmp_path)
    target = tmp_path / "page.png"
    quantity = plots.BOLUS_FIELDS[0]
    assert not plots.contour_page(Case(tmp_path), quantity, target, (5.0,))
    assert not curves.curves([tmp_path], target)
    assert not target.exists()


def test_scripts_results_makes_everything_in_one_command(run_as_in_the_paper):
    readme = run_as_in_the_paper / "README.md"
    readme.write_text(f"# Case\n{paper.BEGIN}\n{paper.END}\n")
    done = subprocess.run(
        [
            REPOSITORY / "scripts" / "results",
            run_as_in_the_paper,
            "-readme",
            readme,
        ],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ,
    )
    assert done.returncode == 0, done.stderr
    made = [Path(line).name for line in done.stdout.splitlines()]
    assert made == [
        "results.json",
        "comparison.md",
        "README.md",
        "sigmaEq.png",
        "triaxiality.png",
        "epsilonPEq.png",
        "D.png",
        "overview.png",
        "curves.png",
        "summary.txt",
    ]
    for name in made[3:9]:
        shape = image.imread(run_as_in_the_paper / "pictures" / name).shape
        assert min(shape[:2]) > 300
    assert "23 rows agree" in readme.read_text()


def test_scripts_results_on_no_case_says_so(tmp_path):
    done = subprocess.run(
        [REPOSITORY / "scripts" / "results", tmp_path],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ,
    )
    assert done.returncode != 0
    assert "not a case of OpenFOAM" in done.stderr
