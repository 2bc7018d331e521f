# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The example of doc/adding-a-law.md, built and run as it stands there."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from bolus_validation import rheology
from scipy.optimize import brentq

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "doc" / "adding-a-law.md"
FOLDER = "flowStress/Voce"


def blocks():
    """(language, text) of the page's blocks of code."""
    return re.findall(r"^```(\w+)\n(.*?)^```", PAGE.read_text(), re.M | re.S)


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    """A copy of the rheology library with the page's law; its folder."""
    base = tmp_path_factory.mktemp("law")
    source = base / "rheology"
    shutil.copytree(
        ROOT / "src" / "rheology",
        source,
        ignore=shutil.ignore_patterns("lnInclude", "linux*"),
    )
    (header, code), (line, _) = (
        [text for kind, text in blocks() if kind == language]
        for language in ("cpp", "text")
    )
    (source / FOLDER).mkdir()
    (source / FOLDER / "VoceFlowStress.H").write_text(header)
    (source / FOLDER / "VoceFlowStress.C").write_text(code)
    files = source / "Make" / "files"
    files.write_text(line + files.read_text())
    built = base / "lib"
    built.mkdir()
    done = subprocess.run(
        ["wmake", "-j", "libso"],
        cwd=source,
        env=os.environ | {"FOAM_USER_LIBBIN": str(built), "PWD": str(source)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-3000:]
    return built


def test_the_law_of_the_page_follows_its_equation(
    library, tmp_path, monkeypatch
):
    monkeypatch.setenv(
        "LD_LIBRARY_PATH",
        f"{library}:{os.environ.get('LD_LIBRARY_PATH', '')}",
    )
    text = [text for kind, text in blocks() if kind == "text"][1]
    done = rheology.run_material_point(text, tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    table = rheology.read_table(tmp_path / "point.dat")["compression"]
    strain, stress = abs(table["axialStrain"]), abs(table["axialStress"])

    def exact(e):
        def residual(s):
            plastic = max(e - s / 100e3, 0)
            return s - 2000 - 3000 * (1 - np.exp(-8 * plastic))

        elastic = 100e3 * e
        return elastic if elastic <= 2000 else brentq(residual, 0, 5000)

    late = strain > 0.001
    assert late.sum() > 50
    expected = np.array([exact(e) for e in strain[late]])
    assert stress[late] == pytest.approx(expected, rel=1e-3)


def test_without_the_line_the_law_is_not_known(tmp_path):
    text = [text for kind, text in blocks() if kind == "text"][1]
    done = rheology.run_material_point(text, tmp_path)
    assert done.returncode != 0
    assert "Voce" in done.stderr and "HerschelBulkley" in done.stderr
