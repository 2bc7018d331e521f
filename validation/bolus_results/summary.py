# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""A run in a dozen lines, from its results.json.

python -m bolus_results.summary CASE

writes CASE/summary.txt. What the run does not have is left out.
"""

import argparse
import json
import re
import sys
from pathlib import Path

from bolus_results.foam_files import FoamFileError
from bolus_results.locking import alone_in
from bolus_results.measure import number_at

# Title | path of the number in results.json or its results | format | unit
_LINES = """
simulated | run.simulatedTime | .6g | s
time steps | run.steps | d |
rejected | run.rejectedSteps | d |
friction lagged | run.explicitPressureSteps | d |
turning lagged | run.splitRotationSteps | d |
Newton iterations | run.newtonIterations | d |
cells | run.cells | d |
cores | run.cores | d |
solver's clock time | run.clockTime | .4g | s
force on the wall, peak | contactForce.total_perMass.peak | .4g | N/g
work of the wall | externalWork.work_perMass.final | .4g | mJ/g
bolus retained | retainedMass.retained.final | .4g | %
passed while closed | retainedMass.passedWhileClosed.final | .2g | %
largest mass error | retainedMass.balanceError.peak | .2g | %
overfull steps | run.overfullSteps | d |
spilled | run.spilled | .2g | % of the bolus
energy residual | energyBalance.relative.final | .2g | % of the work
taken by the gas | energyBalance.shares.gas | .2g | % of the work
by broken bolus | energyBalance.shares.damagedViscosity | .2g | % of the work
by the stabilisation | energyBalance.shares.stabilisation | .2g | % of the work
damaged | damagedVolume.fraction.final | .3g | %
external surface | freeSurface.externalArea.final | .4g | mm2
alpha, smallest | run.alphaMin | .2g |
alpha, largest | run.alphaMax | .6g |
"""
# From the units of results.json to those shown
_FACTORS = {"%": 100, "mm2": 1e6}


def summary(path) -> str:
    """The summary of a case that has a results.json."""
    path = Path(path)
    source = path / "results.json"
    if not source.is_file():
        raise FoamFileError(f"{source}: missing; make it with scripts/results")
    results = json.loads(source.read_text())

    lines = []
    for line in _LINES.strip().splitlines():
        title, place, form, unit = map(str.strip, line.split("|"))
        number = number_at(results | results["results"], place)
        if number is None:
            continue
        scaled = number["value"] * _FACTORS.get(unit.split(" ")[0], 1)
        text = f"{title:<28}{scaled:{form}} {unit}".rstrip()
        if "time" in number:
            text += f" at {number['time']:.4g} s"
        lines.append(text)

    profile = results.get("run", {}).get("profile", {})
    for n, (phase, taken) in enumerate(profile.items()):
        title = "" if n else "where the time went"
        lines.append(f"{title:<28}{phase:<14}{taken['value']:8.1f} s")

    comparison = path / "comparison.md"
    if comparison.is_file():
        count = re.search(r"^\d+ rows agree.*$", comparison.read_text(), re.M)
        if count:
            lines.append(f"{'comparison':<28}{count.group(0).rstrip('.')}")
            lines.append(f"{'':<28}row by row in comparison.md")
    return "\n".join(lines) + "\n"


def main(arguments=None) -> int:
    """Command line."""
    parser = argparse.ArgumentParser(
        prog="summary", description="Write summary.txt of a case."
    )
    parser.add_argument("case", type=Path)
    options = parser.parse_args(arguments)
    try:
        target = options.case / "summary.txt"
        text = summary(options.case)
        with alone_in(options.case):
            target.write_text(text)
        print(target)
    except (FoamFileError, OSError) as error:
        print(f"summary: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
