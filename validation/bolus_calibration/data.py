# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Measured curves: CSV files to equivalent strain and stress in SI units.

A file holds one specimen, or several told apart by a column "specimen".
Separators are commas, semicolons or tabs. The header row names the columns
with their units, in any order; columns with other names are ignored:

    time [s]                               also ms, min
    displacement [mm], force [N]           also m, um; mN, kN, gf
    engineeringStrain [-]                  also %: 1 - H/H0
    strain [-]                             logarithmic
    engineeringStress [kPa]                force over first section; Pa, MPa
    stress [kPa]                           force over present section
    shearStrain [-], shearStress [kPa]     rim of the plates
    rate [1/s]                             of strain or shearStrain; also 1/min
    specimen, segment                      text, without unit

Lines "# name: value unit" before the header hold for the whole file:

    # height: 20 mm        of the specimen, needed with displacement
    # diameter: 20 mm      or area: 314 mm2, needed with force
    # rate: 0.1 1/s        if there is no column and no time

Equations of Skamniotis et al. (2020):

    sigma = |F/A|, A H = A0 H0                           (1), (3)
    epsilon = |ln(H/H0)|                                 (2)
    epsilon = gamma/sqrt(3), sigma = tau sqrt(3)         (4), (5)

What is done with odd data:

- Compression may be positive or negative, in strain and in stress: the largest
  value of each gives its sign. Both signs beyond 10 % of it are an error.
- Rows out of order in time are sorted, and said so; without time, rows whose
  strain goes back are an unloading if there is one turning point, else they
  are sorted.
- An empty row is skipped. A value that is not a finite number is an error.
- Loading, relaxation (the strain stays within 0.2 % of the largest) and
  unloading are found from the strain; a column segment overrides it.
- Without time, time follows from the rate. A relaxation needs time.
- Fewer than 8 rows of a specimen are an error.
"""

import csv
import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

LENGTH = {"m": 1.0, "mm": 1e-3, "um": 1e-6}
STRAIN = {"-": 1.0, "%": 1e-2}
STRESS = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6}
FORCE = {"N": 1.0, "mN": 1e-3, "kN": 1e3, "gf": 9.80665e-3}
TIME = {"s": 1.0, "ms": 1e-3, "min": 60.0}
RATE = {"1/s": 1.0, "1/min": 1 / 60}
AREA = {"m2": 1.0, "mm2": 1e-6, "cm2": 1e-4}

COLUMNS = {
    "time": TIME,
    "displacement": LENGTH,
    "force": FORCE,
    "engineeringStrain": STRAIN,
    "strain": STRAIN,
    "engineeringStress": STRESS,
    "stress": STRESS,
    "shearStrain": STRAIN,
    "shearStress": STRESS,
    "rate": RATE,
}
LABELS = ("specimen", "segment")
NOTES = {"height": LENGTH, "diameter": LENGTH, "area": AREA, "rate": RATE}

SEGMENTS = ("loading", "relaxation", "unloading")
FEWEST_ROWS = 8


class DataError(ValueError):
    """Data that cannot be used: where, what, and what would be valid."""


@dataclass
class Curve:
    """A specimen's equivalent strain and stress, all arrays (n,), SI units."""

    name: str
    kind: str  # compression or shear
    rate: float  # equivalent, of the loading [1/s]
    time: np.ndarray
    strain: np.ndarray
    stress: np.ndarray
    segment: np.ndarray  # of indices into SEGMENTS
    remarks: list[str] = field(default_factory=list)

    def has(self, segment: str) -> bool:
        """Has it rows of this segment?"""
        return bool(np.any(self.segment == SEGMENTS.index(segment)))


def _number(text: str, where: str) -> float:
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


def _columns(names: list[str], where: str) -> dict[str, tuple[int, float]]:
    """Position and scale to SI of each column that is ours."""
    known = {name.lower(): name for name in (*COLUMNS, *LABELS)}
    found = {}
    for i, text in enumerate(names):
        match = re.fullmatch(r"\s*(\w+)\s*(?:[\[(]\s*(.*?)\s*[\])])?\s*", text)
        name = known.get(match.group(1).lower()) if match else None
        if name is None:
            continue
        if name in found:
            raise DataError(f"{where}: two columns {name}")
        if name in LABELS:
            found[name] = (i, 1.0)
            continue
        if match.group(2) is None:
            raise DataError(
                f"{where}: column {name} lacks its unit, as in "
                f"'{name} [{next(iter(COLUMNS[name]))}]'; valid are "
                f"{', '.join(COLUMNS[name])}"
            )
        scale = _unit(COLUMNS[name], match.group(2), f"{where}: column {name}")
        found[name] = (i, scale)
    return found


def _note(line: str, notes: dict, where: str) -> None:
    """A line "# name: value unit"; other comments are free."""
    match = re.fullmatch(r"#\s*(\w+)\s*:\s*(\S+)\s*(\S*)\s*", line)
    if not match or match.group(1).lower() not in NOTES:
        return
    name, number, unit = match.groups()
    name = name.lower()
    value = _number(number, f"{where}: {name}")
    value *= _unit(NOTES[name], unit, f"{where}: {name}")
    if value <= 0:
        raise DataError(f"{where}: {name} is {number}; it must be positive")
    notes[name] = value


def _one_sign(values: np.ndarray, what: str) -> np.ndarray:
    """Magnitudes of values that are of one sign but for a little noise."""
    low, high = -min(values.min(), 0), max(values.max(), 0)
    if max(low, high) == 0:
        raise DataError(f"{what} is zero everywhere")
    if min(low, high) > 0.1 * max(low, high):
        raise DataError(
            f"{what} goes from {values.min():.3g} to {values.max():.3g}: "
            "tension and compression in one specimen; give one of them"
        )
    return values if high > low else -values


def _strain_and_stress(data: dict, notes: dict, where: str):
    """Kind of test, equivalent strain [-] and stress [Pa]."""

    def need(name, what):
        if name not in notes:
            raise DataError(
                f"{where}: {what} needs a line '# {name}: VALUE UNIT'"
            )
        return notes[name]

    shear = "shearStrain" in data and "shearStress" in data
    strains = [
        n for n in ("strain", "engineeringStrain", "displacement") if n in data
    ]
    stresses = [
        n for n in ("stress", "engineeringStress", "force") if n in data
    ]
    if shear:
        if strains or stresses:
            raise DataError(
                f"{where}: shear and compression in one file: "
                f"{', '.join(strains + stresses)} beside the shear columns"
            )
        strain = _one_sign(data["shearStrain"], f"{where}: shearStrain")
        stress = _one_sign(data["shearStress"], f"{where}: shearStress")
        return "shear", strain / np.sqrt(3), stress * np.sqrt(3)
    if len(strains) != 1 or len(stresses) != 1:
        raise DataError(
            f"{where}: it has {', '.join(data) or 'no known column'}; needed "
            "are one of strain, engineeringStrain, displacement and one of "
            "stress, engineeringStress, force; or shearStrain and shearStress"
        )

    given = _one_sign(data[strains[0]], f"{where}: {strains[0]}")
    if strains[0] == "strain":
        strain = given
    else:
        if strains[0] == "displacement":
            given = given / need("height", "displacement")
        if given.max() >= 1:
            raise DataError(
                f"{where}: {strains[0]} reaches {given.max():.3g} of the "
                "height: it must stay below 1 (a percentage has the unit %)"
            )
        strain = -np.log1p(-given)

    stress = _one_sign(data[stresses[0]], f"{where}: {stresses[0]}")
    if stresses[0] == "force":
        if "area" in notes:
            stress = stress / notes["area"]
        else:
            stress = stress / (np.pi / 4 * need("diameter", "force") ** 2)
    if stresses[0] != "stress":
        stress = stress * np.exp(-strain)  # Eq. 3
    return "compression", strain, stress


def _segments(strain, labels, where) -> np.ndarray:
    """Loading 0, relaxation 1, unloading 2 of each row."""
    if labels is not None:
        unknown = set(labels) - set(SEGMENTS)
        if unknown:
            raise DataError(
                f"{where}: unknown segment '{sorted(unknown)[0]}'; valid are "
                f"{', '.join(SEGMENTS)}"
            )
        return np.array([SEGMENTS.index(label) for label in labels])
    near = np.flatnonzero(strain >= 0.998 * strain.max())
    result = np.zeros(len(strain), int)
    # A few rows about the turning point are not a relaxation
    if near[-1] - near[0] >= 4:
        result[near[0] + 1 : near[-1] + 1] = 1
        result[near[-1] + 1 :] = 2
    else:
        result[np.argmax(strain) + 1 :] = 2
    return result


def _curve(name, data, labels, notes, where) -> Curve:
    """A specimen from its columns in SI units."""
    count = len(next(iter(data.values())))
    if count < FEWEST_ROWS:
        raise DataError(
            f"{where}: {count} rows; at least {FEWEST_ROWS} are needed"
        )
    remarks = []

    def rearrange(order, why):
        nonlocal data, labels
        remarks.append(f"{name}: {why}")
        data = {key: values[order] for key, values in data.items()}
        labels = None if labels is None else [labels[i] for i in order]

    if "time" in data and np.any(np.diff(data["time"]) < 0):
        rearrange(np.argsort(data["time"], kind="stable"), "sorted by time")

    kind, strain, stress = _strain_and_stress(data, notes, where)
    if "time" not in data and labels is None:
        # One turning point is an unloading; more is disorder
        steps = np.sign(np.diff(strain))
        steps = steps[steps != 0]
        if np.count_nonzero(np.diff(steps)) > 1:
            rearrange(
                np.argsort(strain, kind="stable"),
                "sorted by strain (no time, and the strain goes to and fro)",
            )
            kind, strain, stress = _strain_and_stress(data, notes, where)
    segment = _segments(strain, labels, where)
    loading = segment == 0
    if np.count_nonzero(loading) < FEWEST_ROWS // 2:
        raise DataError(f"{where}: fewer than {FEWEST_ROWS // 2} rows load it")

    share = 1 / np.sqrt(3) if kind == "shear" else 1.0
    if "time" in data:
        time = data["time"] - data["time"][0]
        if np.ptp(time[loading]) <= 0:
            raise DataError(f"{where}: time stands still while loading")
        rate = np.polyfit(time[loading], strain[loading], 1)[0]
        # What happened before the first row, at the same rate
        time = time + strain[0] / rate if rate > 0 else time
    else:
        if np.any(segment == 1):
            raise DataError(f"{where}: a relaxation needs a column time [s]")
        given = data["rate"][0] if "rate" in data else notes.get("rate")
        if given is None:
            raise DataError(
                f"{where}: no rate: give a column time [s] or rate [1/s], or "
                "a line '# rate: VALUE 1/s'"
            )
        rate = abs(given) * share
        if rate > 0:
            path = np.abs(np.diff(strain, prepend=0.0))
            time = np.cumsum(path) / rate
    if not rate > 0:
        raise DataError(f"{where}: the rate of loading is {rate:.3g}/s")
    return Curve(
        name, kind, float(rate), time, strain, stress, segment, remarks
    )


def read(path) -> list[Curve]:
    """The specimens of a file."""
    path = Path(path)
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise DataError(f"{path}: cannot be read as text: {error}") from error

    notes: dict[str, float] = {}
    columns: dict[str, tuple[int, float]] | None = None
    separator = ","
    rows: dict[str, list[tuple[int, list[str]]]] = {}
    for number, line in enumerate(lines, 1):
        where = f"{path}, line {number}"
        if line.startswith("#"):
            _note(line, notes, where)
            continue
        if not line.strip(",;\t "):
            continue
        if columns is None:
            separator = max(",;\t", key=line.count)
            columns = _columns(
                next(csv.reader([line], delimiter=separator)), where
            )
            continue
        row = [t.strip() for t in next(csv.reader([line], delimiter=separator))]
        if any(i >= len(row) for i, _ in columns.values()):
            raise DataError(f"{where}: {len(row)} values, fewer than columns")
        label = row[columns["specimen"][0]] if "specimen" in columns else ""
        rows.setdefault(label, []).append((number, row))

    if not columns or not rows:
        raise DataError(
            f"{path}: no table; a header row names columns with units, as in "
            "'time [s], displacement [mm], force [N]'"
        )

    curves = []
    for label, table in rows.items():
        name = f"{path.stem} {label}".strip()
        data = {
            column: scale
            * np.array(
                [
                    _number(row[i], f"{path}, line {number}: {column}")
                    for number, row in table
                ]
            )
            for column, (i, scale) in columns.items()
            if column not in LABELS
        }
        labels = (
            [row[columns["segment"][0]] for _, row in table]
            if "segment" in columns
            else None
        )
        curves.append(
            _curve(name, data, labels, notes, f"{path} {label}".strip())
        )
    return curves
