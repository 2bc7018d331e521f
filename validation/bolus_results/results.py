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
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from bolus_results.fields import Case
from bolus_results.foam_files import FoamFileError, read_text, stored
from bolus_results.locking import alone_in
from bolus_results.profiling import phases
from bolus_results.tables import Table, optional_table, read_starts

# A written field stands for a time if it is this near [s]: a wave moves by
# 0.1 mm in it
TIME_TOLERANCE = 0.04

# A connected piece below this part of the bolus's volume is a crumb, no
# fragment: a few cells of a coarse mesh
CRUMB = 0.01


@dataclass(frozen=True)
class Measure:
    """At what a run is looked.

    times      [s] of its fields; (): up to ten over the run
    reference  to what is there at this time [s] mass and surface are related
    loaded     bolus carrying less equivalent stress than this [Pa] counts as
               unloaded: its triaxiality is a ratio of small numbers
    """

    times: tuple = ()
    reference: float | None = None
    loaded: float = 0.0

    def times_of(self, case: Case) -> tuple:
        """The times of a case [s], if none were given those written."""
        return self.times or spread(
            [t for t in case.times if case.has(t, "alpha")], 10
        )


EVERYWHERE = Measure()


def spread(times, most: int) -> tuple:
    """So many of the times at most, spread over them."""
    picks = np.linspace(0, len(times) - 1, min(most, len(times)))
    return tuple(times[i] for i in np.unique(picks.round().astype(int)))


def measure_of(path) -> Measure:
    """At what results.json of a case looked, if it has one."""
    source = Path(path) / "results.json"
    if not source.is_file():
        return EVERYWHERE
    kept = json.loads(source.read_text()).get("measured", {})
    return Measure(**kept | {"times": tuple(kept.get("times", ()))})


def value(number: float, unit: str, **more) -> dict:
    """A number of results.json; counts stay whole."""
    whole = isinstance(number, (int, np.integer))
    return {
        "value": int(number) if whole else float(number),
        "unit": unit,
    } | more


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
        if "lagged" in steps.columns:
            found["laggedSteps"] = value(int(steps["lagged"][-1]), "-")
        if "turnedLater" in steps.columns:
            found["turnedLaterSteps"] = value(
                int(steps["turnedLater"][-1]), "-"
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
        "total",
        "normal",
        "tangential",
        "axial",
        "resultant",
        "tensile",
        "total_perMass",
        "resultant_perMass",
    ),
    "externalWork": ("power", "work", "work_perMass"),
    "retainedMass": (
        "inside",
        "emptied",
        "retained",
        "upstream",
        "balanceError",
        "passedWhileClosed",
    ),
    "freeSurface": (
        "volume",
        "freeArea",
        "contactArea",
        "externalArea",
        "surfaceToVolume",
    ),
    "damagedVolume": ("bolus", "damaged", "fraction"),
    # All that they have
    "energyBalance": None,
    "fragments": None,
    "jets": None,
    "bolusStatistics": None,
    "wallEnergy": None,
}

# What the energy balance would not have if the void carried nothing and the
# mesh and the time step were infinitely fine: sums of the columns' sizes
ARTIFICIAL = {
    "void": ("void",),
    "debris": ("debris",),
    "stabilisation": ("hourglass", "overfill"),
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


@dataclass
class State:
    """The bolus at a written time, from its fields; SI units.

    Extremes are over the cells with alpha > 0.5. Pieces are connected sets of
    such cells of at least 1 % of the bolus, crumbs the smaller ones; of all
    the bolus, and of what is not damaged (D <= 0.5), which only bolus that
    still carries tension connects.
    """

    time: float
    numbers: dict

    def __getitem__(self, name: str) -> float:
        return self.numbers[name]["value"]

    def get(self, name: str) -> float | None:
        """A number, None if its field was not written."""
        return self.numbers[name]["value"] if name in self.numbers else None


def state(case: Case, time: float, loaded: float = 0.0) -> State:
    """Measure the bolus at a written time; loaded: see Measure."""
    mesh = case.mesh(time)
    alpha = case.field(time, "alpha")
    bolus = alpha > 0.5
    volume = alpha * mesh.cell_volumes
    found: dict = {}

    def field(name):
        return case.field(time, name) if case.has(time, name) else None

    damage = field("D")
    intact = bolus if damage is None else bolus & (damage <= 0.5)
    whole = volume[bolus].sum()

    for label, cells in (("", bolus), ("Intact", intact)):
        pieces = mesh.fragments(cells, volume)
        large = pieces >= CRUMB * whole
        found["pieces" + label] = value(large.sum(), "-")
        found["crumbs" + label] = value((~large).sum(), "-")
        if pieces.size:
            found["largestPiece" + label] = value(pieces[0] / whole, "-")

    if bolus.any():
        sigma = field("sigmaEq")
        if sigma is not None:
            found["sigmaEqMax"] = value(sigma[bolus].max(), "Pa")
            mean = np.average(sigma[bolus], weights=volume[bolus])
            found["sigmaEqMean"] = value(mean, "Pa")
        eta = field("triaxiality")
        if eta is not None:
            found["triaxialityMax"] = value(eta[bolus].max(), "-")
            found["triaxialityMin"] = value(eta[bolus].min(), "-")
            # Damaged bolus has hardly a deviator: its ratio says nothing
            carrying = intact if sigma is None else intact & (sigma > loaded)
            if carrying.any():
                found["triaxialityMaxIntact"] = value(eta[carrying].max(), "-")
                found["triaxialityMinIntact"] = value(eta[carrying].min(), "-")
            # The core: within a third of the radius of a sphere of the volume
            # in the domain
            if mesh.axisymmetric and sigma is not None:
                full = 2 * np.pi / mesh.wedge_angle * whole
                radius = np.cbrt(3 * full / 4 / np.pi)
                core = carrying & (mesh.radii < radius / 3)
                if core.any():
                    i = np.flatnonzero(core)[eta[core].argmax()]
                    found["triaxialityMaxCore"] = value(
                        eta[i],
                        "-",
                        x=float(mesh.axial[i]),
                        sigmaEq=float(sigma[i]),
                    )
        strain = field("epsilonPEq")
        if strain is not None:
            found["epsilonPEqMax"] = value(strain[bolus].max(), "-")
        velocity = field("U")
        if velocity is not None:
            axial = mesh.frame.along(velocity[bolus])
            found["jetForward"] = value(max(axial.max(), 0), "m/s")
            found["jetBackward"] = value(max(-axial.min(), 0), "m/s")
        pressure = field("p")
        if pressure is not None:
            found["pMax"] = value(pressure[bolus].max(), "Pa")
            found["pMin"] = value(pressure[bolus].min(), "Pa")
        if damage is not None:
            part = volume[damage > 0.5].sum() / volume.sum()
            found["damagedFraction"] = value(part, "-")
    return State(time, found)


def states(case: Case, measure: Measure) -> dict[float, State]:
    """The bolus at those of the times asked for that were written."""
    found = {}
    for time in measure.times_of(case):
        written = case.nearest(time, TIME_TOLERANCE)
        if written is not None and case.has(written, "alpha"):
            found[time] = state(case, written, measure.loaded)
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
