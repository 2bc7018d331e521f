# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Group F: what the artificial inputs do to the answer of case A.

Each is halved and doubled. The runs are kept in run/validate/physics/runs, so
that a study that was stopped goes on with the next one.
"""

import fcntl
import hashlib
import json
import subprocess
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from bolus_validation.results import read_table  # noqa: E402
from bolus_validation.studies import (  # noqa: E402
    ROOT,
    Findings,
    solver_hash,
    study,
)

CASE = "gastric/caseA"
FLOW = "system/fvSolution:bolus."
MOVE = "system/fvSolution:transport."
VOID = "constant/bolusProperties:void."

# Name: (entry, value of the tutorial, unit)
INPUTS = {
    "voidCompliance": (VOID + "zeta", 50, "Pa s"),
    "voidViscosity": (VOID + "eta", 2, "Pa s"),
    "damagedViscosity": (VOID + "etaDamaged", 5, "Pa s"),
    "voidCorner": (VOID + "delta", 20, "Pa"),
    "voidSeal": (VOID + "seal", 0.02, "-"),
    "voidClosing": (VOID + "closing", 0.5, "-"),
    "elasticSlip": ("elasticSlip", 1e-5, "m"),
    "residualGap": ("residualGap", 2e-5, "m"),
    "hourglass": (FLOW + "hourglass", 0.05, "-"),
    "overfillTime": (FLOW + "overfillTime", 0.02, "s"),
    "partingTension": (FLOW + "partingTension", 0.1, "Pa"),
    "interfaceJump": (FLOW + "interfaceJump", 0.2, "-"),
    "leastRoom": (FLOW + "leastRoom", 0.05, "-"),
    "damageAbove": (FLOW + "damageAbove", 0.1, "-"),
    "tolerance": (FLOW + "tolerance", 1e-6, "-"),
    "transportCourant": (MOVE + "maxCourant", 0.3, "-"),
    "maxCourant": ("maxCourant", 1, "-"),
    "maxDeltaT": ("maxDeltaT", 0.05, "s"),
}

# Bounds of an entry, where doubling would go beyond
LARGEST = {"transportCourant": 0.5}


def gastric_run(**settings) -> Path:
    """Run case A with these -set entries, or take the run that is there.

    Returns its folder. Two processes that ask for the same run do not start
    it twice.
    """
    options = [f"{name}={number}" for name, number in sorted(settings.items())]
    key = hashlib.sha256((solver_hash() + str(options)).encode())
    folder = ROOT / "run" / "validate" / "physics" / "runs"
    folder.mkdir(parents=True, exist_ok=True)
    case = folder / f"caseA-{key.hexdigest()[:16]}"
    with open(f"{case}.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (case / "results.json").exists():
            again = ["-continue"] if case.exists() else []
            words = [] if again else [w for o in options for w in ("-set", o)]
            subprocess.run(
                [
                    ROOT / "scripts" / "runCase",
                    case if again else CASE,
                    *(again or ["-out", case]),
                    *words,
                ],
                check=True,
                capture_output=True,
                cwd=ROOT,
            )
    return case


def figures(case: Path) -> dict:
    """Peak force [N], work [J], retained mass [-] of a run."""
    found = json.loads((case / "results.json").read_text())["results"]
    return {
        "peak force": found["contactForce"]["total"]["peak"]["value"],
        "work": found["externalWork"]["work"]["final"]["value"],
        "retained mass": found["retainedMass"]["retained"]["final"]["value"],
    }


UNITS = {"peak force": "N", "work": "J", "retained mass": "-"}
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
    figure.savefig(folder / "curves.png", dpi=110)
    plt.close(figure)
    found.picture = "curves.png"
    return found


def register(name: str, entry: str, number: float, unit: str) -> None:
    """A study that halves and doubles an input of case A."""

    @study(
        f"sensitivity_{name}",
        "F",
        f"{name}: {entry.split('.')[-1]} {number:g} {unit} halved and doubled",
        "the run of the tutorial; 1 % allowed",
    )
    def run(folder: Path, quick: bool) -> Findings:
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


for _name, (_entry, _number, _unit) in INPUTS.items():
    register(_name, _entry, _number, _unit)


@study(
    "sensitivity_inertia",
    "F",
    "inertia switched on, with the density of the food",
    "the quasi-static run of the tutorial; 1 % allowed",
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


@study(
    "sensitivity_resolution",
    "F",
    "cell size of case A",
    "the run of the tutorial; for information",
)
def resolution(folder: Path, quick: bool) -> Findings:
    return compare(
        folder,
        {
            "0.5 mm": gastric_run(),
            "1 mm": gastric_run(resolution=1e-3),
            "0.7 mm": gastric_run(resolution=0.7e-3),
        },
        None,
    )
