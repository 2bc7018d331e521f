# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Where the time of a run went: OpenFOAM's profiling, by phases of the solver.

On with -set system/controlDict:profiling.active=true.
"""

import re
from pathlib import Path

from bolus_results.foam_files import read_text

# What is shown: the names that the solver gives them, and OpenFOAM its own
PHASES = {
    "assembly": ("residual", "tangent"),
    "factorisation": ("factorisation",),
    "solve": ("linear solve",),
    "transport": ("transport",),
    "mesh motion": ("mesh motion",),
    "output": ("write", "functionObjects.execute()"),
}


def read_profile(path: Path) -> dict[str, float]:
    """Seconds by name of TIME/uniform/profiling; names that occur more than
    once are summed.

    Raises ValueError if the file has none.
    """
    found: dict[str, float] = {}
    for block in re.findall(r"trigger\d+\s*\{(.*?)\}", read_text(path), re.S):
        entries = dict(re.findall(r'(\w+)\s+("[^"]*"|[^;]+);', block))
        name = entries["description"].strip('"')
        found[name] = found.get(name, 0) + float(entries["totalTime"])
    if not found:
        raise ValueError(f"{path}: has no trigger; valid is a file of OpenFOAM")
    return found


def phases(case: Path) -> dict[str, float]:
    """Seconds by phase, "the rest" and "total" [s] of a run since its last
    start, of its first rank; empty if it was not profiled."""
    base = case / "processor0" if (case / "processor0").is_dir() else case
    files = base.glob("*/uniform/profiling*")
    last = max(files, key=lambda p: float(p.parts[-3]), default=None)
    if last is None:
        return {}
    seconds = read_profile(last.with_name("profiling"))
    found = {
        phase: sum(seconds.get(name, 0) for name in names)
        for phase, names in PHASES.items()
    }
    total = seconds["application::main"]
    return found | {"the rest": total - sum(found.values()), "total": total}
