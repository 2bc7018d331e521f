# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Each mechanism against exact solutions, limit analysis, energy balance."""

import importlib
import pkgutil

from bolus_validation import physics
from bolus_validation.studies import command

if __name__ == "__main__":
    # The studies register themselves
    for module in pkgutil.iter_modules(physics.__path__):
        importlib.import_module(f"bolus_validation.physics.{module.name}")
    command("physics", "bolusFoam: physics", __doc__)
