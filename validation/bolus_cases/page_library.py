# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Libraries that the pages doc/adding-*.md print, built as they stand there."""

import os
import re
import subprocess
from contextlib import contextmanager
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def blocks(page: str, language: str) -> list[str]:
    """Blocks of code of doc/<page>.md in a language."""
    text = (ROOT / "doc" / f"{page}.md").read_text()
    found = re.findall(r"^```(\w+)\n(.*?)^```", text, re.M | re.S)
    return [code for its, code in found if its == language]


@contextmanager
def built(page: str, name: str, folder: Path):
    """Build the class of that name, header and source; while the context
    lasts programs find the library."""
    source = folder / "library"
    (source / "Make").mkdir(parents=True)
    header, code = blocks(page, "cpp")
    (source / f"{name}.H").write_text(header)
    (source / f"{name}.C").write_text(code)
    makes = blocks(page, "make")
    for file, text in zip(("files", "options"), makes, strict=True):
        (source / "Make" / file).write_text(text)
    lib = folder / "lib"
    lib.mkdir()
    # Where -lbolus... is looked for
    for library in Path(os.environ["FOAM_USER_LIBBIN"]).glob("libbolus*.so"):
        (lib / library.name).symlink_to(library)
    done = subprocess.run(
        ["wmake", "libso"],
        cwd=source,
        env=os.environ | {"FOAM_USER_LIBBIN": str(lib), "PWD": str(source)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-3000:]
    with pytest.MonkeyPatch.context() as patch:
        path = f"{lib}:{os.environ.get('LD_LIBRARY_PATH', '')}"
        patch.setenv("LD_LIBRARY_PATH", path)
        yield


def is_formatted(page: str) -> bool:
    """Has the page's C++ the form and licence that are checked?"""
    for text in blocks(page, "cpp"):
        done = subprocess.run(
            ["clang-format", f"--style=file:{ROOT / '.clang-format'}"],
            input=text,
            capture_output=True,
            text=True,
            check=True,
        )
        if done.stdout != text or "SPDX-License-Identifier" not in text:
            return False
    return True
