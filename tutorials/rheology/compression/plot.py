# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Stress against strain of the cylinder: compression.png."""

import re
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from bolus_validation import rheology
from bolus_results.tables import read_table

HEIGHT = 0.020  # [m]


def parameter(name: str) -> float:
    """A number of system/caseParameters."""
    text = Path("system/caseParameters").read_text()
    return float(re.search(rf"^{name}\s+([^;]+);", text, re.M).group(1))


def main():
    """Read the tables of the run, draw, and print the plateau."""
    rate, largest = parameter("strainRate"), parameter("strain")
    force, surface = (
        read_table(".", "contactForce"),
        read_table(".", "freeSurface"),
    )

    path = rate * force.time
    strain = np.minimum(path, 2 * abs(largest) - path) * np.sign(largest)
    # The section that carries the force is the bolus's volume over its height:
    # so the flat sides of the wedge (0.13 % less volume) cancel
    height = HEIGHT * np.exp(-strain)
    stress = force["axial"] * height / surface["volume"]

    # The true strain rate is constant, so is the stress once it flows
    flow = np.interp(rate, rheology.RATES, rheology.STRESSES)
    at = np.argmin(abs(path - abs(largest)))
    print(
        f"stress at the largest strain {stress[at]:.1f} Pa, "
        f"flow stress {flow:.1f} Pa, ratio {stress[at] / flow:.5f}"
    )

    figure, axis = plt.subplots(figsize=(6, 4.5), layout="constrained")
    axis.plot(strain, stress / 1e3, label="bolusFoam")
    axis.axhline(flow / 1e3, color="k", linestyle="--", label="flow stress")
    axis.set(
        title=f"Cylinder between platens, {rate:g}/s",
        xlabel="Hencky strain [-]",
        ylabel="axial stress, compression > 0 [kPa]",
    )
    axis.legend()
    figure.savefig("compression.png", dpi=120)


if __name__ == "__main__":
    main()
