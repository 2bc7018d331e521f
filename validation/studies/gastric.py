# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The stomach, cases A to D, on four meshes: the paper's Figs. 8 and 9."""

# The studies register themselves
from bolus_validation import gastric_causes, gastric_study  # noqa: F401
from bolus_validation.studies import command

if __name__ == "__main__":
    command("gastric", "bolusFoam: the stomach", __doc__)
