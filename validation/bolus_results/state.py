# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The bolus at a written time, measured from its fields."""

from dataclasses import dataclass

import numpy as np

from bolus_results.fields import Case
from bolus_results.measure import TIME_TOLERANCE, Measure, value

# A connected piece below this part of the bolus's volume is a crumb, no
# fragment: a few cells of a coarse mesh
CRUMB = 0.01


@dataclass
class State:
    """The bolus at a written time, from its fields; SI units.

    Extremes are over the cells with alpha > 0.5. Pieces are connected sets of
    such cells of at least 1 % of the bolus, crumbs the smaller ones; of all
    the bolus, and of what is not damaged (D <= 0.5), which only bolus that
    still carries tension connects.
    """

    time: float
    numbers: dict

    def __getitem__(self, name: str) -> float:
        return self.numbers[name]["value"]

    def get(self, name: str) -> float | None:
        """A number, None if its field was not written."""
        return self.numbers[name]["value"] if name in self.numbers else None


def state(case: Case, time: float, loaded: float = 0.0) -> State:
    """Measure the bolus at a written time; loaded: see Measure."""
    mesh = case.mesh(time)
    alpha = case.field(time, "alpha")
    bolus = alpha > 0.5
    volume = alpha * mesh.cell_volumes
    found: dict = {}

    def field(name):
        return case.field(time, name) if case.has(time, name) else None

    damage = field("D")
    intact = bolus if damage is None else bolus & (damage <= 0.5)
    whole = volume[bolus].sum()

    for label, cells in (("", bolus), ("Intact", intact)):
        pieces = mesh.fragments(cells, volume)
        large = pieces >= CRUMB * whole
        found["pieces" + label] = value(large.sum(), "-")
        found["smallFragments" + label] = value((~large).sum(), "-")
        if pieces.size:
            found["largestPiece" + label] = value(pieces[0] / whole, "-")

    if bolus.any():
        sigma = field("sigmaEq")
        if sigma is not None:
            found["sigmaEqMax"] = value(sigma[bolus].max(), "Pa")
            mean = np.average(sigma[bolus], weights=volume[bolus])
            found["sigmaEqMean"] = value(mean, "Pa")
        eta = field("triaxiality")
        if eta is not None:
            found["triaxialityMax"] = value(eta[bolus].max(), "-")
            found["triaxialityMin"] = value(eta[bolus].min(), "-")
            # Damaged bolus has hardly a deviator: its ratio says nothing
            carrying = intact if sigma is None else intact & (sigma > loaded)
            if carrying.any():
                found["triaxialityMaxIntact"] = value(eta[carrying].max(), "-")
                found["triaxialityMinIntact"] = value(eta[carrying].min(), "-")
            # The core: within a third of the radius of a sphere of the volume
            # in the domain
            if mesh.axisymmetric and sigma is not None:
                full = 2 * np.pi / mesh.wedge_angle * whole
                radius = np.cbrt(3 * full / 4 / np.pi)
                core = carrying & (mesh.radii < radius / 3)
                if core.any():
                    i = np.flatnonzero(core)[eta[core].argmax()]
                    found["triaxialityMaxCore"] = value(
                        eta[i],
                        "-",
                        x=float(mesh.axial[i]),
                        sigmaEq=float(sigma[i]),
                    )
        strain = field("epsilonPEq")
        if strain is not None:
            found["epsilonPEqMax"] = value(strain[bolus].max(), "-")
        velocity = field("U")
        if velocity is not None:
            axial = mesh.frame.along(velocity[bolus])
            found["jetForward"] = value(max(axial.max(), 0), "m/s")
            found["jetBackward"] = value(max(-axial.min(), 0), "m/s")
        pressure = field("p")
        if pressure is not None:
            found["pMax"] = value(pressure[bolus].max(), "Pa")
            found["pMin"] = value(pressure[bolus].min(), "Pa")
        if damage is not None:
            part = volume[damage > 0.5].sum() / volume.sum()
            found["damagedFraction"] = value(part, "-")
    return State(time, found)


def states(case: Case, measure: Measure) -> dict[float, State]:
    """The bolus at those of the times asked for that were written."""
    found = {}
    for time in measure.times_of(case):
        written = case.nearest(time, TIME_TOLERANCE)
        if written is not None and case.has(written, "alpha"):
            found[time] = state(case, written, measure.loaded)
    return found
