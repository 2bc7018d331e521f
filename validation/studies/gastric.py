# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The stomach, cases A to D, on four meshes: the paper's Figs. 8 and 9."""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

# The studies register themselves
from bolus_validation import gastric_study  # noqa: E402, F401
from bolus_validation.studies import run_all  # noqa: E402

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help="studies; default: all")
    parser.add_argument("-force", action="store_true", help="run again")
    given = parser.parse_args()
    sys.exit(
        run_all("gastric", "bolusFoam: the stomach", given.names, given.force)
    )
