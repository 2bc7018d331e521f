#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Write system/platenDisplacement, timeParameters and meshParameters.

The platen moves such that the Hencky strain rate of the cylinder is that of
system/caseParameters: height H(t) = H0 exp(-strain(t)), where the strain rises
at strainRate to its largest value and then falls by unloadStrain at the same
rate. A negative strain is a tension test. The mesh is 18 mm in radius, or more
where the cylinder needs it.
"""

import math
import re
from pathlib import Path

HEIGHT = 0.020  # [m]
RADIUS = 0.010
POINTS = 2000  # of the table in each direction


def read(text: str, name: str) -> float:
    """An entry of a dictionary that is one number."""
    found = re.search(rf"^{name}\s+([^;]+);", text, re.M)
    if not found:
        raise SystemExit(f"system/caseParameters: entry {name} is missing")
    return float(found.group(1))


def main() -> None:
    """Read system/caseParameters, write the three files."""
    text = Path("system/caseParameters").read_text()
    rate = read(text, "strainRate")
    strain = read(text, "strain")
    unload = read(text, "unloadStrain")
    if rate <= 0 or strain == 0 or unload < 0:
        raise SystemExit(
            f"system/caseParameters: strainRate {rate}, strain {strain}, "
            f"unloadStrain {unload}; valid are > 0, not 0 and >= 0"
        )

    # The strain over the path that the platen has gone, both [-]
    turn, end = abs(strain), abs(strain) + unload
    path = [turn * i / POINTS for i in range(POINTS + 1)]
    if unload:
        path += [turn + unload * (i + 1) / POINTS for i in range(POINTS)]
    with open("system/platenDisplacement", "w") as out:
        for s in path:
            now = min(s, 2 * turn - s) * math.copysign(1, strain)
            x = HEIGHT * math.expm1(-now)
            out.write(f"({s / rate:.12g} ({x:.15g} 0 0))\n")

    # A slipping cylinder, and some room for one that bulges
    outer = max(0.018, 1.15 * RADIUS * math.exp(strain / 2))
    y, z = (1e3 * outer * f(math.radians(2.5)) for f in (math.cos, math.sin))
    Path("system/meshParameters").write_text(
        f"outerY {y:.6f};\nouterZ {z:.6f};\nminusOuterZ {-z:.6f};\n"
    )

    Path("system/timeParameters").write_text(
        f"endTime {end / rate:.12g};\n"
        f"deltaT {read(text, 'strainStep') / rate:.12g};\n"
        f"writeInterval {read(text, 'writeStrain') / rate:.12g};\n"
        f"strainRate {rate:.12g};\n"
    )


if __name__ == "__main__":
    main()
