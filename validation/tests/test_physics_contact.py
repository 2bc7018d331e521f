# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Contact and fracture: the fast versions of the studies of groups C and D.

The full ones: ./Allrun validate physics.
"""

import pytest
from bolus_validation.physics import (  # noqa: F401
    confined,
    contact,
    fracture,
)
from bolus_validation.studies import REGISTRY

FAST = (
    "slidingBlock",
    "frictionalPlatens",
    "separation",
    "convergingTube",
    "barInTension",
    "noFracture",
)


def told(found) -> str:
    """What is not met, for the message of a failure."""
    return "\n".join(
        f"{x.quantity}: {getattr(x, 'value', None)}, "
        f"not {getattr(x, 'reference', None)}"
        for x in (*found.rows, *found.orders)
        if x.met is False
    )


@pytest.mark.parametrize("name", FAST)
def test_fast_study_is_within_its_limits(name, tmp_path):
    found = REGISTRY[name].function(tmp_path, quick=True)
    assert any(row.met is not None for row in found.rows)
    assert found.met, told(found)
    assert (tmp_path / found.picture).is_file()
