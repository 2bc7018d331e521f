# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Group F: what the artificial inputs do to the answer of case A, coarse.

Each is halved and doubled, on cells of 1 mm, with damage by the plastic strain
averaged over 2 mm, of which 0.1 has to come under tension. With the paper's
law, bolus that was squeezed waits for a single step of tension to break, and
what a run does afterwards is up to chance; sensitivity_chance and
sensitivity_chancePaper show how much the figures move when nothing but the
length of the first step changes, with the one law and the other. The runs
are kept in run/validate/physics/runs, so that a study that was stopped goes on
with the next one.
"""

import json
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from bolus_cases.synthetic import run
from bolus_results.tables import read_table

from bolus_validation.studies import (
    ROOT,
    Findings,
    kept_run,
    study,
)

CASE = "gastric/caseA"
COARSE = {
    "resolution": 1e-3,
    "pylorusRefinement": 2.5,
    "nonlocalLength": 2e-3,
    "tensileStrain": 0.1,
}
TUTORIAL = {"resolution": 0.5e-3, "pylorusRefinement": 1.25}
FLOW = "system/fvSolution:bolus."
MOVE = "system/fvSolution:transport."
VOID = "constant/bolusProperties:gasCoeffs."

# Name: (entry, unit)
INPUTS = {
    "gasCompliance": (VOID + "zeta", "Pa s"),
    "voidViscosity": (VOID + "eta", "Pa s"),
    "damagedViscosity": (VOID + "etaDamaged", "Pa s"),
    "voidCorner": (VOID + "delta", "Pa"),
    "voidCohesion": (VOID + "cohesion", "Pa"),
    "gasGrowthThreshold": (VOID + "growthThreshold", "-"),
    "voidClosing": (VOID + "closing", "-"),
    "elasticSlip": ("elasticSlip", "m"),
    "residualGap": ("residualGap", "m"),
    "hourglass": (FLOW + "hourglass", "-"),
    "overshootTime": (FLOW + "overshootTime", "s"),
    "partingTension": (FLOW + "partingTension", "Pa"),
    "interfaceJump": (FLOW + "interfaceJump", "-"),
    "leastAvailable": (FLOW + "leastAvailable", "-"),
    "damageAbove": (FLOW + "damageAbove", "-"),
    "tolerance": (FLOW + "tolerance", "-"),
    "lagFriction": (FLOW + "explicitPressureBelow", "s"),
    "overshootTolerance": (MOVE + "overshootTolerance", "-"),
    "historyAbove": (MOVE + "historyAbove", "-"),
    "transportJump": (MOVE + "interfaceJump", "-"),
    "transportCourant": (MOVE + "maxCourant", "-"),
    "maxCourant": ("maxCourant", "-"),
    "maxDeltaT": ("maxDeltaT", "s"),
}

# Bounds of an entry, where doubling would go beyond
LARGEST = {"transportCourant": 0.5, "gasGrowthThreshold": 0.4}


def gastric_run(**settings) -> Path:
    """The folder of a run of case A with these -set entries (kept_run).

    Raises RuntimeError if it gave up a step: its figures are not those of 32 s.
    """
    case = kept_run(CASE, "physics", **(COARSE | settings))
    if (case / "stopped").exists():
        raise RuntimeError(f"{settings}: {(case / 'stopped').read_text()}")
    return case


def tutorial_value(entry: str) -> float:
    """What an entry FILE:PATH or a short name is in the tutorial."""
    tutorial = ROOT / "tutorials" / CASE
    if ":" not in entry:
        rows = map(str.split, (tutorial / "entries").read_text().splitlines())
        entry = next(f"{r[1]}:{r[2]}" for r in rows if r and r[0] == entry)
    file, path = entry.split(":")
    return float(
        run(tutorial, "foamDictionary", file, "-entry", path, "-value")
    )


def figures(case: Path) -> dict:
    """Peak force [N], work [J], retained mass [-] of a run; 18 s is when the
    first wave has gone. The peak of the whole run is one of some tenths of a
    second, in which bolus that is shut in before the pylorus breaks."""
    found = json.loads((case / "results.json").read_text())["results"]
    work = read_table(case, "externalWork")
    force = read_table(case, "contactForce")
    return {
        "peak force": found["contactForce"]["total"]["peak"]["value"],
        "peak force until 18 s": force["total"][force.time <= 18].max(),
        "work until 8 s": np.interp(8, work.time, work["work"]),
        "work until 18 s": np.interp(18, work.time, work["work"]),
        "work": found["externalWork"]["work"]["final"]["value"],
        "retained mass": found["retainedMass"]["retained"]["final"]["value"],
    }


UNITS = {
    "peak force": "N",
    "peak force until 18 s": "N",
    "work until 8 s": "J",
    "work until 18 s": "J",
    "work": "J",
    "retained mass": "-",
}
CURVES = (
    ("contactForce", "total", "force [N]"),
    ("externalWork", "work", "work [J]"),
    ("retainedMass", "retained", "retained mass [-]"),
)


def compare(folder: Path, runs: dict, limit: float | None) -> Findings:
    """Base run first; every figure of the others against it; a picture."""
    found = Findings()
    label, base = next(iter(runs.items()))
    reference = figures(base)
    for name, case in list(runs.items())[1:]:
        for quantity, number in figures(case).items():
            found.row(
                f"{quantity}, {name}",
                UNITS[quantity],
                number,
                reference[quantity],
                limit,
                remark=f"against {label}",
            )
    figure, axes = plt.subplots(1, 3, figsize=(13, 3.6))
    for axis, (table, column, text) in zip(axes, CURVES, strict=True):
        for name, case in runs.items():
            data = read_table(case, table)
            axis.plot(data.time, data[column], lw=0.8, label=name)
        axis.set(xlabel="time [s]", ylabel=text)
    axes[0].legend(fontsize=8)
    figure.tight_layout()
    found.draw(figure, folder / "curves.png")
    return found


def register(name: str, entry: str, unit: str) -> None:
    """A study that halves and doubles an input of case A."""

    @study(
        f"sensitivity_{name}",
        "F",
        f"{name} ({entry.split('.')[-1]}) halved and doubled",
        "the run with the tutorial's value; 1 % allowed",
    )
    def run_study(folder: Path, quick: bool) -> Findings:
        number = tutorial_value(entry)
        # What cannot be doubled goes to its bound
        twice = min(2 * number, LARGEST.get(name, float("inf")))
        return compare(
            folder,
            {
                f"{number:g} {unit}": gastric_run(),
                f"{number / 2:g} {unit}": gastric_run(**{entry: number / 2}),
                f"{twice:g} {unit}": gastric_run(**{entry: twice}),
            },
            0.01,
        )


for _name, (_entry, _unit) in INPUTS.items():
    register(_name, _entry, _unit)


@study(
    "sensitivity_inertia",
    "F",
    "inertia switched on, with the density of the food",
    "the quasi-static run; 1 % allowed",
)
def inertia(folder: Path, quick: bool) -> Findings:
    return compare(
        folder,
        {
            "none": gastric_run(),
            "inertia": gastric_run(**{FLOW + "inertia": 1}),
        },
        0.01,
    )


def chance(folder: Path, steps, **settings) -> Findings:
    """Runs whose first step has these lengths [s], the first for reference."""
    return compare(
        folder,
        {
            f"first step {step:g} s": gastric_run(deltaT=step, **settings)
            for step in steps
        },
        None,
    )


FIRST_STEPS = (0.01, 0.0095, 0.0099, 0.0101, 0.0105)


@study(
    "sensitivity_chance",
    "F",
    "the first step a little shorter and longer: what chance does",
    "the run with a first step of 0.01 s; for information",
)
def chance_nonlocal(folder: Path, quick: bool) -> Findings:
    return chance(folder, FIRST_STEPS)


@study(
    "sensitivity_chancePaper",
    "F",
    "the same with the paper's law of damage, the tutorial's",
    "the run with a first step of 0.01 s; for information",
)
def chance_paper(folder: Path, quick: bool) -> Findings:
    return chance(folder, FIRST_STEPS, nonlocalLength=0, tensileStrain=0)


# (tensileStrain [-], nonlocalLength [m]); 0.1 and 2 mm, and the paper's law,
# are the studies above
LAWS = ((0, 2e-3), (0.02, 0), (0.05, 2e-3), (0.25, 0))


@study(
    "sensitivity_chanceLaws",
    "F",
    "the same with other laws of damage, and what breaks by each",
    "for each law the run with a first step of 0.01 s; for information",
)
def chance_laws(folder: Path, quick: bool) -> Findings:
    found = Findings()
    for strain, length in LAWS:
        law = f"tensileStrain {strain:g}, {1e3 * length:g} mm"
        runs = [
            gastric_run(
                deltaT=step, tensileStrain=strain, nonlocalLength=length
            )
            for step in FIRST_STEPS[:3]
        ]
        every = [figures(case) for case in runs]
        for quantity in UNITS:
            numbers = [numbers[quantity] for numbers in every]
            found.row(
                f"spread of {quantity}, {law}",
                "-",
                max(numbers) / min(numbers) - 1,
            )
        pieces = read_table(runs[0], "fragments")
        parted = pieces.time[pieces["pieces"] > 1]
        found.row(
            f"two pieces from, {law}",
            "s",
            parted[0] if parted.size else float("inf"),
        )
        broken = read_table(runs[0], "damagedVolume")
        found.row(
            f"broken at 18 s, {law}",
            "-",
            np.interp(18, broken.time, broken["fraction"]),
        )
    return found


@study(
    "sensitivity_resolution",
    "F",
    "cell size of case A",
    "the run at 1 mm; for information",
)
def resolution(folder: Path, quick: bool) -> Findings:
    return compare(
        folder,
        {
            "1 mm": gastric_run(),
            "0.7 mm": gastric_run(resolution=0.7e-3, pylorusRefinement=1.75),
            "0.5 mm": gastric_run(**TUTORIAL),
        },
        None,
    )
