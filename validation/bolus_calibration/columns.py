# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Names and units of the columns and notes of a file: see data.py."""

import re

import numpy as np

LENGTH = {"m": 1.0, "mm": 1e-3, "um": 1e-6}
STRAIN = {"-": 1.0, "%": 1e-2}
STRESS = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6}
FORCE = {"N": 1.0, "mN": 1e-3, "kN": 1e3, "gf": 9.80665e-3}
TIME = {"s": 1.0, "ms": 1e-3, "min": 60.0}
RATE = {
    "1/s": 1.0,
    "s-1": 1.0,
    "s^-1": 1.0,
    "%/s": 1e-2,
    "1/min": 1 / 60,
    "%/min": 1e-2 / 60,
}
AREA = {"m2": 1.0, "mm2": 1e-6, "cm2": 1e-4}

COLUMNS = {
    "time": TIME,
    "displacement": LENGTH,
    "force": FORCE,
    "engineeringStrain": STRAIN,
    "trueStrain": STRAIN,
    "engineeringStress": STRESS,
    "trueStress": STRESS,
    # Of which the header does not say what they are
    "strain": STRAIN,
    "stress": STRESS,
    "shearStrain": STRAIN,
    "shearStress": STRESS,
    "rate": RATE,
}
LABELS = ("specimen", "segment")
NOTES = {"height": LENGTH, "diameter": LENGTH, "area": AREA, "rate": RATE}

# Columns by the words of their names, in any order
WORDS = {
    **{
        frozenset((word, kind)): name + kind.capitalize()
        for kind, words in (
            ("strain", ("true", "logarithmic", "log", "hencky", "natural")),
            ("stress", ("true", "cauchy")),
        )
        for name, synonyms in (
            ("true", words),
            ("engineering", ("engineering", "nominal")),
        )
        for word in synonyms
    },
    frozenset(("shear", "strain")): "shearStrain",
    frozenset(("shear", "stress")): "shearStress",
    frozenset(("strain", "rate")): "rate",
    frozenset(("shear", "rate")): "rate",
    **{
        frozenset((name,)): name
        for name in (*COLUMNS, *LABELS)
        if name.islower()
    },
}


class DataError(ValueError):
    """Data that cannot be used: where, what, and what would be valid."""


def read_number(text: str, where: str) -> float:
    """A finite number."""
    try:
        value = float(text)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise DataError(f"{where}: '{text}' is not a finite number")
    return value


def _unit(units: dict, unit: str, where: str) -> float:
    if unit not in units:
        raise DataError(
            f"{where}: unknown unit '{unit}'; valid are {', '.join(units)}"
        )
    return units[unit]


def find_columns(names: list[str], where: str) -> dict[str, tuple[int, str]]:
    """Position and unit of each column that is ours."""
    found = {}
    for i, text in enumerate(names):
        match = re.fullmatch(r"\s*(.*?)\s*(?:[\[(]([^\[\]()]*)[\])])?\s*", text)
        words = re.findall(r"[A-Z]?[a-z]+|[A-Z]+", match.group(1))
        name = WORDS.get(frozenset(word.lower() for word in words))
        if name is None:
            continue
        if name in found:
            raise DataError(f"{where}: two columns {name}")
        if name in LABELS:
            found[name] = (i, "")
            continue
        if match.group(2) is None:
            raise DataError(
                f"{where}: column {name} lacks its unit, as in "
                f"'{name} [{next(iter(COLUMNS[name]))}]'; valid are "
                f"{', '.join(COLUMNS[name])}"
            )
        unit = match.group(2).strip()
        _unit(COLUMNS[name], unit, f"{where}: column {name}")
        found[name] = (i, unit)
    return found


def read_note(line: str, notes: dict, where: str) -> None:
    """A line "# name: value unit"; other comments are free."""
    match = re.fullmatch(r"#\s*(\w+)\s*[:=]\s*(\S+)\s*(\S*)\s*", line)
    if not match or match.group(1).lower() not in NOTES:
        return
    name, number, unit = match.groups()
    name = name.lower()
    value = read_number(number, f"{where}: {name}")
    value *= _unit(NOTES[name], unit, f"{where}: {name}")
    if value <= 0:
        raise DataError(f"{where}: {name} is {number}; it must be positive")
    if notes.get(name, value) != value:
        raise DataError(f"{where}: a second {name}, other than the first")
    notes[name] = value
