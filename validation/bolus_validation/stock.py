# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Compression and wire by stock interFoam and its Herschel-Bulkley law.

The compression: the mesh is that of tutorials/rheology/compression; the platen
moves at a constant velocity, bolus slides along both without friction, so that
the force is known: flow stress at the rate v/H times the section. interFoam
knows no elasticity.

Bolus has a viscosity of some 30 m2/s. The part of the viscous stress that
interFoam takes from the last iteration, div(nu dev(grad U)^T), bounds its step
by about cell^2/nu: nanoseconds. The factor density multiplies both densities,
which leaves the force alone as long as inertia does not matter.
"""

import os
import re
import shutil
import time
from pathlib import Path

import numpy as np
from bolus_cases.specimens import prepare_compression
from bolus_cases.synthetic import run, write_file

# Cylinder [m], law (4100 + 11000 rate^0.29) [Pa], density [kg/m3]
HEIGHT, RADIUS = 0.020, 0.010
YIELD, CONSISTENCY, POWER = 4100.0, 11000.0, 0.29
RHO = 1100.0
# Of the wedge of 5 degrees to the whole
SECTORS = 72

_CONSTRAINTS = '#includeEtc "caseDicts/setConstraintTypes"'


def flow_stress(rate: np.ndarray | float):
    """Flow stress [Pa] at a rate [1/s]."""
    return YIELD + CONSISTENCY * rate**POWER


def exact_force(path: np.ndarray, velocity: float) -> np.ndarray:
    """Force [N] on the platen after paths [m] at a velocity [m/s]."""
    height = HEIGHT - path
    return flow_stress(velocity / height) * np.pi * RADIUS**2 * HEIGHT / height


def _write(
    case: Path,
    law: tuple[float, float, float],
    rho: float,
    density: float,
    cap: float,
    patch: str,
    end: float,
    step: float,
) -> None:
    """Write constant and system of a case of which mesh and fields are there.

    law        yield stress [Pa], consistency [Pa s^n] and exponent n of
               uniaxial flow
    rho        of bolus [kg/m3], times density; of air density alone
    cap        largest kinematic viscosity [m2/s] at rho
    patch      whose force is measured, in functions/forces
    """
    # The law of uniaxial flow as one of shear: tau = sigma/sqrt(3), gamma =
    # sqrt(3) epsilon
    root = np.sqrt(3)
    sigma, k, n = law
    heavy = rho * density
    write_file(
        case / "constant" / "g",
        "dimensions [0 1 -2 0 0 0 0]; value (0 0 0);\n",
        "uniformDimensionedVectorField",
    )
    write_file(
        case / "constant" / "turbulenceProperties", "simulationType laminar;\n"
    )
    write_file(
        case / "constant" / "transportProperties",
        "phases (bolus air);\n"
        "bolus { transportModel HerschelBulkley; HerschelBulkleyCoeffs { "
        f"tau0 {sigma / root / heavy}; n {n}; "
        f"k {k / root ** (1 + n) / heavy}; "
        f"nu0 {cap / density}; }} rho {heavy}; nu {cap / density}; }}\n"
        "air { transportModel Newtonian; nu 1e-4; "
        f"rho {density}; }}\nsigma 0;\n",
    )
    write_file(
        case / "system" / "controlDict",
        "application interFoam; startFrom startTime; startTime 0; "
        f"stopAt endTime; endTime {end}; deltaT {step}; "
        f"writeControl runTime; writeInterval {end}; writeFormat ascii; "
        "runTimeModifiable no; adjustTimeStep no; maxCo 1; maxAlphaCo 1;\n"
        'functions { forces { type forces; libs ("libforces.so"); '
        f"patches ({patch}); rho rho; CofR (0 0 0); log no; }} }}\n",
    )
    write_file(
        case / "system" / "fvSchemes",
        "ddtSchemes { default Euler; } gradSchemes { default Gauss linear; }\n"
        "divSchemes { div(rhoPhi,U) Gauss upwind; "
        "div(phi,alpha) Gauss vanLeer; div(phirb,alpha) Gauss linear; "
        "div(((rho*nuEff)*dev2(T(grad(U))))) Gauss linear; }\n"
        "laplacianSchemes { default Gauss linear corrected; }\n"
        "interpolationSchemes { default linear; }\n"
        "snGradSchemes { default corrected; }\n",
    )
    write_file(
        case / "system" / "fvSolution",
        "solvers {\n"
        '"alpha.bolus.*" { nAlphaCorr 2; nAlphaSubCycles 1; cAlpha 1; '
        "MULESCorr no; nLimiterIter 5; solver smoothSolver; "
        "smoother symGaussSeidel; tolerance 1e-8; relTol 0; }\n"
        '"(pcorr|p_rgh).*" { solver PCG; preconditioner DIC; '
        "tolerance 1e-9; relTol 0; }\n"
        '"U.*" { solver PBiCGStab; preconditioner DILU; tolerance 1e-12; '
        "relTol 0.001; }\n"
        "cellDisplacement { solver PCG; preconditioner DIC; "
        "tolerance 1e-16; relTol 0; }\n}\n"
        "PIMPLE { momentumPredictor no; nOuterCorrectors 5; nCorrectors 3; "
        "nNonOrthogonalCorrectors 0; correctPhi no; "
        "pRefCell 0; pRefValue 0; }\n",
    )


def _write_field(
    case: Path, name: str, kind: str, dimensions: str, value: str, patches: str
) -> None:
    """A uniform field at time 0; patches: text of its boundaryField."""
    write_file(
        case / "0" / name,
        f"dimensions [{dimensions}]; internalField uniform {value};\n"
        f"boundaryField {{ {_CONSTRAINTS}\n{patches} }}\n",
        kind,
    )


def prepare_compression_case(
    case: Path,
    cells: tuple[int, int],
    velocity: float,
    end: float,
    step: float,
    density: float,
    cap: float = 300.0,
) -> Path:
    """Write and mesh the compression.

    cells       along the axis and the radius
    velocity    of the platen [m/s], until end [s], in steps [s]
    density     factor on both densities [-]
    cap         largest kinematic viscosity [m2/s] of bolus that hardly flows
    """
    shutil.rmtree(case, ignore_errors=True)
    prepare_compression(case, nAxial=cells[0], nRadial=cells[1])
    alpha = (case / "0" / "alpha").read_text()
    (case / "0" / "alpha.bolus").write_text(
        alpha.replace("alpha;", "alpha.bolus;")
    )
    (case / "0" / "alpha").unlink()
    _write_field(
        case,
        "U",
        "volVectorField",
        "0 1 -1 0 0 0 0",
        "(0 0 0)",
        "fixedPlaten { type slip; } "
        "movingPlaten { type fixedNormalSlip; "
        f"fixedValue uniform ({-velocity} 0 0); }} "
        "side { type pressureInletOutletVelocity; value uniform (0 0 0); }",
    )
    _write_field(
        case,
        "p_rgh",
        "volScalarField",
        "1 -1 -2 0 0 0 0",
        "0",
        '".*Platen" { type fixedFluxPressure; value uniform 0; } '
        "side { type totalPressure; p0 uniform 0; }",
    )
    _write_field(
        case,
        "pointDisplacement",
        "pointVectorField",
        "0 1 0 0 0 0 0",
        "(0 0 0)",
        "fixedPlaten { type fixedValue; value uniform (0 0 0); } "
        "movingPlaten { type uniformFixedValue; uniformValue table "
        f"((0 (0 0 0)) ({end} ({-velocity * end} 0 0))); }} "
        "side { type zeroGradient; }",
    )
    law = YIELD, CONSISTENCY, POWER
    _write(case, law, RHO, density, cap, "movingPlaten", end, step)
    return case


def prepare_wire_case(
    case: Path,
    mesh: Path,
    yield_stress: float,
    velocity: float,
    end: float,
    step: float,
    rho: float,
    viscosity: float,
) -> Path:
    """Write the rough wire pushed sideways through a body of bolus.

    mesh          polyMesh with patches x0 (the wire), x1 (far away, at rest),
                  y0 and y1 (symmetry). It stays where it is: only velocities
                  count in plastic flow
    yield_stress  in uniaxial flow [Pa], perfectly plastic
    velocity      of the wire [m/s], until end [s], in steps [s]
    rho           density [kg/m3]
    viscosity     largest dynamic one [Pa s], that of bolus that hardly flows
    """
    shutil.rmtree(case, ignore_errors=True)
    shutil.copytree(mesh, case / "constant" / "polyMesh")
    _write_field(
        case,
        "U",
        "volVectorField",
        "0 1 -1 0 0 0 0",
        # Not at rest: interFoam takes the fluxes through walls in parts of
        # those inside
        f"({1e-3 * velocity} 0 0)",
        f"x0 {{ type fixedValue; value uniform ({velocity} 0 0); }} "
        "x1 { type noSlip; }",
    )
    _write_field(
        case,
        "p_rgh",
        "volScalarField",
        "1 -1 -2 0 0 0 0",
        "0",
        '"x.*" { type fixedFluxPressure; value uniform 0; }',
    )
    _write_field(
        case,
        "alpha.bolus",
        "volScalarField",
        "0 0 0 0 0 0 0",
        "1",
        '"x.*" { type zeroGradient; }',
    )
    write_file(
        case / "constant" / "dynamicMeshDict", "dynamicFvMesh staticFvMesh;\n"
    )
    law = yield_stress, 0.0, 1.0
    _write(case, law, rho, 1.0, viscosity / rho, "x0", end, step)
    return case


def inter_foam(folder: Path) -> Path:
    """The stock interFoam, compiled in folder without vectorisation (half a
    minute), unless it is there."""
    program = folder / "interFoam"
    if not program.exists():
        (folder / "Make").mkdir(parents=True, exist_ok=True)
        source = (
            Path(os.environ["WM_PROJECT_DIR"])
            / "applications/solvers/multiphase/interFoam"
        )
        for file in (*source.glob("*.[CH]"), *source.glob("../VoF/*.H")):
            link = folder / file.name
            link.unlink(missing_ok=True)
            link.symlink_to(file.resolve())
        (folder / "Make" / "files").write_text(
            f"interFoam.C\n\nEXE = {program.resolve()}\n"
        )
        options = (source / "Make" / "options").read_text()
        assert "-I../VoF" in options, f"{source}: other options than known"
        (folder / "Make" / "options").write_text(
            options.replace("-I../VoF", "-fno-tree-vectorize -I.")
        )
        run(folder, "wmake")
    return program


def solve(
    case: Path, program: str | Path = "interFoam"
) -> tuple[np.ndarray, np.ndarray, float]:
    """Run interFoam: times [s] (n,), forces [N] (n,) along x on the measured
    patch, seconds it took.

    Raises AssertionError with what it printed if it stops with an error.
    """
    start = time.monotonic()
    (case / "log.interFoam").write_text(run(case, str(program)))
    seconds = time.monotonic() - start
    table = case / "postProcessing" / "forces" / "0" / "force.dat"
    rows = [
        [float(x) for x in re.findall(r"[-+.\de]+", line)][:2]
        for line in table.read_text().splitlines()
        if not line.startswith("#")
    ]
    times, force = np.array(rows).T
    return times, force, seconds
