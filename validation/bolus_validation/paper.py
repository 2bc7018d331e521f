# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The paper's numbers, and a run of case A against what it reports.

    python -m bolus_validation.paper CASE [--readme FILE]

writes CASE/results.json, of what the paper tells of, and from it and the
tables of the function objects CASE/comparison.md, agreeing or not; with
--readme also puts it into FILE, between the markers below. The paper's force
and work curves are pictures: no number is taken from them, only what its text
says.
"""

import argparse
import json
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from bolus_results import markdown
from bolus_results.fields import Case
from bolus_results.foam_files import FoamFileError
from bolus_results.locking import alone_in
from bolus_results.measure import Measure
from bolus_results.results import write_json
from bolus_results.tables import Table, optional_table

BEGIN = "<!-- comparison: begin, made by scripts/results: do not edit -->"
END = "<!-- comparison: end -->"

# The ten times of Fig. 8, and that to which mass and surface are related [s]
TIMES = (7.5, 9.0, 10.5, 12.5, 14.0, 18.0, 23.0, 25.5, 29.0, 32.0)
REFERENCE = 7.5

# Bolus carrying less is unloaded: a tenth of the static yield stress [Pa]
LOADED = 410.0

# What counts as its numbers, of which it gives no tolerances: plastic strain of
# up to 15 [-], jets of some 20 mm/s, triaxiality of 3.65 where fragments touch
# [-], half of the mass and 18 % less surface at the end against REFERENCE [%]
PLASTIC_STRAIN = (7.5, 30)
JET = (10, 40)
BAND = (1.8, 7.3)
RETAINED = (45, 55)
SURFACE = (-28, -8)
# How near to its times an event has to be [s]
NEAR = 0.5

MEASURE = Measure(TIMES, REFERENCE, LOADED)


def within(number: float, ends: tuple) -> bool:
    """Is a number in a range?"""
    return ends[0] <= number <= ends[1]


def words(ends: tuple, unit: str = "") -> str:
    """A range in words."""
    return f"{ends[0]:g} to {ends[1]:g}{unit}"


# (what this run has, does it agree): None for what the run does not tell
Finding = tuple[str, bool | str | None]
NOTHING: Finding = ("not reached or not written", None)


class Run:
    """The numbers of a run, as the rows of the comparison ask for them."""

    def __init__(self, path):
        self.path = Path(path)
        source = self.path / "results.json"
        if not source.is_file():
            raise FoamFileError(
                f"{source}: missing; make it with scripts/results"
            )
        self.results = json.loads(source.read_text())

    def table(self, name: str) -> Table | None:
        """The table of a function object."""
        return optional_table(self.path, name)

    def at(self, time: float, name: str) -> float | None:
        """A number of the fields at one of the paper's times; SI units."""
        entry = self.entry(time, name)
        return entry and entry["value"]

    def entry(self, time: float, name: str) -> dict | None:
        """That number with its unit and what else is told of it."""
        try:
            return self.results["times"][f"{time:g}"][name]
        except KeyError:
            return None

    def series(self, name: str, column: str, *times: float):
        """A column at several times, or None if any is not reached."""
        table = self.table(name)
        if table is None:
            return None
        found = [table.at(column, time) for time in times]
        return None if None in found else found

    def peak(self, name: str, column: str, t0: float, t1: float):
        """Largest value of a column in an interval, None if not reached."""
        table = self.table(name)
        if table is None or table.time[-1] < t1 - 1e-6:
            return None
        inside = (table.time >= t0) & (table.time <= t1)
        return float(table[column][inside].max()) if inside.any() else None


@dataclass
class Row:
    """A line of the comparison: what the paper says, what is found."""

    when: str
    paper: str
    agrees_if: str
    find: Callable[[Run], Finding]


def _not_loaded(run: Run, time: float) -> Finding:
    """What to say of the triaxiality where nothing carries a load."""
    if run.at(time, "sigmaEqMax") is None:
        return NOTHING
    return ("no loaded bolus there", False)


def _core_triaxiality(run: Run) -> Finding:
    core = run.entry(7.5, "triaxialityMaxCore")
    if core is None:
        return _not_loaded(run, 7.5)
    place = f"at x = {1e3 * core['x']:.1f} mm"
    stress = f"where σ_eq is {1e-3 * core['sigmaEq']:.2g} kPa"
    return (
        f"largest there {core['value']:.2f}, {place}, {stress}",
        core["value"] > 1,
    )


def _first_damage(run: Run) -> Finding:
    table = run.table("damagedVolume")
    if table is None or table.time[-1] < 7.5:
        return NOTHING
    first = run.results["results"].get("damagedVolume", {}).get("firstDamage")
    if first is None:
        return (f"no damage until {table.time[-1]:.4g} s", False)
    time = first["value"]
    return (f"first damage at {time:.2f} s", abs(time - 7.5) <= NEAR)


def _fragments(run: Run) -> Finding:
    whole = run.at(10.5, "pieces")
    intact = run.at(10.5, "piecesIntact")
    if whole is None:
        return NOTHING
    earlier = run.at(9, "pieces")
    text = f"{whole} at 10.5 s, {intact} counting undamaged bolus only"
    if earlier is not None:
        text = f"{earlier} at 9 s; " + text
    if whole == 2:
        return (text, True)
    return (text, "in part" if intact == 2 else False)


def _unloaded(run: Run) -> Finding:
    mean = run.at(10.5, "sigmaEqMean")
    if mean is None:
        return NOTHING
    highest = run.at(10.5, "sigmaEqMax")
    text = f"mean {mean / 1e3:.2f} kPa, highest {highest / 1e3:.1f} kPa"
    return (text, mean < LOADED)


def _force_after_fracture(run: Run) -> Finding:
    force = run.series("contactForce", "total_perMass", 10.5)
    before = run.peak("contactForce", "total_perMass", 6, 10.5)
    if force is None or before is None:
        return NOTHING
    return (
        f"{force[0]:.3g} N/g after a peak of {before:.3g} N/g",
        force[0] < 0.5 * before,
    )


def _force_climbs(run: Run) -> Finding:
    force = run.series("contactForce", "total_perMass", 10.5, 12.5)
    if force is None:
        return NOTHING
    return (
        f"{force[0]:.3g} N/g at 10.5 s, {force[1]:.3g} N/g at 12.5 s",
        force[1] > 2 * force[0],
    )


def _work_climbs(run: Run) -> Finding:
    work = run.series("externalWork", "work_perMass", 8.5, 10.5, 12.5)
    if work is None:
        return NOTHING
    return (
        f"{work[1]:.3g} mJ/g at 10.5 s, {work[2]:.3g} mJ/g at 12.5 s",
        work[2] - work[1] > work[1] - work[0],
    )


def _compression(run: Run) -> Finding:
    lowest = run.at(12.5, "triaxialityMinIntact")
    extreme = run.at(12.5, "triaxialityMin")
    if lowest is None or extreme is None:
        return _not_loaded(run, 12.5)
    return (
        f"down to {lowest:.3g} in loaded bolus, {extreme:.3g} anywhere",
        lowest < -3,
    )


def _plastic_strain(run: Run) -> Finding:
    strain = run.at(12.5, "epsilonPEqMax")
    if strain is None:
        return NOTHING
    return (f"up to {strain:.3g}", within(strain, PLASTIC_STRAIN))


def _jet(name: str) -> Callable[[Run], Finding]:
    def find(run: Run) -> Finding:
        speed = run.at(12.5, name)
        if speed is None:
            return NOTHING
        return (f"{1e3 * speed:.1f} mm/s", within(1e3 * speed, JET))

    return find


def _band(run: Run) -> Finding:
    eta = run.at(12.5, "triaxialityMax")
    if eta is None:
        return NOTHING
    return (f"largest anywhere {eta:.3g}", within(eta, BAND))


def _outflow_onset(run: Run) -> Finding:
    table = run.table("retainedMass")
    if table is None or table.time[-1] < 12.5:
        return NOTHING
    # Out of the stomach: past the throat
    gone = 1 - table["upstream"] > 1e-3
    if not gone.any():
        return (f"nothing until {table.time[-1]:.4g} s", False)
    onset = table.time[gone.argmax()]
    return (
        f"0.1 % of the bolus past the throat at {onset:.2f} s",
        abs(onset - 12.5) <= NEAR,
    )


def _backward(run: Run) -> Finding:
    speed = run.at(14, "jetBackward")
    if speed is None:
        return NOTHING
    return (f"backward flow up to {1e3 * speed:.1f} mm/s", speed > 2.5e-3)


def _unloading(run: Run) -> Finding:
    force = run.series("contactForce", "total_perMass", 18)
    before = run.peak("contactForce", "total_perMass", 12.5, 18)
    if force is None or before is None:
        return NOTHING
    return (
        f"{force[0]:.3g} N/g after a peak of {before:.3g} N/g",
        force[0] < 0.5 * before,
    )


def _sticking(run: Run) -> Finding:
    before, after = run.at(10.5, "pieces"), run.at(18, "pieces")
    if before is None or after is None:
        return NOTHING
    text = f"{before} at 10.5 s, {after} at 18 s"
    return (text, after < before) if before > 1 else (text, False)


def _second_wave(run: Run) -> Finding:
    force = run.series("contactForce", "total_perMass", 18)
    then = run.peak("contactForce", "total_perMass", 23, 25.5)
    if force is None or then is None:
        return NOTHING
    return (
        f"{force[0]:.3g} N/g at 18 s, up to {then:.3g} N/g in 23 to 25.5 s",
        then > 2 * force[0],
    )


def _one_mass(run: Run) -> Finding:
    pieces = run.at(25.5, "pieces")
    return NOTHING if pieces is None else (f"{pieces} pieces", pieces == 1)


def _reopening(run: Run) -> Finding:
    mass = run.series("retainedMass", "retained", 25.5, 29, 32)
    if mass is None:
        return NOTHING
    closed, flowing, end = (100 * m for m in mass)
    return (
        f"retained {closed:.1f} % at 25.5 s, {flowing:.1f} % at 29 s, "
        f"{end:.1f} % at 32 s",
        closed > flowing > end,
    )


def _retained(run: Run) -> Finding:
    mass = run.series("retainedMass", "retained", 7.5, 32)
    if mass is None:
        return NOTHING
    part = 100 * mass[1] / mass[0]
    return (f"{part:.1f} %", within(part, RETAINED))


def _surface(run: Run) -> Finding:
    area = run.series("freeSurface", "externalArea", 7.5, 32)
    if area is None:
        return NOTHING
    change = 100 * (area[1] / area[0] - 1)
    return (f"{change:+.1f} %", within(change, SURFACE))


def _balance(run: Run) -> Finding:
    table = run.table("retainedMass")
    if table is None:
        return NOTHING
    worst = max(table["balanceError"], key=abs)
    return (
        f"{100 * worst:+.2g} % at most, until {table.time[-1]:.4g} s",
        bool(abs(worst) < 0.005),
    )


def _leak(run: Run) -> Finding:
    mass = run.series("retainedMass", "passedWhileClosed", 25.5)
    if mass is None:
        return NOTHING
    return (f"{100 * mass[0]:.2g} % of the bolus", abs(mass[0]) < 1e-4)


CASE_A = (
    Row("7.5 s", "η > 1 in the core under the wave", "> 1", _core_triaxiality),
    Row("7.5 s", "damage starts", f"within {NEAR:g} s", _first_damage),
    Row("9 to 10.5 s", "fracture: two fragments at 10.5 s", "2", _fragments),
    Row(
        "10.5 s",
        "σ_eq about 0 everywhere",
        "mean < 0.41 kPa, a tenth of the static yield stress",
        _unloaded,
    ),
    Row(
        "10.5 s",
        "force falls with the fracture",
        "below half of the peak from 6 s on",
        _force_after_fracture,
    ),
    Row(
        "12.5 s",
        "squeezed against the open pylorus: force climbs",
        "more than twice that at 10.5 s",
        _force_climbs,
    ),
    Row(
        "12.5 s",
        "... and work",
        "more in these 2 s than in the 2 s before",
        _work_climbs,
    ),
    Row("12.5 s", "η < -3, locally -2220", "< -3", _compression),
    Row(
        "12.5 s",
        "plastic strain up to 15",
        words(PLASTIC_STRAIN),
        _plastic_strain,
    ),
    Row(
        "12.5 s",
        "outflow through the pylorus about 20 mm/s",
        words(JET, " mm/s"),
        _jet("jetForward"),
    ),
    Row(
        "12.5 s",
        "backward jet about 20 mm/s (Ferrua and Singh: 28)",
        words(JET, " mm/s"),
        _jet("jetBackward"),
    ),
    Row(
        "12.5 s",
        "η 3.65 in the band where fragments touch",
        words(BAND),
        _band,
    ),
    Row("12.5 s", "outflow begins", f"within {NEAR:g} s", _outflow_onset),
    Row(
        "14 s",
        "a strip is extruded backwards",
        "faster than the wave, 2.5 mm/s",
        _backward,
    ),
    Row(
        "18 s",
        "unloading",
        "force below half of the peak from 12.5 s on",
        _unloading,
    ),
    Row(
        "18 s",
        "fragments stick again",
        "fewer pieces than at 10.5 s",
        _sticking,
    ),
    Row(
        "23 to 25.5 s",
        "the second wave compresses against the closed pylorus",
        "force more than twice that at 18 s",
        _second_wave,
    ),
    Row("25.5 s", "one continuous mass", "1", _one_mass),
    Row(
        "25.5 to 32 s",
        "flows out after the re-opening",
        "retained mass falls to 29 s, and to 32 s",
        _reopening,
    ),
    Row(
        "32 s",
        "retained mass 50 % of that at 7.5 s",
        words(RETAINED, " %"),
        _retained,
    ),
    Row(
        "32 s",
        "external surface -18 % (against 7.5 s here)",
        words(SURFACE, " %"),
        _surface,
    ),
    Row(
        "all",
        "mass balance: up to +3 % (the paper's error; ours must be better)",
        "within 0.5 %",
        _balance,
    ),
    Row(
        "closed pylorus",
        "(not reported; ours must not leak)",
        "< 0.01 %",
        _leak,
    ),
)

_VERDICT = {True: "yes", False: "no", None: "-"}

_NOTES = """\
Pieces are connected cells with alpha > 0.5 that hold at least 1 % of the
bolus; undamaged: those with D <= 0.5 as well. η is of such cells; "loaded":
of those with D <= 0.5 and σ_eq > 0.41 kPa. The core is what is nearer to the
axis than a third of the bolus's radius. Force: integral of the traction's
magnitude over the wall, full geometry, per initial bolus mass. The ranges
under "agrees if" are ours: the paper gives no tolerances.
"""


def comparison(path) -> str:
    """The comparison as Markdown."""
    run = Run(path)
    numbers = run.results["run"]

    def number(name: str) -> str:
        found = numbers.get(name)
        if not found:
            return "?"
        unit = "" if found["unit"] == "-" else " " + found["unit"]
        return f"{found['value']:.5g}{unit}"

    found = [(row, *row.find(run)) for row in CASE_A]
    count = {key: 0 for key in ("yes", "no", "in part", "-")}
    lines = []
    for row, here, verdict in found:
        word = verdict if isinstance(verdict, str) else _VERDICT[verdict]
        count[word] += 1
        lines.append((row.when, row.paper, here, row.agrees_if, word))

    return "\n".join(
        [
            f"Run `{run.results['case']}`: {number('simulatedTime')} simulated"
            f" on {number('cells')} cells, {number('steps')} steps,"
            f" {number('clockTime')} on {number('cores')} core(s).",
            "",
            f"{count['yes']} rows agree, {count['in part']} in part,"
            f" {count['no']} do not, {count['-']} cannot be told.",
            "",
            markdown.table(
                ("when", "the paper", "this run", "agrees if", "agrees"), lines
            ),
            "",
            _NOTES,
        ]
    )


def main(arguments=None) -> int:
    """Command line."""
    parser = argparse.ArgumentParser(
        prog="paper", description="Compare a run of case A with the paper."
    )
    parser.add_argument("case", type=Path)
    parser.add_argument(
        "--readme",
        type=Path,
        metavar="FILE",
        help="put the comparison into this file as well",
    )
    options = parser.parse_args(arguments)
    try:
        Case(options.case)
        target = options.case / "comparison.md"
        with alone_in(options.case):
            print(write_json(options.case, MEASURE))
            text = comparison(options.case)
            target.write_text(text)
        print(target)
        if options.readme:
            markdown.put(options.readme, BEGIN, END, text)
            print(options.readme)
    except (FoamFileError, OSError) as error:
        print(f"paper: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
