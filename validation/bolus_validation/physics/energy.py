# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Group E: the work of the walls against all that takes it.

The residual is that of an identity of the discrete equations: it says that the
books are complete and the steps converged. What mesh and step take, and the
gas, are columns of their own, which must vanish with them.
"""

from pathlib import Path

import numpy as np
from bolus_cases.mapped import picture
from bolus_cases.specimens import compression
from bolus_results import curves
from bolus_results.results import ARTIFICIAL, energy_shares
from bolus_results.tables import read_table

from bolus_validation import rheology
from bolus_validation.physics.sensitivity import TUTORIAL, gastric_run
from bolus_validation.studies import Findings, energy_residual, study

RATE = 0.1  # of the tutorial [1/s]

# What the issue allows of the work, and of what
RESIDUAL, THROUGH_FRACTURE, SHARE = 0.01, 0.02, 0.02
LIMITED = ("gas", "stabilisation")

# Cells along the axis and the radius of the tutorial's mesh
MESHES = ((5, 18), (10, 36), (20, 72))
STEPS = (0.02, 0.01, 0.005)  # of strain


@study(
    "energy_compression",
    "E",
    "energy of a cylinder compressed to 0.3 and unloaded",
    "exact uniaxial solution without friction (plastic, elastic, work); the "
    "artificial columns of the run with friction over cell size and step",
)
def tutorial(folder: Path, quick: bool) -> Findings:
    found = Findings()
    meshes, steps = (MESHES[:2], STEPS[:2]) if quick else (MESHES, STEPS)

    def run(name, mesh, step, friction, strain=0.3, unload=0.0):
        case = compression(
            folder / name,
            friction=friction,
            strain=strain,
            unloadStrain=unload,
            strainStep=step,
            nAxial=mesh[0],
            nRadial=mesh[1],
        )
        return case.case, read_table(case.case, "energyBalance")

    # Against the exact solution
    case, table = run("exact", meshes[-1], steps[-1], "none", 0.5)
    energy_residual(found, table, "frictionless", RESIDUAL)
    law = rheology.Tabulated(rheology.RATES, rheology.STRESSES)
    strain = np.linspace(0, 0.5, 5001)
    stress = rheology.uniaxial_tabulated(law, RATE, strain / RATE)
    volume = read_table(case, "freeSurface")["volume"][-1]
    for column, density in (
        ("work", np.trapezoid(stress, strain)),
        ("plastic", np.trapezoid(stress, strain - stress / rheology.E)),
        ("elastic", stress[-1] ** 2 / 2 / rheology.E),
    ):
        found.row(column, "J", table[column][-1], density * volume, 0.01)

    # Over the cell size: 20 mm of height
    shares = []
    for mesh in meshes:
        _, table = run(f"mesh{mesh[0]}", mesh, 0.01, "coulomb", unload=0.1)
        energy_residual(found, table, f"friction, {mesh[0]} cells", RESIDUAL)
        shares.append({n: s[-1] for n, s in energy_shares(table).items()})
    sizes = [0.020 / mesh[0] for mesh in meshes]
    for name in (*LIMITED, "transport"):
        found.order(
            f"share of {name}, cell size [m]", sizes, [s[name] for s in shares]
        )
    for name in LIMITED:
        found.row(f"share of {name}", "-", shares[-1][name], 0, SHARE, 1)

    # Over the step
    losses = []
    for step in steps:
        _, table = run(f"step{step}", meshes[1], step, "coulomb")
        losses.append(energy_shares(table)["timeStep"][-1])
    found.order("share of the time step, strain of a step", steps, losses, 0.9)

    def draw(left, right):
        for name in (*LIMITED, "transport"):
            left.loglog(
                sizes, [100 * s[name] for s in shares], "o-", label=name
            )
        left.set(xlabel="cell [m]", ylabel="share of the work [%]")
        right.loglog(steps, [100 * x for x in losses], "o-", label="time step")
        right.set(xlabel="strain of a step [-]")
        for axis in (left, right):
            axis.legend(fontsize=8)
            axis.grid(alpha=0.3, which="both")

    found.picture = picture(folder, "shares.png", draw, 2)
    return found


@study(
    "energy_gastric",
    "E",
    "energy of case A",
    "balance within 2 % through fracture and contact; gas and stabilisation "
    "below 2 % each (issue 3)",
)
def gastric(folder: Path, quick: bool) -> Findings:
    found = Findings()
    case = gastric_run(
        nonlocalLength=0, tensileStrain=0, **({} if quick else TUTORIAL)
    )
    table = read_table(case, "energyBalance")
    energy_residual(found, table, "case A", THROUGH_FRACTURE)
    for name, share in energy_shares(table).items():
        limit = SHARE if name in LIMITED else None
        columns = " + ".join(ARTIFICIAL[name])
        found.row(f"share of {name}", "-", share[-1], 0, limit, 1, columns)
    found.remarks.append(
        "Debris is the viscosity that broken bolus is given because it would "
        "else be a fluid without any: artificial, but in no limit of its own."
    )
    curves.energy(case, folder / "energy.png")
    found.picture = "energy.png"
    return found
