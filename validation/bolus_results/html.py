# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""HTML pages by jinja2, from the folders templates of the packages."""

import base64
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined


def picture(path: Path) -> str:
    """A picture as an address that holds it itself."""
    data = base64.b64encode(path.read_bytes()).decode()
    return f"data:image/{path.suffix[1:]};base64,{data}"


def render(name: str, **given) -> str:
    """The page of a template bolus_*/templates/NAME; all text is escaped."""
    pages = Environment(
        loader=FileSystemLoader(Path(__file__).parents[1].glob("*/templates")),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    pages.filters["picture"] = picture
    return pages.get_template(name).render(given)
