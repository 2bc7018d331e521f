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
import base64
import html
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
from bolus_results.locking import alone_in
from bolus_results.results import collect, measure_of, spread
from bolus_results.tables import optional_table

INPUTS = (
    "constant/bolusProperties",
    "constant/motilityProperties",
    "constant/dynamicMeshDict",
    "system/controlDict",
    "system/fvSolution",
    "system/fvSchemes",
)
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
    for key in place.split("."):
        if not isinstance(results, dict) or key not in results:
            return None
        results = results[key]
    return results["value"]


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
                (f"{shares}.void", SHARE_LIMIT, "void"),
                (f"{shares}.debris", SHARE_LIMIT, "viscosity of broken bolus"),
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

STYLE = """
body { font: 15px sans-serif; margin: 2em; }
table { border-collapse: collapse; margin: 1em 0; }
td, th { border: 1px solid #ccc; padding: .2em .6em; text-align: left;
         vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
tr.differs td { background: #fff4d6; }
img { max-width: 100%; }
.side { display: flex; gap: 2em; flex-wrap: wrap; }
.side > section { flex: 1 1 30em; min-width: 0; }
.warning { color: #a02000; }
"""


def table(heads, rows, mark_differences=False) -> str:
    """Rows of (label, cells...); cells are text, or numbers to the right."""
    lines = [
        "<tr>" + "".join(f"<th>{html.escape(h)}</th>" for h in heads) + "</tr>"
    ]
    for label, *cells in rows:
        differs = mark_differences and len(set(cells)) > 1
        line = f"<tr{' class=differs' if differs else ''}>"
        line += f"<td>{html.escape(label)}</td>"
        for cell in cells:
            number = isinstance(cell, (int, float))
            text = "" if cell is None else f"{cell:.6g}" if number else cell
            kind = ' class="number"' if number else ""
            line += f"<td{kind}>{html.escape(text)}</td>"
        lines.append(line + "</tr>")
    return "<table>" + "\n".join(lines) + "</table>"


def flat(results: dict, path=()) -> dict[str, dict]:
    """Numbers of results.json by their paths."""
    if "value" in results and "unit" in results:
        return {".".join(path): results}
    found = {}
    for key, child in results.items():
        if isinstance(child, dict):
            found |= flat(child, (*path, key))
    return found


def number_table(shown: list[Shown], part: str, only=lambda name: True) -> str:
    """The numbers of a part of results.json, side by side."""
    numbers = [flat(one.results.get(part, {})) for one in shown]
    names = dict.fromkeys(name for each in numbers for name in each)
    rows = []
    for name in names:
        if not only(name):
            continue
        unit = next(each[name]["unit"] for each in numbers if name in each)
        rows.append(
            (
                f"{name} [{unit}]",
                *(
                    each[name]["value"] if name in each else None
                    for each in numbers
                ),
            )
        )
    return table(["", *(one.name for one in shown)], rows)


def picture(path: Path, caption: str) -> str:
    """A picture as a part of the page."""
    kind = path.suffix[1:]
    data = base64.b64encode(path.read_bytes()).decode()
    caption = html.escape(caption)
    return (
        f'<figure><img alt="{caption}" src="data:image/{kind};base64,{data}">'
        f"<figcaption>{caption}</figcaption></figure>"
    )


def side_by_side(blocks: list[str]) -> str:
    """Blocks of HTML in columns."""
    return (
        '<div class="side">'
        + "".join(f"<section>{block}</section>" for block in blocks)
        + "</div>"
    )


def what_was_run(shown: list[Shown]) -> str:
    """Folders, settings, and what the runs cost."""

    def text(one, name):
        path = one.path / name
        return path.read_text().strip() if path.is_file() else ""

    rows = [
        ("folder", *(str(one.path.resolve()) for one in shown)),
        ("settings", *(text(one, "settings") or "none" for one in shown)),
    ]
    return table(["", *(one.name for one in shown)], rows) + number_table(
        shown, "run"
    )


def input_tables(shown: list[Shown]) -> str:
    """The dictionaries, with the entries that differ in colour."""
    parts = []
    names = dict.fromkeys(name for one in shown for name in one.inputs)
    for name in names:
        each = [one.inputs.get(name, {}) for one in shown]
        keys = dict.fromkeys(key for inputs in each for key in inputs)
        rows = [(k, *(inputs.get(k, "-") for inputs in each)) for k in keys]
        parts.append(
            f"<details><summary>{html.escape(name)}</summary>"
            + table(["entry", *(one.name for one in shown)], rows, True)
            + "</details>"
        )
    return "".join(parts)


def is_balance(name: str) -> bool:
    """Does a number of the results belong to the balances?"""
    return name.startswith(("energyBalance", "retainedMass", "externalWork"))


def page(shown: list[Shown], common, own) -> str:
    """The text of the page."""
    title = "bolusFoam: " + ", ".join(one.name for one in shown)
    warnings = side_by_side(
        [
            f"<h3>{html.escape(one.name)}</h3>"
            + (
                "<ul>"
                + "".join(
                    f'<li class="warning">{html.escape(text)}</li>'
                    for text in one.warnings
                )
                + "</ul>"
                if one.warnings
                else "<p>None.</p>"
            )
            for one in shown
        ]
    )
    pictures = side_by_side(
        [
            f"<h3>{html.escape(one.name)}</h3>"
            + (
                "".join(picture(path, caption) for caption, path in mine)
                or "<p>No pictures of fields: none written, or a 3D mesh.</p>"
            )
            for one, mine in zip(shown, own, strict=True)
        ]
    )
    sections = (
        ("What was run", what_was_run(shown)),
        ("Warnings", warnings),
        ("Curves", "".join(picture(path, text) for text, path in common)),
        ("Fields", pictures),
        ("Mass and energy balance", number_table(shown, "results", is_balance)),
        (
            "Other numbers",
            number_table(shown, "results", lambda name: not is_balance(name)),
        ),
        ("Inputs", input_tables(shown)),
    )
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        f"<title>{html.escape(title)}</title><style>{STYLE}</style></head><body>"
        f"<h1>{html.escape(title)}</h1>"
        + "".join(f"<h2>{head}</h2>\n{body}\n" for head, body in sections)
        + "</body></html>\n"
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
