# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The stomach, cases A to D, on four meshes: the paper's Figs. 8 and 9."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

# The studies register themselves
from bolus_validation import gastric_causes, gastric_study  # noqa: E402, F401
from bolus_validation.studies import command  # noqa: E402

if __name__ == "__main__":
    command("gastric", "bolusFoam: the stomach", __doc__)
