# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The page of the search for the paper's stomach: tables and one picture."""

from itertools import combinations
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from bolus_results.markdown import put, table
from scipy.interpolate import PchipInterpolator

from bolus_validation import paper_score, paper_sets
from bolus_validation.paper import CASE_A
from bolus_validation.paper_search import (
    CHANCE,
    COARSE,
    FINE,
    Records,
    score,
)
from bolus_validation.studies import ROOT

BEGIN = "<!-- search: begin, made by ./Allrun validate paper --page -->"
END = "<!-- search: end -->"

# Sets that are as good as the best: their score is higher by at most this, that
# of one row. With a first step that is 1 % shorter a score has moved by 0.036
AS_GOOD = 0.06
BEST = 3

OUTLINES = dict(zip(paper_score.NAMES, CASE_A, strict=True))


def met(record: dict | None) -> str:
    """How many rows a record meets."""
    if record is None:
        return "not run"
    found = f"{paper_score.rows_met(record['rows'])}"
    return found + (" (gave up)" if record["gaveUp"] else "")


def cell(record: dict | None, name: str) -> str:
    """A row's number; bold if it agrees."""
    if record is None:
        return ""
    number, _, agrees = record["rows"][name]
    text = "never" if number is None else f"{number:.3g}"
    return f"**{text}**" if agrees is True else text


def columns(records: Records) -> dict[str, dict]:
    """{heading: set}: the tutorial and the best."""
    found = {"tutorial": paper_sets.TUTORIAL}
    for i, record in enumerate(records.best(BEST), 1):
        found[f"set {i}"] = record["set"]
    return found


def equally_good(records: Records) -> list[dict]:
    """Records that are as good as the best one."""
    ordered = records.searched()
    return [r for r in ordered if score(r) <= score(ordered[0]) + AS_GOOD]


def spread(parameter: paper_sets.Parameter, found: list[dict]) -> str:
    """Of a parameter among records."""
    values = [r["set"][parameter.name] for r in found]
    if parameter.choice:
        count = [(values.count(v), v) for v in parameter.values]
        return ", ".join(f"{v} ({n})" for n, v in count if n)
    return f"{min(values):.4g} to {max(values):.4g}"


def sets_table(records: Records) -> str:
    """What the sets are, and what the text has about it."""
    good = equally_good(records)
    rows = []
    for p in paper_sets.PARAMETERS:
        unit = f" [{p.unit}]" if p.unit else ""
        if p.choice:
            searched = ", ".join(p.values)
        else:
            searched = " to ".join(f"{v:g}" for v in p.values)
        rows.append(
            [
                p.label + unit,
                p.text,
                searched,
                *(paper_sets.text(p, one) for one in columns(records).values()),
                spread(p, good),
            ]
        )
    for label, case, size, other in (
        (f"rows met, {COARSE:g} mm", "A", COARSE, ()),
        ("... first step 1 % shorter", "A", COARSE, CHANCE),
        (f"rows met, {FINE:g} mm", "A", FINE, ()),
    ):
        runs = [
            records.of(one, case, size, other)
            for one in columns(records).values()
        ]
        every = [paper_score.rows_met(r["rows"]) for r in good]
        last = f"{min(every)} to {max(every)}" if "1 mm" in label else ""
        rows.append(
            [label, "", "", *(met(r) for r in runs), last],
        )
    return table(
        [
            "open",
            "the text",
            "searched",
            *columns(records),
            f"the {len(good)} that are as good",
        ],
        rows,
    )


def rows_table(records: Records) -> str:
    """Row by row: the best sets, and how many sets meet it."""
    every = records.searched()
    lines = []
    for name in paper_score.NAMES:
        row = OUTLINES[name]
        share = [r["rows"][name][2] is True for r in every]
        numbers = [r["rows"][name][0] for r in every]
        nearest = min(
            (n for n in numbers if n is not None),
            key=lambda n: paper_score.distance(name, n),
            default=None,
        )
        lines.append(
            [
                row.when,
                row.paper,
                row.agrees_if,
                *(
                    cell(
                        records.of(one, "A", FINE)
                        or records.of(one, "A", COARSE),
                        name,
                    )
                    for one in columns(records).values()
                ),
                f"{sum(share)} of {len(every)}"
                + (
                    ""
                    if any(share) or nearest is None
                    else f"; nearest {nearest:.3g}"
                ),
            ]
        )
    return table(
        [
            "when",
            "the paper",
            "agrees if",
            *columns(records),
            f"sets that agree, {COARSE:g} mm",
        ],
        lines,
    )


def excluded(records: Records, least: int) -> list[str]:
    """Pairs of rows of which each is met by at least so many sets, and no set
    meets both."""
    every = records.searched()
    holds = {
        name: np.array([r["rows"][name][2] is True for r in every])
        for name in paper_score.NAMES
    }
    found = []
    for a, b in combinations(paper_score.NAMES, 2):
        number = holds[a].sum(), holds[b].sum()
        if min(number) >= least and not np.any(holds[a] & holds[b]):
            found.append(f"- {a} ({number[0]}); {b} ({number[1]})")
    return found


def others(records: Records) -> str:
    """Cases B and C by the same sets."""

    def figures(one, case):
        record = records.of(one, case, COARSE)
        return record and record["figures"]

    rows = []
    for heading, one in columns(records).items():
        a, b, c = (figures(one, case) for case in "ABC")
        if not (a and b and c):
            continue

        def ratio(of, name, over=a):
            whole = of[name] is None or over[name] is None
            return "?" if whole else f"{of[name] / over[name]:.2f}"

        rows.append(
            [
                heading,
                f"{b['damaged']:.2g} %",
                *(ratio(b, n) for n in ("force", "work", "retained")),
                *(ratio(c, n) for n in ("work", "retained")),
            ]
        )
    return table(
        [
            "",
            "B damaged at 18 s (never any)",
            "B: peak force over A's (< 1)",
            "work (< 1)",
            "retained (far < 1)",
            "C: work over A's (> 1)",
            "retained (slightly < 1)",
        ],
        rows,
    )


def text(records: Records) -> str:
    """All that stands between the markers."""
    every = records.searched()
    pairs = excluded(records, max(3, len(every) // 20))
    return "\n\n".join(
        [
            f"{len(every)} sets were run; the best score is "
            f"{score(every[0]):.3f}, that of the tutorial's set "
            f"{_tutorial_score(records)}. As good as the best: a score higher "
            f"by at most {AS_GOOD:g}, a row; chance has moved it by 0.036. "
            "Of a choice, how many of these took it stands in brackets.",
            sets_table(records),
            "Cases B and C by the same sets, on 1 mm:",
            others(records),
            f"Row by row, on {FINE:g} mm where it was run. A row's number, "
            "bold where it agrees; ratios where the row compares two.",
            rows_table(records),
            "Rows that exclude each other: each is met by several sets "
            "(in brackets), both by none."
            if pairs
            else "No two rows that several sets meet exclude each other.",
            "\n".join(pairs),
        ]
    ).rstrip()


def _tutorial_score(records: Records) -> str:
    found = records.of(paper_sets.TUTORIAL, "A", COARSE)
    return "not known" if found is None else f"{score(found):.3f}"


def picture(records: Records, target: Path) -> None:
    """The stomachs, and which rows each set meets."""
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(12, 5.6), width_ratios=(1.1, 1)
    )
    x = np.linspace(210, 250, 161)
    for one in equally_good(records):
        wall = PchipInterpolator(*paper_sets.profile(one["set"]).T)(x)
        left.plot(x, wall, color="0.85", lw=0.8)
    for i, (heading, one) in enumerate(columns(records).items()):
        wall = PchipInterpolator(*paper_sets.profile(one).T)(x)
        style = {"color": "k", "ls": "--"} if i == 0 else {"color": f"C{i}"}
        left.plot(x, wall, label=heading, **style)
        angle = np.linspace(0, np.pi, 100)
        radius = paper_sets.BOLUS_RADIUS
        left.plot(
            one["centre"] + radius * np.cos(angle),
            radius * np.sin(angle),
            lw=0.8,
            **style,
        )
    left.axhline(13.5, color="0.6", lw=0.6, ls=":")
    left.set(xlabel="x [mm]", ylabel="r [mm]", ylim=(0, 18))
    left.set_aspect("equal")
    left.legend(fontsize=8)
    left.set_title("wall and bolus; grey: sets that are as good", fontsize=9)

    share = np.array(
        [
            np.mean([r["rows"][n][2] is True for r in records.searched()])
            for n in paper_score.NAMES
        ]
    )
    right.barh(range(len(share)), share, color="0.85")
    for i, one in enumerate(columns(records).values()):
        record = records.of(one, "A", FINE) or records.of(one, "A", COARSE)
        if record is None:
            continue
        agree = [
            n
            for n, name in enumerate(paper_score.NAMES)
            if record["rows"][name][2] is True
        ]
        right.plot(
            [1.06 + 0.06 * i] * len(agree),
            agree,
            "s",
            ms=5,
            color="k" if i == 0 else f"C{i}",
        )
    right.set_yticks(
        range(len(share)),
        [n if len(n) < 45 else n[:43] + "…" for n in paper_score.NAMES],
        fontsize=7,
    )
    right.invert_yaxis()
    right.set(xlim=(0, 1.3), xlabel="part of all sets that meet the row")
    right.set_xticks([0, 0.5, 1])
    right.set_title("rows met; squares: these sets", fontsize=9)
    figure.tight_layout()
    figure.savefig(target, dpi=85)
    plt.close(figure)


def write(records: Records, base: Path, into_doc: bool = False) -> list[Path]:
    """Write page and picture: into the folder of the search, or into doc."""
    if into_doc:
        page, drawn = ROOT / "doc" / "paper.md", ROOT / "doc" / "paper.png"
        put(page, BEGIN, END, text(records))
    else:
        page, drawn = base / "paper.md", base / "paper.png"
        page.write_text(text(records) + "\n")
    picture(records, drawn)
    return [page, drawn]
