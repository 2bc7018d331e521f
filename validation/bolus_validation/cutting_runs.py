# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Runs of the cutting tutorials: their tables, local strain rates, pictures.

They are kept in run/validate/cutting/runs and taken again as long as solver and
tutorials have not changed; a run that was stopped goes on. SI units.
"""

import csv
import os
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from bolus_cases import cutting
from bolus_cases.mapped import draw_cells
from bolus_results.fields import Case
from bolus_results.foam_files import read_field
from bolus_results.tables import optional_table, read_table

from bolus_validation.studies import (
    ROOT,
    Findings,
    kept_run,
)

# Of the tutorials: what is set to these is the same run
DEFAULTS = {"speed": 2.5e-3, "law": "viscoplastic"}

# Measured curves, if there are any: see measured_curve
MEASURED = Path(
    os.environ.get(
        "BOLUSFOAM_MEASURED", ROOT / "validation" / "data" / "cutting"
    )
)


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

    def written(self, depth: float) -> tuple[Case, float | None]:
        """The case, and its written time nearest to delta/H [s]."""
        case, p = Case(self.path), self.parameters
        return case, case.nearest(
            depth * p.height / p.speed, 0.51 * p.writeTravel / p.speed
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
    case, time = run.written(depth)
    if time is None:
        return float("nan")
    mesh, p = case.mesh(time), run.parameters
    centre = np.array([0, p.centre - p.speed * time])
    away = mesh.cell_centres[:, :2] - centre
    near = (
        (np.linalg.norm(away, axis=1) < p.radius + 0.25 * p.diameter)
        & (away[:, 1] < 0)
        & (case.field(time, "alpha") > 0.9)
    )
    rates = strain_rates(case, time)
    return float(np.average(rates[near], weights=mesh.cell_volumes[near]))


def spread(run: Run, depth: float) -> float:
    """Part of the bolus whose plastic strain is above 0.1 at delta/H."""
    case, time = run.written(depth)
    if time is None:
        return float("nan")
    volume = case.field(time, "alpha") * case.mesh(time).cell_volumes
    return float(
        volume[case.field(time, "epsilonPEq") > 0.1].sum() / volume.sum()
    )


def longest_below(run: Run, depth: float) -> float:
    """Length of bolus along the tool's axis [m], below the tool, at delta/H.

    Of a run in 3D: that of the longest of the columns of cells along the axis
    which are straight ahead of the tool.
    """
    case, time = run.written(depth)
    if time is None:
        return float("nan")
    mesh, p = case.mesh(time), run.parameters
    volume = mesh.cell_volumes
    x, y, _ = mesh.cell_centres.T
    ahead = (abs(x) < p.radius) & (y < p.centre - p.speed * time)
    section = np.round(mesh.cell_centres[ahead, :2], 8)
    _, column = np.unique(section, axis=0, return_inverse=True)
    bolus = case.field(time, "alpha") * volume
    filled = np.bincount(column, bolus[ahead]) / np.bincount(
        column, volume[ahead]
    )
    return float(2 / p.ends * p.depth * filled.max())


# --- pictures ----------------------------------------------------------------


def curves(
    folder: Path, runs: dict, measured=None, name: str = "curves.png"
) -> str:
    """F/(T d) over delta/H, like the paper's Fig. 7.

    measured    curves by label: delta/H [-], F/(T d) [Pa]
    """
    figure, axis = plt.subplots(figsize=(7, 4.8), layout="constrained")
    for label, run in runs.items():
        axis.plot(run.depth, run.stress / 1e3, lw=1, label=label)
    for label, (depth, stress) in (measured or {}).items():
        axis.plot(depth, stress / 1e3, ".", ms=3, label=label)
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


# --- measured curves ---------------------------------------------------------


def measured_curve(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """A measured curve: way of the tool into the block [m], force [N] (n,).

    CSV: a row of names, then rows delta [mm], F [N], delta increasing.
    Raises ValueError, which names the row, for anything else.
    """
    with open(path, newline="") as lines:
        rows = [(n, row) for n, row in enumerate(csv.reader(lines), 1) if row]
    found = []
    for n, row in rows[1:]:
        try:
            delta, force = map(float, row)
        except ValueError:
            delta = force = np.nan
        if not np.isfinite(delta + force):
            raise ValueError(
                f"{path}, row {n}: {','.join(row)}; valid are two numbers, "
                "delta [mm] and F [N], below a row of names"
            )
        if found and delta <= found[-1][0]:
            raise ValueError(
                f"{path}, row {n}: delta {delta:g} mm after {found[-1][0]:g}; "
                "valid are increasing values"
            )
        found.append((delta, force))
    if len(found) < 2:
        raise ValueError(f"{path}: {len(found)} rows; valid are two or more")
    way, force = np.array(found).T
    return 1e-3 * way, force


def overlay(found: Findings, tutorial: str, runs: dict) -> dict:
    """Score runs by speed [m/s] against measured curves, where such files are.

    They are <cylinder2D|wire2D>_<speed in mm/s>.csv in MEASURED. Returns them
    for curves().
    """
    drawn = {}
    for speed, run in runs.items():
        path = MEASURED / f"{tutorial}_{1e3 * speed:g}.csv"
        if not path.exists():
            continue
        p = run.parameters
        way, force = measured_curve(path)
        drawn[f"measured, {1e3 * speed:g} mm/s"] = (
            way / p.height,
            force / (p.thickness * p.diameter),
        )
        shared = way <= run.travel[-1] - p.startGap
        ours = np.interp(
            way[shared] + p.startGap, run.travel, run.table["axial"]
        )
        found.row(
            f"rms distance to {path.name} over its largest force",
            "-",
            float(np.sqrt(np.mean((ours - force[shared]) ** 2)) / force.max()),
            remark=f"{shared.sum()} of {len(way)} points",
        )
    return drawn
