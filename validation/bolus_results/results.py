# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The results of a run: tables of the function objects, and results.json.

    python -m bolus_results.results CASE [--times T ...] [--reference T]
                                         [--loaded PA]

writes results.json into the case: every number as {"value", "unit"}, peaks
with their "time" [s]. What was not computed or written is left out; nothing
is guessed.
"""

import argparse
import json
import re
import sys
from dataclasses import asdict
from pathlib import Path

import numpy as np

from bolus_results.fields import Case
from bolus_results.foam_files import FoamFileError, read_text, stored
from bolus_results.locking import alone_in
from bolus_results.measure import EVERYWHERE, Measure, value
from bolus_results.profiling import phases
from bolus_results.state import states
from bolus_results.tables import Table, optional_table, read_starts


def _peak(table: Table, name: str) -> dict:
    """The largest absolute value of a column, with its sign and time."""
    i = int(np.abs(table[name]).argmax())
    return value(table[name][i], table.units[name], time=float(table.time[i]))


def _final(table: Table, name: str) -> dict:
    return value(table[name][-1], table.units[name])


def overfull_numbers(path: Path) -> dict:
    """Steps that overfilled a cell, and the part of the bolus passed on."""
    for folder in reversed(Case(path).times.values()):
        books = folder / "uniform" / "bolusBooks"
        if stored(books):
            entry = dict(
                re.findall(r"^(\w+)\s+(\S+);", read_text(books), re.MULTILINE)
            )
            return {
                "overfullSteps": value(int(entry.get("overfull", 0)), "-"),
                "spilled": value(
                    float(entry.get("spilled", 0)) / float(entry["initial"]),
                    "-",
                    of="the bolus at the start",
                ),
            }
    return {}


def run_numbers(path: Path) -> dict:
    """What the run cost: steps, Newton iterations, time, cores, cells."""
    found: dict = {}
    steps = optional_table(path, "solver", "steps")
    if steps:
        found["simulatedTime"] = value(steps.time[-1], "s")
        found["steps"] = value(steps.time.size, "-")
        found["newtonIterations"] = value(
            int(steps["NewtonIterations"].sum()), "-"
        )
        # The solver's running count, kept over restarts
        found["rejectedSteps"] = value(int(steps["rejected"][-1]), "-")
        if "explicitPressure" in steps.columns:
            found["explicitPressureSteps"] = value(
                int(steps["explicitPressure"][-1]), "-"
            )
        if "splitRotation" in steps.columns:
            found["splitRotationSteps"] = value(
                int(steps["splitRotation"][-1]), "-"
            )
        found["maxCourant"] = value(steps["courant"].max(), "-")
        found["maxMassError"] = value(np.abs(steps["massError"]).max(), "-")
        found["alphaMin"] = value(steps["alphaMin"].min(), "-")
        found["alphaMax"] = value(steps["alphaMax"].max(), "-")
        found["cpuTime"] = value(
            sum(
                start["cpuTime"][-1]
                for start in read_starts(path, "solver", "steps")
            ),
            "s",
            of="the first rank",
        )

    found |= overfull_numbers(path)

    log = path / "log.bolusFoam"
    if log.is_file():
        # A continued run appends to its log
        runs = re.split(r"^Exec\s*:", log.read_text(), flags=re.MULTILINE)[1:]
        clock = [
            float(seconds)
            for text in runs
            for seconds in re.findall(r"clock time\s+([\d.e+-]+)", text)
        ]
        if clock:
            found["clockTime"] = value(sum(clock), "s")
        if runs:
            cores = re.search(r"nProcs\s*:\s*(\d+)", runs[-1])
            if cores:
                found["cores"] = value(int(cores.group(1)), "-")
            # The solver stops at the first step that it has to give up
            found["givenUpSteps"] = value(
                len(
                    re.findall(
                        r"FOAM FATAL ERROR[^\n]*\s+no convergence at", runs[-1]
                    )
                ),
                "-",
            )

    seconds = phases(path)
    if seconds:
        found["profile"] = {
            phase: value(taken, "s", of="the first rank, since its last start")
            for phase, taken in seconds.items()
        }

    if stored(path / "constant" / "polyMesh" / "owner"):
        case = Case(path)
        found["cells"] = value(case.mesh(0.0).n_cells, "-")

    control = path / "system" / "controlDict"
    if control.is_file() and steps:
        end = re.search(
            r"^\s*endTime\s+([\d.eE+-]+)\s*;", control.read_text(), re.MULTILINE
        )
        if end:
            end_time = float(end.group(1))
            found["endTime"] = value(end_time, "s")
            found["finished"] = bool(
                steps.time[-1] >= end_time - 1e-6 * max(end_time, 1.0)
            )
    return found


# Function object: columns of which results.json has the final value and peak
_COLUMNS = {
    "contactForce": (
        "total normal tangential axial resultant tensile "
        "total_perMass resultant_perMass"
    ).split(),
    "externalWork": "power work work_perMass".split(),
    "retainedMass": (
        "inside emptied retained upstream balanceError passedWhileClosed"
    ).split(),
    "freeSurface": (
        "volume freeArea contactArea externalArea surfaceToVolume"
    ).split(),
    "damagedVolume": "bolus damaged fraction".split(),
    "energyBalance": None,
    "fragments": None,
    "jets": None,
    "bolusStatistics": None,
    "wallEnergy": None,
}

# What the energy balance would not have if the gas carried nothing and the
# mesh and the time step were infinitely fine: sums of the columns' sizes
ARTIFICIAL = {
    "gas": ("gas",),
    "damagedViscosity": ("damagedViscosity",),
    "stabilisation": ("hourglass", "overshoot"),
    "timeStep": ("relaxation", "inertiaLoss"),
    "transport": ("transport",),
}


def energy_shares(table: Table) -> dict[str, np.ndarray]:
    """What is artificial in the energy balance, (n,), of the largest work [-].

    table: energyBalance. Without any work so far: 0.
    """
    work = np.abs(table["work"] + table["closure"]).max()
    return {
        name: sum(np.abs(table[column]) for column in columns)
        / (work if work > 0 else 1.0)
        for name, columns in ARTIFICIAL.items()
    }


def table_numbers(path: Path, reference: float | None) -> dict:
    """Final and peak values of the function objects; reference: see Measure."""
    found: dict = {}
    for name, columns in _COLUMNS.items():
        table = optional_table(path, name)
        if not table:
            continue
        found[name] = {
            column: {
                "final": _final(table, column),
                "peak": _peak(table, column),
            }
            for column in columns or list(table.columns)[1:]
        }

    mass = optional_table(path, "retainedMass")
    if mass and reference is not None:
        # What is left, against what was there at the reference
        then = mass.at("retained", reference)
        if then:
            found["retainedMass"]["retainedOfReference"] = value(
                mass["retained"][-1] / then, "-", reference=reference
            )
    surface = optional_table(path, "freeSurface")
    if surface:
        change = surface["externalArea"][-1] / surface["externalArea"][0] - 1
        found["freeSurface"]["changeSinceStart"] = value(change, "-")
        if reference is not None and (
            then := surface.at("externalArea", reference)
        ):
            found["freeSurface"]["changeSinceReference"] = value(
                surface["externalArea"][-1] / then - 1,
                "-",
                reference=reference,
            )
    energy = optional_table(path, "energyBalance")
    if energy:
        found["energyBalance"]["shares"] = {
            name: value(share[-1], "-")
            for name, share in energy_shares(energy).items()
        }
    damage = optional_table(path, "damagedVolume")
    if damage and damage["damaged"].max() > 0:
        first = int(np.flatnonzero(damage["damaged"] > 0)[0])
        found["damagedVolume"]["firstDamage"] = value(damage.time[first], "s")
    return found


def collect(path, measure: Measure = EVERYWHERE) -> dict:
    """All that results.json holds."""
    path = Path(path)
    measured = states(Case(path), measure)
    found = {
        "case": path.resolve().name,
        "measured": asdict(measure),
        "run": run_numbers(path),
        "results": table_numbers(path, measure.reference),
    }
    if measured:
        found["times"] = {
            f"{time:g}": {"written": value(at.time, "s")} | at.numbers
            for time, at in measured.items()
        }
    return found


def write_json(path, measure: Measure = EVERYWHERE) -> Path:
    """Write results.json into the case; returns its path."""
    target = Path(path) / "results.json"
    # NaN is no JSON: let it fail here, where it is seen
    text = json.dumps(collect(path, measure), indent=2, allow_nan=False)
    target.write_text(text + "\n")
    return target


def main(arguments=None) -> int:
    """Command line."""
    parser = argparse.ArgumentParser(
        prog="results", description="Write results.json of a case."
    )
    parser.add_argument("case", type=Path)
    for name, unit, what in (
        ("times", "T", "of the fields [s] (ten over the run)"),
        ("reference", "T", "relate mass and surface to this time [s] (none)"),
        ("loaded", "PA", "least stress of bolus that counts as loaded (0)"),
    ):
        parser.add_argument(
            f"--{name}",
            type=float,
            nargs="+" if name == "times" else None,
            default=getattr(Measure, name),
            metavar=unit,
            help=what,
        )
    options = parser.parse_args(arguments)
    measure = Measure(tuple(options.times), options.reference, options.loaded)
    try:
        Case(options.case)
        with alone_in(options.case):
            print(write_json(options.case, measure))
    except (FoamFileError, OSError) as error:
        print(f"results: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
