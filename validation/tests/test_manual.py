# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The pages of doc/ are current, and what they point to is there."""

import re

import pytest
from bolus_validation import manual

PAGES = [manual.ROOT / "README.md", *sorted(manual.TARGET.parent.glob("*.md"))]


def test_inputs_page_is_what_the_headers_say():
    assert manual.TARGET.read_text() == manual.page(), (
        "run python -m bolus_validation.manual"
    )


def test_rows_that_go_on_in_the_next_line_are_one_row():
    table = "    a | b\n    x | one\n        two | three\n    y | \\\n      4\n"
    assert manual.rows(table) == [["a", "b"], ["x", "one two"], ["y", "4"]]


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.name)
def test_links_of_the_pages_lead_somewhere(path):
    for link in re.findall(r"\]\(([^)#:]+)\)", path.read_text()):
        assert (path.parent / link).exists(), f"{path}: {link}"
