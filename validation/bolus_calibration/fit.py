# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Least squares of a law on measured curves, with confidence intervals.

Residuals are (measured - law)/law, with at least a tenth of the curve's
largest stress below the line; each specimen counts the same, however many rows
it has. The parameters are positive: their logarithms are fitted.

Two kinds of scatter make the intervals: rows about their specimen's own curve,
and whole specimens above or below the law (repeatability), which many rows do
not average out. The second is estimated if there are at least three specimens
more than parameters, with Student's t for the difference; else it is taken as
7 %, what Skamniotis et al. (2020) measured for the oatcake (6.5 % in
compression, 8.2 % in shear), and said so.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import norm, t

from bolus_calibration.data import Curve, DataError
from bolus_calibration.model import (
    HerschelBulkley,
    Histories,
    Law,
    PowerHardening,
    Tabulated,
)

USUAL_SCATTER = 0.07  # of specimens, if it cannot be estimated [-]
CONFIDENCE = 0.95
# Specimens beyond the parameters that an estimate of their scatter takes: with
# fewer Student's t would widen any interval beyond use
FREEDOM = 3
# An interval wider than this factor to either side says: not determined
WIDEST = 3.0
# A more general law must be better by this part of the misfit to be chosen
PREFERENCE = 0.05


@dataclass
class Fit:
    """A law with its numbers. Those of names: E, then the law's reported."""

    law: Law
    parameters: np.ndarray  # E and the law's own
    names: list[str]
    values: np.ndarray
    low: np.ndarray
    high: np.ndarray
    misfit: float  # root mean square of the residuals [-]
    row_scatter: float  # within specimens [-]
    specimen_scatter: float  # between specimens [-]
    scatter_assumed: bool
    stresses: list[np.ndarray]  # of the law at the rows of each curve [Pa]

    @property
    def undetermined(self) -> list[str]:
        """Names of numbers that the data leave open."""
        wide = self.high > WIDEST * self.values
        return [n for n, w in zip(self.names, wide, strict=True) if w]


def _first_modulus(curves: list[Curve]) -> float:
    """E [Pa] of the unloading; without, of the first rows, but at least ten
    times the secant of the whole, which a J-shaped curve would else hide."""
    slopes = []
    for c in curves:
        for i in (2, 0):
            inside = c.segment == i
            strain, stress = c.strain[inside], c.stress[inside]
            if i == 0:
                few = max(3, np.count_nonzero(stress < 0.3 * stress.max()))
                strain, stress = strain[:few], stress[:few]
            if len(strain) > 2 and np.ptp(strain) > 0:
                slope = np.polyfit(strain, stress, 1)[0]
                if i == 0:
                    slope = max(slope, 10 * c.stress.max() / c.strain.max())
                slopes.append(slope)
                break
    slopes = [s for s in slopes if s > 0]
    return float(np.median(slopes)) if slopes else 1e5


def fit(law: Law, curves: list[Curve], scatter: float | None = None) -> Fit:
    """Fit a law; scatter of whole specimens [-] if it is known."""
    histories = Histories.of(curves)
    measured = np.concatenate([c.stress for c in curves])
    owner = np.repeat(np.arange(len(curves)), [len(c.time) for c in curves])
    rows = np.bincount(owner)
    weight = np.sqrt(rows.mean() / rows)[owner]
    floors = np.array([0.1 * c.stress.max() for c in curves])[owner]

    def stress(x):
        return np.concatenate(law.stress(np.exp(x), histories))

    def solve(start, below):
        def residuals(x):
            return weight * (measured - stress(x)) / below

        return least_squares(
            residuals,
            start,
            bounds=(lowest, highest),
            x_scale=0.1,
            xtol=1e-6,
            ftol=1e-8,
            diff_step=1e-4,
        )

    guesses = np.log([[_first_modulus(curves), *g] for g in law.starts(curves)])
    lowest = guesses.min(axis=0) - np.log(1e3)
    highest = guesses.max(axis=0) + np.log(1e3)
    for name, largest in law.largest.items():
        highest[1 + law.names.index(name)] = np.log(largest)

    # The denominators of the second round are the first one's law: the measured
    # stresses would pull the fit to the low ones
    below = np.maximum(measured, floors)
    x = min((solve(g, below) for g in guesses), key=lambda end: end.cost).x
    below = np.maximum(stress(x), floors)
    found = solve(x, below)
    x, jacobian = found.x, found.jac

    relative = (measured - stress(x)) / below
    means = np.bincount(owner, relative) / rows
    n, p = len(curves), len(x)
    freedom = len(measured) - n - p
    within = np.sum((relative - means[owner]) ** 2) / max(freedom, 1)
    assumed = scatter is None and n < p + FREEDOM
    quantile = norm.ppf(0.5 + CONFIDENCE / 2)
    if scatter is None and not assumed:
        between = np.sum(means**2) / (n - p)
        quantile = t.ppf(0.5 + CONFIDENCE / 2, n - p)
    else:
        between = (USUAL_SCATTER if scatter is None else scatter) ** 2

    inverse = np.linalg.pinv(jacobian.T @ jacobian, rcond=1e-12)
    middle = within * (jacobian * weight[:, None] ** 2).T @ jacobian
    for i in range(n):
        mine = owner == i
        whole = jacobian[mine].T @ weight[mine]
        middle += between * np.outer(whole, whole)
    covariance = inverse @ middle @ inverse

    def reported(x):
        values = np.exp(x)
        return np.concatenate(([values[0]], law.reported(values[1:])))

    values = reported(x)
    step = 1e-6
    gradient = np.array(
        [
            np.log(reported(x + step * unit) / values) / step
            for unit in np.eye(p)
        ]
    ).T
    deviation = np.sqrt(np.diag(gradient @ covariance @ gradient.T))
    # exp() of a deviation that says "anything" would overflow
    factor = np.exp(np.minimum(quantile * deviation, 50))
    ends = np.cumsum(rows)[:-1]
    return Fit(
        law=law,
        parameters=np.exp(x),
        names=["E", *law.names],
        values=values,
        low=values / factor,
        high=values * factor,
        misfit=float(np.sqrt(np.mean(relative**2))),
        row_scatter=float(np.sqrt(within)),
        specimen_scatter=float(np.sqrt(between)),
        scatter_assumed=assumed,
        stresses=np.split(stress(x), ends),
    )


LAWS = ("tabulated", "HerschelBulkley", "powerHardening")


def possible(curves: list[Curve]) -> list[Law]:
    """The laws that these curves can tell something about."""
    rates = [c.rate for c in curves]
    several = max(rates) > 1.3 * min(rates)
    laws: list[Law] = [PowerHardening()]
    if several or any(c.has("relaxation") for c in curves):
        laws = [Tabulated(curves), HerschelBulkley(), *laws]
    return laws


def fit_all(
    curves: list[Curve], law: str | None = None, scatter: float | None = None
) -> list[Fit]:
    """Fits of the laws, the chosen one first: law, or that of least misfit."""
    laws = possible(curves)
    if law is not None and law not in [one.type for one in laws]:
        raise DataError(
            f"law {law}: the data have one rate only, {curves[0].rate:.3g}/s, "
            "and no relaxation, so that nothing tells how the stress depends "
            "on the rate; add a rate or a relaxation, or fit powerHardening"
            if law in LAWS
            else f"unknown law '{law}'; valid are {', '.join(LAWS)}"
        )
    fits = [fit(one, curves, scatter) for one in laws]
    if law is not None:
        chosen = next(f for f in fits if f.law.type == law)
    else:
        least = min(f.misfit for f in fits)
        chosen = next(f for f in fits if f.misfit <= (1 + PREFERENCE) * least)
    return [chosen, *(f for f in fits if f is not chosen)]
