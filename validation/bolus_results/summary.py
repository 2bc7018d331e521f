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

# (title, path of the number in results.json, factor, unit shown, format)
_LINES = (
    ("simulated", "run.simulatedTime", 1, "s", ".6g"),
    ("time steps", "run.steps", 1, "", "d"),
    ("rejected", "run.rejectedSteps", 1, "", "d"),
    ("friction lagged", "run.laggedSteps", 1, "", "d"),
    ("turning lagged", "run.turnedLaterSteps", 1, "", "d"),
    ("Newton iterations", "run.newtonIterations", 1, "", "d"),
    ("cells", "run.cells", 1, "", "d"),
    ("cores", "run.cores", 1, "", "d"),
    ("solver's clock time", "run.clockTime", 1, "s", ".4g"),
    (
        "force on the wall, peak",
        "results.contactForce.total_perMass.peak",
        1,
        "N/g",
        ".4g",
    ),
    (
        "work of the wall",
        "results.externalWork.work_perMass.final",
        1,
        "mJ/g",
        ".4g",
    ),
    (
        "bolus retained",
        "results.retainedMass.retained.final",
        100,
        "%",
        ".4g",
    ),
    (
        "passed while closed",
        "results.retainedMass.passedWhileClosed.final",
        100,
        "%",
        ".2g",
    ),
    (
        "largest mass error",
        "results.retainedMass.balanceError.peak",
        100,
        "%",
        ".2g",
    ),
    ("overfull steps", "run.overfullSteps", 1, "", "d"),
    ("spilled", "run.spilled", 100, "% of the bolus", ".2g"),
    (
        "energy residual",
        "results.energyBalance.relative.final",
        100,
        "% of the work",
        ".2g",
    ),
    (
        "taken by the void",
        "results.energyBalance.shares.void",
        100,
        "% of the work",
        ".2g",
    ),
    (
        "by broken bolus's viscosity",
        "results.energyBalance.shares.debris",
        100,
        "% of the work",
        ".2g",
    ),
    (
        "by the stabilisation",
        "results.energyBalance.shares.stabilisation",
        100,
        "% of the work",
        ".2g",
    ),
    ("damaged", "results.damagedVolume.fraction.final", 100, "%", ".3g"),
    (
        "external surface",
        "results.freeSurface.externalArea.final",
        1e6,
        "mm2",
        ".4g",
    ),
    ("alpha, smallest", "run.alphaMin", 1, "", ".2g"),
    ("alpha, largest", "run.alphaMax", 1, "", ".6g"),
)


def summary(path) -> str:
    """The summary of a case that has a results.json."""
    path = Path(path)
    source = path / "results.json"
    if not source.is_file():
        raise FoamFileError(f"{source}: missing; make it with scripts/results")
    results = json.loads(source.read_text())

    lines = []
    for title, place, factor, unit, form in _LINES:
        number = number_at(results, place)
        if number is None:
            continue
        scaled = factor * number["value"]
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
