# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Independent theory of the bolus in homogeneous deformation.

Exact solutions where there are any, else the rate equations integrated by a
classical Runge-Kutta method: nothing of the solver's time integration (radial
return, backward Euler, Cayley rotation) is used here.

Uniaxial stress, logarithmic strain, magnitudes (the equations are the same in
tension and compression, and independent of Poisson's ratio):

    d(sigma)/dt = E (strain_rate - r),   d(eps_p)/dt = r

Simple shear dU_x/dy = gamma', Jaumann rate, deviatoric stress s:

    ds/dt = W s - s W + 2 G (D - 3 r/(2 q) s),   q = sqrt(3/2 s:s)

with D + [s, [s, D]]/(12 G^2) for D where the law goes with the logarithmic rate
(of its series the two terms that the solver takes: see elastoViscoPlastic.H),
and r the plastic rate [1/s] at which the flow stress is q, or, for a law
without rate dependence, that of the consistency condition.
"""

from dataclasses import dataclass

import numpy as np

# Oatcake bolus of Skamniotis et al. (2020), SI units
E = 100e3
NU = 0.49
G = E / (2 * (1 + NU))
K = E / (3 * (1 - 2 * NU))
RATES = np.array([0.0, 0.01, 0.1, 1.0])
STRESSES = np.array([4100.0, 7000.0, 9600.0, 15200.0])


@dataclass
class Tabulated:
    """Flow stress from a table.

    rates      plastic strain rates [1/s], from 0 on, rising
    stresses   flow stresses [Pa]
    logarithmic   interpolation in ln(rate), but for the first interval
    """

    rates: np.ndarray
    stresses: np.ndarray
    logarithmic: bool = False

    def rate(self, q, eps_p=0.0):
        """Plastic rate [1/s] at a von Mises stress q [Pa] below the last."""
        if q <= self.stresses[0]:
            return 0.0
        i = int(np.searchsorted(self.stresses, q, side="right")) - 1
        i = min(i, len(self.rates) - 2)
        part = (q - self.stresses[i]) / (
            self.stresses[i + 1] - self.stresses[i]
        )
        if self.logarithmic and i > 0:
            return self.rates[i] * (self.rates[i + 1] / self.rates[i]) ** part
        return self.rates[i] + part * (self.rates[i + 1] - self.rates[i])


@dataclass
class HerschelBulkley:
    """Flow stress sigma0 + k rate^n [Pa]."""

    sigma0: float = 4100.0
    k: float = 11000.0
    n: float = 0.29

    def rate(self, q, eps_p=0.0):
        """Plastic rate [1/s] at a von Mises stress q [Pa]."""
        return (max(q - self.sigma0, 0.0) / self.k) ** (1 / self.n)


@dataclass
class PowerHardening:
    """Flow stress sigma_y + h min(eps_p, ends)^m [Pa], whatever the rate.

    logarithmic_rate    of stress, as in the tutorials; else Jaumann's
    """

    sigma_y: float = 100.0
    h: float = 11780.0
    m: float = 2.0
    ends: float = np.inf
    logarithmic_rate: bool = True

    def stress(self, eps_p):
        """Flow stress [Pa] at a plastic strain."""
        return self.sigma_y + self.h * min(eps_p, self.ends) ** self.m

    def slope(self, eps_p):
        """d(flow stress)/d(plastic strain) [Pa]."""
        if eps_p > self.ends:
            return 0.0
        return self.h * self.m * eps_p ** (self.m - 1)


def uniaxial_tabulated(law, strain_rate, times, sigma=0.0):
    """Exact stress [Pa] at times [s], shape (n,), from sigma at time 0.

    Loading at a constant strain_rate [1/s], or relaxation at strain_rate 0.
    The stress is inside one interval of the table at a time; there the rate
    equation is linear (or logistic, with logarithmic interpolation).
    """
    stresses = np.concatenate(([0.0], law.stresses))
    rates = np.concatenate(([0.0], law.rates))
    result = np.empty(len(times))
    now, k = 0.0, 0

    while k < len(times):
        # The interval that the stress is in, or moves into
        rising = strain_rate > law.rate(sigma)
        i = int(
            np.searchsorted(stresses, sigma, side="right" if rising else "left")
        )
        i = min(max(i, 1), len(stresses) - 1) - 1
        edge = stresses[i + 1] if rising else stresses[i]
        span = stresses[i + 1] - stresses[i]

        if i == 0:  # elastic

            def solution(t, s=sigma):
                return s + E * strain_rate * t

            until = (
                (edge - sigma) / (E * strain_rate) if strain_rate else np.inf
            )
        elif law.logarithmic and i > 1:
            b = span / np.log(rates[i + 1] / rates[i])
            r0 = law.rate(sigma)
            scale, base = b, rates[i]

            def solution(t, r0=r0, b=b, base=base, s0=stresses[i]):
                # 1/r is linear in exp(-E strain_rate t/b)
                if strain_rate:
                    decay = np.exp(-E * strain_rate * t / b)
                    inverse = (1 - decay) / strain_rate + decay / r0
                else:
                    inverse = 1 / r0 + E * t / b
                return s0 - b * np.log(base * inverse)

            # 1/r at the edge, solved for t
            target = 1 / (base * np.exp((edge - stresses[i]) / scale))
            if strain_rate:
                decay = (target - 1 / strain_rate) / (1 / r0 - 1 / strain_rate)
                until = (
                    -scale / (E * strain_rate) * np.log(decay)
                    if decay > 0
                    else np.inf
                )
            else:
                until = (target - 1 / r0) * scale / E
        else:
            eta = span / (rates[i + 1] - rates[i])
            end = stresses[i] + eta * (strain_rate - rates[i])

            def solution(t, s=sigma, end=end, eta=eta):
                return end + (s - end) * np.exp(-E * t / eta)

            ratio = (edge - end) / (sigma - end) if sigma != end else 0.0
            until = -eta / E * np.log(ratio) if 0 < ratio < 1 else np.inf

        while k < len(times) and times[k] <= now + until:
            result[k] = solution(times[k] - now)
            k += 1
        now += until
        sigma = edge

    return result


def uniaxial_rate_law(law, strain_rate, times, sigma=0.0, substeps=200):
    """Stress [Pa] at times [s], shape (n,), by Runge-Kutta.

    law.rate(q) is the plastic rate [1/s] at the stress q [Pa].
    """

    def slope(s):
        return E * (strain_rate - law.rate(s))

    result = np.empty(len(times))
    now = 0.0
    for k, time in enumerate(times):
        h = (time - now) / substeps
        for _ in range(substeps):
            k1 = slope(sigma)
            k2 = slope(sigma + h / 2 * k1)
            k3 = slope(sigma + h / 2 * k2)
            k4 = slope(sigma + h * k3)
            sigma += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        now = time
        result[k] = sigma
    return result


def relaxation_herschel_bulkley(law, times, sigma):
    """Exact stress [Pa] at times [s] of a held strain, from sigma at 0."""
    power = 1 - 1 / law.n
    over = (sigma - law.sigma0) ** power - power * E * law.k ** (
        -1 / law.n
    ) * np.asarray(times)
    return law.sigma0 + over ** (1 / power)


def uniaxial_power_hardening(law, strains):
    """Exact stress [Pa] at total strains >= 0, shape (n,): a bisection of
    sigma = sigma_y + h (strain - sigma/E)^m, and E strain before yield."""
    result = np.empty(len(strains))
    for i, strain in enumerate(strains):
        low, high = 0.0, E * strain
        if high > law.sigma_y:
            for _ in range(200):
                mid = 0.5 * (low + high)
                if mid < law.stress(strain - mid / E):
                    low = mid
                else:
                    high = mid
        result[i] = high
    return result


def simple_shear(law, gamma_rate, times, stress=None, eps_p=0.0, step=2e-4):
    """State in simple shear at times [s], shape (n,), by Runge-Kutta.

    law          anything with rate(q), or a PowerHardening
    gamma_rate   dU_x/dy [1/s], 0 to hold, < 0 to unload
    stress, eps_p   at time 0: deviator [Pa], shape (3, 3), plastic strain
    step         largest increment of gamma and of the plastic strain

    Returns the deviators [Pa], shape (n, 3, 3), and plastic strains, (n,).
    """
    s = np.zeros((3, 3)) if stress is None else np.array(stress, float)
    gradient = np.zeros((3, 3))
    gradient[0, 1] = gamma_rate
    d = 0.5 * (gradient + gradient.T)
    w = 0.5 * (gradient - gradient.T)

    hardening = isinstance(law, PowerHardening)

    def equivalent(s):
        return np.sqrt(1.5 * np.sum(s * s))

    def plastic_rate(s, eps_p, plastic):
        q = equivalent(s)
        if not hardening:
            return law.rate(q, eps_p)
        if not plastic:
            return 0.0
        return 3 * G / q * np.sum(s * d) / (3 * G + law.slope(eps_p))

    def slope(s, eps_p, plastic):
        r = plastic_rate(s, eps_p, plastic)
        flow = 1.5 * r / equivalent(s) * s if r > 0 else 0.0
        turned = 0.0
        if hardening and law.logarithmic_rate:
            turned = (s @ s @ d - 2 * s @ d @ s + d @ s @ s) / (12 * G**2)
        return w @ s - s @ w + 2 * G * (d + turned - flow), r

    def runge_kutta(s, eps_p, h, plastic):
        a1, r1 = slope(s, eps_p, plastic)
        a2, r2 = slope(s + h / 2 * a1, eps_p + h / 2 * r1, plastic)
        a3, r3 = slope(s + h / 2 * a2, eps_p + h / 2 * r2, plastic)
        a4, r4 = slope(s + h * a3, eps_p + h * r3, plastic)
        return (
            s + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4),
            eps_p + h / 6 * (r1 + 2 * r2 + 2 * r3 + r4),
        )

    def step_from(s, eps_p, h):
        """A step of at most h that ends where plastic flow begins."""
        if not hardening:
            return *runge_kutta(s, eps_p, h, True), h
        yields = equivalent(s) > law.stress(eps_p) * (1 - 1e-9)
        if yields and np.sum(s * d) > 0:
            return *runge_kutta(s, eps_p, h, True), h
        end, _ = runge_kutta(s, eps_p, h, False)
        if not yields and equivalent(end) > law.stress(eps_p):
            low, high = 0.0, h
            for _ in range(60):
                h = 0.5 * (low + high)
                end, _ = runge_kutta(s, eps_p, h, False)
                if equivalent(end) > law.stress(eps_p):
                    high = h
                else:
                    low = h
        return end, eps_p, h

    stresses = np.empty((len(times), 3, 3))
    strains = np.empty(len(times))
    now = 0.0
    for k, time in enumerate(times):
        while now < time:
            r = 0.0 if hardening else law.rate(equivalent(s))
            h = min(time - now, step / max(r, abs(gamma_rate), 1e-12))
            # In a hold the rates fall, so that h may grow with time: keep
            # it well below the shortest relaxation time of the laws
            h = min(h, 2e-2 * (1 + now) if gamma_rate == 0 else h)
            s, eps_p, h = step_from(s, eps_p, h)
            now = time if time - now - h < 1e-12 * (1 + time) else now + h
        stresses[k] = s
        strains[k] = eps_p
    return stresses, strains


def steady_shear(q):
    """Exact steady state of simple shear at a flow stress q [Pa].

    Returns the shear stress [Pa] and the plastic rate over gamma_rate/sqrt(3):
    both are q/sqrt(3) and 1 times the same cosine, of the angle by which the
    Jaumann rate turns the elastic strain out of the shear plane.
    """
    cosine = np.sqrt(1 - q**2 / (3 * G**2))
    return q / np.sqrt(3) * cosine, cosine
