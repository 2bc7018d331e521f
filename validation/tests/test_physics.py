# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The fast studies of ./Allrun validate physics, groups A and B.

Each runs on its coarsest mesh, with wider limits than those of the page. Not
here: translation, which needs a fine mesh, and meshKinds, which takes long.
"""

import importlib

import pytest
from bolus_validation.studies import REGISTRY

for _name in ("elasticity", "flow", "limit", "objectivity", "turning"):
    importlib.import_module(f"bolus_validation.physics.{_name}")

STUDIES = (
    "shellElastic",
    "shellPlastic",
    "shear",
    "relaxation",
    "rotation",
    "pipe",
    "punch",
    "cylinder",
)


@pytest.mark.parametrize("name", STUDIES)
def test_a_coarse_study_is_within_its_limits(tmp_path, name):
    found = REGISTRY[name].function(tmp_path, quick=True)
    assert any(row.limit is not None for row in found.rows)
    missed = [
        f"{row.quantity}: {row.value:.5g}, not {row.reference:.5g}"
        for row in found.rows
        if row.met is False
    ]
    assert not missed
    assert (tmp_path / found.picture).stat().st_size > 10_000
