# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Jet and shear rate of the liquid meal: liquidMeal.json, liquidMeal.png."""

import json

import matplotlib.pyplot as plt
import numpy as np
from bolus_results.fields import Case


def shear_rate(gradient):
    """sqrt(2 D:D) [1/s], (n,), of velocity gradients (n, 9) [1/s]."""
    gradient = gradient.reshape(-1, 3, 3)
    rate = 0.5 * (gradient + gradient.transpose(0, 2, 1))
    return np.sqrt(2 * np.einsum("nij,nij->n", rate, rate))


def main():
    """Measure at the written times; draw the time of the fastest jet."""
    case = Case(".")
    times = [t for t in case.times if t > 0 and case.has(t, "gradU")]
    if not times:
        print(
            "note: no time after the start was written: nothing to measure; "
            "-set endTime=... to at least one writeInterval"
        )
        return
    speeds = {
        t: case.mesh(t).frame.along(case.field(t, "U")) for t in times
    }
    jets = [max(0.0, -speeds[t].min()) for t in times]
    rates, means = [], []
    for t in times:
        mesh = case.mesh(t)
        rate = shear_rate(case.field(t, "gradU"))
        rates.append(rate.max())
        # Distal antrum: the last 4 cm
        distal = mesh.axial > 0.21
        means.append(
            np.average(rate[distal], weights=mesh.cell_volumes[distal])
        )
    fastest = int(np.argmax(jets))
    found = {
        "jet": {"value": jets[fastest], "unit": "m/s", "time": times[fastest]},
        "shearRateMax": {"value": float(max(rates)), "unit": "1/s"},
        "shearRateMeanDistal": {"value": float(max(means)), "unit": "1/s"},
    }
    with open("liquidMeal.json", "w") as file:
        json.dump(found, file, indent=1)
        file.write("\n")

    figure, axes = plt.subplots(1, 2, figsize=(11, 4), layout="constrained")
    axes[0].plot(times, 1e3 * np.array(jets), label="jet [mm/s]")
    axes[0].plot(times, rates, label="largest shear rate [1/s]")
    axes[0].axhline(28, color="C0", linestyle=":", label="Ferrua, Singh 2010")
    axes[0].set(xlabel="t [s]", ylim=(0, None))
    axes[0].legend()
    t = times[fastest]
    mesh = case.mesh(t)
    x, r = 1e3 * mesh.axial, 1e3 * mesh.radii
    points = axes[1].scatter(x, r, c=1e3 * speeds[t], s=4, cmap="RdBu_r")
    figure.colorbar(points, label="axial velocity [mm/s], < 0 is the jet")
    axes[1].set(
        title=f"t = {t:g} s", xlabel="x [mm]", ylabel="r [mm]", aspect="equal"
    )
    figure.savefig("liquidMeal.png", dpi=120)


if __name__ == "__main__":
    main()
