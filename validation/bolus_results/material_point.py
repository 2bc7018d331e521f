# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""materialPoint, the laws of a bolus without a mesh, and its tables."""

import subprocess
from pathlib import Path

import numpy as np


def run_material_point(text, folder, name="point"):
    """Run materialPoint on a dictionary's text in a folder.

    Returns the completed process; the table, if any, is folder/name.dat.
    """
    folder = Path(folder)
    (folder / name).write_text(text)
    return subprocess.run(
        ["materialPoint", "-dict", name, "-out", f"{name}.dat"],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=300,
    )


def read_segments(path):
    """Table of materialPoint as a dictionary of segments.

    Each is a dictionary of columns, named without their unit, shape (rows,).
    The segment "start" holds the first row.
    """
    names, rows, segments = [], [], {}
    segments["start"] = rows
    for line in Path(path).read_text().splitlines():
        words = line.split()
        if line.startswith("# segment"):
            rows = segments[words[2]] = []
        elif line.startswith("#") and not names:
            names = [word.split("[")[0] for word in words[1:]]
        elif not line.startswith("#"):
            rows.append([float(word) for word in words])
    return {
        key: dict(
            zip(names, np.array(rows).reshape(-1, len(names)).T, strict=True)
        )
        for key, rows in segments.items()
    }
