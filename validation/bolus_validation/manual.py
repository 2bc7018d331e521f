# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
r"""doc/inputs.md: the entries of all dictionaries, from the headers' \table.

    python -m bolus_validation.manual

The header of a class is its manual; this only gathers the tables. A test
fails if the page is not what this would write.
"""

import re
from pathlib import Path

from bolus_results import markdown

ROOT = Path(__file__).parents[2]
TARGET = ROOT / "doc" / "inputs.md"

HEAD = """\
# Inputs

Made from the header of each class by `python -m bolus_validation.manual`: edit
the headers, not this page. Example dictionaries and equations are there.
"""


def rows(table: str) -> list[list[str]]:
    """The cells of a table; lines indented deeper go on with their row."""
    lines = [line for line in table.splitlines() if line.strip()]
    if not lines:
        return []
    indent = len(lines[0]) - len(lines[0].lstrip())
    joined: list[str] = []
    for line in lines:
        text = line.strip().removesuffix("\\").strip()
        if joined and len(line) - len(line.lstrip()) > indent:
            joined[-1] += " " + text
        else:
            joined.append(text)
    cells = [[cell.strip() for cell in line.split("|")] for line in joined]
    width = len(cells[0])
    return [(row + [""] * width)[:width] for row in cells]


def section(path: Path) -> str:
    """The tables of a header as Markdown; empty without any."""
    text = path.read_text()
    tables = re.findall(r"\\table\n(.*?)\\endtable", text, re.DOTALL)
    if not tables:
        return ""
    where = path.relative_to(ROOT)
    parts = [f"## [{path.stem}](../{where})\n"]
    for table in tables:
        head, *body = rows(table)
        parts.append(markdown.table(head, body) + "\n")
    return "\n".join(parts)


def page() -> str:
    """The text of doc/inputs.md."""
    headers = [
        path
        for folder in ("src", "applications")
        for path in sorted((ROOT / folder).rglob("*.[HC]"))
        if "lnInclude" not in path.parts
    ]
    return "\n".join([HEAD, *filter(None, map(section, headers))])


if __name__ == "__main__":
    TARGET.write_text(page())
    print(TARGET)
