# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Stress of a law under a measured history of the equivalent strain.

Laws with a rate:        dsigma/dt = E (depsilon/dt - r(sigma)),
r the plastic rate [1/s] at which the flow stress is sigma [Pa]. An exponential
Rosenbrock step is exact where r is linear and needs no iteration; all
specimens march at once, each in its own time.

The J law (no rate):     sigma = E epsilon below sigma_y, then
sigma_y + H (epsilon - sigma/E)^m (Eqs. 9, 10 of Skamniotis et al., 2020);
constant while the strain is held, slope E when unloaded.

This is the uniaxial equation, used for shear as well by Eqs. 4 and 5: the
Jaumann rate of the solver lowers its shear stress by 0.7 to 3.5 % at stresses
of 7 to 15 kPa and E = 100 kPa.
"""

from dataclasses import dataclass

import numpy as np

from bolus_calibration.data import Curve

STEPS = (240, 100, 60)  # of loading, relaxation, unloading


@dataclass
class Histories:
    """Strain [-] at times [s] of all curves, each (steps + 1, curves)."""

    curves: list[Curve]
    time: np.ndarray
    strain: np.ndarray

    @classmethod
    def of(cls, curves: list[Curve]) -> "Histories":
        """Refined where a curve bends: its begin, that of a relaxation."""
        times, strains = [], []
        for curve in curves:
            ends = [0.0]
            for i in range(3):
                inside = curve.time[curve.segment == i]
                ends.append(inside[-1] if inside.size else ends[-1])
            t = [np.zeros(1)]
            for i, n in enumerate(STEPS):
                s = np.linspace(0, 1, n + 1)[1:] ** (4 if i == 1 else 1.5)
                t.append(ends[i] + (ends[i + 1] - ends[i]) * s)
            time = np.concatenate(t)
            times.append(time)
            known = np.concatenate(([0.0], curve.time))
            strains.append(
                np.interp(time, known, np.concatenate(([0.0], curve.strain)))
            )
        return cls(curves, np.array(times).T, np.array(strains).T)


class Law:
    """A flow stress of the solver: parameters, all positive, by name."""

    type: str  # of flowStress in bolusProperties
    names: list[str]  # of the reported numbers behind E
    largest: dict[str, float] = {}  # that the solver accepts

    def starts(self, curves: list[Curve]) -> list[list[float]]:
        """First guesses of the parameters behind E; the best end counts."""
        raise NotImplementedError

    def stress(self, p: np.ndarray, histories: Histories) -> list[np.ndarray]:
        """Stress [Pa] at each curve's rows; p is E and the parameters."""
        raise NotImplementedError

    def reported(self, p: np.ndarray) -> np.ndarray:
        """What names tells, of the parameters behind E."""
        return p

    def entries(self, p: np.ndarray) -> list[str]:
        """The entries of flowStress behind its type."""
        raise NotImplementedError


def last_tenth(curve: Curve) -> float:
    """Mean stress [Pa] of the last tenth of the loading."""
    stress = curve.stress[curve.segment == 0]
    return float(np.mean(stress[-max(1, len(stress) // 10) :]))


def rest(curves: list[Curve]) -> float | None:
    """Least stress [Pa] at a relaxation's end; None without relaxation."""
    ends = [
        float(np.median(c.stress[c.segment == 1][-5:]))
        for c in curves
        if c.has("relaxation")
    ]
    return min(ends) if ends else None


class RateLaw(Law):
    """A law r(sigma)."""

    def plastic_rate(self, p, sigma):
        """r [1/s] and dr/dsigma [1/(Pa s)]; p without E."""
        raise NotImplementedError

    def limit(self, p) -> float:
        """The largest stress [Pa] that the law can carry."""
        return np.inf

    def stress(self, p, histories):
        e, rest_of = p[0], p[1:]
        limit = self.limit(rest_of)
        dt = np.diff(histories.time, axis=0)
        de = np.diff(histories.strain, axis=0)
        sigma = np.zeros(histories.time.shape)
        now = sigma[0]
        for i in range(len(dt)):
            r, slope = self.plastic_rate(rest_of, now)
            z = np.maximum(e * slope * dt[i], 1e-12)
            phi = -np.expm1(-z) / z
            now = np.minimum(now + e * (de[i] - r * dt[i]) * phi, limit)
            sigma[i + 1] = now
        return [
            np.interp(c.time, histories.time[:, k], sigma[:, k])
            for k, c in enumerate(histories.curves)
        ]


class Tabulated(RateLaw):
    """Linear between (rate, stress); knots are 0 and the measured rates.

    The parameters are the first stress and the rises to the next ones, so
    that the table rises for any positive values.
    """

    type = "tabulated"

    def __init__(self, curves: list[Curve]):
        # Rates within 30 % of their group's first are one knot, at their mean
        rates = sorted(c.rate for c in curves)
        groups = [[rates[0]]]
        for rate in rates[1:]:
            if rate > 1.3 * groups[-1][0]:
                groups.append([])
            groups[-1].append(rate)
        means = [float(np.exp(np.mean(np.log(g)))) for g in groups]
        self.rates = np.array([0.0, *means])
        self.names = [f"sigma({rate:.3g}/s)" for rate in self.rates]

    def starts(self, curves):
        plateaus = [
            np.mean(
                [
                    last_tenth(c)
                    for c in curves
                    if abs(np.log(c.rate / rate)) < 0.3
                ]
                or [np.nan]
            )
            for rate in self.rates[1:]
        ]
        first = rest(curves) or 0.6 * plateaus[0]
        stresses = np.maximum.accumulate([first, *plateaus])
        return [[first, *np.maximum(np.diff(stresses), 0.02 * first)]]

    def reported(self, p):
        return np.cumsum(p)

    def plastic_rate(self, p, sigma):
        knots = np.cumsum(p)
        rate = np.interp(sigma, knots, self.rates)
        slopes = np.diff(self.rates) / np.diff(knots)
        i = np.clip(
            np.searchsorted(knots, sigma, side="right") - 1, 0, len(slopes) - 1
        )
        return rate, np.where(sigma < knots[0], 0.0, slopes[i])

    def limit(self, p):
        return float(np.sum(p))

    def entries(self, p):
        rows = "\n".join(
            f"        ({rate:<8.4g} {stress:.6g})"
            for rate, stress in zip(self.rates, np.cumsum(p), strict=True)
        )
        return [
            "interpolation   linear;",
            "",
            "// Plastic strain rate [1/s], flow stress [Pa]; constant beyond",
            f"table\n    (\n{rows}\n    );",
        ]


class HerschelBulkley(RateLaw):
    """sigma0 + k r^n."""

    type = "HerschelBulkley"
    names = ["sigma0", "k", "n"]
    largest = {"n": 1.0}

    def starts(self, curves):
        plateaus = np.array([last_tenth(c) for c in curves])
        first = rest(curves) or 0.6 * plateaus.min()
        rates = np.array([c.rate for c in curves])
        over = np.maximum(plateaus - first, 0.05 * first)
        if np.ptp(np.log(rates)) > 0.3:
            n, log_k = np.polyfit(np.log(rates), np.log(over), 1)
        else:
            n, log_k = 0.3, np.log(over / rates**0.3).mean()
        return [[first, float(np.exp(log_k)), float(np.clip(n, 0.05, 0.95))]]

    def plastic_rate(self, p, sigma):
        sigma0, k, n = p
        over = np.maximum(sigma - sigma0, 1e-9 * sigma0) / k
        # A trial law of the fit may be absurd; no rheometer goes beyond
        over = np.minimum(over, 1e9**n)
        rate = np.where(sigma > sigma0, over ** (1 / n), 0.0)
        return rate, np.where(sigma > sigma0, rate / (n * k * over), 0.0)

    def entries(self, p):
        sigma0, k, n = p
        return [
            f"sigma0          {sigma0:.6g};   // [Pa]",
            f"k               {k:.6g};   // [Pa s^n]",
            f"n               {n:.6g};   // [-]",
        ]


class PowerHardening(Law):
    """sigma_y + H eps_p^m, no rate: the J law if m > 1."""

    type = "powerHardening"
    names = ["sigmaY", "H", "m"]
    largest = {"m": 5.0}

    def starts(self, curves):
        top = max(curves, key=lambda c: c.strain.max())
        last, strain = last_tenth(top), top.strain.max()
        # Bent one way or the other: there is a minimum for each
        return [[0.5 * last, 0.5 * last / strain**0.5, 0.5]] + [
            [share * last, last / strain**m, m]
            for share, m in ((0.1, 1.0), (0.02, 2.0))
        ]

    def monotonic(self, p, strain):
        """Stress [Pa] of a first loading to strains."""
        e, sigma_y, h, m = p
        low, high = np.zeros_like(strain), e * strain
        # sigma - sigma_y - H (strain - sigma/E)^m rises with sigma
        for _ in range(50):
            mid = 0.5 * (low + high)
            over = mid > sigma_y + h * np.maximum(strain - mid / e, 0.0) ** m
            low, high = np.where(over, low, mid), np.where(over, mid, high)
        return np.where(e * strain <= sigma_y, e * strain, 0.5 * (low + high))

    def stress(self, p, histories):
        result = []
        for c in histories.curves:
            largest = np.maximum.accumulate(np.maximum(c.strain, 0.0))
            back = p[0] * (largest - c.strain)
            loaded = self.monotonic(p, largest)
            result.append(np.where(c.segment == 2, loaded - back, loaded))
        return result

    def entries(self, p):
        sigma_y, h, m = p
        return [
            f"sigmaY          {sigma_y:.6g};   // [Pa]",
            f"H               {h:.6g};   // [Pa]",
            f"m               {m:.6g};   // [-]",
        ]
