# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Measured curves: CSV files to equivalent strain and stress in SI units.

A file holds one specimen, or several told apart by a column "specimen".
Separators are commas, semicolons or tabs. The header row names the columns
with their units, in any order; a note names the columns that are not used:

    time [s]                               also ms, min
    displacement [mm], force [N]           also m, um; mN, kN, gf
    engineeringStrain [-]                  also %: 1 - H/H0
    trueStrain [-]                         |ln(H/H0)|
    engineeringStress [kPa]                force over first section; Pa, MPa
    trueStress [kPa]                       force over present section
    shearStrain [-], shearStress [kPa]     rim of the plates
    rate [1/s]                             of that strain; also %/s, 1/min
    specimen, segment                      text, without unit

Words may stand apart, in any order: "True strain". Nominal is engineering;
logarithmic, Hencky and natural strain, and Cauchy stress, are true. A strain or
stress of which the header says neither is taken as engineering, and a note says
so. The rate is that of the strain as it is given, of displacement over height.

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
- An empty row is skipped. A value that is not a finite number is an error, and
  a row of more or fewer values than columns (decimal commas).
- A true strain beyond 4 or a shear strain beyond 20, which would be a
  percentage, is an error; a percentage that stays below 2 is noted.
- Two rates, areas or notes that contradict each other are an error.
- Loading, relaxation (the strain stays within 0.2 % of the largest) and
  unloading are found from the strain; a column segment overrides it.
- Without time, time follows from the rate. A relaxation needs time.
- A first row beyond a fifth of the largest strain is noted: the strain is
  taken as that since the specimen was unloaded.
- Fewer than 8 rows of a specimen are an error.
"""

import csv
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from bolus_calibration.columns import (
    COLUMNS,
    LABELS,
    DataError,
    find_columns,
    read_note,
    read_number,
)

# Largest strains that are no percentages
LARGEST_STRAIN = 4.0
LARGEST_SHEAR = 20.0

SEGMENTS = ("loading", "relaxation", "unloading")
FEWEST_ROWS = 8


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


def _section(notes: dict, where: str) -> float:
    """Area of the first section [m2]."""
    areas = [notes["area"]] if "area" in notes else []
    if "diameter" in notes:
        areas.append(np.pi / 4 * notes["diameter"] ** 2)
    if not areas:
        raise DataError(
            f"{where}: force needs a line '# diameter: VALUE UNIT' or '# area: "
            "VALUE UNIT'"
        )
    if max(areas) > 1.01 * min(areas):
        raise DataError(
            f"{where}: the area is {areas[0]:.4g} m2, but by the diameter "
            f"{areas[1]:.4g} m2; give one of them"
        )
    return areas[0]


def _strain_and_stress(data: dict, notes: dict, where: str):
    """Kind of test, strain as given [-], equivalent strain [-] and stress
    [Pa]."""

    def below(strain, largest, name):
        if strain.max() > largest:
            raise DataError(
                f"{where}: {name} reaches {strain.max():.3g}: it must stay "
                f"below {largest:g} (a percentage has the unit %)"
            )

    shear = "shearStrain" in data and "shearStress" in data
    strains = [
        n
        for n in ("strain", "engineeringStrain", "trueStrain", "displacement")
        if n in data
    ]
    stresses = [
        n
        for n in ("stress", "engineeringStress", "trueStress", "force")
        if n in data
    ]
    if shear:
        if strains or stresses:
            raise DataError(
                f"{where}: shear and compression in one file: "
                f"{', '.join(strains + stresses)} beside the shear columns"
            )
        strain = _one_sign(data["shearStrain"], f"{where}: shearStrain")
        below(strain, LARGEST_SHEAR, "shearStrain")
        stress = _one_sign(data["shearStress"], f"{where}: shearStress")
        return "shear", strain, strain / np.sqrt(3), stress * np.sqrt(3)
    if len(strains) != 1 or len(stresses) != 1:
        raise DataError(
            f"{where}: it has {', '.join(data) or 'no known column'}; needed "
            "are one of strain, engineeringStrain, trueStrain, displacement "
            "and one of stress, engineeringStress, trueStress, force; or "
            "shearStrain and shearStress"
        )

    given = _one_sign(data[strains[0]], f"{where}: {strains[0]}")
    if strains[0] == "trueStrain":
        below(given, LARGEST_STRAIN, "trueStrain")
        strain = given
    else:
        if strains[0] == "displacement":
            if "height" not in notes:
                raise DataError(
                    f"{where}: displacement needs a line '# height: VALUE UNIT'"
                )
            given = given / notes["height"]
        if given.max() >= 1:
            raise DataError(
                f"{where}: {strains[0]} reaches {given.max():.3g} of the "
                "height: it must stay below 1 (a percentage has the unit %; "
                "a logarithmic strain is a trueStrain)"
            )
        strain = -np.log1p(-given)

    stress = _one_sign(data[stresses[0]], f"{where}: {stresses[0]}")
    if stresses[0] == "force":
        stress = stress / _section(notes, where)
    if stresses[0] != "trueStress":
        stress = stress * np.exp(-strain)  # Eq. 3
    return "compression", given, strain, stress


def _taken(data: dict, units: dict, name: str) -> list[str]:
    """What the header leaves open, and how it was taken."""
    remarks = []
    open_ = [n for n in ("strain", "stress") if n in data]
    if open_:
        meant = {
            "strain": "strain as engineering, 1 - H/H0 (logarithmic is a "
            "trueStrain)",
            "stress": "stress as engineering, force over the first section "
            "(over the present one is a trueStress)",
        }
        remarks.append(
            f"{name}: the header does not say which; taken are "
            + " and ".join(meant[n] for n in open_)
        )
    for column, unit in units.items():
        if unit == "%":
            largest = 100 * np.abs(data[column]).max()
            if largest < 2:
                remarks.append(
                    f"{name}: {column} reaches {largest:.3g} %; if that is no "
                    "percentage, its unit is -"
                )
    return remarks


def _given_rate(data: dict, notes: dict, loading, where: str) -> float | None:
    """Rate that the file tells, of the strain as it is given [1/s]."""
    told = [notes["rate"]] if "rate" in notes else []
    if "rate" in data:
        rates = np.abs(data["rate"][loading])
        # A rheometer's own rates waver
        told += [np.median(rates)]
        if "time" not in data:
            told += [rates.min(), rates.max()]
    if not told:
        return None
    if max(told) > 1.1 * min(told):
        raise DataError(
            f"{where}: rates from {min(told):.3g} to {max(told):.3g}/s; "
            "valid is one rate of the loading, or a column time [s]"
        )
    return float(told[0])


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


def _curve(name, data, units, labels, notes, where) -> Curve:
    """A specimen from its columns in SI units; units: those of the file."""
    count = len(next(iter(data.values())))
    if count < FEWEST_ROWS:
        raise DataError(
            f"{where}: {count} rows; at least {FEWEST_ROWS} are needed"
        )
    remarks = _taken(data, units, name)

    def rearrange(order, why):
        nonlocal data, labels
        remarks.append(f"{name}: {why}")
        data = {key: values[order] for key, values in data.items()}
        labels = None if labels is None else [labels[i] for i in order]

    if "time" in data and np.any(np.diff(data["time"]) < 0):
        rearrange(np.argsort(data["time"], kind="stable"), "sorted by time")

    kind, given, strain, stress = _strain_and_stress(data, notes, where)
    if "time" not in data and labels is None:
        # One turning point is an unloading; more is disorder
        steps = np.sign(np.diff(strain))
        steps = steps[steps != 0]
        if np.count_nonzero(np.diff(steps)) > 1:
            rearrange(
                np.argsort(strain, kind="stable"),
                "sorted by strain (no time, and the strain goes to and fro)",
            )
            kind, given, strain, stress = _strain_and_stress(data, notes, where)
    segment = _segments(strain, labels, where)
    loading = segment == 0
    if np.count_nonzero(loading) < FEWEST_ROWS // 2:
        raise DataError(f"{where}: fewer than {FEWEST_ROWS // 2} rows load it")

    if strain[0] > 0.2 * strain.max():
        remarks.append(
            f"{name}: the first row is at {100 * strain[0] / strain.max():.0f} "
            "% of the largest strain; taken as since the specimen was unloaded"
        )
    told = _given_rate(data, notes, loading, where)
    if "time" in data:
        time = data["time"] - data["time"][0]
        if np.ptp(time[loading]) <= 0:
            raise DataError(f"{where}: time stands still while loading")
        found = np.polyfit(time[loading], given[loading], 1)[0]
        if told and not told / 1.5 < found < told * 1.5:
            raise DataError(
                f"{where}: the rate is {told:.3g}/s, but by time and strain "
                f"{found:.3g}/s"
            )
    else:
        if np.any(segment == 1):
            raise DataError(f"{where}: a relaxation needs a column time [s]")
        if told is None:
            raise DataError(
                f"{where}: no rate: give a column time [s] or rate [1/s], or "
                "a line '# rate: VALUE 1/s'"
            )
        if not told > 0:
            raise DataError(f"{where}: the rate of loading is {told:.3g}/s")
        time = np.cumsum(np.abs(np.diff(given, prepend=given[0]))) / told
        if kind == "compression" and "trueStrain" not in data:
            remarks.append(
                f"{name}: the rate is taken as that of the engineering strain "
                "(speed over first height)"
            )
    rate = np.polyfit(time[loading], strain[loading], 1)[0]
    if not rate > 0:
        raise DataError(f"{where}: the rate of loading is {rate:.3g}/s")
    # What happened before the first row, at the same rate
    time = time + strain[0] / rate
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
    columns: dict[str, tuple[int, str]] | None = None
    header: list[str] = []
    separator = ","
    rows: dict[str, list[tuple[int, list[str]]]] = {}
    for number, line in enumerate(lines, 1):
        where = f"{path}, line {number}"
        if line.startswith("#"):
            read_note(line, notes, where)
            continue
        if not line.strip(",;\t "):
            continue
        if columns is None:
            separator = max(",;\t", key=line.count)
            header = next(csv.reader([line], delimiter=separator))
            columns = find_columns(header, where)
            continue
        row = [t.strip() for t in next(csv.reader([line], delimiter=separator))]
        if any(i >= len(row) for i, _ in columns.values()):
            raise DataError(f"{where}: {len(row)} values, fewer than columns")
        if any(row[len(header) :]):
            raise DataError(
                f"{where}: {len(row)} values, more than columns; decimals have "
                "a point"
            )
        label = row[columns["specimen"][0]] if "specimen" in columns else ""
        rows.setdefault(label, []).append((number, row))

    if not columns or not rows:
        raise DataError(
            f"{path}: no table; a header row names columns with units, as in "
            "'time [s], displacement [mm], force [N]'"
        )

    used = {i for i, _ in columns.values()}
    unused = [h.strip() for i, h in enumerate(header) if i not in used]
    unused = [text for text in unused if text]
    curves = []
    for label, table in rows.items():
        name = f"{path.stem} {label}".strip()
        data = {
            column: COLUMNS[column][unit]
            * np.array(
                [
                    read_number(row[i], f"{path}, line {number}: {column}")
                    for number, row in table
                ]
            )
            for column, (i, unit) in columns.items()
            if column not in LABELS
        }
        labels = (
            [row[columns["segment"][0]] for _, row in table]
            if "segment" in columns
            else None
        )
        units = {column: unit for column, (_, unit) in columns.items()}
        curves.append(
            _curve(name, data, units, labels, notes, f"{path} {label}".strip())
        )
    if unused:
        curves[0].remarks.append(
            f"{path.name}: columns not used: {', '.join(unused)}"
        )
    return curves
