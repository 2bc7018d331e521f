# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Studies: our answer held against one that we did not write.

A study is a function, registered by @study, that runs small cases in its own
folder and returns Findings: rows of (value, reference, error, limit), observed
orders, remarks, and a picture. run_all() runs those whose result is not there
yet (several at once), and writes one page and one JSON of all.

A result is kept under run/validate/<page>/<study> and taken again as long as
nothing that it depends on has changed: solver, study, common properties.
"""

import argparse
import ctypes
import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import traceback
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import asdict, dataclass, field
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from bolus_results.html import render
from bolus_results.locking import FolderBusy, alone_in, locked

ROOT = Path(__file__).parents[2]


@dataclass
class Row:
    """One figure against its reference.

    value, reference   in the given unit
    error    |value - reference| / |scale|; scale is the reference unless given
    limit    the largest error that counts as met; None: for information
    """

    quantity: str
    unit: str
    value: float
    reference: float | None = None
    limit: float | None = None
    scale: float | None = None
    remark: str = ""

    @property
    def error(self) -> float | None:
        """Relative error [-]; None without a reference."""
        if self.reference is None:
            return None
        scale = self.reference if self.scale is None else self.scale
        return abs(self.value - self.reference) / abs(scale)

    @property
    def met(self) -> bool | None:
        """Whether the error is within the limit; None without a limit."""
        if self.limit is None or self.error is None:
            return None
        return bool(self.error <= self.limit)


@dataclass
class Order:
    """An observed order of convergence.

    sizes    cell sizes [m] or steps [s], coarse to fine
    errors   relative errors at these sizes
    least    what it has to be; None: for information
    """

    quantity: str
    sizes: list
    errors: list
    least: float | None = None

    @property
    def observed(self) -> float:
        """Slope of log(error) over log(size), least squares."""
        return float(
            np.polyfit(np.log(self.sizes), np.log(np.abs(self.errors)), 1)[0]
        )

    @property
    def met(self) -> bool | None:
        """Whether the observed order is large enough."""
        return None if self.least is None else self.observed >= self.least


@dataclass
class Findings:
    """What a study found; picture is the name of a file in its folder, more
    those of others to show below it."""

    rows: list = field(default_factory=list)
    orders: list = field(default_factory=list)
    remarks: list = field(default_factory=list)
    picture: str | None = None
    more: list = field(default_factory=list)

    def row(self, *args, **named) -> Row:
        """Add a Row."""
        self.rows.append(Row(*args, **named))
        return self.rows[-1]

    def order(self, *args, **named) -> Order:
        """Add an Order."""
        self.orders.append(Order(*args, **named))
        return self.orders[-1]

    def draw(self, figure, target: Path) -> None:
        """Save a figure as the picture of the study."""
        figure.savefig(target, dpi=120)
        plt.close(figure)
        self.picture = target.name

    @property
    def met(self) -> bool:
        """Whether everything that has a limit is within it."""
        return all(x.met is not False for x in (*self.rows, *self.orders))


def holds(found: Findings, what: str, true: bool, remark: str = "") -> None:
    """A row for a statement: 1 where it holds, which is what it should."""
    found.row(what, "-", float(true), 1.0, 0.0, remark=remark)


def energy_residual(found: Findings, table, what: str, limit: float) -> None:
    """A row for the largest residual of a run, of its largest work; table:
    that of energyBalance."""
    work = np.abs(table["work"] + table["closure"]).max()
    found.row(
        f"residual, {what}",
        "-",
        np.abs(table["residual"]).max() / work,
        0,
        limit,
        1,
        "largest of the run",
    )


@dataclass(frozen=True)
class Study:
    """A registered study: function(folder, quick) -> Findings.

    quick    a coarse and fast version, for ./Allrun test
    long     runs only where it is named
    """

    name: str
    group: str
    title: str
    reference: str
    function: Callable
    module: str
    long: bool = False


REGISTRY: dict[str, Study] = {}


def study(
    name: str, group: str, title: str, reference: str, long: bool = False
):
    """Register a study; name is also that of its folder. A long one runs only
    where it is named."""

    def register(function):
        REGISTRY[name] = Study(
            name, group, title, reference, function, function.__module__, long
        )
        return function

    return register


def _hash(files) -> str:
    """Hash of the contents of files; links of wmake do not count twice."""
    digest = hashlib.sha256()
    for path in files:
        if path.is_file() and "lnInclude" not in path.parts:
            digest.update(path.read_bytes())
    return digest.hexdigest()


# What results depend on: the solver, its libraries, the tutorials and the
# scripts that make meshes for some of them
SOLVER = ("src", "applications", "tutorials/common")
SET_UP = {
    "cutting": (
        "validation/bolus_cases/cutting.py",
        "validation/bolus_cases/tool_surface.py",
    )
}
FAMILIES = ("cutting", "gastric", "rheology")


def solver_hash(families=FAMILIES) -> str:
    """Hash of the sources of the solver and of these families of tutorials."""
    files = []
    for name in (
        *SOLVER,
        *(f"tutorials/{family}" for family in families),
        *(name for family in families for name in SET_UP.get(family, ())),
    ):
        path = ROOT / name
        files += sorted(path.rglob("*")) if path.is_dir() else [path]
    return _hash(
        path
        for path in files
        if path.suffix not in (".md", ".pyc")
        and not any(part.startswith("linux") for part in path.parts)
    )


class GaveUp(RuntimeError):
    """A run that gave up a step: its figures are not those of its end."""


def _options(settings: dict) -> list[str]:
    return [f"{name}={number}" for name, number in sorted(settings.items())]


def run_folder(tutorial: str, page: str, ranks: int = 1, **settings) -> Path:
    """Where kept_run keeps a run, for the sources as they are."""
    what = tutorial + str(_options(settings))
    what += f" -np {ranks}" if ranks > 1 else ""
    key = hashlib.sha256(
        (solver_hash([Path(tutorial).parts[0]]) + what).encode()
    )
    folder = ROOT / "run" / "validate" / page / "runs"
    return folder / f"{Path(tutorial).name}-{key.hexdigest()[:16]}"


# -set entries of case D without an end of its hardening
NO_END = {
    "law": "JLaw",
    "splitRotationBelow": 0,
    "explicitPressureBelow": 1,
}


def gastric_settings(size: float) -> dict:
    """-set entries of a gastric case on cells of a size [mm]: below 0.4 mm
    the pylorus needs none that are shorter."""
    return {
        "resolution": size * 1e-3,
        "pylorusRefinement": max(2.5 * size, 1.0),
    }


def whole_run(case: str, size: float, **settings) -> dict:
    """Arguments of kept_run for a gastric case over 32 s on two cores, with
    other settings as of -set, profiled: the studies whole_... of the page
    speed; the page gastric takes such a run where there is one."""
    return {
        "tutorial": f"gastric/case{case}",
        "page": "speed",
        "ranks": 2,
        "system/controlDict:profiling.active": "true",
        **gastric_settings(size),
        **settings,
    }


def run_tutorial(
    tutorial, case: Path, options, ranks: int = 1, again: bool = False
) -> str | None:
    """Run a tutorial with these -set entries into a folder, or go on there.

    Returns the reason if it gave up a step. Raises RuntimeError with what was
    printed if it failed otherwise: killed, no mesh, bad input.
    """
    done = subprocess.run(
        [
            *(ROOT / "scripts" / "runCase", tutorial, "-out", case),
            *("-np", str(ranks)),
            *(["-continue"] if again else []),
            *(word for option in options for word in ("-set", option)),
        ],
        capture_output=True,
        text=True,
        cwd=ROOT,
        check=False,
        preexec_fn=_end_with_parent,
    )
    log = case / "log.bolusFoam"
    gave_up = re.findall(
        r"no convergence at[^\n]*", log.read_text() if log.exists() else ""
    )
    if done.returncode and not gave_up:
        raise RuntimeError(done.stdout[-2000:] + done.stderr)
    return gave_up[-1] if done.returncode else None


def kept_run(tutorial: str, page: str, ranks: int = 1, **settings) -> Path:
    """Run a tutorial with these -set entries, or take the run that is there.

    tutorial    as in ./Allrun run, for example gastric/caseA
    page        the run is kept in run/validate/<page>/runs
    ranks       on how many it runs
    Returns the case's folder. A run that was stopped from outside goes on from
    its last written time; one that gave up a step is kept with its reason in
    the file "stopped". Two processes that ask for the same run do not start it
    twice. Raises RuntimeError with what was printed if it failed otherwise.
    """
    options = _options(settings)
    case = run_folder(tutorial, page, ranks, **settings)
    case.parent.mkdir(parents=True, exist_ok=True)
    with locked(Path(f"{case}.lock"), str(case), wait=True):
        if (case / "finished").exists() or (case / "stopped").exists():
            return case
        # Without a solver's log there is nothing to go on from
        again = (case / "log.bolusFoam").exists()
        gave_up = run_tutorial(
            tutorial, case, [] if again else options, ranks, again
        )
        if gave_up is None:
            (case / "finished").touch()
        else:
            (case / "stopped").write_text(gave_up)
    return case


def _key(one: Study) -> str:
    """Hash of what a study's result depends on."""
    base = ROOT / "validation"
    own = _hash(
        [
            *(
                path
                for package in ("results", "cases", "validation")
                for path in sorted((base / f"bolus_{package}").glob("*.py"))
            ),
            base / (one.module.replace(".", "/") + ".py"),
        ]
    )
    return solver_hash() + own


def _run_one(name: str, folder: Path, key: str) -> dict:
    """Run a study in a fresh folder; its result as written to result.json."""
    one = REGISTRY[name]
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    start = time.monotonic()
    result = {"name": name, "key": key, "error": None}
    try:
        found = one.function(folder, quick=False)
        result |= {
            "rows": [
                asdict(r) | {"error": r.error, "met": r.met} for r in found.rows
            ],
            "orders": [
                asdict(o) | {"observed": o.observed, "met": o.met}
                for o in found.orders
            ],
            "remarks": found.remarks,
            "picture": found.picture,
            "more": found.more,
            "met": found.met,
        }
    except Exception:
        # Told on the page and by the exit code; the other studies go on
        result |= {"error": traceback.format_exc(), "met": False}
    result["seconds"] = round(time.monotonic() - start, 1)
    (folder / "result.json").write_text(json.dumps(result, indent=1))
    return result


def run_all(
    page: str,
    title: str,
    names=(),
    force: bool = False,
    workers: int | None = None,
) -> int:
    """Run the registered studies, or those named; write the page.

    workers    studies at a time; None: one for each core

    Returns the exit code: 0 if every limit was met.
    """
    unknown = [n for n in names if n not in REGISTRY]
    if unknown:
        print(
            f"validate: no study {', '.join(unknown)}; they are: "
            + ", ".join(REGISTRY)
        )
        return 2
    chosen = list(names) or [n for n in REGISTRY if not REGISTRY[n].long]
    base = ROOT / "run" / "validate" / page
    base.mkdir(parents=True, exist_ok=True)
    try:
        with alone_in(base):
            return _run_chosen(base, page, title, chosen, force, workers)
    except FolderBusy as error:
        print(f"validate: {error}", file=sys.stderr)
        return 2


def _end_with_parent() -> None:
    """A worker ends when the command is killed: none is left at work."""
    pr_set_pdeathsig = 1
    ctypes.CDLL(None).prctl(pr_set_pdeathsig, signal.SIGTERM)


def _run_chosen(base: Path, page, title, chosen, force, workers) -> int:
    """run_all, alone in the page's folder."""
    results, missing = {}, []
    for name in REGISTRY:
        path = base / name / "result.json"
        key = _key(REGISTRY[name])
        if path.exists():
            old = json.loads(path.read_text())
            fresh = old["key"] == key and old["error"] is None
            if name not in chosen or (fresh and not force):
                results[name] = old | {"stale": old["key"] != key}
                continue
        if name in chosen:
            missing.append((name, base / name, key))

    print(
        f"validate: {len(missing)} studies to run, "
        f"{len(chosen) - len(missing)} kept",
        flush=True,
    )
    with ProcessPoolExecutor(
        max_workers=workers or os.cpu_count(), initializer=_end_with_parent
    ) as pool:
        futures = [pool.submit(_run_one, *job) for job in missing]
        for n, future in enumerate(as_completed(futures), 1):
            result = future.result()
            results[result["name"]] = result
            print(
                f"  {n}/{len(missing)}  {result['name']}: "
                f"{'met' if result['met'] else 'NOT MET'}, "
                f"{result['seconds']} s",
                flush=True,
            )
            if result["error"]:
                print(result["error"].strip().splitlines()[-1], flush=True)
            _write_page(base, page, title, results)
    _write_page(base, page, title, results)
    print(f"validate: {base.relative_to(ROOT) / (page + '.html')}")
    return 0 if all(results[n]["met"] for n in chosen) else 1


def command(
    page: str, title: str, description: str, workers: int | None = None
) -> None:
    """The command of a page: its arguments, run_all(), the exit code."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("names", nargs="*", help="default: all but long ones")
    parser.add_argument("-force", action="store_true", help="run again")
    given = parser.parse_args()
    sys.exit(run_all(page, title, given.names, given.force, workers))


def _write_page(base: Path, page: str, title: str, results: dict) -> None:
    """One HTML page and one JSON of all results, in the registered order."""
    ordered = [results[n] for n in REGISTRY if n in results]
    text = render(
        "studies.html",
        title=title,
        studies=[(REGISTRY[r["name"]], r) for r in ordered],
        absent=[n for n in REGISTRY if n not in results],
    )
    (base / f"{page}.html").write_text(text)
    (base / f"{page}.json").write_text(json.dumps(ordered, indent=1))
