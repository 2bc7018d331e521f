# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Each entry of the dictionaries spoilt in six ways; runs killed at random."""

import argparse
import collections
import json
import random
import shutil
import sys
from pathlib import Path

from bolus_results.locking import FolderBusy, alone_in
from bolus_validation import robustness as rough
from bolus_validation.robustness_cases import BASES, kill_test

ROOT = Path(__file__).parents[2]
BASE = ROOT / "run" / "validate" / "robustness"


def main(names) -> bool:
    """Spoil and kill the cases named; was there a fault?"""
    counts, faults = collections.Counter(), []
    for name in names:
        if name == "kills":
            continue
        folder = BASE / name
        shutil.rmtree(folder, ignore_errors=True)
        command, files = BASES[name](folder)
        found = []
        for file, only in files:
            for outcome in rough.fuzz(folder, file, command, only):
                found.append(outcome)
                counts[outcome.verdict] += 1
                if outcome.fault:
                    faults.append(outcome)
                    print(
                        f"{outcome.verdict}: {name} {outcome.file} "
                        f"{outcome.entry} {outcome.spoil}\n"
                        f"    {outcome.message[:300]!r}",
                        flush=True,
                    )
        verdicts = collections.Counter(o.verdict for o in found)
        (BASE / f"{name}.json").write_text(
            json.dumps([vars(o) for o in found], indent=1)
        )
        print(f"{name}: {len(found)} bad inputs, {dict(verdicts)}", flush=True)
    if counts:
        print(
            f"fuzz: {counts.total()} bad inputs: "
            + ", ".join(f"{v} {k}" for k, v in sorted(counts.items()))
            + f"; {len(faults)} faults"
        )
    lost = 0
    if "kills" in names:
        kills = kill_test(BASE / "kills", 5, random.Random())
        worst = max(kill.difference for kill in kills)
        lost = sum(kill.difference > 1e-5 for kill in kills)
        print(
            f"kills: {len(kills)}, {sum(k.writing for k in kills)} of them "
            "while a time was written, largest difference from the run that "
            f"was left alone {worst:.1e}, lost {lost}"
        )
    return bool(faults or lost)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help=", ".join([*BASES, "kills"]))
    given = parser.parse_args()
    names = given.names or [*BASES, "kills"]
    unknown = set(names) - {*BASES, "kills"}
    if unknown:
        sys.exit(
            f"robustness: no {', '.join(unknown)}; there are "
            f"{', '.join([*BASES, 'kills'])}"
        )
    BASE.mkdir(parents=True, exist_ok=True)
    try:
        with alone_in(BASE):
            sys.exit(main(names))
    except FolderBusy as error:
        sys.exit(f"robustness: {error}")
