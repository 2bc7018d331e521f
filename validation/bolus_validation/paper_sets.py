# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""What the paper's text leaves open of its stomach: parameters and sets.

A set is {name of a parameter: value}: one stomach that the text allows, with
one reading of its waves. settings() makes the -set entries of a case of it,
fault() says what of the text it breaks.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator

from bolus_validation.motility import PROFILE

BOLUS_RADIUS = 12.8  # [mm]
VOLUME = 0.88e6  # of the stomach [mm3]
SHELL = 210.0  # x_1: the bolus lies beyond it [mm]
PYLORUS = 250.0  # [mm]
PYLORUS_RADIUS = 6.0  # [mm]

# Upstream radii, 30 to 180 mm, are scaled to the volume, by at most this
MOST_UPSTREAM = 0.02


@dataclass(frozen=True)
class Parameter:
    """One thing that is open.

    values   (lowest, highest), or the choices of a reading
    text     what the paper's text has about it
    """

    name: str
    label: str
    unit: str
    values: tuple
    text: str

    @property
    def choice(self) -> bool:
        """Is it one of several readings?"""
        return isinstance(self.values[0], str) or len(self.values) != 2


def _radius(x: int, low: float, high: float, text: str) -> Parameter:
    return Parameter(f"r{x}", f"radius at {x} mm", "mm", (low, high), text)


PARAMETERS = (
    _radius(220, 13.4, 16.8, "no number; room for the sphere of 12.8 mm"),
    _radius(
        230,
        11.8,
        15.5,
        "no number; much of the wall lies outside 13.5 mm at the start",
    ),
    _radius(240, 8.2, 13.4, "no number"),
    _radius(245, 6.9, 10.6, "no number; 6 mm at 250 mm"),
    Parameter(
        "centre",
        "place of the bolus",
        "mm",
        (222.8, 227.0),
        "no number; between the shell at 210 mm and the wave at 7.5 s",
    ),
    Parameter(
        "full",
        "wave 0.9 deep from",
        "mm",
        (232.0, 240.0),
        "at 240 mm. Its front is there when its tip is at 233 to 234 mm",
    ),
    Parameter(
        "grows",
        "depth of the wave",
        "",
        ("position", "travel"),
        "Eq. 15: by place on the wall; in words the wave grows",
    ),
    Parameter(
        "times",
        "timeline",
        "",
        ("closes 16 s", "closes 18 s", "tail"),
        "Eq. 14 moves the wave's tail; the pylorus closes when the wave is at "
        "240 mm, which is at 16 s (centre) or 17.6 s (tail), and at 18 s",
    ),
    Parameter(
        "tensile",
        "strain under tension",
        "-",
        ("0", "0.1"),
        "strain above 0.25, no matter how it came about; in words tensile "
        "strain breaks the bolus",
    ),
    Parameter(
        "cohesion",
        "cohesion of broken bolus",
        "Pa",
        (5.0, 100.0),
        "none; ours is artificial",
    ),
    Parameter(
        "shell",
        "friction of the shell",
        "",
        ("as the wall", "none"),
        "not said",
    ),
    Parameter(
        "inertia",
        "density over that of food",
        "-",
        ("0", "100"),
        "1.1 g/mL, and 1.1e-7 t/mm3, which is a hundred times that",
    ),
)

# The case as its tutorial has it
TUTORIAL = {
    "r220": 14.8,
    "r230": 12.3,
    "r240": 9.2,
    "r245": 7.5,
    "centre": 222.8,
    "full": 240.0,
    "grows": "position",
    "times": "closes 16 s",
    "tensile": "0",
    "cohesion": 100.0,
    "shell": "as the wall",
    "inertia": "0",
}


def _with(radii, centre, full, **others) -> dict:
    names = ("r220", "r230", "r240", "r245")
    found = dict(zip(names, radii, strict=True))
    return TUTORIAL | found | {"centre": centre, "full": full} | others


# Where a search begins: the tutorial, what a first random search found best,
# and these antra and narrower ones by the other timelines
STARTS = (
    TUTORIAL,
    _with((15.8, 14.8, 11.3, 8.1), 223.5, 234.0, grows="travel"),
    _with((15.7, 14.8, 12.3, 9.4), 224.5, 234.0, grows="travel", shell="none"),
    _with((16.1, 13.6, 10.6, 8.6), 226.0, 234.0, grows="travel"),
    _with((15.9, 14.3, 12.6, 9.2), 224.5, 236.0, grows="travel", shell="none"),
    _with((15.8, 14.8, 11.3, 8.1), 223.5, 240.0, times="closes 18 s"),
    _with((15.7, 14.8, 12.3, 9.4), 222.8, 236.0, times="closes 18 s"),
    _with((15.8, 14.8, 11.3, 8.1), 223.5, 236.0, times="tail"),
    _with(
        (15.9, 14.3, 12.6, 9.2),
        222.8,
        234.0,
        times="closes 18 s",
        tensile="0.1",
    ),
    _with(
        (15.8, 14.8, 11.3, 8.1),
        223.5,
        234.0,
        grows="travel",
        inertia="100",
        cohesion=10.0,
    ),
    _with((15.7, 14.8, 12.3, 9.4), 222.8, 234.5, times="closes 18 s"),
    _with((14.6, 13.6, 12.0, 9.4), 222.8, 235.5, times="closes 18 s"),
    _with(
        (15.7, 14.8, 12.3, 9.4),
        222.8,
        233.0,
        times="closes 18 s",
        shell="none",
        cohesion=20.0,
    ),
    _with((13.9, 12.8, 11.4, 9.0), 222.8, 233.0),
    # Close about the sphere, narrowing late
    _with(
        (14.2, 13.8, 12.6, 9.8),
        222.8,
        234.5,
        times="closes 18 s",
        cohesion=15.0,
    ),
    _with((14.2, 13.8, 12.6, 9.8), 222.8, 233.0, cohesion=30.0),
    _with((13.9, 12.8, 11.4, 9.0), 222.8, 233.0, cohesion=12.0),
    _with(
        (14.0, 13.9, 13.2, 10.4),
        222.8,
        235.0,
        times="closes 18 s",
        cohesion=30.0,
    ),
    # ... and break by strain under tension
    _with((13.42, 12.46, 11.83, 8.72), 223.46, 232.93, tensile="0.1"),
    _with((14.2, 13.8, 12.6, 9.8), 222.8, 233.0, cohesion=30.0, tensile="0.1"),
    _with(
        (13.42, 12.46, 11.83, 8.72),
        223.46,
        232.93,
        tensile="0.1",
        cohesion=45.0,
    ),
    _with((13.7, 13.0, 12.1, 9.1), 223.2, 233.0, tensile="0.1", cohesion=50.0),
    _with((13.9, 13.3, 12.3, 9.4), 223.0, 232.7, tensile="0.1", cohesion=30.0),
    _with((13.5, 12.7, 12.0, 9.0), 223.4, 233.4, tensile="0.1", cohesion=60.0),
    # ... and part in two on 0.5 mm
    _with((14.2, 13.8, 12.6, 9.8), 222.8, 232.8, cohesion=30.0),
    # ... and to the text's words: 0.9 from 240 mm on
    _with((13.42, 12.46, 11.83, 8.72), 223.46, 240.0, tensile="0.1"),
    _with(
        (13.42, 12.46, 11.83, 8.72),
        223.46,
        240.0,
        tensile="0.1",
        times="closes 18 s",
    ),
    _with((13.42, 12.46, 11.83, 8.72), 223.46, 236.5, tensile="0.1"),
)


def radii(chosen: dict, upstream: float = 1.0) -> np.ndarray:
    """The table of the wall, x and r [mm], upstream radii scaled."""
    table = 1e3 * PROFILE
    scaled = (table[:, 0] >= 30) & (table[:, 0] <= 180)
    table[scaled, 1] *= upstream
    for x in (220, 230, 240, 245):
        table[table[:, 0].round() == x, 1] = chosen[f"r{x}"]
    return table


def volume(table: np.ndarray) -> float:
    """Of the stomach that a table describes, to the pylorus [mm3]."""
    x = np.linspace(0, PYLORUS, 2001)
    area = np.pi * PchipInterpolator(*table.T)(x) ** 2
    return float(np.trapezoid(area, x))


def profile(chosen: dict) -> np.ndarray:
    """The table of the wall [mm] of which the volume is the paper's."""
    low, high = (volume(radii(chosen, s)) for s in (0.98, 1.02))
    # Nearly linear in so small a range: two secants
    scale = 0.98 + 0.04 * (VOLUME - low) / (high - low)
    slope = (high - low) / 0.04
    scale += (VOLUME - volume(radii(chosen, scale))) / slope
    table = radii(chosen, scale)
    return table.round(5)


def fault(chosen: dict) -> str | None:
    """What of the text a set breaks; None: nothing."""
    table = profile(chosen)
    x, r = table.T
    beyond = r[x >= 200]
    if np.any(np.diff(beyond) >= 0):
        return "the antrum does not narrow towards the pylorus"
    if r[x == PYLORUS][0] != PYLORUS_RADIUS:
        return "6 mm at the pylorus"
    if abs(volume(table) / VOLUME - 1) > 1e-4:
        return "0.88 L"
    upstream = r[x == 60][0] / (1e3 * PROFILE[PROFILE[:, 0] == 0.06, 1][0])
    if abs(upstream - 1) > MOST_UPSTREAM:
        return "0.88 L by upstream radii that are hardly changed"
    centre = chosen["centre"]
    if centre - BOLUS_RADIUS < SHELL - 1e-9:
        return "the bolus would lie in the shell"
    places = centre + np.linspace(-1, 1, 401) * BOLUS_RADIUS
    sphere = np.sqrt(np.maximum(BOLUS_RADIUS**2 - (places - centre) ** 2, 0))
    if np.any(PchipInterpolator(x, r)(places) < sphere):
        return "no room for the sphere"
    return None


# Reading of Eq. 14, times at which the pylorus closes and opens [s], place
# from which wave 0 fades, within 5 mm [mm]
TIMES = {
    "closes 16 s": ("centre", 16.0, 25.6, 240),
    "closes 18 s": ("centre", 18.0, 25.6, 245),
    "tail": ("tail", 17.5, 27.1, 240),
}

MOTILITY = "constant/motilityProperties:"
BOLUS = "constant/bolusProperties:"


def settings(chosen: dict) -> dict:
    """-set entries of a set."""
    rows = " ".join(
        f"({x * 1e-3:.3f} {r * 1e-3:.8f})" for x, r in profile(chosen)
    )
    reading, closes, opens, fades = TIMES[chosen["times"]]
    found = {
        MOTILITY + "profile.radius": f"({rows})",
        MOTILITY + "waves.occlusion": "((0.210 0) "
        f"({chosen['full'] * 1e-3:.5f} 0.9))",
        MOTILITY + "waves.occlusionBy": chosen["grows"],
        MOTILITY + "waves.fadeOut.wave0.from": f"{fades * 1e-3:.3f}",
        MOTILITY + "waves.fadeOut.wave0.to": f"{fades * 1e-3 + 0.005:.3f}",
        "reading": reading,
        "closedBetween": f"({closes + 0.1:g} {opens:g})",
        "bolusCentre": f"({chosen['centre'] * 1e-3:.5f} 0 0)",
        "tensileStrain": chosen["tensile"],
        "inertia": chosen["inertia"],
        BOLUS + "gasCoeffs.cohesion": f"{chosen['cohesion']:.4g}",
    }
    if chosen["times"] == "closes 18 s":
        found[MOTILITY + "sphincter.trigger"] = (
            f"{{ type schedule; closeTimes ({closes:g}); "
            f"openTimes ({opens:g}); }}"
        )
    if chosen["shell"] == "none":
        found["shellFriction"] = "none"
    return found


def text(parameter: Parameter, chosen: dict) -> str:
    """A value of a set, as it is shown."""
    found = chosen[parameter.name]
    if isinstance(found, str):
        return found
    digits = 1 if math.log10(abs(found) + 1e-9) > 0.5 else 2
    return f"{found:.{digits}f}"
