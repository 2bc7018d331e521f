# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Group F: where in the mesh the free surface lies, and growthThreshold."""

from itertools import product
from pathlib import Path

import numpy as np
from bolus_cases.specimens import compression
from bolus_results.fields import Case
from matplotlib import pyplot as plt

from bolus_validation.studies import Findings, study

AXIAL, RADIAL = (8, 10, 12), (40, 44, 48, 52, 56, 60)


@study(
    "surfaceInTheMesh",
    "F",
    "Frictionless compression on many meshes, by gasCoeffs.growthThreshold",
    "a third of the von Mises stress in each full cell; no rejected step",
)
def surface_in_the_mesh(folder: Path, quick: bool) -> Findings:
    """Worst cell's pressure and rejected steps over meshes that the free
    surface crosses at other places, slow (0.01/s), where it is worst."""
    found = Findings()
    figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    meshes = [(10, 52)] if quick else list(product(AXIAL, RADIAL))
    for seal in (0.4, 0.02):
        errors, cells, rejected = [], [], []
        for axial, radial in meshes:
            run = compression(
                folder / f"seal{seal:g}-{axial}x{radial}",
                gas=f"growthThreshold {seal};",
                strainRate=0.01,
                unloadStrain=0,
                nAxial=axial,
                nRadial=radial,
            )
            case = Case(run.case)
            end = max(case.times)
            full = case.field(end, "alpha") > 0.999
            p = case.field(end, "p")[full]
            error = np.abs(3 * p / case.field(end, "sigmaEq")[full] - 1)
            errors.append(error.max())
            cells.append(int((error > 0.01).sum()))
            rejected.append(int(run.steps["rejected"][-1]))
        found.row(
            f"worst cell's pressure of {len(meshes)} meshes, seal {seal:g}",
            "-",
            max(errors),
            0.0,
            0.01,
            scale=1,
            remark=f"{sum(e > 0.01 for e in errors)} meshes beyond, at most "
            f"{max(cells)} cells in one",
        )
        found.row(
            f"rejected steps of 100, worst mesh, seal {seal:g}",
            "-",
            max(rejected),
            0,
            scale=1,
            remark=f"{sum(r == 0 for r in rejected)} meshes without any",
        )
        axes.plot(range(len(meshes)), errors, "o-", label=f"seal {seal:g}")
    axes.axhline(0.01, color="0.5", lw=0.8)
    axes.set(
        xlabel="mesh (axial, then radial cells)",
        ylabel="error of the worst cell's pressure [-]",
    )
    axes.legend()
    found.draw(figure, folder / "surface.png")
    return found
