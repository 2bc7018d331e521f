# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""How far a run of case A is from what the paper's text says of it.

For each row of the comparison (paper.CASE_A) one number and its distance from
the row's range: 0 within, growing smoothly outside, so that a search can
descend. A distance d costs d/(1 + d), at most 1: what cannot be met does not
drown the rest. The score is the mean cost, by the weights: 0 where every row
is met, 1 where all are hopeless.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from bolus_results.fields import Case
from bolus_results.measure import TIME_TOLERANCE

from bolus_validation.paper import (
    BAND,
    CASE_A,
    JET,
    LOADED,
    NEAR,
    PLASTIC_STRAIN,
    RETAINED,
    SURFACE,
    Run,
)

# The distance of what did not happen or was not reached
NEVER = 5.0

# Weights: a number that the text prints; an event in words; what follows from
# another row; what the paper does not report
NUMBER, WORDS, FOLLOWS, OURS = 2.0, 1.0, 0.5, 0.25


@dataclass(frozen=True)
class Target:
    """A row of the comparison as a search sees it.

    measure    of a run: a number; None: did not happen, or not reached
    distance   of that number from the row's range [-]
    paper      a number as the paper has it
    """

    weight: float
    measure: Callable[[Run], float | None]
    distance: Callable[[float], float]
    paper: float


def within(low: float, high: float, scale: float):
    """Distance from a range, in scales."""

    def distance(x: float) -> float:
        return max(0.0, low - x, x - high) / scale

    return distance


def near(time: float):
    """Distance from about a time [s]."""
    return within(time - NEAR, time + NEAR, 1)


def factor(low: float, high: float = math.inf):
    """Distance from a range of positive numbers, by the logarithm."""

    def distance(x: float) -> float:
        size = max(x, 1e-6 * low if low > 0 else 1e-6 * high)
        below = math.log(low / size) if low > 0 else 0.0
        above = math.log(size / high) if high < math.inf else 0.0
        return max(0.0, below, above)

    return distance


def neck(area: np.ndarray) -> float:
    """The thinnest place between two bulges, over the smaller; 1: none."""
    left = np.maximum.accumulate(area)
    right = np.maximum.accumulate(area[::-1])[::-1]
    bulge = np.minimum(left, right)
    there = bulge > 0.05 * area.max()
    return float((area[there] / bulge[there]).min()) if there.any() else 1.0


def parted(run: Run) -> float | None:
    """How far from two pieces at 10.5 s [-]: 0 two; else the neck of all the
    bolus and that of its undamaged part, mean; more pieces: how many more."""
    pieces = run.at(10.5, "pieces")
    if pieces is None:
        return None
    if pieces >= 2:
        return 0.5 * (pieces - 2)
    case = Case(run.path)
    time = case.nearest(10.5, TIME_TOLERANCE)
    mesh = case.mesh(time)
    place, column = np.unique(mesh.axial.round(6), return_inverse=True)
    bolus = case.field(time, "alpha") * mesh.cell_volumes
    found = [bolus]
    if case.has(time, "D"):
        found.append(bolus * (case.field(time, "D") <= 0.5))
    length = np.gradient(place)
    necks = [neck(np.bincount(column, part) / length) for part in found]
    return 0.1 + float(np.mean(necks))


def _at(time: float, name: str, unit: float = 1.0):
    def measure(run: Run) -> float | None:
        found = run.at(time, name)
        return None if found is None else found / unit

    return measure


def _ratio(part: Callable, whole: Callable):
    def measure(run: Run) -> float | None:
        a, b = part(run), whole(run)
        if a is None or b is None:
            return None
        return a / b if b > 0 else math.inf

    return measure


def _force(time: float):
    def measure(run: Run) -> float | None:
        found = run.series("contactForce", "total_perMass", time)
        return found and found[0]

    return measure


def _peak(t0: float, t1: float):
    return lambda run: run.peak("contactForce", "total_perMass", t0, t1)


def _work(t0: float, t1: float):
    def measure(run: Run) -> float | None:
        found = run.series("externalWork", "work_perMass", t0, t1)
        return found and found[1] - found[0]

    return measure


def _first_damage(run: Run) -> float | None:
    found = run.results["results"].get("damagedVolume", {}).get("firstDamage")
    return found and found["value"]


def _outflow(run: Run) -> float | None:
    table = run.table("retainedMass")
    gone = table is not None and 1 - table["upstream"] > 1e-3
    return float(table.time[gone.argmax()]) if np.any(gone) else None


def _change(table: str, column: str):
    def measure(run: Run) -> float | None:
        found = run.series(table, column, 7.5, 32)
        return found and 100 * found[1] / found[0]

    return measure


def _stuck(run: Run) -> float | None:
    before, after = run.at(10.5, "pieces"), run.at(18, "pieces")
    if before is None or after is None or before < 2:
        return None
    return float(after - before)


def _outflow_later(run: Run) -> float | None:
    found = run.series("retainedMass", "retained", 25.5, 29, 32)
    return found and -100 * float(np.diff(found).max())


def _balance(run: Run) -> float | None:
    table = run.table("retainedMass")
    return None if table is None else float(np.abs(table["balanceError"]).max())


def _leak(run: Run) -> float | None:
    found = run.series("retainedMass", "passedWhileClosed", 25.5)
    return found and abs(found[0])


# In the order of CASE_A
_TARGETS = (
    Target(NUMBER, _at(7.5, "triaxialityMaxCore"), within(1, math.inf, 1), 1.1),
    Target(NUMBER, _first_damage, near(7.5), 7.5),
    Target(WORDS, parted, within(0, 0, 1), 0.0),
    Target(WORDS, _at(10.5, "sigmaEqMean", 1e3), factor(0, 1e-3 * LOADED), 0.0),
    Target(WORDS, _ratio(_force(10.5), _peak(6, 10.5)), factor(0, 0.5), 0.1),
    Target(WORDS, _ratio(_force(12.5), _force(10.5)), factor(2), 10.0),
    Target(WORDS, _ratio(_work(10.5, 12.5), _work(8.5, 10.5)), factor(1), 2.0),
    Target(
        NUMBER, _at(12.5, "triaxialityMinIntact"), within(-math.inf, -3, 3), -9
    ),
    Target(NUMBER, _at(12.5, "epsilonPEqMax"), factor(*PLASTIC_STRAIN), 15.0),
    Target(NUMBER, _at(12.5, "jetForward", 1e-3), factor(*JET), 20.0),
    Target(NUMBER, _at(12.5, "jetBackward", 1e-3), factor(*JET), 20.0),
    Target(NUMBER, _at(12.5, "triaxialityMax"), factor(*BAND), 3.65),
    Target(NUMBER, _outflow, near(12.5), 12.5),
    Target(WORDS, _at(14, "jetBackward", 1e-3), factor(2.5), 20.0),
    Target(WORDS, _ratio(_force(18), _peak(12.5, 18)), factor(0, 0.5), 0.1),
    Target(FOLLOWS, _stuck, within(-math.inf, -1, 1), -1.0),
    Target(WORDS, _ratio(_peak(23, 25.5), _force(18)), factor(2), 10.0),
    Target(WORDS, _at(25.5, "pieces"), within(1, 1, 2), 1.0),
    Target(WORDS, _outflow_later, within(1e-6, math.inf, 10), 5.0),
    Target(
        NUMBER, _change("retainedMass", "retained"), within(*RETAINED, 10), 50
    ),
    Target(
        NUMBER,
        _change("freeSurface", "externalArea"),
        within(*(100 + c for c in SURFACE), 10),
        82,
    ),
    Target(OURS, _balance, factor(0, 5e-3), 0.0),
    Target(OURS, _leak, factor(0, 1e-4), 0.0),
)

NAMES = tuple(f"{row.when}: {row.paper}" for row in CASE_A)
TARGETS = dict(zip(NAMES, _TARGETS, strict=True))


def measure(run: Run) -> dict:
    """{row: [number or None, what the comparison prints, agrees]}."""
    found = {}
    for name, row in zip(NAMES, CASE_A, strict=True):
        number = TARGETS[name].measure(run)
        if number is not None and not math.isfinite(number):
            number = 1e9
        text, agrees = row.find(run)
        if agrees is not None and not isinstance(agrees, str):
            agrees = bool(agrees)
        found[name] = [number, text, agrees]
    return found


def distance(name: str, number: float | None) -> float:
    """Of a row's number from its range [-]."""
    return NEVER if number is None else TARGETS[name].distance(number)


def score(measured: dict) -> float:
    """Mean cost of the rows, weighted [-]: 0 to 1. {row: [number, ...]}."""
    total = 0.0
    for name, target in TARGETS.items():
        d = distance(name, measured[name][0])
        total += target.weight * d / (1 + d)
    return total / sum(target.weight for target in TARGETS.values())


def rows_met(measured: dict) -> int:
    """Rows of the comparison that agree."""
    return sum(found[2] is True for found in measured.values())
