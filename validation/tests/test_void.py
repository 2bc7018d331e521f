# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""What the gas does in broken bolus."""

import pytest
from bolus_cases.specimens import GRIPPING, box, ramp, solve
from bolus_results.tables import read_table

LENGTH = 0.01  # of a column of broken bolus [m]
CELLS = 20


AREA = LENGTH / CELLS * 0.01  # of the column's end [m2]


def pull(case, cohesion: float) -> float:
    """Tension [Pa] in a column between walls that hold on to it, of which one
    goes off by a fifth in 1 s."""
    box(
        case,
        size=(LENGTH, LENGTH / CELLS),
        counts=(CELLS, 1),
        patches={
            "x0": (GRIPPING, ramp(1, lambda t: (0, 0, 0), 1)),
            "x1": (GRIPPING, ramp(1, lambda t: (0.2 * LENGTH * t, 0, 0))),
            "y0": "symmetryPlane",
            "y1": "symmetryPlane",
        },
        end=1,
        step=0.02,
        material="viscoplasticDamage",
        damaged=True,
    )
    with open(case / "constant" / "bolusProperties", "a") as file:
        file.write(f"gasCoeffs {{ cohesion {cohesion}; etaDamaged 1e-3; }}\n")
    solve(case)
    return abs(read_table(case, "forceX1", "contactForce")["axial"][-1]) / AREA


@pytest.mark.parametrize("cohesion", [0, 200])
def test_crumbs_hold_their_cohesion_and_no_more(tmp_path, cohesion):
    # Beyond it they open everywhere, at 0.2/s: at most 4 Pa by zeta 20 Pa s;
    # 2 Pa are the rounding of the corner (delta)
    assert pull(tmp_path, cohesion) == pytest.approx(cohesion, abs=6)
