# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Cutting: limit analysis, all speeds and laws, what the paper says in words.

The runs are those of the tutorials, with settings. They are kept in
run/validate/cutting/runs and taken again as long as solver and tutorials have
not changed; a run that was stopped goes on. SI units.
"""

import csv
import os
import re
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

from bolus_validation import cutting  # noqa: E402
from bolus_validation.cutting_cases import (  # noqa: E402
    ROUGH,
    embedded,
    embedded_force,
)
from bolus_validation.fields import Case, read_field  # noqa: E402
from bolus_validation.physics.cases import draw_cells  # noqa: E402
from bolus_validation.results import (  # noqa: E402
    optional_table,
    read_table,
)
from bolus_validation.studies import (  # noqa: E402
    ROOT,
    Findings,
    kept_run,
    study,
)

SPEEDS = (1e-4, 1e-3, 2.5e-3, 1e-2)  # [m/s]
LAWS = ("viscoplastic", "viscoplasticDamage", "HerschelBulkley", "JLaw")
NAMES = {
    "viscoplastic": "tabulated",
    "viscoplasticDamage": "tabulated, damage",
    "HerschelBulkley": "Herschel-Bulkley",
    "JLaw": "J law",
}

# Of the tutorials: what is set to these is the same run
DEFAULTS = {"speed": 2.5e-3, "law": "viscoplastic"}

# Measured curves, if there are any: CSV files <cylinder2D|wire2D>_<speed in
# mm/s>.csv of rows delta [mm], F [N]
MEASURED = ROOT / "validation" / "data" / "cutting"


# --- runs --------------------------------------------------------------------


class Run:
    """A run of a tutorial.

    travel [m], stress = F/(T d) [Pa], both (steps,) over the rows of
    toolForce; reason: why it stopped before its end, or None
    """

    def __init__(self, case: Path):
        self.path = case
        self.parameters = cutting.read_parameters(
            case / "system" / "caseParameters"
        )
        p = self.parameters
        self.table = read_table(case, "toolForce")
        self.travel = self.table["travel"]
        self.stress = self.table["axial"] / (p.thickness * p.diameter)
        self.steps = read_table(case, "solver", "steps")
        stopped = case / "stopped"
        self.reason = stopped.read_text() if stopped.exists() else None

    @property
    def depth(self) -> np.ndarray:
        """delta/H [-]."""
        p = self.parameters
        return (self.travel - p.startGap) / p.height

    def at(self, depth: float) -> float:
        """F/(T d) [Pa] at delta/H [-]; nan beyond the run's end."""
        last = self.depth[-1] + 1e-6
        return float(
            np.interp(depth, self.depth, self.stress)
            if depth < last
            else np.nan
        )

    @property
    def cpu(self) -> float:
        """Computing time [s]."""
        return float(self.steps["cpuTime"][-1])


def tutorial_run(name: str, **settings) -> Run:
    """Run a tutorial with these -set entries, or take the run that is there.

    See kept_run. A run that gave up a step is shown as far as it came.
    """
    chosen = {e: x for e, x in settings.items() if DEFAULTS.get(e) != x}
    return Run(kept_run(f"cutting/{name}", "cutting", **chosen))


def book(found: Findings, label: str, run: Run) -> None:
    """Lines 1 and 5 of the issue: end of the run, mass, energy."""
    p = run.parameters
    found.row(
        f"{label}: travel",
        "mm",
        1e3 * run.travel[-1],
        1e3 * p.travel,
        limit=1e-6,
        remark=run.reason or f"{run.cpu:.0f} s of computing",
    )
    found.row(
        f"{label}: mass error",
        "-",
        float(np.max(abs(run.steps["massError"]))),
        0.0,
        limit=1e-3,
        scale=1.0,
    )
    energy = optional_table(run.path, "energyBalance")
    if energy:
        found.row(
            f"{label}: residual of the energy balance over the work",
            "-",
            float(np.max(abs(energy["relative"][1:]))),
            0.0,
            limit=0.02,
            scale=1.0,
        )


# --- local rates -------------------------------------------------------------


def strain_rates(case: Case, time: float) -> np.ndarray:
    """Equivalent strain rate of the cells of a plane mesh [1/s] (nCells,).

    From the velocity of the cells' corners, by Gauss's theorem.
    """
    mesh = case.mesh(time)
    velocity = read_field(case.times[time] / "pointU", len(mesh.points))
    rates = np.zeros(mesh.n_cells)
    empty = [
        i for p in mesh.patches.values() if p.type == "empty" for i in p.faces
    ]
    for i in empty:
        if mesh.face_areas[i, 2] <= 0:
            continue
        face = mesh.faces[i]
        x, u = mesh.points[face, :2], velocity[face, :2]
        edge = np.roll(x, -1, axis=0) - x
        normal = np.column_stack([edge[:, 1], -edge[:, 0]])
        middle = 0.5 * (u + np.roll(u, -1, axis=0))
        gradient = middle.T @ normal / mesh.face_areas[i, 2]
        d = np.zeros((3, 3))
        d[:2, :2] = 0.5 * (gradient + gradient.T)
        d -= np.trace(d) / 3 * np.eye(3)
        rates[mesh.owner[i]] = np.sqrt(2 / 3 * (d * d).sum())
    return rates


def local_rate(run: Run, depth: float) -> float:
    """Mean equivalent strain rate [1/s] within a quarter of d below the tool.

    Of the cells of bolus around the lower half of the tool, by volume, at
    delta/H.
    """
    case, p = Case(run.path), run.parameters
    time = case.nearest(
        depth * p.height / p.speed, 0.51 * p.writeTravel / p.speed
    )
    if time is None:
        return float("nan")
    mesh = case.mesh(time)
    centre = np.array([0, p.centre - p.speed * time])
    away = mesh.cell_centres[:, :2] - centre
    near = (
        (np.linalg.norm(away, axis=1) < p.radius + 0.25 * p.diameter)
        & (away[:, 1] < 0)
        & (case.field(time, "alpha") > 0.9)
    )
    rates = strain_rates(case, time)
    return float(np.average(rates[near], weights=mesh.cell_volumes[near]))


# --- pictures ----------------------------------------------------------------


def curves(folder: Path, runs: dict, name: str = "curves.png") -> str:
    """F/(T d) over delta/H, like the paper's Fig. 7."""
    figure, axis = plt.subplots(figsize=(7, 4.8), layout="constrained")
    for label, run in runs.items():
        axis.plot(run.depth, run.stress / 1e3, lw=1, label=label)
    axis.set(xlabel="delta / H [-]", ylabel="F / (T d) [kPa]")
    axis.set(xlim=(0, None), ylim=(0, None))
    axis.legend(fontsize=7)
    figure.savefig(folder / name, dpi=120)
    plt.close(figure)
    return name


def contours(folder: Path, runs: dict, fields, depth: float, name: str) -> str:
    """Fields of runs at delta/H, like the paper's Figs. 5 and 6."""
    figure, axes = plt.subplots(
        len(fields),
        len(runs),
        figsize=(4.2 * len(runs), 3.8 * len(fields)),
        layout="constrained",
        squeeze=False,
    )
    for j, (label, run) in enumerate(runs.items()):
        case, p = Case(run.path), run.parameters
        time = max(
            (t for t in case.times if t * p.speed <= depth * p.height + 1e-9),
        )
        mesh = case.mesh(time)
        bolus = case.field(time, "alpha") > 0.5
        for i, field in enumerate(fields):
            values = np.where(bolus, case.field(time, field), np.nan)
            seen = values[bolus]
            axis = axes[i, j]
            draw_cells(
                axis,
                mesh,
                values,
                1e-3,
                field,
                clim=np.percentile(seen, [1, 99]) if seen.size else None,
            )
            axis.set_title(
                f"{label}, delta {1e3 * time * p.speed:.3g} mm", fontsize=8
            )
    figure.savefig(folder / name, dpi=90)
    plt.close(figure)
    return name


def overlay(found: Findings, folder: Path, tutorial: str, runs: dict) -> None:
    """Score the runs against measured curves, where such files are."""
    for speed, run in runs.items():
        path = MEASURED / f"{tutorial}_{1e3 * speed:g}.csv"
        if not path.exists():
            continue
        with open(path) as lines:
            rows = [
                tuple(map(float, row))
                for row in csv.reader(lines)
                if row and re.match(r"\s*[-+.\d]", row[0])
            ]
        way, force = np.array(rows).T
        ours = np.interp(1e-3 * way, run.travel, run.table["axial"])
        found.row(
            f"rms distance to {path.name} over its largest force",
            "-",
            float(np.sqrt(np.mean((ours - force) ** 2)) / force.max()),
        )


# --- the studies -------------------------------------------------------------


@study(
    "limit",
    "A",
    "Rough cylinder drawn through a perfectly plastic body by the moving mesh",
    "Randolph and Houlsby (1984): force per diameter and thickness "
    "(2 pi + 4 sqrt 2) s_u = 11.94 s_u; ripple over five cells",
)
def limit(folder: Path, quick: bool) -> Findings:
    found = Findings()
    figure, axis = plt.subplots(figsize=(7, 4), layout="constrained")
    for n in (6, 10, 16):
        way, force = embedded_force(
            embedded(folder / f"cells{n}", n, travel=1.0, steps=50)
        )
        axis.plot(way, force, lw=1, label=f"{n} cells per diameter")
        steady = force[way > 0.2]
        needed = n == 10
        found.row(
            f"force, {n} cells per diameter",
            "s_u d",
            float(steady.mean()),
            ROUGH,
            limit=0.03 if n >= 10 else None,
        )
        found.row(
            f"largest less smallest force over the mean, {n} cells",
            "-",
            float(np.ptp(steady) / steady.mean()),
            0.0,
            limit=0.02 if needed else None,
            scale=1.0,
        )
    axis.axhline(ROUGH, color="k", ls="--", label="exact")
    axis.set(xlabel="travel / radius", ylabel="force / (s_u d T)", ylim=(0, 14))
    axis.legend()
    figure.savefig(folder / "force.png", dpi=120)
    plt.close(figure)
    found.picture = "force.png"
    return found


@study(
    "cylinder",
    "B",
    "Cylinder: four speeds",
    "the paper in words (facts of Figs. 5 to 7); no measured force is printed",
)
def cylinder(folder: Path, quick: bool) -> Findings:
    found = Findings()
    runs = {v: tutorial_run("cylinder2D", speed=v) for v in SPEEDS}
    for v, run in runs.items():
        book(found, f"{1e3 * v:g} mm/s", run)
    for v, run in runs.items():
        found.row(
            "fall of the force from delta/H 0.45 to 0.9 over the former, "
            f"{1e3 * v:g} mm/s",
            "-",
            max(0.0, 1 - run.at(0.9) / run.at(0.45)),
            0.0,
            limit=1e-3,
            scale=1.0,
            remark="paper: keeps rising; here the halves slide apart on the "
            "platen, see cylinder_platen",
        )
    for depth in (0.3, 0.6, 0.9):
        found.row(
            f"force at 10 over that at 0.1 mm/s, delta/H {depth:g}",
            "-",
            runs[1e-2].at(depth) / runs[1e-4].at(depth),
            remark="paper: strongly rate dependent (> 1)",
        )
    found.row(
        "local strain rate at 10 mm/s, delta/H 0.5",
        "1/s",
        local_rate(runs[1e-2], 0.5),
        2.0,
        remark="paper: about 2/s",
    )
    overlay(found, folder, "cylinder2D", runs)
    found.picture = curves(
        folder, {f"{1e3 * v:g} mm/s": r for v, r in runs.items()}
    )
    return found


@study(
    "cylinder_laws",
    "B",
    "Cylinder at 2.5 mm/s: four laws",
    "the paper in words (Figs. 6 and 7)",
)
def cylinder_laws(folder: Path, quick: bool) -> Findings:
    found = Findings()
    runs = {NAMES[x]: tutorial_run("cylinder2D", law=x) for x in LAWS}
    for name, run in runs.items():
        book(found, name, run)
    sound, damaged = runs["tabulated"], runs["tabulated, damage"]
    for depth in (0.15, 0.3, 0.5, 0.7, 0.85):
        found.row(
            f"force with damage over that without, delta/H {depth:g}",
            "-",
            damaged.at(depth) / sound.at(depth),
            1.0,
            limit=0.05 if depth <= 0.7 else None,
            remark="paper: the same until 0.7 (5 %: the measured scatter)",
        )
    table = read_table(damaged.path, "damagedVolume")
    first = np.flatnonzero(table["damaged"] > 0)
    found.row(
        "first damage, plane strain",
        "mm",
        1e3 * damaged.parameters.speed * table.time[first[0]]
        if first.size
        else float("nan"),
        4.0,
        remark="paper: 4 mm, in 3D, at the free end faces",
    )
    j = runs["J law"]
    found.row(
        "J law: force at delta/H 0.75 over that at 0.375",
        "-",
        j.at(0.75) / j.at(0.375),
        remark="tabulated: "
        f"{sound.at(0.75) / sound.at(0.375):.2f}; paper: like an exponential",
    )
    for name in ("tabulated", "J law"):
        found.row(
            f"{name}: part of the bolus with plastic strain > 0.1, delta/H 0.5",
            "-",
            spread(runs[name], 0.5),
            remark="paper: the deformation spreads with the J law",
        )
    curves(folder, runs)
    contours(
        folder,
        runs,
        ("epsilonPEq", "triaxiality", "D"),
        0.8,
        "contours.png",
    )
    found.remarks.append("Contours near the end: cylinder_laws/contours.png")
    found.picture = "curves.png"
    return found


def spread(run: Run, depth: float) -> float:
    """Part of the bolus whose plastic strain is above 0.1 at delta/H."""
    case, p = Case(run.path), run.parameters
    time = case.nearest(
        depth * p.height / p.speed, 0.51 * p.writeTravel / p.speed
    )
    if time is None:
        return float("nan")
    volume = case.field(time, "alpha") * case.mesh(time).cell_volumes
    return float(
        volume[case.field(time, "epsilonPEq") > 0.1].sum() / volume.sum()
    )


def compare(
    found, runs: dict, reference, depths, limit=None, only=None
) -> None:
    """Rows of the force of runs against that of one of them."""
    for name, run in runs.items():
        if name == reference:
            continue
        for depth in depths:
            found.row(
                f"force, {name}, delta/H {depth:g}",
                "kPa",
                run.at(depth) / 1e3,
                runs[reference].at(depth) / 1e3,
                limit=limit if only is None or name == only else None,
                remark=f"against {reference}",
            )


@study(
    "cylinder_cells",
    "C",
    "Cylinder at 2.5 mm/s: 6, 10, 16 cells per diameter",
    "each other; 3 % from 10 to 16",
)
def cylinder_cells(folder: Path, quick: bool) -> Findings:
    found = Findings()
    runs = {}
    for n, near in ((6, 1), (10, 2), (16, 3)):
        runs[f"{n} cells"] = (
            tutorial_run("cylinder2D")
            if n == 10
            else tutorial_run(
                "cylinder2D",
                cellSize=5e-3 / n,
                boxCells=near,
                travelStep=1e-3 / n,
            )
        )
    compare(
        found, runs, "10 cells", (0.1, 0.3, 0.5, 0.7, 0.9), 0.03, "16 cells"
    )
    found.picture = curves(folder, runs)
    return found


@study(
    "cylinder_step",
    "C",
    "Cylinder at 2.5 mm/s: time step halved and doubled",
    "the run of the tutorial; 3 %",
)
def cylinder_step(folder: Path, quick: bool) -> Findings:
    found = Findings()
    runs = {"0.1 mm": tutorial_run("cylinder2D")}
    for step in (5e-5, 2e-4):
        runs[f"{1e3 * step:g} mm"] = tutorial_run(
            "cylinder2D", travelStep=step, maxCourant=1e4 * step
        )
    compare(found, runs, "0.1 mm", (0.1, 0.3, 0.5, 0.7, 0.9), 0.03)
    found.picture = curves(folder, runs)
    return found


@study(
    "cylinder_friction",
    "C",
    "Cylinder at 2.5 mm/s: friction 0.9, 0.3, none",
    "none; for information",
)
def cylinder_friction(folder: Path, quick: bool) -> Findings:
    found = Findings()
    runs = {
        "0.9": tutorial_run("cylinder2D"),
        "0.3": tutorial_run("cylinder2D", mu=0.3),
        "none on the tool": tutorial_run("cylinder2D", friction="none"),
        "none": tutorial_run(
            "cylinder2D", friction="none", platenFriction="none"
        ),
    }
    compare(found, runs, "0.9", (0.1, 0.3, 0.5, 0.7, 0.9))
    found.picture = curves(folder, runs)
    return found


@study(
    "cylinder_platen",
    "C",
    "Cylinder at 2.5 mm/s: block that sticks to the platen, inertia",
    "none; for information",
)
def cylinder_platen(folder: Path, quick: bool) -> Findings:
    found = Findings()
    runs = {
        "platen 0.9": tutorial_run("cylinder2D"),
        "sticks to the platen": tutorial_run(
            "cylinder2D", platenFriction="noSlip", platenSeparation="no"
        ),
        "does not lift": tutorial_run("cylinder2D", platenSeparation="no"),
        "without inertia": tutorial_run("cylinder2D", inertia=0),
    }
    compare(found, runs, "platen 0.9", (0.1, 0.3, 0.5, 0.7, 0.9))
    run = runs["sticks to the platen"]
    found.row(
        "force at delta/H 0.9 over that at 0.45, sticks to the platen",
        "-",
        run.at(0.9) / run.at(0.45),
        remark="paper: keeps rising with depth (> 1)",
    )
    found.remarks.append(
        "Beyond delta/H 0.6 the halves slide apart on the platen, and the "
        "force falls. Of a block that sticks to the platen, as a moist bolus "
        "may, it keeps rising."
    )
    found.picture = curves(folder, runs)
    return found


@study(
    "cylinder_void",
    "C",
    "Cylinder at 2.5 mm/s: artificial resistance of the void",
    "the run of the tutorial; 1 %",
)
def cylinder_void(folder: Path, quick: bool) -> Findings:
    found = Findings()
    runs = {"10 Pa": tutorial_run("cylinder2D")}
    for stress in (5, 20):
        runs[f"{stress} Pa"] = tutorial_run("cylinder2D", voidStress=stress)
    compare(found, runs, "10 Pa", (0.1, 0.3, 0.5, 0.7, 0.9), 0.01)
    found.picture = curves(folder, runs)
    return found


@study(
    "wire",
    "D",
    "Wire: four speeds, and what happens above 1/s",
    "the paper in words (Fig. 7)",
)
def wire(folder: Path, quick: bool) -> Findings:
    found = Findings()
    runs = {v: tutorial_run("wire2D", speed=v) for v in SPEEDS}
    for v, run in runs.items():
        book(found, f"{1e3 * v:g} mm/s", run)
        plateau = run.stress[(run.depth > 0.1) & (run.depth < 0.6)]
        found.row(
            f"force from delta/H 0.1 to 0.6, {1e3 * v:g} mm/s: largest less "
            "smallest over the mean",
            "-",
            float(np.ptp(plateau) / plateau.mean()),
            0.0,
            limit=0.07,
            scale=1.0,
            remark="paper: a plateau (7 %: the measured scatter)",
        )
        found.row(
            f"force at delta/H 0.05 over the plateau, {1e3 * v:g} mm/s",
            "-",
            run.at(0.05) / float(plateau.mean()),
            1.0,
            limit=0.1,
            remark="paper: plateau beyond 0.05",
        )
    found.row(
        "local strain rate at 10 mm/s, delta/H 0.3",
        "1/s",
        local_rate(runs[1e-2], 0.3),
        30.0,
        remark="paper: about 30/s",
    )
    laws = {f"tabulated, {1e3 * v:g} mm/s": r for v, r in runs.items()}
    for v in (2.5e-3, 1e-2):
        run = tutorial_run("wire2D", speed=v, law="HerschelBulkley")
        laws[f"Herschel-Bulkley, {1e3 * v:g} mm/s"] = run
        book(found, f"Herschel-Bulkley, {1e3 * v:g} mm/s", run)
        found.row(
            f"plateau, Herschel-Bulkley over tabulated, {1e3 * v:g} mm/s",
            "-",
            run.at(0.4) / runs[v].at(0.4),
            remark="beyond 1/s the table saturates, the fit goes on: the "
            "paper's curves are too low there",
        )
    overlay(found, folder, "wire2D", runs)
    found.picture = curves(folder, laws)
    return found


@study(
    "wire_J",
    "D",
    "Wire at 2.5 mm/s: J law",
    "the paper in words (Figs. 6 and 7)",
)
def wire_j(folder: Path, quick: bool) -> Findings:
    found = Findings()
    runs = {
        "tabulated": tutorial_run("wire2D"),
        "J law": tutorial_run("wire2D", law="JLaw"),
    }
    book(found, "J law", runs["J law"])
    j = runs["J law"]
    found.row(
        "J law: force at delta/H 0.4 over that at 0.2",
        "-",
        j.at(0.4) / j.at(0.2),
        remark="paper: like an exponential",
    )
    found.picture = curves(folder, runs)
    return found


def solid_run() -> Run | None:
    """A run of cylinder3D: from ./Allrun run cutting/cylinder3D, it is long."""
    path = Path(
        os.environ.get(
            "BOLUSFOAM_CYLINDER3D", ROOT / "run" / "cutting" / "cylinder3D"
        )
    )
    return (
        Run(path) if (path / "postProcessing" / "toolForce").is_dir() else None
    )


@study(
    "solid",
    "E",
    "Cylinder at 2.5 mm/s: plane against 3D",
    "the paper in words: they agree; first damage at 4 mm",
)
def solid(folder: Path, quick: bool) -> Findings:
    found = Findings()
    run = solid_run()
    if run is None:
        found.row(
            "cylinder3D: travel",
            "mm",
            0.0,
            18.0,
            limit=1e-6,
            remark="run it first: ./Allrun run cutting/cylinder3D -np 2",
        )
        return found
    plane = tutorial_run("cylinder2D")
    book(found, "cylinder3D", run)
    compare(
        found, {"plane": plane, "3D": run}, "plane", (0.1, 0.3, 0.5, 0.7, 0.9)
    )
    found.picture = curves(folder, {"plane": plane, "3D": run})
    return found
