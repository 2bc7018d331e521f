# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""One page about one or several runs, side by side: ./Allrun report.

    python -m bolus_results.page CASE [CASE ...] [-out DIR]

writes DIR (default CASE/report, of the first) with page.html and its pictures;
the page holds them itself, so that it can be sent alone. It tells what was
run, with which inputs and where they differ, mass and energy balance, numbers,
curves, contours, a moving picture, and what to be wary of.

A case must have been run: serially, or reconstructed.
"""

import argparse
import json
import re
import sys
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.animation import FuncAnimation, PillowWriter
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from bolus_results import curves, plots
from bolus_results.fields import Case
from bolus_results.foam_files import (
    FoamFileError,
    entries,
    foam_dictionary,
    messages,
)
from bolus_results.html import render
from bolus_results.locking import alone_in
from bolus_results.measure import measure_of, number_at, spread
from bolus_results.results import collect
from bolus_results.tables import optional_table

INPUTS = (
    "constant/bolusProperties",
    "constant/motilityProperties",
    "constant/dynamicMeshDict",
    "system/controlDict",
    "system/fvSolution",
    "system/fvSchemes",
)
# Numbers of the balances
BALANCES = ("energyBalance", "retainedMass", "externalWork")
FRAMES = 60  # of the moving picture, at most
# What the issues of the project ask of a run
MASS_LIMIT = 1e-3  # [-]
ENERGY_LIMIT = 0.01  # residual, of the work [-]
SHARE_LIMIT = 0.02  # of one artificial viscosity, of the work [-]
SPILL_LIMIT = 1e-3  # of the bolus [-]
# A patch "wall" of type wall, as the gastric cases have it
HARMLESS = (
    r"Removed patchGroup '(\w+)' which clashes with patch \d+ of the same"
)
# [J]; below it no share of the work says anything
LEAST_WORK = 1e-9


@dataclass
class Shown:
    """A case as the page shows it."""

    name: str
    path: Path
    results: dict
    inputs: dict[str, dict[str, str]]  # file: {entry: value}
    warnings: list[str]


# --- what is told of a case -----------------------------


def read_inputs(path: Path) -> tuple[dict[str, dict[str, str]], list[str]]:
    """The dictionaries of a case, includes and macros expanded; warnings."""
    found, warnings = {}, []
    for name in INPUTS:
        if (path / name).is_file():
            try:
                text, said = foam_dictionary(path, name)
            except FoamFileError as error:
                found[name] = {"(not readable)": str(error)}
                continue
            found[name] = entries(text)
            warnings += [f"{name}: {kind}: {it}" for kind, it in messages(said)]
    return found, warnings


def find(results: dict, place: str) -> float | None:
    """A number of results.json by its path."""
    return (number_at(results, place) or {}).get("value")


def warn(path: Path, results: dict, inputs: dict) -> list[str]:
    """What to be wary of in a run."""
    found = []
    control = inputs.get("system/controlDict", {})
    end = float(control.get("endTime", "nan"))
    reached = find(results, "run.simulatedTime")
    if reached is None:
        found.append("No table of steps: the solver did not come far.")
    elif np.isfinite(end) and reached < end * (1 - 1e-6):
        found.append(f"The run ended at {reached:g} s, before its {end:g} s.")
    for log in sorted(path.glob("log.*")):
        told = Counter(messages(log.read_text(errors="replace")))
        for (kind, said), count in told.items():
            if not re.search(HARMLESS, said):
                found.append(f"{log.name}: {kind}, {count} times: {said[:160]}")
    for place, limit, what in (
        ("run.maxMassError", MASS_LIMIT, "largest mass error"),
        ("run.spilled", SPILL_LIMIT, "bolus passed on where cells overfilled"),
    ):
        number = find(results, place)
        if number is not None and abs(number) > limit:
            found.append(
                f"{what}: {100 * number:.2g} % (limit {100 * limit:g} %)"
            )
    table = optional_table(path, "energyBalance")
    if table is not None:
        work = float(np.abs(table["work"] + table["closure"]).max())
        if work < LEAST_WORK:
            found.append(
                f"The walls did {work:.1e} J of work: parts of it say nothing."
            )
        else:
            shares = "results.energyBalance.shares"
            for place, limit, what in (
                (
                    "results.energyBalance.relative.final",
                    ENERGY_LIMIT,
                    "residual",
                ),
                (f"{shares}.gas", SHARE_LIMIT, "gas"),
                (
                    f"{shares}.damagedViscosity",
                    SHARE_LIMIT,
                    "viscosity of broken bolus",
                ),
                (f"{shares}.stabilisation", SHARE_LIMIT, "stabilisation"),
            ):
                number = find(results, place)
                if number is not None and abs(number) > limit:
                    found.append(
                        f"energy, {what}: {100 * number:.2g} % of the work "
                        f"(limit {100 * limit:g} %)"
                    )
    return found


def check(path: Path) -> None:
    """Raise FoamFileError where there is no run to tell of."""
    if not (path / "system" / "controlDict").is_file():
        raise FoamFileError(f"{path}: not a case (no system/controlDict)")
    if not (path / "postProcessing").is_dir():
        if any(path.glob("processor[0-9]*")):
            raise FoamFileError(f"{path}: reconstruct it first")
        raise FoamFileError(
            f"{path}: no results (no postProcessing); ./Allrun run it first"
        )


def show(path: Path) -> Shown:
    """All that the page tells of a case, but for its pictures."""
    check(path)
    results = collect(path, measure_of(path))
    inputs, warnings = read_inputs(path)
    warnings += warn(path, results, inputs)
    return Shown(path.resolve().name, path, results, inputs, warnings)


# --- pictures -----------------------------


def movie(case: Case, target: Path) -> bool:
    """The von Mises stress of the bolus over the run; False without fields."""
    times = [
        t for t in case.times if case.has(t, "alpha") and case.has(t, "sigmaEq")
    ]
    if len(times) < 2:
        return False
    times = spread(times, FRAMES)
    highest = max(
        float(np.percentile(1e-3 * case.field(t, "sigmaEq"), 99)) for t in times
    )
    norm = Normalize(0, max(highest, 1e-3))
    figure, grid = plots.sheet(case, times[-1], 1, 1)
    axes = grid[0, 0]
    figure.colorbar(
        ScalarMappable(norm, "viridis"),
        ax=axes,
        label="sigmaEq of the bolus [kPa]",
    )

    def draw(time):
        axes.clear()
        plots.frame(axes, case, time)
        section = case.mesh(time).section
        bolus = case.field(time, "alpha")[section.cells] > 0.5
        values = 1e-3 * case.field(time, "sigmaEq")[section.cells]
        plots.paint(axes, section, bolus, values, norm, "viridis")

    FuncAnimation(figure, draw, frames=times, init_func=lambda: None).save(
        target, writer=PillowWriter(fps=6), dpi=110
    )
    plt.close(figure)
    return True


def tool_curves(shown: list[Shown], target: Path) -> bool:
    """Force and torque of a rigid tool; False if no case has one."""
    figure, axes = plt.subplots(figsize=(7, 3.8), layout="constrained")
    drawn = False
    for one in shown:
        table = optional_table(one.path, "toolForce")
        if table is not None:
            for name in list(table.columns)[1:]:
                if table.units[name] == "N":
                    axes.plot(
                        table.time, table[name], label=f"{one.name}: {name}"
                    )
                    drawn = True
    axes.set(xlabel="t [s]", ylabel="force on the tool [N]")
    axes.grid(alpha=0.3)
    if drawn:
        axes.legend(fontsize=7)
        figure.savefig(target, dpi=130)
    plt.close(figure)
    return drawn


def draw_all(shown: list[Shown], folder: Path):
    """Pictures: [(caption, path)] of all cases, and of each case."""
    common = []
    if curves.curves([one.path for one in shown], folder / "curves.png"):
        common.append(("Force, work, retained bolus", folder / "curves.png"))
    if tool_curves(shown, folder / "tool.png"):
        common.append(("The tool", folder / "tool.png"))
    own = []
    for i, one in enumerate(shown, 1):
        case = Case(one.path)
        mine, target = [], folder / f"case{i}"
        target.mkdir(exist_ok=True)
        made = plots.draw([one.path], measure_of(one.path).times, target)
        for path in made:
            if path.name != "curves.png":
                mine.append((path.stem, path))
            else:
                path.unlink()
        try:
            if movie(case, target / "movie.gif"):
                mine.insert(0, ("movie", target / "movie.gif"))
        except (ValueError, FoamFileError) as error:
            one.warnings.append(f"No moving picture: {error}")
        own.append(mine)
    return common, own


# --- the page -----------------------------


def flat(results: dict, path=()) -> dict[str, dict]:
    """Numbers of results.json by their paths."""
    if "value" in results and "unit" in results:
        return {".".join(path): results}
    found = {}
    for key, child in results.items():
        if isinstance(child, dict):
            found |= flat(child, (*path, key))
    return found


def number_rows(shown: list[Shown], part: str) -> list[tuple]:
    """The numbers of a part of results.json, side by side."""
    numbers = [flat(one.results.get(part, {})) for one in shown]
    units = {k: v["unit"] for each in numbers for k, v in each.items()}
    return [
        (
            f"{name} [{unit}]",
            *(each.get(name, {}).get("value") for each in numbers),
        )
        for name, unit in units.items()
    ]


def page(shown: list[Shown], common, own) -> str:
    """The text of the page; pictures as of draw_all."""

    def settings(one):
        path = one.path / "settings"
        return path.read_text().strip() if path.is_file() else ""

    names = dict.fromkeys(name for one in shown for name in one.inputs)
    each = {n: [one.inputs.get(n, {}) for one in shown] for n in names}
    numbers = number_rows(shown, "results")
    return render(
        "runs.html",
        title="bolusFoam: " + ", ".join(one.name for one in shown),
        shown=shown,
        common=common,
        own=own,
        run=[
            ("folder", *(str(one.path.resolve()) for one in shown)),
            ("settings", *(settings(one) or "none" for one in shown)),
            *number_rows(shown, "run"),
        ],
        balance=[row for row in numbers if row[0].startswith(BALANCES)],
        others=[row for row in numbers if not row[0].startswith(BALANCES)],
        inputs={
            name: [
                (key, *(given.get(key, "-") for given in inputs))
                for key in dict.fromkeys(k for given in inputs for k in given)
            ]
            for name, inputs in each.items()
        },
    )


def write(paths, folder: Path | None = None) -> Path:
    """Write page and pictures; returns the page."""
    paths = [Path(path) for path in paths]
    folder = Path(folder) if folder else paths[0] / "report"
    shown = [show(path) for path in paths]
    folder.mkdir(parents=True, exist_ok=True)
    common, own = draw_all(shown, folder)
    target = folder / "page.html"
    target.write_text(page(shown, common, own))
    (folder / "results.json").write_text(
        json.dumps({str(one.path): one.results for one in shown}, indent=1)
        + "\n"
    )
    return target


def main(arguments=None) -> int:
    """Command line."""
    parser = argparse.ArgumentParser(
        prog="./Allrun report",
        description="One HTML page about one or several runs, side by side.",
    )
    parser.add_argument("cases", type=Path, nargs="+", metavar="CASE")
    parser.add_argument(
        "-out", type=Path, help="folder; default: report in the first case"
    )
    options = parser.parse_args(arguments)
    try:
        folder = options.out or options.cases[0] / "report"
        for case in options.cases:
            check(case)
        folder.mkdir(parents=True, exist_ok=True)
        with alone_in(folder):
            print(write(options.cases, folder))
    except (FoamFileError, OSError) as error:
        print(f"report: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
