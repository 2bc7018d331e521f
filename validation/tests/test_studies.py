# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""What a kept run depends on."""

import pytest
from bolus_validation import studies


@pytest.mark.parametrize(
    ("changed", "cutting", "gastric"),
    [
        ("src/coupled/a.C", True, True),
        ("tutorials/common/bolus", True, True),
        ("tutorials/cutting/wire2D/system/fvSolution", True, False),
        ("tutorials/gastric/caseA/system/fvSolution", False, True),
        ("validation/bolus_validation/cutting.py", True, False),
        ("tutorials/gastric/caseA/README.md", False, False),
    ],
)
def test_a_run_is_kept_until_what_it_depends_on_changes(
    tmp_path, monkeypatch, changed, cutting, gastric
):
    # Not until a tutorial of another family does: hours of runs hang on it
    monkeypatch.setattr(studies, "ROOT", tmp_path)
    path = tmp_path / changed
    path.parent.mkdir(parents=True)
    path.write_text("before")
    before = {f: studies.solver_hash([f]) for f in ("cutting", "gastric")}
    path.write_text("after")
    assert (studies.solver_hash(["cutting"]) != before["cutting"]) == cutting
    assert (studies.solver_hash(["gastric"]) != before["gastric"]) == gastric
