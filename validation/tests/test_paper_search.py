# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The search for the paper's stomach: its score, its sets, its restart."""

import json
import re
import subprocess
import sys
from concurrent.futures import Future

import numpy as np
import pytest
from bolus_results import markdown
from bolus_results.foam_files import FoamFileError
from bolus_validation import (
    paper,
    paper_page,
    paper_score,
    paper_search,
    paper_sets,
)
from bolus_validation.motility import PROFILE
from bolus_validation.paper import CASE_A
from scipy.interpolate import PchipInterpolator

PAPERS = {n: [t.paper, "", True] for n, t in paper_score.TARGETS.items()}
NONE = {name: [None, "", False] for name in paper_score.NAMES}


def test_the_papers_own_numbers_have_no_distance():
    assert paper_score.score(PAPERS) == 0


@pytest.mark.parametrize(
    ("row", "numbers"),
    [
        (3, (0.4, 0.5, 1.0, 5.0)),  # stress at 10.5 s [kPa]: to 0.41
        (7, (-3.1, -2.5, -1.0, 0.5)),  # triaxiality: below -3
        (8, (7.6, 7.0, 5.0, 1.0)),  # plastic strain: 7.5 to 30
        (8, (29, 31, 50, 100)),
        (9, (11, 9, 4, 0.1)),  # jet [mm/s]: 10 to 40
        (12, (12.9, 13.5, 14.0, 15.0)),  # outflow [s]: 12 to 13
        (19, (54, 58, 65, 80)),  # retained [%]: 45 to 55
        (20, (90, 95, 100, 250)),  # surface [%]: 72 to 92
    ],
)
def test_the_score_grows_with_the_distance_from_a_rows_range(row, numbers):
    name = paper_score.NAMES[row]
    found = [
        paper_score.score(PAPERS | {name: [number, "", None]})
        for number in numbers
    ]
    assert found[0] == 0
    assert np.all(np.diff(found) > 0)


def test_what_never_happens_costs_more_than_what_is_late_and_is_finite():
    name = paper_score.NAMES[1]
    late = PAPERS | {name: [9.5, "", False]}
    never = PAPERS | {name: [None, "", False]}
    assert paper_score.score(late) < paper_score.score(never) < 1
    assert paper_score.score(NONE) < 1


def test_numbers_at_the_ends_of_a_range_agree_as_in_the_comparison():
    for row, ends in (
        (CASE_A[8], paper.PLASTIC_STRAIN),
        (CASE_A[9], paper.JET),
        (CASE_A[10], paper.JET),
        (CASE_A[11], paper.BAND),
    ):
        key = f"{row.when}: {row.paper}"
        assert row.agrees_if.split(" mm/s")[0] == f"{ends[0]} to {ends[1]}"
        for end, beyond in zip(ends, (0.99, 1.01), strict=True):
            assert paper_score.distance(key, end) == 0
            assert paper_score.distance(key, end * beyond) > 0


def test_a_neck_is_the_thinnest_place_between_two_bulges():
    assert paper_score.neck(np.array([0, 1, 3, 2, 0])) == 1
    assert paper_score.neck(np.array([0, 4, 1, 2, 0])) == 0.5
    assert paper_score.neck(np.array([0, 4, 0, 2, 0])) == 0


def test_the_tutorials_set_is_the_tutorial():
    assert paper_sets.profile(paper_sets.TUTORIAL) == pytest.approx(
        1e3 * PROFILE, rel=2e-4
    )
    assert paper_sets.fault(paper_sets.TUTORIAL) is None


def test_every_proposed_set_keeps_to_the_text():
    proposals = paper_search.Proposals([])
    for n in range(40):
        trial, chosen = proposals.next()
        table = paper_sets.profile(chosen)
        x = np.linspace(0, 250, 5001)
        wall = PchipInterpolator(*table.T)
        volume = np.trapezoid(np.pi * wall(x) ** 2, x)
        assert volume == pytest.approx(0.88e6, rel=1e-3)
        assert wall(250) == pytest.approx(6)
        # The sphere, from the shell at 210 mm on, within the wall
        assert chosen["centre"] >= 222.8
        along = chosen["centre"] + np.linspace(-12.8, 12.8, 300)
        height = 12.8**2 - (along - chosen["centre"]) ** 2
        assert np.all(wall(along) ** 2 >= height - 1e-6)
        for p in paper_sets.PARAMETERS:
            if p.choice:
                assert chosen[p.name] in p.values
            else:
                assert p.values[0] <= chosen[p.name] <= p.values[1]
        record = {"set": chosen, "rows": NONE if n % 2 else PAPERS}
        proposals.tell(trial, record)


def test_the_stomach_of_case_a_as_reported_keeps_to_the_text():
    case = paper_search.ROOT / "tutorials" / "gastric" / "caseA_asReported"
    text = (case / "constant" / "motilityProperties").read_text()
    table = re.findall(r"\((\S+) +(\S+)\)\n", text.split("profile")[1])
    x, r = 1e3 * np.array(table, dtype=float)[: len(PROFILE)].T
    start = (case / "system" / "setAlphaFieldDict").read_text()
    centre = 1e3 * float(re.search(r"origin +\((\S+)", start)[1])
    chosen = paper_sets.TUTORIAL | {"centre": round(centre, 3)}
    for at in (220, 230, 240, 245):
        chosen[f"r{at}"] = r[x.round() == at][0]
    assert paper_sets.fault(chosen) is None
    assert paper_sets.volume(np.column_stack([x, r])) == pytest.approx(
        0.88e6, rel=1e-3
    )


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        ({"r230": 11.9, "centre": 226.0}, "no room for the sphere"),
        ({"r240": 12.3}, "does not narrow"),
        ({"centre": 222.0}, "in the shell"),
    ],
)
def test_sets_that_break_the_text_are_refused(change, fault):
    assert fault in paper_sets.fault(paper_sets.TUTORIAL | change)


class Here:
    """A pool of this process."""

    def __init__(self, workers, initializer):
        pass

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def submit(self, function, *job):
        future = Future()
        future.set_result(function(*job))
        return future


def test_a_stopped_search_goes_on_without_running_a_set_twice(tmp_path):
    ran, stopped = [], []

    def evaluate(base, job, sources):
        if len(ran) == 5 and not stopped:
            stopped.append(job.chosen)
            raise KeyboardInterrupt
        ran.append(job.chosen)
        return {
            "key": job.key(sources),
            "sources": sources,
            "set": job.chosen,
            "case": job.case,
            "size": job.size,
            "other": [],
            "gaveUp": False,
            "rows": PAPERS if job.chosen["tensile"] == "0" else NONE,
            "figures": {},
        }

    def search(number):
        return paper_search.search(
            tmp_path, number, evaluate, workers=1, pool_type=Here
        )

    with pytest.raises(KeyboardInterrupt):
        search(20)
    # A stop while a line was written
    with (tmp_path / "records.jsonl").open("a") as file:
        file.write('{"key": "cut sho')
    found = search(20)
    assert len(found.searched()) == 20
    assert stopped[0] in ran
    kept = [json.dumps(chosen, sort_keys=True) for chosen in ran]
    assert len(kept) == len(set(kept)) == 20
    # All there: nothing is left to run, and the page can be written
    assert len(search(20).searched()) == len(ran) == 20
    page, drawn = paper_page.write(found, tmp_path)
    assert "20 sets were run" in page.read_text()
    assert drawn.stat().st_size < 200e3


def test_records_of_other_sources_do_not_count(tmp_path):
    line = {
        "sources": "old",
        "case": "A",
        "size": 1.0,
        "other": [],
        "rows": NONE,
    }
    (tmp_path / "records.jsonl").write_text(json.dumps(line) + "\n")
    assert paper_search.Records(tmp_path, "new").searched() == []
    assert len(paper_search.Records(tmp_path, "old").searched()) == 1


def test_the_page_has_its_markers_once(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("before\n" + paper_page.BEGIN + "\nold\n")
    with pytest.raises(FoamFileError, match="each once"):
        markdown.put(page, paper_page.BEGIN, paper_page.END, "new")
    page.write_text(page.read_text() + paper_page.END + "\nafter\n")
    markdown.put(page, paper_page.BEGIN, paper_page.END, "new")
    assert page.read_text().split() == (
        f"before {paper_page.BEGIN} new {paper_page.END} after".split()
    )


def test_the_quick_search_runs_and_leaves_no_folders():
    # On 2 mm, to 9 s: it has to run, not to find anything
    study = paper_search.ROOT / "validation" / "studies" / "paper.py"
    done = subprocess.run(
        [sys.executable, study, "--quick"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    base = paper_search.BASE / "quick"
    assert len((base / "records.jsonl").read_text().splitlines()) == 3
    assert (base / "paper.png").exists()
    assert not list((base / "runs").iterdir())
