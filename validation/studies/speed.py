# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Where the time goes, on one core and two, and how it grows with the cells."""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

# The studies register themselves
from bolus_validation import speed_study  # noqa: E402, F401
from bolus_validation.studies import run_all  # noqa: E402

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help="studies; default: all")
    parser.add_argument("-force", action="store_true", help="run again")
    given = parser.parse_args()
    # One at a time: what runs beside would be timed too
    sys.exit(
        run_all(
            "speed",
            "bolusFoam: speed",
            given.names,
            given.force,
            workers=1,
        )
    )
