# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""At what a run is looked, and how results.json holds its numbers."""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bolus_results.fields import Case

# A written field stands for a time if it is this near [s]: a wave moves by
# 0.1 mm in it
TIME_TOLERANCE = 0.04


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


def number_at(results: dict, path: str) -> dict | None:
    """The number of results.json at a path, None if there is none."""
    found = results
    for key in path.split("."):
        if not isinstance(found, dict) or key not in found:
            return None
        found = found[key]
    return found
