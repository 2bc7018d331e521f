# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Cutting by cylinder and wire: limit analysis, speeds, laws, cell sizes."""

# The studies register themselves
from bolus_validation import cutting_study  # noqa: F401
from bolus_validation.studies import command

if __name__ == "__main__":
    command("cutting", "bolusFoam: cutting", __doc__)
