# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""What OpenFOAM from v1912 to v2512 has in common is all that we take of it."""

import re

import pytest
from bolus_cases.specimens import ROOT

SOURCES = [
    path
    for folder in ("src", "applications")
    for path in sorted((ROOT / folder).rglob("*.[CH]"))
    if "lnInclude" not in path.parts
]

# Gone, or deprecated, in one of them; what serves all is in the other column
GONE = {
    r"\bcombineReduce\b": "reduce with an operation",
    r"\bPstreamCombineReduceOps\.H": "PstreamReduceOps.H",
    r"\blistCombine(Gather|Scatter)\b": "reduce of a field",
    r"\bmapCombine(Gather|Scatter)\b": "reduce of a map",
    r"\bscatterList\b": "reduce of a list",
    r"\.offset\(": "globalIndex::toGlobal(processor, 0)",
}


@pytest.mark.parametrize("pattern", GONE)
def test_no_source_takes_what_some_version_lacks(pattern):
    found = [
        str(path.relative_to(ROOT))
        for path in SOURCES
        if re.search(pattern, path.read_text())
    ]
    assert len(SOURCES) > 100
    assert found == [], f"take {GONE[pattern]}"


def test_reductions_come_after_what_they_need():
    # From v2506 on PstreamReduceOps.H does not bring it
    for path in SOURCES:
        lines = re.findall(r'#include "(\w+\.H)"', path.read_text())
        if "PstreamReduceOps.H" in lines:
            place = lines.index("PstreamReduceOps.H")
            assert "Pstream.H" in lines[:place], path
