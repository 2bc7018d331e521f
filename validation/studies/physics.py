# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Each mechanism against exact solutions, limit analysis, energy balance."""

import argparse
import importlib
import pkgutil
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from bolus_validation import physics  # noqa: E402
from bolus_validation.studies import run_all  # noqa: E402

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help="studies; default: all")
    parser.add_argument("-force", action="store_true", help="run again")
    given = parser.parse_args()
    # The studies register themselves
    for module in pkgutil.iter_modules(physics.__path__):
        importlib.import_module(f"bolus_validation.physics.{module.name}")
    sys.exit(run_all("physics", "bolusFoam: physics", given.names, given.force))
