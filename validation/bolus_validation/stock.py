# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The compression of a cylinder by stock interFoam and Herschel-Bulkley.

The mesh is that of tutorials/rheology/compression; the platen moves at a
constant velocity, bolus slides along both without friction, so that the force
is known: flow stress at the rate v/H times the section. interFoam knows no
elasticity.

Bolus has a viscosity of some 30 m2/s. The part of the viscous stress that
interFoam takes from the last iteration, div(nu dev(grad U)^T), bounds its step
by about cell^2/nu: nanoseconds. The factor density multiplies both densities,
which leaves the force alone as long as inertia does not matter.
"""

import re
import shutil
import time
from pathlib import Path

import numpy as np

from bolus_validation.specimens import prepare_compression
from bolus_validation.synthetic import run, write_file

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


def prepare(
    case: Path,
    cells: tuple[int, int],
    velocity: float,
    end: float,
    step: float,
    density: float,
    cap: float = 300.0,
) -> Path:
    """Write and mesh the case.

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

    def field(name: str, kind: str, dimensions: str, value: str, patches: str):
        write_file(
            case / "0" / name,
            f"dimensions [{dimensions}]; internalField uniform {value};\n"
            f"boundaryField {{ {_CONSTRAINTS}\n{patches} }}\n",
            kind,
        )

    field(
        "U",
        "volVectorField",
        "0 1 -1 0 0 0 0",
        "(0 0 0)",
        "fixedPlaten { type slip; } "
        "movingPlaten { type fixedNormalSlip; "
        f"fixedValue uniform ({-velocity} 0 0); }} "
        "side { type pressureInletOutletVelocity; value uniform (0 0 0); }",
    )
    field(
        "p_rgh",
        "volScalarField",
        "1 -1 -2 0 0 0 0",
        "0",
        '".*Platen" { type fixedFluxPressure; value uniform 0; } '
        "side { type totalPressure; p0 uniform 0; }",
    )
    field(
        "pointDisplacement",
        "pointVectorField",
        "0 1 0 0 0 0 0",
        "(0 0 0)",
        "fixedPlaten { type fixedValue; value uniform (0 0 0); } "
        "movingPlaten { type uniformFixedValue; uniformValue table "
        f"((0 (0 0 0)) ({end} ({-velocity * end} 0 0))); }} "
        "side { type zeroGradient; }",
    )
    write_file(
        case / "constant" / "g",
        "dimensions [0 1 -2 0 0 0 0]; value (0 0 0);\n",
        "uniformDimensionedVectorField",
    )
    write_file(
        case / "constant" / "turbulenceProperties", "simulationType laminar;\n"
    )
    # The law of uniaxial flow as one of shear: tau = sigma/sqrt(3), gamma =
    # sqrt(3) epsilon
    root = np.sqrt(3)
    rho = RHO * density
    write_file(
        case / "constant" / "transportProperties",
        "phases (bolus air);\n"
        "bolus { transportModel HerschelBulkley; HerschelBulkleyCoeffs { "
        f"tau0 {YIELD / root / rho}; n {POWER}; "
        f"k {CONSISTENCY / root ** (1 + POWER) / rho}; "
        f"nu0 {cap / density}; }} rho {rho}; nu {cap / density}; }}\n"
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
        "patches (movingPlaten); rho rho; CofR (0 0 0); log no; } }\n",
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
        "nNonOrthogonalCorrectors 0; correctPhi no; }\n",
    )
    return case


def solve(case: Path) -> tuple[np.ndarray, np.ndarray, float]:
    """Run interFoam: times [s] (n,), forces [N] (n,) of the whole cylinder on
    the moving platen, seconds it took.

    Raises AssertionError with what it printed if it stops with an error.
    """
    start = time.monotonic()
    (case / "log.interFoam").write_text(run(case, "interFoam"))
    seconds = time.monotonic() - start
    table = case / "postProcessing" / "forces" / "0" / "force.dat"
    rows = [
        [float(x) for x in re.findall(r"[-+.\de]+", line)][:2]
        for line in table.read_text().splitlines()
        if not line.startswith("#")
    ]
    times, force = np.array(rows).T
    return times, SECTORS * force, seconds
