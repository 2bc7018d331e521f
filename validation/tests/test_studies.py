# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""What a kept run depends on."""

import importlib.util
import sys
from concurrent.futures import Future
from pathlib import Path

import pytest
from bolus_validation import studies
from test_page import Strict


@pytest.mark.parametrize(
    ("changed", "cutting", "gastric"),
    [
        ("src/coupled/a.C", True, True),
        ("tutorials/common/bolus", True, True),
        ("tutorials/cutting/wire2D/system/fvSolution", True, False),
        ("tutorials/gastric/caseA/system/fvSolution", False, True),
        ("validation/bolus_cases/cutting.py", True, False),
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


def test_a_long_study_runs_only_where_it_is_named(tmp_path, monkeypatch):
    ran = []

    def run_one(name, folder, key):
        ran.append(name)
        return {"name": name, "met": True, "error": None, "seconds": 0}

    class Here:
        """A pool of this process."""

        def __init__(self, max_workers, initializer):
            pass

        def __enter__(self):
            return self

        def __exit__(self, *_):
            pass

        def submit(self, function, *job):
            future = Future()
            future.set_result(function(*job))
            return future

    def nothing(folder, quick):
        pass

    monkeypatch.setattr(studies, "ROOT", tmp_path)
    monkeypatch.setattr(studies, "REGISTRY", {})
    monkeypatch.setattr(studies, "ProcessPoolExecutor", Here)
    monkeypatch.setattr(studies, "_run_one", run_one)
    monkeypatch.setattr(studies, "_write_page", lambda *_: None)
    studies.study("short", "S", "", "")(nothing)
    studies.study("hours", "S", "", "", long=True)(nothing)
    assert studies.run_all("page", "") == 0
    assert ran == ["short"]
    assert studies.run_all("page", "", ["hours"]) == 0
    assert ran == ["short", "hours"]


def test_what_the_mutations_break_is_in_the_sources_once():
    # A mutation that finds no text would break nothing
    path = Path(__file__).parents[1] / "studies" / "mutations.py"
    spec = importlib.util.spec_from_file_location("mutations", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules["mutations"] = module
    spec.loader.exec_module(module)
    lost = [
        m.name
        for m in module.MUTATIONS
        if (module.ROOT / m.file).read_text().count(m.old) != 1
    ]
    assert lost == []


def test_the_page_of_studies_is_well_formed_and_shows_what_is_missing(tmp_path):
    @studies.study("page", "G", "One < another", "itself")
    def found(folder, quick):
        found = studies.Findings(remarks=["x & y"], picture="a.png")
        found.row("a < b", "Pa", float("nan"), 2.0, 0.1)
        found.row("told", "-", 1.0)
        found.order("rest", [2, 1], [0.4, 0.1], 1)
        return found

    try:
        result = studies._run_one("page", tmp_path / "page", "key")
        studies._write_page(tmp_path, "all", "All & more", {"page": result})
    finally:
        del studies.REGISTRY["page"]
    text = (tmp_path / "all.html").read_text()
    parser = Strict()
    parser.feed(text)
    assert not parser.open
    assert "One < another" in parser.words and "x & y" in parser.words
    assert [i["src"] for i in parser.images] == ["page/a.png"]
    assert "2.00" in parser.words and "no" in parser.words
