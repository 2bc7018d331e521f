# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Tables in Markdown, and their place in a page that is written by hand."""

from pathlib import Path

from bolus_results.foam_files import FoamFileError


def table(heads, rows) -> str:
    """A table of these heads and rows of cells."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join(f"| {' | '.join(map(str, line))} |" for line in lines)


def put(page: Path, begin: str, end: str, text: str) -> None:
    """Replace what stands between two lines of a page."""
    old = page.read_text()
    if old.count(begin) != 1 or old.count(end) != 1:
        raise FoamFileError(
            f"{page}: must have these two lines, each once:\n{begin}\n{end}"
        )
    before, rest = old.split(begin)
    after = rest.split(end)[1]
    page.write_text(f"{before}{begin}\n\n{text.rstrip()}\n\n{end}{after}")
