#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Write system/platenDisplacement and system/timeParameters.

The platen moves such that the Hencky strain rate of the cylinder is that of
system/caseParameters: height H(t) = H0 exp(-rate t). One step is 1 % strain.
"""

import math
import re
from pathlib import Path

HEIGHT = 0.020  # [m]
POINTS = 2000  # in the table

text = Path("system/caseParameters").read_text()
rate, strain, step = (
    float(re.search(rf"^{name}\s+([^;]+);", text, re.M).group(1))
    for name in ("strainRate", "strain", "strainStep")
)
end = strain / rate
with open("system/platenDisplacement", "w") as out:
    for i in range(POINTS + 1):
        t = end * i / POINTS
        x = HEIGHT * math.expm1(-rate * t)
        out.write(f"({t:.12g} ({x:.15g} 0 0))\n")
Path("system/timeParameters").write_text(
    f"endTime {end:.12g};\ndeltaT {step / rate:.12g};\nwriteInterval {end / 5:.12g};\n"
)
