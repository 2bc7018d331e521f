# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""From measured curves of a food to the bolusProperties of a case.

data      reads CSV files; what it says of columns and units is the manual
columns   their names and units
model     stress of a law under a measured strain history
fit       least squares with confidence intervals
output    the dictionary, the pictures, the one-cell rheometer beside it
"""
