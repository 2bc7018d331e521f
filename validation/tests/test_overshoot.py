# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Cells fuller than 1 expand in the time that overshootTime says."""

import numpy as np
import pytest
from bolus_cases.specimens import box, replace, solve
from bolus_cases.synthetic import write_field
from bolus_results.fields import Case

SIDE = 0.006  # of the box, half filled each way [m]
TIME = 0.2  # overshootTime [s]
BEYOND = 0.02  # alpha - 1 at the start [-]


@pytest.fixture(scope="module")
def expanded(tmp_path_factory):
    """alpha - 1 in the middle of a cube that was overfull for this time [s]."""
    case = tmp_path_factory.mktemp("overfull")
    # Free on all sides: it expands without stress
    sides = {f"{x}0": "symmetryPlane" for x in "xyz"}
    mesh = box(
        case,
        (SIDE, SIDE, SIDE),
        (8, 8, 8),
        sides | {f"{x}1": "open" for x in "xyz"},
        end=TIME,
        step=TIME / 20,
        block=(SIDE / 2, SIDE / 2, SIDE / 2),
        measured=(),
    )
    replace(
        case / "system" / "fvSolution",
        r"\nbolus \{\}",
        f"\nbolus {{ overshootTime {TIME}; }}\n"
        # ... and nothing of it is passed on to cells that have room
        "transport { overshootTolerance 0.1; }",
    )
    # With its mass it is a run that goes on: it may be overfull
    inside = np.all(mesh.cell_centres < SIDE / 2, axis=1)
    for name in ("alpha", "mass"):
        write_field(case, mesh, 0, name, np.where(inside, 1 + BEYOND, 0.0))
    solve(case)
    alpha = Case(case).field(TIME, "alpha")
    return alpha[np.all(mesh.cell_centres < SIDE / 4, axis=1)] - 1


def test_what_is_beyond_1_decays_in_overshoot_time(expanded):
    # d(alpha)/dt = -alpha (alpha - 1)/T; twenty steps of backward Euler
    x = BEYOND / (1 + BEYOND) * np.exp(-1)
    assert expanded == pytest.approx(x / (1 - x), rel=0.04)
