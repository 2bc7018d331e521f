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
from bolus_cases.specimens import replace, run_case
from bolus_results.foam_files import expanded
from bolus_results.material_point import read_segments, run_material_point
from bolus_results.tables import read_table
from scipy.optimize import brentq

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "doc" / "adding-a-law.md"
FOLDER = "flowStress/Voce"


def blocks(*languages):
    """The page's blocks of code in these languages."""
    found = re.findall(r"^```(\w+)\n(.*?)^```", PAGE.read_text(), re.M | re.S)
    return [text for language, text in found if language in languages]


HEADER, CODE = blocks("cpp")
LINE, PROGRAMME = blocks("text")
LIBS_OF_POINT, LIBS_OF_CASE, OWN_LAW = blocks("foam")


def wmake(source, built):
    """Build a library of the page into a folder."""
    done = subprocess.run(
        ["wmake", "-j", "libso"],
        cwd=source,
        env=os.environ | {"FOAM_USER_LIBBIN": str(built), "PWD": str(source)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-3000:]


def libraries(folder, *names):
    """A folder with those that are linked to, libbolusInput among them."""
    folder.mkdir()
    for name in {"Input", *names}:
        built = Path(os.environ["FOAM_USER_LIBBIN"], f"libbolus{name}.so")
        (folder / built.name).symlink_to(built)
    return folder


def write_law(folder):
    """The two files of the page."""
    folder.mkdir(parents=True)
    (folder / "VoceFlowStress.H").write_text(HEADER)
    (folder / "VoceFlowStress.C").write_text(CODE)


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    """A copy of the rheology library with the page's law; its folder."""
    base = tmp_path_factory.mktemp("law")
    source = base / "rheology"
    (base / "input").symlink_to(ROOT / "src" / "input")
    shutil.copytree(
        ROOT / "src" / "rheology",
        source,
        ignore=shutil.ignore_patterns("lnInclude", "linux*"),
    )
    write_law(source / FOLDER)
    files = source / "Make" / "files"
    files.write_text(LINE + files.read_text())
    built = libraries(base / "lib")
    wmake(source, built)
    return built


@pytest.fixture(scope="module")
def own_library(tmp_path_factory):
    """The page's library of one's own; its folder."""
    base = tmp_path_factory.mktemp("own")
    write_law(base / "myFlowStress")
    make = base / "myFlowStress" / "Make"
    make.mkdir()
    for name, text in zip(("files", "options"), blocks("make"), strict=True):
        (make / name).write_text(text)
    built = libraries(base / "lib", "Input", "Rheology")
    wmake(base / "myFlowStress", built)
    return built


@pytest.fixture
def load(monkeypatch):
    """Have programs look for libraries in a folder first."""

    def first(folder):
        path = f"{folder}:{os.environ.get('LD_LIBRARY_PATH', '')}"
        monkeypatch.setenv("LD_LIBRARY_PATH", path)

    return first


def follows_its_equation(path) -> bool:
    """Does the table of materialPoint have the stress of Voce's law?"""
    table = read_segments(path)["compression"]
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
    return stress[late] == pytest.approx(expected, rel=1e-3)


def test_the_law_of_the_page_follows_its_equation(library, tmp_path, load):
    load(library)
    done = run_material_point(PROGRAMME, tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert follows_its_equation(tmp_path / "point.dat")


def test_without_the_line_the_law_is_not_known(tmp_path):
    done = run_material_point(PROGRAMME, tmp_path)
    assert done.returncode != 0
    assert "Voce" in done.stderr and "HerschelBulkley" in done.stderr


def test_the_code_of_the_page_has_the_form_that_is_checked():
    for text in (HEADER, CODE):
        done = subprocess.run(
            ["clang-format", f"--style=file:{ROOT / '.clang-format'}"],
            input=text,
            capture_output=True,
            text=True,
            check=True,
        )
        assert done.stdout == text
        assert "SPDX-License-Identifier: GPL-3.0-or-later" in text


def test_the_commands_of_the_page_put_the_law_into_the_inputs(tmp_path):
    # The clone's sources and what these commands need
    for name in ("src", "applications", "doc", "scripts", "validation"):
        shutil.copytree(
            ROOT / name,
            tmp_path / name,
            ignore=shutil.ignore_patterns("lnInclude", "linux*", "*.so"),
        )
    for name in (".clang-format", "pyproject.toml", ".shellcheckrc"):
        shutil.copy(ROOT / name, tmp_path / name)
    (tmp_path / ".local").mkdir()
    (tmp_path / ".local" / "venv").symlink_to(ROOT / ".local" / "venv")
    write_law(tmp_path / "src" / "rheology" / FOLDER)
    inputs = tmp_path / "doc" / "inputs.md"
    assert "VoceFlowStress" not in inputs.read_text()
    (commands,) = blocks("bash")
    done = subprocess.run(
        ["bash", "-e", "-c", commands],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": "", "PWD": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "| Q | what hardening adds [Pa] | yes | >= 0 |" in inputs.read_text()


def test_a_library_of_ones_own_serves_the_rheometer(
    own_library, tmp_path, load
):
    load(own_library)
    done = run_material_point(LIBS_OF_POINT + PROGRAMME, tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert follows_its_equation(tmp_path / "point.dat")


def test_a_library_that_is_not_there_is_told(tmp_path):
    done = run_material_point(LIBS_OF_POINT + PROGRAMME, tmp_path)
    assert done.returncode != 0
    assert 'not all of 1("libmyFlowStress.so") can be loaded' in done.stderr


@pytest.fixture
def own_case(own_library, tmp_path, load):
    """The page's case: that of the stomach with its list and its law."""
    load(own_library)
    case = tmp_path / "myCase"
    shutil.copytree(ROOT / "tutorials" / "gastric" / "caseA", case)
    replace(
        case / "system" / "controlDict", r"\nlibs\n\([^)]*\);\n", LIBS_OF_CASE
    )
    replace(
        case / "constant" / "bolusProperties",
        r"tutorials/common/law\"\n",
        'tutorials/common/law"\n' + OWN_LAW,
    )
    # Pictures and comparison have their own tests
    replace(case / "Allrun", r"\nfinish[^\0]*", "\n")
    return case


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_library_of_ones_own_serves_a_case(own_case, tmp_path, ranks):
    out = tmp_path / f"run{ranks}"
    run_case(
        *(own_case, "-np", ranks, "-out", out),
        *("-set", "resolution=2e-3", "-set", "pylorusRefinement=2.5"),
        *("-set", "endTime=0.02", "-set", "deltaT=0.01"),
    )
    assert read_table(out, "solver", "steps").time[-1] == pytest.approx(0.02)
    assert expanded(out, "constant/bolusProperties")["flowStress.Q"] == "3000"


def test_what_the_own_law_leaves_out_is_not_taken_from_the_included_one(
    own_case, tmp_path
):
    properties = own_case / "constant" / "bolusProperties"
    replace(
        properties, r"type\s+Voce;[^}]*", "type HerschelBulkley;\n k 1; n 1;"
    )
    said = run_case(
        *(own_case, "-out", tmp_path / "run"),
        *("-set", "law=HerschelBulkley", "-set", "resolution=2e-3"),
        ok=False,
    )
    assert "Missing entry 'sigma0'" in said
