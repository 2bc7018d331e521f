# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The moving stomach wall of Skamniotis et al. (2020), Eqs. 12 to 15.

Written from the equations and independent of src/motility, which is tested
against it. All lengths in m, times in s.
"""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.optimize import brentq

# Radius of the relaxed wall, x and r [m]. Not printed in the paper: made to
# meet what it says (6 mm at 0.250 m, 0.88 L, room for the bolus).
PROFILE = 1e-3 * np.array(
    [
        [0, 0],
        [4, 16.4],
        [12, 28.0],
        [30, 39.6],
        [60, 45.9],
        [95, 44.4],
        [125, 38.2],
        [155, 30.0],
        [180, 23.7],
        [200, 19.5],
        [210, 17.0],
        [220, 14.8],
        [230, 12.3],
        [240, 9.2],
        [245, 7.5],
        [250, 6.0],
    ]
)


@dataclass(frozen=True)
class Motility:
    """The paper's motility; every parameter can be changed.

    x_1, x_p, x_m   start of the waves, begin of the pylorus, trigger [m]
    speed           of the waves [m/s]
    distance        between waves [m]
    n_waves         number of waves
    lam_1, lam_p    wavelengths at x_1 and x_p, linear between [m]
    c_m             occlusion at x_m, rising linearly from 0 at x_1 [-]
    a               exponent of the waves [-]
    fade            length beyond x_m on which wave 0 dies out [m]
    c_by, fade_by   where the rise and the fade-out are taken: "position",
                    on the wall; "travel", at the wave's tip
    reading         of Eq. 14: "centre" or "tail" moves with the speed
    lam_s, a_s, c_s length [m], exponent, occlusion of the open sphincter [-]
    rate            of closing and opening [1/s]
    ramp            "smooth" or "linear"
    gap             smallest radius [m]
    interpolation   of the profile: "monotoneCubic" or "linear"
    """

    x_1: float = 0.210
    x_p: float = 0.250
    x_m: float = 0.240
    speed: float = 2.5e-3
    distance: float = 0.024
    n_waves: int = 2
    lam_1: float = 0.020
    lam_p: float = 0.010
    c_m: float = 0.9
    a: float = 5
    fade: float = 0.005
    c_by: str = "position"
    fade_by: str = "travel"
    reading: str = "centre"
    lam_s: float = 0.004
    a_s: float = 2
    c_s: float = 0.75
    rate: float = 10
    ramp: str = "smooth"
    gap: float = 2e-5
    interpolation: str = "monotoneCubic"

    def profile(self, x):
        """Radius of the relaxed stomach without the sphincter [m]."""
        x = np.asarray(x, dtype=float)
        if self.interpolation == "linear":
            return np.interp(x, *PROFILE.T)
        last = PROFILE[-1, 0]
        return PchipInterpolator(*PROFILE.T)(np.minimum(x, last))

    def open_radius(self, x):
        """Eq. 12: radius before any motion [m]."""
        x = np.asarray(x, dtype=float)
        r_p = self.profile(self.x_p)
        beyond = r_p * (1 - self.c_s * self._b(x))
        return np.where(x > self.x_p, beyond, self.profile(x))

    def _b(self, x):
        """[x' (lam_s - x')]^a_s (lam_s/2)^(-2 a_s), 0 outside [-]."""
        local = np.clip(np.asarray(x) - self.x_p, 0, self.lam_s)
        product = local * (self.lam_s - local)
        return product**self.a_s * (self.lam_s / 2) ** (-2 * self.a_s)

    def wavelength(self, x):
        """lam(x) [m]."""
        ends = [self.x_1, self.x_p]
        return np.interp(x, ends, [self.lam_1, self.lam_p])

    def xi(self, i, x, t):
        """Eq. 14: place within wave i, 0 at its tail, lam(x) at its head [m].

        The reading "tail" is the equation as printed (with k lam(x_1) =
        distance); in "centre", x_1 - lam_1/2 - i distance + speed t is where
        xi = lam/2.
        """
        if self.reading == "tail":
            shift = i * self.distance + self.lam_1
            return x - self.x_1 + shift - self.speed * t
        centre = self.x_1 - self.lam_1 / 2 - i * self.distance
        return x - centre - self.speed * t + self.wavelength(x) / 2

    def tip(self, i, t):
        """Where xi = lam/2, for wave i [m]."""
        return brentq(
            lambda x: self.xi(i, x, t) - self.wavelength(x) / 2,
            -1,
            2,
            xtol=1e-15,
        )

    def arrival(self, i, x):
        """When the tip of wave i is at x [s]."""
        return brentq(lambda t: self.tip(i, t) - x, -100, 500, xtol=1e-12)

    def occlusion(self, i, x, t):
        """Eq. 15: fraction of the open radius that wave i takes away [-]."""
        x = np.asarray(x, dtype=float)
        lam = self.wavelength(x)
        xi = np.clip(self.xi(i, x, t), 0, lam)
        tip = self.tip(i, t)
        place = tip if self.c_by == "travel" else x
        c = np.interp(place, [self.x_1, self.x_m], [0, self.c_m])
        if i == 0:
            place = tip if self.fade_by == "travel" else x
            ends = [self.x_m, self.x_m + self.fade]
            c = c * np.interp(place, ends, [1, 0])
        return c * (xi * (lam - xi)) ** self.a * (lam / 2) ** (-2 * self.a)

    def closure(self, t):
        """Eq. 13, C_s t: 0 open to 1 closed [-]; closed by wave 0 at x_m,
        opened by wave 1."""

        def ramp(start):
            s = np.clip(self.rate * (t - start), 0, 1)
            return s if self.ramp == "linear" else s**2 * (3 - 2 * s)

        closing = ramp(self.arrival(0, self.x_m))
        return closing - ramp(self.arrival(1, self.x_m))

    def radius(self, x, t):
        """Radius of the wall at x (array) and time t (number) [m]."""
        r = self.open_radius(x)
        moved = r.copy()
        for i in range(self.n_waves):
            moved -= r * self.occlusion(i, x, t)
        throat = self.profile(self.x_p) * (1 - self.c_s)
        moved -= self.closure(t) * throat * self._b(x)
        return np.maximum(moved, self.gap)

    def sector_volume(self, x, t, angle):
        """Volume of a mesh with planes at x (sorted) in a wedge of an angle
        [rad], whose wall is straight between the planes and flat across [m3].
        """
        r = self.radius(x, t)
        squares = (r[:-1] ** 2 + r[:-1] * r[1:] + r[1:] ** 2) / 3
        return np.sin(angle) / 2 * np.sum(np.diff(x) * squares)
