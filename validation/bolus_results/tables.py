# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The tables that function objects write, over all the starts of a run."""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bolus_results.foam_files import FoamFileError


@dataclass
class Table:
    """Columns (n,) and their units, by name. Time comes first, ascending."""

    columns: dict[str, np.ndarray]
    units: dict[str, str]

    def __getitem__(self, name: str) -> np.ndarray:
        return self.columns[name]

    @property
    def time(self) -> np.ndarray:
        """(n,) [s]."""
        return next(iter(self.columns.values()))

    def at(self, name: str, time: float) -> float | None:
        """A column at a time [s], linear between rows; None outside."""
        # The last step may end this little before a written time
        slack = 1e-7 * np.abs(self.time).max()
        if not self.time[0] - slack <= time <= self.time[-1] + slack:
            return None
        return float(np.interp(time, self.time, self[name]))


def _read_one(path: Path) -> Table | None:
    """A table of one start; None if it has no row."""
    lines = path.read_text().splitlines()
    head = [line for line in lines if line.startswith("#")]
    if not head:
        raise FoamFileError(f"{path}: no head of columns")
    # Name [unit], or a bare name; a unit may have a solidus, never a bracket
    found = re.findall(r"(\w+)(?:\s*\[([^\]]*)\])?", head[-1].lstrip("# "))
    names = [name for name, _ in found]
    rows = [line.split() for line in lines if line and line[0] != "#"]
    # The last row of a run that was killed may be cut
    rows = [row for row in rows if len(row) == len(names)]
    if not rows:
        return None
    data = np.array(rows, dtype=float).T
    return Table(
        dict(zip(names, data, strict=True)),
        dict(found),
    )


def read_starts(case, name: str, file: str | None = None) -> list[Table]:
    """The tables of a function object, one for each start of the run.

    In the order of the times they start from, and for one time in the order
    in which they were written.
    """
    folder = Path(case) / "postProcessing" / name
    file = file or name
    found = []
    if folder.is_dir():
        for start in folder.iterdir():
            for path in start.glob(f"{file}*.dat"):
                # file.dat, file_2.dat, ... of one start time
                order = re.fullmatch(rf"{file}(?:_(\d+))?", path.stem)
                if order:
                    number = int(order.group(1) or 1)
                    found.append((float(start.name), number, path))
    if not found:
        raise FoamFileError(f"{folder}: no table {file}.dat of any start")
    tables = [_read_one(path) for *_, path in sorted(found)]
    return [table for table in tables if table]


def read_table(case, name: str, file: str | None = None) -> Table:
    """The table of a function object over all the starts of the run.

    Where a run was continued from a time before the former one's end, the
    continuation counts.
    """
    tables = read_starts(case, name, file)
    if not tables:
        raise FoamFileError(f"{Path(case) / 'postProcessing' / name}: no rows")
    columns = dict(tables[0].columns)
    for table in tables[1:]:
        time = next(iter(columns.values()))
        # The same time, but for the digits written
        keep = time < table.time[0] - 1e-9 * np.abs(time).max()
        columns = {
            name: np.concatenate([column[keep], table[name]])
            for name, column in columns.items()
        }
    return Table(columns, tables[0].units)


def optional_table(case, name: str, file: str | None = None) -> Table | None:
    """read_table, or None if the case has none."""
    try:
        return read_table(case, name, file)
    except FoamFileError:
        return None
