# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The search for the paper's stomach: runs of case A, two at a time.

Every run that was measured is a line of records.jsonl, so that a search which
was stopped goes on where it was. What to try next is chosen by Optuna's
tree-structured Parzen estimator: it takes numbers and choices together, and
results in any order. Runs are serial; their folders are deleted when they are
measured.
"""

import hashlib
import json
import os
import shutil
import sys
import time
from collections.abc import Callable
from concurrent.futures import (
    FIRST_COMPLETED,
    ProcessPoolExecutor,
    as_completed,
    wait,
)
from dataclasses import dataclass
from pathlib import Path

import optuna
from bolus_results.results import write_json
from optuna.distributions import CategoricalDistribution, FloatDistribution
from optuna.trial import TrialState, create_trial

from bolus_validation import paper_score, paper_sets
from bolus_validation.paper import MEASURE, Run
from bolus_validation.studies import (
    ROOT,
    _end_with_parent,
    gastric_settings,
    run_tutorial,
    solver_hash,
)

BASE = ROOT / "run" / "validate" / "paper"
COARSE = 1.0  # the search's cells [mm]
FINE = 0.5  # those of the best sets [mm]

# Sets that are run, starts included, before the estimator has a say; its seed
AT_RANDOM, SEED = 16, 34

# By these the best sets that are shown differ
READINGS = ("times", "tensile")

# A case as its tutorial has it, without pictures and summary
ALLRUN = """\
#!/usr/bin/env bash
source "${BOLUSFOAM_DIR:?}/scripts/caseFunctions"
initialFields
prepare python system/makeBlockMeshDict.py
prepare blockMesh
prepare gastricMesh
prepare setAlphaField
solve bolusFoam
"""


@dataclass(frozen=True)
class Job:
    """A run: a set, a case, cells [mm]; other: further -set entries."""

    chosen: dict
    case: str = "A"
    size: float = COARSE
    other: tuple = ()

    @property
    def entries(self) -> dict:
        """Its -set entries; case C has no damage."""
        own = paper_sets.settings(self.chosen)
        if self.case == "C":
            del own["tensileStrain"]
        return {
            **own,
            **{k: f"{v:g}" for k, v in gastric_settings(self.size).items()},
            **dict(self.other),
        }

    def key(self, sources: str) -> str:
        """What names it, for the sources as they are."""
        text = json.dumps([sources, self.case, sorted(self.entries.items())])
        return hashlib.sha256(text.encode()).hexdigest()[:16]


def sources() -> str:
    """Hash of what runs depend on beside their settings."""
    return solver_hash(
        [f"gastric/case{c}/{d}" for c in "ABC" for d in ("system", "constant")]
        + ["gastric/caseA/0.orig"]
    )


def _tutorial(base: Path, case: str) -> Path:
    return base / "cases" / f"case{case}"


def _prepare(base: Path) -> None:
    """Cases that only solve, beside what they are made of."""
    for case in "ABC":
        folder = _tutorial(base, case)
        folder.mkdir(parents=True, exist_ok=True)
        origin = ROOT / "tutorials" / "gastric" / f"case{case}"
        (folder / "base").write_text(os.path.relpath(origin, folder) + "\n")
        (folder / "Allrun").write_text(ALLRUN)
        (folder / "Allrun").chmod(0o755)


def run(base: Path, job: Job, sources: str, keep: bool = False) -> dict:
    """Run it; the line of records.jsonl. A run that gave up a step is measured
    as far as it came: what it did not reach did not happen."""
    key = job.key(sources)
    folder = base / "runs" / key
    shutil.rmtree(folder, ignore_errors=True)
    folder.parent.mkdir(parents=True, exist_ok=True)
    start = time.monotonic()
    options = ["=".join(entry) for entry in job.entries.items()]
    gave_up = run_tutorial(_tutorial(base, job.case), folder, options)
    write_json(folder, MEASURE)
    of = Run(folder)
    record = {
        "key": key,
        "sources": sources,
        "set": job.chosen,
        "case": job.case,
        "size": job.size,
        "other": list(job.other),
        "gaveUp": gave_up is not None,
        "rows": paper_score.measure(of),
        "figures": figures(of),
        "seconds": round(time.monotonic() - start, 1),
    }
    if not keep:
        shutil.rmtree(folder)
    return record


def figures(of: Run) -> dict:
    """What cases are compared by; None: not reached."""
    work = of.series("externalWork", "work_perMass", 32)
    damaged = of.series("damagedVolume", "fraction", 18)
    mass = of.series("retainedMass", "retained", 7.5, 32)
    return {
        "force": of.peak("contactForce", "total_perMass", 0, 32),
        "work": work and work[0],
        "retained": mass and 100 * mass[1] / mass[0],
        "damaged": damaged and 100 * damaged[0],
    }


class Records:
    """What has been run, in a file of JSON lines; a line cut short by a stop
    counts for nothing."""

    def __init__(self, base: Path, sources: str):
        self.path = base / "records.jsonl"
        self.all: list[dict] = []
        text = self.path.read_text() if self.path.exists() else ""
        for line in text.splitlines():
            try:
                record = json.loads(line)
            except json.JSONDecodeError:
                continue
            if record["sources"] == sources:
                self.all.append(record)
        if text and not text.endswith("\n"):
            with self.path.open("a") as file:
                file.write("\n")

    def add(self, record: dict) -> None:
        """Keep one."""
        self.all.append(record)
        with self.path.open("a") as file:
            file.write(json.dumps(record) + "\n")

    def searched(self) -> list[dict]:
        """Those of the search, best first."""
        found = [
            r
            for r in self.all
            if (r["case"], r["size"], r["other"]) == ("A", COARSE, [])
        ]
        return sorted(found, key=score)

    def best(self, few: int) -> list[dict]:
        """The best of the search, each by another timeline or kind of
        fracture: neighbours tell the same. Those that were run on finer cells
        come first, by their score there."""
        found: dict = {}

        def order(record):
            fine = self.of(record["set"], "A", FINE)
            return (not fine, score(fine or record))

        for record in sorted(self.searched(), key=order):
            reading = tuple(record["set"][name] for name in READINGS)
            found.setdefault(reading, record)
        return list(found.values())[:few]

    def of(self, chosen: dict, case: str, size: float, other=()) -> dict | None:
        """That of a set, if it has been run."""
        for r in self.all:
            if (r["set"], r["case"], r["size"]) == (chosen, case, size) and r[
                "other"
            ] == [list(o) for o in other]:
                return r
        return None


def score(record: dict) -> float:
    """Of a record, by the rows as they are weighted now."""
    return paper_score.score(record["rows"])


def _distribution(parameter: paper_sets.Parameter):
    if parameter.choice:
        return CategoricalDistribution(parameter.values)
    return FloatDistribution(*parameter.values)


DISTRIBUTIONS = {p.name: _distribution(p) for p in paper_sets.PARAMETERS}


def _rounded(chosen: dict) -> dict:
    """To what makes a difference: 0.01 mm, 1 Pa."""
    digits = {"cohesion": 0}
    return {
        name: v if isinstance(v, str) else round(v, digits.get(name, 2))
        for name, v in chosen.items()
    }


class Proposals:
    """Sets to try: first the starts, then as Optuna proposes."""

    def __init__(self, records: list[dict], seed: int = SEED):
        optuna.logging.set_verbosity(optuna.logging.WARNING)
        optuna.logging.disable_default_handler()
        # Another seed after a stop: else it would draw the same again
        sampler = optuna.samplers.TPESampler(
            multivariate=True,
            constant_liar=True,
            n_startup_trials=AT_RANDOM,
            seed=seed + len(records),
        )
        self.study = optuna.create_study(sampler=sampler)
        for record in records:
            self.study.add_trial(
                create_trial(
                    params=record["set"],
                    distributions=DISTRIBUTIONS,
                    value=score(record),
                )
            )
        self.tried = [r["set"] for r in records]
        for chosen in paper_sets.STARTS:
            if chosen not in self.tried:
                self.study.enqueue_trial(chosen)

    def next(self) -> tuple:
        """A trial and its set, which breaks nothing of the text."""
        while True:
            trial = self.study.ask(DISTRIBUTIONS)
            chosen = _rounded(trial.params)
            if chosen in self.tried or paper_sets.fault(chosen):
                self.study.tell(trial, state=TrialState.FAIL)
                continue
            self.tried.append(chosen)
            return trial, chosen

    def tell(self, trial, record: dict) -> None:
        """What came of it."""
        self.study.tell(trial, score(record))


def _progress(records: Records, number: int, start: float, ran: int) -> None:
    found = records.searched()
    left = (time.monotonic() - start) / ran * (number - len(found)) / 60
    best = found[0]
    print(
        f"  {len(found)}/{number} sets, best {score(best):.3f}, "
        f"{paper_score.rows_met(best['rows'])} of {len(paper_score.NAMES)} "
        f"rows; {max(left, 0):.0f} min left",
        flush=True,
    )


def search(
    base: Path,
    number: int,
    evaluate: Callable = run,
    workers: int = 2,
    minutes: float | None = None,
    pool_type: type = ProcessPoolExecutor,
) -> Records:
    """Try sets until there are so many, or the time is over.

    evaluate   (base, job, sources) -> record
    """
    now = sources()
    records = Records(base, now)
    _prepare(base)
    kept = {record["key"] for record in records.all}
    for folder in (base / "runs").glob("*"):
        # Of a search that was stopped
        if folder.name not in kept:
            shutil.rmtree(folder)
    proposals = Proposals(records.searched())
    start, ran = time.monotonic(), 0
    left = number - len(records.searched())
    with pool_type(workers, initializer=_end_with_parent) as pool:
        trials: dict = {}
        while left > 0 or trials:
            late = minutes and time.monotonic() - start > 60 * minutes
            if late:
                left = 0
            while left > 0 and len(trials) < workers:
                trial, chosen = proposals.next()
                job = Job(chosen)
                trials[pool.submit(evaluate, base, job, now)] = trial
                left -= 1
            for future in wait(trials, return_when=FIRST_COMPLETED).done:
                trial = trials.pop(future)
                try:
                    record = future.result()
                except RuntimeError as error:
                    # No mesh, killed: said, and not tried again in this search
                    print(f"  failed: {error}", file=sys.stderr, flush=True)
                    proposals.study.tell(trial, state=TrialState.FAIL)
                    continue
                records.add(record)
                proposals.tell(trial, record)
                ran += 1
                _progress(records, number, start, ran)
    return records


# Chance: the same with a first step that is 1 % shorter
CHANCE = (("deltaT", "0.0099"),)


def refine(base: Path, records: Records, number: int) -> None:
    """The best sets of the search on finer cells: bolus that parts in two on
    0.5 mm need not do so on 1 mm."""
    chosen = [r["set"] for r in records.searched()[:number]]
    _complete(base, records, [Job(one, "A", FINE) for one in chosen])


def judge(base: Path, records: Records, few: int) -> None:
    """Cases B and C, other steps and finer cells, of the best few sets and the
    tutorial."""
    chosen = [r["set"] for r in records.best(few)]
    if paper_sets.TUTORIAL not in chosen:
        chosen.append(paper_sets.TUTORIAL)
    # Set by set: what is stopped has all of the best
    jobs = [
        Job(one, case, size, other)
        for one in chosen
        for case, size, other in (
            ("A", FINE, ()),
            ("B", COARSE, ()),
            ("C", COARSE, ()),
            ("A", COARSE, CHANCE),
        )
    ]
    _complete(base, records, jobs)


def _complete(
    base: Path, records: Records, jobs: list[Job], workers: int = 2
) -> None:
    """Run those of the jobs that have not been run."""
    now = sources()
    jobs = [
        j for j in jobs if not records.of(j.chosen, j.case, j.size, j.other)
    ]
    _prepare(base)
    with ProcessPoolExecutor(workers, initializer=_end_with_parent) as pool:
        # The fine ones stay, to be looked at
        waiting = {
            pool.submit(run, base, job, now, job.size == FINE): job
            for job in jobs
        }
        for n, future in enumerate(as_completed(waiting), 1):
            job = waiting[future]
            try:
                records.add(future.result())
            except RuntimeError as error:
                print(f"  failed: {error}", file=sys.stderr, flush=True)
            print(
                f"  judged {n}/{len(jobs)}: case {job.case}, {job.size:g} mm",
                flush=True,
            )


def quick_run(base: Path, job: Job, sources: str) -> dict:
    """run() on 2 mm until 9 s; most rows are not reached."""
    short = (
        ("resolution", "2e-3"),
        ("pylorusRefinement", "4"),
        ("endTime", "9"),
    )
    record = run(base, Job(job.chosen, job.case, job.size, short), sources)
    return record | {"other": []}
