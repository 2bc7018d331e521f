# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Studies of ./Allrun validate speed: where the time goes, and what it buys.

size_0.6, size_0.3, size_0.15: case A until its first wave has broken the bolus,
on one core and on two, timed by OpenFOAM's own profiling; scaling: how the cost
grows with the cells; whole_A_0.15, ...: a case over its 32 s on two cores
against the time it may take (run where they are named: up to hours each).
Nothing else may run meanwhile: the studies run one by one, and tell how busy
the machine was when they began.
"""

import os
import re
import time
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from bolus_cases.specimens import compression
from bolus_results.profiling import PHASES, phases
from bolus_results.results import run_numbers
from bolus_results.tables import read_table

from bolus_validation import stock
from bolus_validation.physics import limit
from bolus_validation.studies import (
    NO_END,
    Findings,
    gastric_settings,
    holds,
    kept_run,
    study,
    whole_run,
)

# Cell sizes [mm], and until when [s]: the wave is in the bolus from 6.9 s on
SIZES = (0.6, 0.3, 0.15)
END = 9.0


def timed_run(size: float, ranks: int) -> Path:
    """The folder of a run of case A on cells of a size [mm] until END."""
    return kept_run(
        "gastric/caseA",
        "speed",
        ranks=ranks,
        endTime=END,
        **{"system/controlDict:profiling.active": "true"},
        **gastric_settings(size),
    )


def costs(case: Path) -> dict[str, float]:
    """Seconds by phase (of the first rank) and in all, counts of a run."""
    steps = read_table(case, "solver", "steps")
    log = (case / "log.bolusFoam").read_text()
    return phases(case) | {
        "steps": steps.time.size,
        "rejected steps": steps["rejected"][-1],
        "Newton iterations": steps["NewtonIterations"].sum(),
        "linear iterations": float(
            re.findall(r"linear iterations (\d+)", log)[-1]
        ),
        "cells": float(re.findall(r"cells\s+(\d+)", log)[-1]),
    }


def load() -> str:
    """How busy the machine is, for a remark."""
    return f"load of the machine before: {os.getloadavg()[0]:.1f}"


def register(size: float) -> None:
    """The study of one cell size."""

    @study(
        f"size_{size:g}",
        "S",
        f"Case A until {END:g} s on cells of {size:g} mm",
        "one core against two; for information",
    )
    def run_study(folder: Path, quick: bool) -> Findings:
        found = Findings()
        found.remarks.append(load())
        figure, axes = plt.subplots(figsize=(8, 2.5), layout="constrained")
        totals = {}
        for ranks in (1, 2):
            cost = costs(timed_run(size, ranks))
            totals[ranks] = cost["total"]
            left = 0.0
            print(f"  {size:g} mm, {ranks} ranks", flush=True)
            for name, number in cost.items():
                phase = name in PHASES or name in ("the rest", "total")
                each = number / cost["steps"] if phase else number
                unit = "s/step" if phase else "-"
                found.row(f"{name}, {ranks} ranks", unit, each)
                print(f"    {name:20} {each:12.5g} {unit}", flush=True)
                if phase and name != "total":
                    axes.barh(
                        f"{ranks} ranks",
                        each,
                        left=left,
                        label=name if ranks == 1 else None,
                    )
                    left += each
            axes.set_prop_cycle(None)
        found.row("two ranks faster by", "-", totals[1] / totals[2])
        axes.set_xlabel("seconds per step")
        axes.legend(
            fontsize=8, ncols=7, loc="lower center", bbox_to_anchor=(0.5, 1)
        )
        found.draw(figure, folder / "phases.png")
        return found


for _size in SIZES:
    register(_size)


# Longest times [min] over 32 s on two cores, by cell size [mm]; case D's own
LONGEST = {0.3: 10, 0.15: 45}
LONGEST_D = {0.3: 10, 0.15: 60}


def register_whole(case: str, size: float, **settings) -> None:
    """The study of a whole run on two cores, with other settings as of -set."""
    law = settings.get("law")

    @study(
        f"whole_{case}{law or ''}_{size:g}",
        "W",
        f"Case {case} {f'({law}) ' if law else ''}over 32 s on cells of "
        f"{size:g} mm, two cores",
        "the time it may take; no step given up",
        long=True,
    )
    def run_study(folder: Path, quick: bool) -> Findings:
        found = Findings()
        found.remarks.append(load())
        path = kept_run(**whole_run(case, size, **settings))
        for phase, seconds in phases(path).items():
            found.row(f"{phase}, since the last start", "s", seconds)
        run = run_numbers(path)
        for name in (
            *("cells", "steps", "rejectedSteps"),
            *(
                "explicitPressureSteps",
                "splitRotationSteps",
                "newtonIterations",
            ),
        ):
            found.row(name, "-", run[name]["value"])
        # A start that was killed or gave up has left no clock time, but that
        # of its first rank
        clock = run.get("clockTime", {"value": 0})["value"]
        minutes = max(clock, run["cpuTime"]["value"]) / 60
        found.row("time", "min", minutes)
        longest = (LONGEST_D if case == "D" else LONGEST)[size]
        holds(found, f"within {longest} min", minutes <= longest)
        stopped = path / "stopped"
        holds(
            found,
            "to 32 s without a step given up",
            not stopped.exists(),
            stopped.read_text() if stopped.exists() else "",
        )
        for row in found.rows:
            print(f"    {row.quantity:34} {row.value:10.5g} {row.unit}")
        return found


for _case in "ABCD":
    for _size in LONGEST:
        register_whole(_case, _size)
for _size in LONGEST_D:
    register_whole("D", _size, **NO_END)


@study(
    "scaling",
    "S",
    "How the cost grows with the cells",
    "the exponent of a power law through the cell sizes, one core",
)
def scaling(folder: Path, quick: bool) -> Findings:
    found = Findings()
    every = [costs(timed_run(size, 1)) for size in SIZES]
    cells = np.array([cost["cells"] for cost in every])
    figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    for name in (*PHASES, "total"):
        each = np.array([cost[name] / cost["steps"] for cost in every])
        exponent = np.polyfit(np.log(cells), np.log(each), 1)[0]
        found.row(f"exponent of the seconds per step, {name}", "-", exponent)
        print(f"    exponent per step, {name:15} {exponent:.2f}", flush=True)
        axes.loglog(cells, each, "o-", label=name)
    total = np.array([cost["total"] for cost in every])
    found.row(
        "exponent of all the seconds",
        "-",
        np.polyfit(np.log(cells), np.log(total), 1)[0],
    )
    axes.set(xlabel="cells", ylabel="seconds per step")
    axes.legend(fontsize=8)
    found.draw(figure, folder / "scaling.png")
    return found


# Cells along axis and radius, platen's velocity for interFoam [m/s]
MESHES = ((14, 18), (28, 36))
VELOCITY = 2e-3
# interFoam: (factor on the density, step [s], end [s], meshes). Its start, with
# the smallest factor, is there to tell what the food's own density would cost
STOCK = ((2.5e4, 1e-3, 2.0, MESHES), (2.5e3, 1e-4, 0.2, MESHES[:1]))


@study(
    "stockCompression",
    "S",
    "The compression by stock interFoam and by bolusFoam",
    "flow stress times section, no friction: exact",
)
def stock_compression(folder: Path, quick: bool) -> Findings:
    """Forces against the exact ones, and seconds, on the same meshes."""
    found = Findings()
    found.remarks.append(load())
    figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
    for cells in MESHES:
        what = f"{cells[0]} x {cells[1]} cells"
        case = folder / f"ours-{cells[0]}"
        start = time.monotonic()
        ours = compression(
            case,
            material="HerschelBulkley",
            strain=0.3,
            unloadStrain=0,
            nAxial=cells[0],
            nRadial=cells[1],
        )
        seconds = time.monotonic() - start
        force = ours.at("force", 0.25)
        exact = stock.flow_stress(0.1) * np.pi * stock.RADIUS**2 * np.exp(0.25)
        found.row(f"force, bolusFoam, {what}", "N", force, exact, 0.01)
        found.row(f"time for a second, bolusFoam, {what}", "s", seconds / 3)
        axes.plot(
            ours.strain,
            ours.force * np.exp(-ours.strain),
            label=f"bolusFoam, {what}, {seconds:.0f} s",
        )

        for density, step, end, meshes in STOCK:
            if cells not in meshes:
                continue
            case = stock.prepare_compression_case(
                folder / f"interFoam-{cells[0]}-{density:g}",
                cells,
                VELOCITY,
                end,
                step,
                density,
            )
            label = f"interFoam, density times {density:g}, {what}"
            times, force, seconds = stock.solve(case)
            force = stock.SECTORS * force
            path = VELOCITY * times
            exact = stock.exact_force(path, VELOCITY)
            found.row(
                f"force after {end:g} s, {label}", "N", force[-1], exact[-1]
            )
            found.row(f"time for a second, {label}", "s", seconds / end)
            axes.plot(
                -np.log(1 - path / stock.HEIGHT),
                force * (1 - path / stock.HEIGHT),
                label=f"{label}, {seconds:.0f} s",
            )
    axes.set(
        xlabel="strain",
        ylabel="force times height, of that at first [N]",
        ylim=(0, 5),
    )
    axes.legend(fontsize=7)
    found.draw(figure, folder / "force.png")
    return found


# The wire: cells along a quarter of it, step of interFoam [s]
WIRES = ((4, 4e-5), (8, 1e-5))
# Found 7.3 % (bolusFoam) and 5.1 % above limit analysis on 4 cells
WIRE_LIMIT = 0.08
# Growth of the cells away from the wire, over all of them [-]
THIN = 2
# interFoam's wire: velocity [m/s], until when [s], density [kg/m3] (inertia
# 0.25 kPa, of a pressure of 60 kPa), largest viscosity [Pa s] (Newtonian below
# a hundredth of velocity/radius)
WIRE_VELOCITY, WIRE_END = 5e-3, 0.05
WIRE_RHO, WIRE_VISCOSITY = 1e7, 5e5


@study(
    "stockWire",
    "S",
    "A rough wire pushed sideways, by stock interFoam and by bolusFoam",
    "Randolph and Houlsby (1984): force per diameter and thickness "
    "(2 pi + 4 sqrt 2) s_u = 11.94 s_u",
)
def stock_wire(folder: Path, quick: bool) -> Findings:
    """Forces against limit analysis, and seconds, on the same meshes."""
    found = Findings()
    found.remarks.append(load())
    found.remarks.append(
        "interFoam compiled here without vectorisation: with it, velocities "
        "are wrong on such meshes (see stock.py). The density is some 9,000 "
        "times that of food: cell^2/viscosity bounds the steps."
    )
    program = stock.inter_foam(folder / "interFoam")
    scale = limit.HALF * limit.THICKNESS * limit.SHEAR
    figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
    for n, step in WIRES[:1] if quick else WIRES:
        what = f"{n} cells"
        case = folder / f"ours-{n}"
        start = time.monotonic()
        way, force, _ = limit.cylinder(case, n, 1e4, 0.01, thin=THIN)
        seconds = time.monotonic() - start
        found.row(
            f"force, bolusFoam, {what}",
            "s_u d",
            force[-1],
            limit.CYLINDER,
            WIRE_LIMIT,
        )
        found.row(f"time to the steady force, bolusFoam, {what}", "s", seconds)
        axes.plot(way / way[-1], force, label=f"bolusFoam, {what}")

        stocks = stock.prepare_wire_case(
            folder / f"interFoam-{n}",
            case / "constant" / "polyMesh",
            limit.YIELD,
            WIRE_VELOCITY,
            WIRE_END,
            step,
            WIRE_RHO,
            WIRE_VISCOSITY,
        )
        times, force, seconds = stock.solve(stocks, program)
        force = -force / scale
        found.row(
            f"force, interFoam, {what}",
            "s_u d",
            force[-1],
            limit.CYLINDER,
            WIRE_LIMIT,
        )
        found.row(
            f"what it still falls by in a tenth of the time, {what}",
            "s_u d",
            np.interp(0.9 * WIRE_END, times, force) - force[-1],
        )
        found.row(f"time to the steady force, interFoam, {what}", "s", seconds)
        axes.plot(times / WIRE_END, force, label=f"interFoam, {what}")
    axes.axhline(limit.CYLINDER, color="k", ls="--", label="exact")
    axes.set(
        xlabel="part of the way (bolusFoam) or time (interFoam)",
        ylabel="force / (d s_u thickness)",
        ylim=(0, 20),
    )
    axes.legend(fontsize=7)
    found.draw(figure, folder / "force.png")
    return found
