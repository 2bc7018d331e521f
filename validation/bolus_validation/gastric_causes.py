# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Why cases A and B differ from the paper: one assumption changed at a time.

The paper prints neither the stomach's radius nor how its bolus is held, and its
contact, its fracture and its density are those of another code. Each row is
case A on 1 mm with one of these changed, or case B in other stomachs; what the
paper's text says of it is beside it. The runs (a minute or two each) are kept
in run/validate/gastric/runs.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from bolus_results.fields import Case
from bolus_results.measure import TIME_TOLERANCE

from bolus_validation.motility import PROFILE
from bolus_validation.paper import CASE_A, Run
from bolus_validation.studies import Findings, kept_run, study

COARSE = {"resolution": 1e-3, "pylorusRefinement": 2.5}

# Radii [mm] at these x [mm], between 210 and 250, of other stomachs that meet
# what the text says as well: 6 mm at 250 mm, room for the bolus
WIDE = {220: 15.4, 230: 13.9, 240: 11.5, 245: 9.3}
NARROW = {210: 15.2, 220: 13.7, 230: 12.0, 240: 8.6, 245: 7.0}
# Radius [mm] upstream, 30 to 180 mm, against the tutorial's: for 0.88 L
UPSTREAM = {"wide": 0.9978, "narrow": 1.0020}


def profile(radii: dict, upstream: float) -> str:
    """Entry radius of motilityProperties [m] with these radii [mm]."""
    rows = []
    for x, r in 1e3 * PROFILE:
        inside = 30 <= x <= 180
        new = radii.get(round(x), r * upstream if inside else r)
        rows.append(f"({x * 1e-3:.3f} {new * 1e-3:.5f})")
    return f"({' '.join(rows)})"


MOTILITY = "constant/motilityProperties:"
BOLUS = "constant/bolusProperties:"

WIDER = {MOTILITY + "profile.radius": profile(WIDE, UPSTREAM["wide"])}
NARROWER = {MOTILITY + "profile.radius": profile(NARROW, UPSTREAM["narrow"])}


def occluded(x: int) -> dict:
    """The wave has its full depth from x [mm] on."""
    return {MOTILITY + "waves.occlusion": f"((0.210 0) ({x * 1e-3:.3f} 0.9))"}


# What is changed: {entry: value}
CAUSES = {
    "as the tutorial": {},
    "wider antrum": WIDER,
    "narrower antrum": NARROWER,
    "bolus 2 mm on": {"bolusCentre": "(0.2248 0 0)"},
    "bolus 4 mm on": {"bolusCentre": "(0.2268 0 0)"},
    "shell without friction": {"shellFriction": "none"},
    "friction 0.3": {"mu": 0.3},
    "friction 0.6": {"mu": 0.6},
    "no slip": {"friction": "noSlip"},
    "elasticSlip 5 µm": {"elasticSlip": 5e-6},
    "elasticSlip 20 µm": {"elasticSlip": 2e-5},
    "damage averaged over 1 mm": {"nonlocalLength": 1e-3},
    "damage averaged over 2 mm": {"nonlocalLength": 2e-3},
    "0.1 of strain under tension": {"tensileStrain": 0.1},
    "broken bolus holds no tension": {BOLUS + "gasCoeffs.cohesion": 0},
    "broken bolus half as viscous": {BOLUS + "gasCoeffs.etaDamaged": 2.5},
    "wave by Eq. 14 to the letter": {
        "reading": "tail",
        "closedBetween": "(17.6 27.1)",
    },
    "occlusion 0.9 from 235 mm on": occluded(235),
    "occlusion 0.9 from 230 mm on": occluded(230),
    "from 235 mm on, wider antrum": occluded(235) | WIDER,
    "from 230 mm on, wider antrum": occluded(230) | WIDER,
    "from 230 mm on, 0.1 under tension": occluded(230) | {"tensileStrain": 0.1},
    "density of food": {"inertia": 1},
    "the paper's density": {"inertia": 100},
}

# Those that case B, which has no friction and should not break, is run with
STOMACHS = (
    "as the tutorial",
    "wider antrum",
    "narrower antrum",
    "bolus 4 mm on",
    "wave by Eq. 14 to the letter",
    "occlusion 0.9 from 235 mm on",
    "occlusion 0.9 from 230 mm on",
    "from 235 mm on, wider antrum",
    "from 230 mm on, wider antrum",
    "0.1 of strain under tension",
    "from 230 mm on, 0.1 under tension",
)


def _when(run: Run, name: str, reached) -> float:
    """First time at which a table reached(it); inf: never."""
    table = run.table(name)
    if table is None:
        return float("nan")
    times = table.time[reached(table)]
    return float(times[0]) if times.size else float("inf")


def _at(run: Run, time: float, name: str) -> float:
    found = run.at(time, name)
    return float("nan") if found is None else found


def _part(run: Run, table: str, column: str, *times: float) -> float:
    """A column at the last of two times, of that at the first."""
    found = run.series(table, column, *times)
    return float("nan") if found is None else found[1] / found[0]


def _peak(run: Run, t0: float, t1: float) -> float:
    found = run.peak("contactForce", "total_perMass", t0, t1)
    return float("nan") if found is None else found


def _value(run: Run, table: str, column: str, time: float) -> float:
    found = run.series(table, column, time)
    return float("nan") if found is None else found[0]


def _work(run: Run) -> float:
    return _value(run, "externalWork", "work_perMass", 32)


def _agree(run: Run) -> float:
    return sum(row.find(run)[1] is True for row in CASE_A)


def _first_damage(run: Run) -> float:
    return _when(run, "damagedVolume", lambda table: table["fraction"] > 0)


def _retained(run: Run) -> float:
    return 100 * _part(run, "retainedMass", "retained", 7.5, 32)


def _front(run: Run, time: float) -> float:
    """Largest x of the bolus [m]."""
    case = Case(run.path)
    written = case.nearest(time, TIME_TOLERANCE)
    if written is None:
        return float("nan")
    bolus = case.field(written, "alpha") > 0.5
    return float(case.mesh(written).cell_centres[bolus, 0].max())


# Column: (what the paper says, of a run)
FIGURES = {
    "rows that agree": (f"{len(CASE_A)}", _agree),
    "first damage [s]": ("7.5", _first_damage),
    "η in the core at 7.5 s": (
        "> 1",
        lambda run: _at(run, 7.5, "triaxialityMaxCore"),
    ),
    "pieces at 10.5 s": ("2", lambda run: _at(run, 10.5, "pieces")),
    "mean σ_eq at 10.5 s [kPa]": (
        "0",
        lambda run: 1e-3 * _at(run, 10.5, "sigmaEqMean"),
    ),
    "plastic strain at 12.5 s": (
        "15",
        lambda run: _at(run, 12.5, "epsilonPEqMax"),
    ),
    "jet back at 12.5 s [mm/s]": (
        "20",
        lambda run: 1e3 * _at(run, 12.5, "jetBackward"),
    ),
    "jet out at 12.5 s [mm/s]": (
        "20",
        lambda run: 1e3 * _at(run, 12.5, "jetForward"),
    ),
    "outflow from [s]": (
        "12.5",
        lambda run: _when(run, "retainedMass", lambda t: t["upstream"] < 0.999),
    ),
    "peak force to 18 s [N/g]": ("-", lambda run: _peak(run, 0, 18)),
    "work [mJ/g]": ("-", _work),
    "retained at 32 s [%]": ("50", _retained),
    "surface at 32 s [%]": (
        "-18",
        lambda run: 100 * _part(run, "freeSurface", "externalArea", 7.5, 32)
        - 100,
    ),
}


FIGURES_B = {
    "first damage [s]": ("never", _first_damage),
    "damaged at 18 s [%]": (
        "0",
        lambda run: 100 * _value(run, "damagedVolume", "fraction", 18),
    ),
    "front at 9 s [mm]": ("250", lambda run: 1e3 * _front(run, 9)),
    "peak force to 18 s [N/g]": ("least", lambda run: _peak(run, 0, 18)),
    "work [mJ/g]": ("least", _work),
    "retained at 32 s [%]": ("least", _retained),
}


def picture(numbers: dict, figures: dict, target: Path) -> None:
    """The table of all figures; coloured where they leave the tutorial's."""
    names = list(figures)
    labels = list(numbers)
    values = np.array([[numbers[c][n] for n in names] for c in labels])
    base = values[0]
    scale = np.where(np.isfinite(base) & (base != 0), np.abs(base), 1)
    with np.errstate(invalid="ignore"):
        change = np.clip((values - base) / scale, -1, 1)
    change[~np.isfinite(change)] = 0
    figure, axis = plt.subplots(
        figsize=(1.1 * len(names), 0.36 * len(labels) + 2)
    )
    axis.imshow(change, cmap="RdBu_r", vmin=-1, vmax=1, aspect="auto")
    for (i, j), number in np.ndenumerate(values):
        axis.text(j, i, f"{number:.3g}", ha="center", va="center", fontsize=8)
    axis.set_xticks(
        range(len(names)),
        [f"{n}\n(paper: {figures[n][0]})" for n in names],
        rotation=40,
        ha="left",
        fontsize=8,
    )
    axis.xaxis.tick_top()
    axis.set_yticks(range(len(labels)), labels, fontsize=8)
    figure.tight_layout()
    figure.savefig(target, dpi=110)
    plt.close(figure)


def vary(found: Findings, case: str, causes, figures: dict) -> dict:
    """Run a case on 1 mm with each of the causes: {cause: {name: number}}."""
    numbers = {}
    for cause in causes:
        path = kept_run(
            f"gastric/case{case}", "gastric", **(COARSE | CAUSES[cause])
        )
        gave_up = path / "stopped"
        if gave_up.exists():
            found.remarks.append(f"{case}, {cause}: {gave_up.read_text()}")
            numbers[cause] = dict.fromkeys(figures, float("nan"))
            continue
        run = Run(path)
        numbers[cause] = {name: of(run) for name, (_, of) in figures.items()}
    return numbers


def tell(found: Findings, numbers: dict, figures: dict, folder: Path):
    """Rows and the picture of what vary has found."""
    for cause, of in numbers.items():
        for name, number in of.items():
            found.row(f"{name}: {cause}", "-", number)
    picture(numbers, figures, folder / "causes.png")
    found.picture = "causes.png"


@study(
    "causes",
    "E",
    "Case A on 1 mm, one assumption changed at a time",
    "what the paper says in words; for information",
)
def causes(folder: Path, quick: bool) -> Findings:
    found = Findings()
    tell(found, vary(found, "A", CAUSES, FIGURES), FIGURES, folder)
    return found


@study(
    "causes_B",
    "E",
    "Case B on 1 mm, in other stomachs too, against case A in the same",
    "what the paper says in words; for information",
)
def causes_b(folder: Path, quick: bool) -> Findings:
    found = Findings()
    numbers = vary(found, "B", STOMACHS, FIGURES_B)
    least = {n: x for n, x in FIGURES_B.items() if x[0] == "least"}
    rough = vary(found, "A", STOMACHS, least)
    figures = dict(FIGURES_B)
    for name in least:
        over = f"{name.split(' [')[0]}, over A's"
        figures[over] = ("< 1", None)
        for cause, of in numbers.items():
            of[over] = of[name] / rough[cause][name]
    tell(found, numbers, figures, folder)
    return found
