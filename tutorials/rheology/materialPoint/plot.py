# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Picture of the tables of materialPoint: rheology.png."""

import matplotlib.pyplot as plt
import numpy as np
from bolus_results.material_point import read_segments

LAWS = ("viscoplastic", "HerschelBulkley", "JLaw")
RATES = ("0.01", "0.1", "1")


def main():
    """Stress-strain curves of the laws, relaxation, fracture."""
    figure, axes = plt.subplots(2, 3, figsize=(13, 7.5), layout="constrained")

    for axis, law in zip(axes[0], LAWS, strict=True):
        for i, rate in enumerate(RATES):
            table = read_segments(f"tables/{law}.compression.{rate}")
            for name in ("compression", "relaxation", "unloading"):
                axis.plot(
                    -table[name]["axialStrain"],
                    table[name]["sigmaEq"] / 1e3,
                    color=f"C{i}",
                    label=f"{rate}/s" if name == "compression" else None,
                )
            shear = read_segments(f"tables/{law}.shear.{rate}")["shear"]
            axis.plot(
                shear["shearStrain"] / np.sqrt(3),
                shear["shearStress"] * np.sqrt(3) / 1e3,
                color=f"C{i}",
                linestyle="--",
            )
        axis.set(
            title=f"{law}: compression, shear (dashed)",
            xlabel="equivalent strain [-]",
            ylabel="equivalent stress [kPa]",
        )
        axis.legend()

    axis = axes[1, 0]
    for i, rate in enumerate(RATES):
        hold = read_segments(f"tables/viscoplastic.compression.{rate}")[
            "relaxation"
        ]
        axis.semilogx(
            hold["time"] - 1.2 / float(rate),
            hold["sigmaEq"] / 1e3,
            color=f"C{i}",
            label=f"after {rate}/s",
        )
    axis.set(
        title="viscoplastic: relaxation",
        xlabel="time [s]",
        ylabel="equivalent stress [kPa]",
    )
    axis.legend()

    table = read_segments("tables/fracture")
    for axis, names, title in (
        (axes[1, 1], ("tension", "closing"), "fracture in tension"),
        (axes[1, 2], ("pressing", "pulling"), "the fragments in a rigid die"),
    ):
        for name in names:
            axis.plot(
                table[name]["axialStrain"],
                table[name]["axialStress"] / 1e3,
                label=name,
            )
        axis.set(
            title=title,
            xlabel="axial strain [-]",
            ylabel="axial stress [kPa], tension > 0",
        )
        axis.legend()

    figure.savefig("rheology.png", dpi=120)


if __name__ == "__main__":
    main()
