# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""./Allrun report: the page tells what is in the runs, and a browser shows it.

Two runs of the compression tutorial, which differ in the material.
"""

import json
import re
import shutil
import subprocess
from html.parser import HTMLParser
from pathlib import Path

import pytest
from bolus_cases.specimens import compression
from bolus_results import page
from bolus_results.foam_files import FoamFileError
from matplotlib import image

ROOT = Path(__file__).resolve().parents[2]
BROWSERS = ("chromium", "chromium-browser", "google-chrome")


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Two short runs."""
    base = tmp_path_factory.mktemp("page")
    for name in ("soft", "hard"):
        material = {"soft": "JLaw", "hard": "viscoplastic"}[name]
        compression(
            base / name,
            material=material,
            strain=0.1,
            unloadStrain=0,
            writeStrain=0.05,
            nAxial=10,
            nRadial=20,
        )
    return base / "soft", base / "hard"


@pytest.fixture(scope="module")
def written(runs, tmp_path_factory):
    """The page of both, by the command."""
    out = tmp_path_factory.mktemp("report")
    done = subprocess.run(
        [ROOT / "scripts" / "report", *runs, "-out", out],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == str(out / "page.html")
    return out / "page.html"


class Strict(HTMLParser):
    """Fails on a tag that is not closed in order; keeps images and text."""

    VOID = {"meta", "img", "br"}

    def __init__(self):
        super().__init__()
        self.open, self.images, self.words = [], [], []

    def handle_starttag(self, tag, attributes):
        """Keep what is open."""
        if tag == "img":
            self.images.append(dict(attributes))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        """It must close the last that is open."""
        assert self.open and self.open.pop() == tag, (tag, self.getpos())

    def handle_data(self, data):
        """Keep the text."""
        self.words.append(data)


def test_the_page_is_one_file_and_well_formed(written):
    text = written.read_text()
    parser = Strict()
    parser.feed(text)
    assert not parser.open
    assert parser.images
    for one in parser.images:
        assert one["src"].startswith("data:image/"), one["src"][:80]
    assert not re.search(r'(src|href)="(?!data:)', text)
    assert any(one["src"].startswith("data:image/gif") for one in parser.images)


def test_the_page_holds_the_numbers_of_the_runs_and_marks_what_differs(
    written, runs
):
    text = written.read_text()
    kept = json.loads((written.parent / "results.json").read_text())
    for run in runs:
        force = kept[str(run)]["results"]["contactForce"]
        peak = next(v for v in page.flat(force).values())
        assert f"{peak['value']:.6g}" in text
    differing = re.findall(r"<tr class=differs><td>([^<]*)", text)
    assert "flowStress.type" in differing
    assert "elasticity.E" not in differing


def test_a_run_that_stopped_early_is_told(runs, tmp_path):
    run = tmp_path / "short"
    shutil.copytree(runs[0], run)
    control = run / "system" / "controlDict"
    control.write_text(control.read_text() + "\nendTime 1000;\n")
    assert any("before its 1000 s" in text for text in page.show(run).warnings)
    assert not any("before its" in t for t in page.show(runs[0]).warnings)


def test_what_is_no_run_is_refused(tmp_path):
    with pytest.raises(FoamFileError, match="not a case"):
        page.write([tmp_path])
    with pytest.raises(FoamFileError, match="no results"):
        page.write([ROOT / "tutorials" / "rheology" / "compression"])


def test_a_browser_shows_the_page_with_all_its_pictures(written, tmp_path):
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        pytest.skip(f"NO BROWSER: none of {', '.join(BROWSERS)} is installed")

    def run(*options):
        done = subprocess.run(
            [
                browser,
                "--headless",
                "--no-sandbox",
                "--disable-gpu",
                "--virtual-time-budget=5000",
                f"--user-data-dir={tmp_path / 'profile'}",
                *options,
            ],
            capture_output=True,
            text=True,
            timeout=120,
        )
        assert done.returncode == 0, done.stderr[-2000:]
        return done.stdout

    # The browser itself says which pictures it could decode
    looked = tmp_path / "looked.html"
    looked.write_text(
        written.read_text().replace(
            "</body>",
            "<script>onload = () => document.body.dataset.widths = "
            "[...document.images].map(i => i.naturalWidth).join()</script>"
            "</body>",
        )
    )
    found = run("--dump-dom", looked.as_uri())
    widths = re.search(r'data-widths="([\d,]+)"', found)
    assert widths, "the browser ran no script"
    parser = Strict()
    parser.feed(written.read_text())
    sizes = [int(w) for w in widths.group(1).split(",")]
    assert len(sizes) == len(parser.images)
    assert min(sizes) > 100

    shot = tmp_path / "shot.png"
    run(f"--screenshot={shot}", "--window-size=1400,3000", written.as_uri())
    pixels = image.imread(shot)[..., :3]
    assert pixels.shape[:2] == (3000, 1400)
    # Text and pictures, not an empty page
    assert (pixels.min(axis=2) < 0.5).mean() > 0.005
