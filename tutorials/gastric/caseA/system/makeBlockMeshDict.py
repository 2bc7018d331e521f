#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Write system/blockMeshDict from system/meshParameters.

The mesh is a straight wedge about the x axis with the radius 1, lengths along
x in m; gastricMesh then gives it the shape of the stomach.

    x1         xA         xB         x2
     |    A     |    B     |    C     |     A: cells of the length resolution
                                            B: shorter from cell to cell
                                            C: resolution/pylorusRefinement

A script, because blockMesh wants whole numbers of cells, and OpenFOAM's own
#eval gives none in v1912 (#calc does, but needs a compiler and is refused to
root).
"""

import math
import re
import sys
from pathlib import Path

X1 = 0.210  # shell [m]
XA = 0.236  # where cells begin to shrink: before the waves are strong [m]
XB = 0.248  # 2 mm before the pylorus, which begins at 0.250 [m]
X2 = 0.256  # outlet; the throat of the pylorus, 0.252, is halfway [m]

# The cells are as high as they are long where the lumen has this radius, that
# of the paper's mesh around the bolus [m]
NOMINAL_RADIUS = 13.5e-3

# Name: (lower, upper bound, unit)
PARAMETERS = {
    "resolution": (1e-5, 5e-3, "m"),
    "pylorusRefinement": (1.0, 100.0, "-"),
    "wedgeAngle": (0.1, 30.0, "degrees"),
}

TEMPLATE = """\
FoamFile
{{
    version     2.0;
    format      ascii;
    class       dictionary;
    location    "system";
    object      blockMeshDict;
}}

// Made by system/makeBlockMeshDict.py from system/meshParameters: edit those

scale   1;

vertices
(
    ({x1} 0 0)
    ({xA} 0 0)
    ({xB} 0 0)
    ({x2} 0 0)

    ({x1} {c} -{s})
    ({xA} {c} -{s})
    ({xB} {c} -{s})
    ({x2} {c} -{s})

    ({x1} {c} {s})
    ({xA} {c} {s})
    ({xB} {c} {s})
    ({x2} {c} {s})
);

blocks
(
    hex (0 1 5 4 0 1 9 8)    ({nA} {nR} 1) simpleGrading (1 1 1)
    hex (1 2 6 5 1 2 10 9)   ({nB} {nR} 1) simpleGrading ({gB} 1 1)
    hex (2 3 7 6 2 3 11 10)  ({nC} {nR} 1) simpleGrading (1 1 1)
);

edges
();

boundary
(
    shell
    {{
        type wall;
        faces ((0 4 8 0));
    }}

    wall
    {{
        type wall;
        faces ((4 5 9 8) (5 6 10 9) (6 7 11 10));
    }}

    outlet
    {{
        type patch;
        faces ((3 7 11 3));
    }}

    wedge0
    {{
        type wedge;
        faces ((0 1 5 4) (1 2 6 5) (2 3 7 6));
    }}

    wedge1
    {{
        type wedge;
        faces ((0 1 9 8) (1 2 10 9) (2 3 11 10));
    }}

    // No faces are left of it: the axis is a line
    axis
    {{
        type empty;
        faces ((0 1 1 0) (1 2 2 1) (2 3 3 2));
    }}
);

mergePatchPairs
();
"""


def read_parameters(path):
    """Read the numbers of PARAMETERS from an OpenFOAM dictionary.

    path: file; returns a dict name -> value (units as in PARAMETERS).
    Exits with a message on a missing, unknown or impossible entry.
    """
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", path.read_text(), flags=re.S)
    text = re.sub(r"FoamFile\s*\{.*?\}", "", text, flags=re.S)
    found = dict(re.findall(r"^\s*(\w+)\s+([^;]*?)\s*;", text, flags=re.M))

    names = ", ".join(PARAMETERS)
    for name in found:
        if name not in PARAMETERS:
            sys.exit(f"{path}: unknown entry '{name}'; valid entries: {names}")

    values = {}
    for name, (lower, upper, unit) in PARAMETERS.items():
        if name not in found:
            sys.exit(f"{path}: missing entry '{name}'; entries: {names}")
        try:
            values[name] = float(found[name])
        except ValueError:
            values[name] = math.nan
        if not lower <= values[name] <= upper:
            sys.exit(
                f"{path}: entry '{name}' is {found[name]}; it must be a "
                f"number from {lower:g} to {upper:g} {unit}"
            )
    return values


def progression(length, first, last):
    """Number of cells, on a length [m], whose sizes [m] go geometrically from
    first to last (last <= first), rounded; cells all alike if first == last.
    """
    if math.isclose(first, last):
        return max(1, round(length / first))
    # first (1 - q^n)/(1 - q) = length with q^(n - 1) = last/first
    q = (length - first) / (length - last)
    return max(1, round(1 + math.log(last / first) / math.log(q)))


def block_mesh_dict(resolution, pylorusRefinement, wedgeAngle):
    """The text of blockMeshDict; arguments as in PARAMETERS."""
    fine = resolution / pylorusRefinement
    half = math.radians(wedgeAngle / 2)
    return TEMPLATE.format(
        x1=X1,
        xA=XA,
        xB=XB,
        x2=X2,
        c=repr(math.cos(half)),
        s=repr(math.sin(half)),
        nA=max(1, round((XA - X1) / resolution)),
        nB=progression(XB - XA, resolution, fine),
        # Even, so that the throat, in the middle of C, has points
        nC=2 * max(1, round((X2 - XB) / fine / 2)),
        nR=max(1, round(NOMINAL_RADIUS / resolution)),
        gB=repr(1 / pylorusRefinement),
    )


if __name__ == "__main__":
    system = Path(__file__).resolve().parent
    parameters = read_parameters(system / "meshParameters")
    (system / "blockMeshDict").write_text(block_mesh_dict(**parameters))
