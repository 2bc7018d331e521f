# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The cases that robustness spoils, kills, and starves of disk.

Each function of BASES makes a sound case in a folder and returns
(command, [(dictionary, which entries or None), ...]).
"""

import os
import random
import shutil
import signal
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from bolus_cases import specimens
from bolus_cases.synthetic import run, write_file
from bolus_results.fields import Case
from bolus_results.tables import read_table

from bolus_validation.robustness import expand

COMMON = specimens.COMMON
VOID = (
    "zeta 20; eta 1; etaDamaged 20; growthThreshold 0.4; closing 0.5; "
    "delta 2; cohesion 9;"
)
# What a stock OpenFOAM reads, and judges as it likes
STOCK = {
    "application",
    "startFrom",
    "startTime",
    "endTime",  # 1e30 s is a long run, not a bad one
    "stopAt",
    "writeControl",
    "writeFormat",
    "writePrecision",
    "writeCompression",
    "timeFormat",
    "timePrecision",
    "runTimeModifiable",
    "purgeWrite",
    "libs",
}


def point(law: str):
    """A rheometer of one cell, with a law of tutorials/common."""

    def base(folder: Path):
        folder.mkdir(parents=True)
        write_file(
            folder / "point",
            f'bolusProperties {{ #include "{COMMON}/bolusProperties.{law}" }}\n'
            "segments { press { mode uniaxial; rate 0.1; strain -0.1; } }\n"
            "maxStrainIncrement 1e-4; rows 10; openingViscosity 100;\n"
            "checkTangent no;\n",
        )
        (folder / "system").mkdir()
        expand(folder, "point")
        return (
            ["materialPoint", "-dict", "point", "-out", "point.dat"],
            [("point", None)],
        )

    return base


def ours(path) -> bool:
    """An entry of controlDict that bolusFoam or its libraries read."""
    return path[0] not in STOCK and path[-1] not in (
        "libs",
        "writeControl",
        "writeInterval",
    )


def compression(folder: Path):
    """Two steps of the compressed cylinder."""
    specimens.prepare_compression(
        folder,
        material="viscoplasticDamage",
        gas=VOID,
        friction="coulomb",
        strain=0.01,
        unloadStrain=0,
        nAxial=6,
        nRadial=18,
    )
    with open(folder / "constant" / "bolusProperties", "a") as file:
        file.write("damage { nonlocalLength 1e-3; }\n")
    gastric = specimens.ROOT / "tutorials/gastric/caseA/system"
    text = (gastric / "fvSolution").read_text()
    mine = text[text.index("bolus\n") :].replace("$:inertia", "0")
    fv = folder / "system" / "fvSolution"
    fv.write_text(fv.read_text().replace("bolus {}\ntransport {}", mine))
    files = (
        ("constant/bolusProperties", None),
        ("system/fvSolution", lambda p: p[0] in ("bolus", "transport")),
        ("system/controlDict", ours),
        ("0/U", lambda p: p[0] == "boundaryField" and "laten" in p[1]),
    )
    for file, _ in files:
        expand(folder, file)
    run(folder, "bolusFoam")
    clean(folder)
    return ["bolusFoam"], files


def clean(folder: Path) -> None:
    """Take the results of a run away."""
    for path in folder.glob("[0-9]*"):
        if path.name != "0":
            shutil.rmtree(path)
    shutil.rmtree(folder / "postProcessing", ignore_errors=True)


def gastric(folder: Path):
    """Two steps of case A on cells of 2 mm."""
    specimens.run_case(
        "gastric/caseA",
        *("-set", "resolution=2e-3", "-set", "pylorusRefinement=4"),
        *("-set", "endTime=0.02", "-out", folder),
    )
    clean(folder)
    for path in folder.glob("*.png"):
        path.unlink()
    files = (
        ("constant/motilityProperties", None),
        (
            "system/controlDict",
            lambda p: p[0] == "functions" and ours(p),
        ),
        ("constant/dynamicMeshDict", lambda p: p[0] == "motionSolver"),
    )
    for file, _ in files:
        expand(folder, file)
    return ["bolusFoam"], files


def cutting(folder: Path):
    """Some steps of the cylinder that cuts, coarse."""
    specimens.run_case(
        "cutting/cylinder2D",
        *("-set", "cellSize=1e-3", "-set", "travel=2e-4", "-out", folder),
    )
    clean(folder)
    files = (
        ("constant/dynamicMeshDict", lambda p: p[0] == "rigidToolCoeffs"),
        (
            "system/controlDict",
            lambda p: p[0] == "functions" and ours(p),
        ),
    )
    for file, _ in files:
        expand(folder, file)
    return ["bolusFoam"], files


BASES = {
    **{
        f"point-{law}": point(law)
        for law in ("viscoplasticDamage", "HerschelBulkley", "JLaw")
    },
    "compression": compression,
    "gastric": gastric,
    "cutting": cutting,
}


# --- kills -------------------------------------------------------------------

PRESS = (
    "rheology/compression",
    *("-set", "writeStrain=0.01", "-set", "strainStep=0.005"),
    *("-set", "unloadStrain=0", "-set", "nAxial=16"),
    *("-set", "friction=coulomb"),
)


def difference(case: Path, reference: Path) -> float:
    """Largest difference of fields and of the force's table from those of the
    run that was left alone, relative to the largest value; inf where something
    is missing."""
    one, other = Case(case), Case(reference)
    end = max(other.times)
    if max(one.times) != end:
        return np.inf
    worst = 0.0
    for name in ("alpha", "U", "p", "epsilonPEq", "deviator"):
        a, b = one.field(end, name), other.field(end, name)
        worst = max(worst, np.max(abs(a - b)) / np.max(abs(b)))
    a, b = (read_table(c, "contactForce") for c in (case, reference))
    if len(a.time) != len(b.time):
        return np.inf
    a, b = a["axial"], b["axial"]
    return float(max(worst, np.max(abs(a - b)) / np.max(abs(b))))


@dataclass
class Kill:
    """A run that was killed and continued.

    times       written before, also in part
    writing     whether the last of them was being written
    difference  from the run that was left alone, see difference()
    """

    times: int
    writing: bool
    difference: float


def written(case: Path) -> list[Path]:
    """Folders of the times of a run, without the start, in order."""
    found = [
        path
        for path in case.glob("[0-9]*")
        if path.is_dir() and path.name not in ("0", "0.orig")
    ]
    return sorted(found, key=lambda path: float(path.name))


def complete(time: Path) -> bool:
    """Whether a time was written to its end."""
    return (time / "uniform" / "complete").is_file()


def kill_test(folder: Path, kills: int, rng: random.Random) -> list[Kill]:
    """Kill as many runs, every other one at a random moment, the others while
    they write a time, and continue each."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    reference = folder / "alone"
    start = time.monotonic()
    specimens.run_case(*PRESS, "-out", reference)
    whole = time.monotonic() - start
    total = len(written(reference))
    found = []
    for number in range(kills):
        case = folder / f"killed{number}"
        process = subprocess.Popen(
            [
                specimens.ROOT / "scripts" / "runCase",
                *PRESS,
                *("-out", str(case)),
            ],
            cwd=specimens.ROOT,
            env=os.environ | {"PWD": str(specimens.ROOT)},
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        if number % 2:
            least = rng.randint(1, total - 1)
            while process.poll() is None:
                times = written(case)
                if len(times) >= least and not complete(times[-1]):
                    break
        else:
            time.sleep(rng.uniform(0.3, 0.9) * whole)
        if process.poll() is not None:
            raise RuntimeError(f"{case} ended before it was killed")
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        times = written(case)
        writing = bool(times) and not complete(times[-1])
        specimens.run_case(PRESS[0], "-continue", "-out", case)
        found.append(Kill(len(times), writing, difference(case, reference)))
        print(f"  {found[-1]}", flush=True)
    return found
