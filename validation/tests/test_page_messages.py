# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""What a page tells of the messages of OpenFOAM's tools, without a run."""

import pytest
from bolus_cases.synthetic import write_file
from bolus_results import page

HARMLESS = """
--> FOAM Warning :
    From function Foam::polyBoundaryMesh::groupPatchIDs() const
    in file meshes/polyMesh/polyBoundaryMesh/polyBoundaryMesh.C at line 510
    Removed patchGroup 'wall' which clashes with patch 1 of the same name.
"""
REAL = """
--> FOAM Warning :
    From function void Foam::something()
    in file some/where.C at line 7
    Found small volumes:
    3 cells
"""
FATAL = """
[1] --> FOAM FATAL ERROR:
[1] no convergence at t = 3 s
[1]
[1]     From function void Foam::step()
[1]     in file step.C at line 1.
"""


@pytest.fixture
def case(tmp_path, monkeypatch):
    """A folder with a controlDict, as seen from another folder."""
    write_file(
        tmp_path / "system" / "controlDict", "endTime 3; a { b $endTime; }"
    )
    monkeypatch.setenv("PWD", "/usr")
    return tmp_path


def test_inputs_are_the_entries_of_the_dictionary_only(case):
    inputs, warnings = page.read_inputs(case)
    assert inputs == {"system/controlDict": {"endTime": "3", "a.b": "3"}}
    assert warnings == []


def test_a_warning_about_an_input_is_told_beside_it(case, monkeypatch):
    tool = case / "bin" / "foamDictionary"
    tool.parent.mkdir()
    tool.write_text(
        f"#!/bin/sh\ncat << 'END'\n{REAL}\n/*--------*\\\n*/\na 1;\nEND\n"
    )
    tool.chmod(0o755)
    monkeypatch.setenv("PATH", str(tool.parent), prepend=":")
    inputs, warnings = page.read_inputs(case)
    assert inputs == {"system/controlDict": {"a": "1"}}
    (warning,) = warnings
    assert warning.endswith("Found small volumes: 3 cells")


def test_every_warning_but_the_harmless_is_told_with_its_count(case):
    (case / "log.setAlphaField").write_text(HARMLESS)
    assert not any("log." in text for text in page.warn(case, {}, {}))
    (case / "log.setAlphaField").write_text(HARMLESS + 2 * REAL + FATAL)
    told = [text for text in page.warn(case, {}, {}) if "log." in text]
    assert told == [
        "log.setAlphaField: Warning, 2 times: Found small volumes: 3 cells",
        "log.setAlphaField: FATAL, 1 times: no convergence at t = 3 s",
    ]
