# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Where the time goes, on one core and two, and how it grows with the cells."""

# The studies register themselves
from bolus_validation import speed_study  # noqa: F401
from bolus_validation.studies import command

if __name__ == "__main__":
    # One at a time: what runs beside would be timed too
    command("speed", "bolusFoam: speed", __doc__, workers=1)
