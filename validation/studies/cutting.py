# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Cutting by cylinder and wire: limit analysis, speeds, laws, cell sizes."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

# The studies register themselves
from bolus_validation import cutting_study  # noqa: E402, F401
from bolus_validation.studies import command  # noqa: E402

if __name__ == "__main__":
    command("cutting", "bolusFoam: cutting", __doc__)
