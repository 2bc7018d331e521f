# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Break each mechanism once and see that its test fails.

Works on a copy of the sources under run/validate/mutations: each mutation is
built there, its test has to fail, and the copy is mended again. What was found
is kept in mutations.json; a study that was stopped goes on.
"""

import argparse
import hashlib
import json
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from bolus_results.locking import FolderBusy, alone_in  # noqa: E402

ROOT = Path(__file__).parents[2]
BASE = ROOT / "run" / "validate" / "mutations"
TREE = BASE / "tree"

MIXTURE = "src/mixture/laminate/laminate.C"
GAS = "src/phases/gas/gas.C"
FRICTION = "src/contact/wallFriction/wallFriction.C"
NEWTON = "src/newton/newtonSolver/newtonSolver.C"
ELIMINATION = "src/mixture/pressureElimination/pressureElimination.H"
TURNING = "src/coupled/splitRotation/splitRotation.C"
TANGENT = "src/linear/condensedTangent/condensedTangent.C"
SLABS = "src/linear/schwarzSlabs/schwarzSlabs.C"
SPACE = "src/space/nodalSpace/nodalSpace.C"
OPERATORS = "src/space/cellOperators/cellOperators.C"
HISTORY = "src/transport/historyFlux/historyFlux.C"
FLUX = "src/transport/bolusFlux/bolusFlux.C"
SUBSTEPS = "src/transport/subSteps/subSteps.C"
PACKED = "src/transport/packedHistory/packedHistory.C"
POINT = "src/rheology/elastoViscoPlastic/elastoViscoPlasticI.H"


@dataclass(frozen=True)
class Mutation:
    """What is broken: text old -> new in file; test: arguments of pytest
    under validation/tests that have to fail."""

    name: str
    file: str
    old: str
    new: str
    test: str


MUTATIONS = (
    Mutation(
        "axis of a wedge through the origin",
        "src/space/wedgeFrame/wedgeFrame.C",
        "origin_ = sum / found;",
        "origin_ = Zero;",
        "test_axis.py -k sideways",
    ),
    Mutation(
        "axis of a wedge free to move",
        SPACE,
        "if (nodes_.onAxis()[n]) constrain(n, e2);",
        "",
        "test_axis.py -k hair",
    ),
    Mutation(
        "stress limited by its components in space, not in the slice",
        "src/space/nodeNumbering/nodeNumbering.H",
        "return tensor(e1_, e2_, e3_);",
        "return tensor::I;",
        "test_axis.py -k plane",
    ),
    Mutation(
        "function objects measure from the origin of coordinates",
        "src/functionObjects/axialFrame/axialFrame.C",
        'origin_ = motility.lookupOrDefault<point>("origin", point(Zero));',
        "",
        "test_axis.py -k along",
    ),
    Mutation(
        "motility beside the axis of the wedge",
        "src/motility/lumenMotion/lumenMotion.C",
        "if (!wedge.valid()) return;",
        "return;",
        "test_axis.py -k beside",
    ),
    Mutation(
        "energy of the wall beyond its law",
        "src/functionObjects/vanDerWaals/vanDerWaals.C",
        "min(invariant(l1, l2, l3), largest_)",
        "invariant(l1, l2, l3)",
        "test_bolus_functions.py -k beyond",
    ),
    Mutation(
        "a folder for two runs",
        "applications/solvers/bolusFoam/runLock.C",
        "::flock(file_, LOCK_EX | LOCK_NB) == 0",
        "true",
        "test_runs.py -k second_run",
    ),
    Mutation(
        "PETSc's handlers of signals for OpenFOAM's",
        "src/linear/petscHandles/petscHandles.H",
        '"-no_signal_handler", "1"',
        '"-no_signal_handler", "0"',
        "test_runs.py -k SIGFPE",
    ),
    Mutation(
        "no look at what is no number",
        "src/history/historyVariable/historyField.H",
        "{\n        requireNumbers();\n    }",
        "{}",
        "test_runs.py -k no_number",
    ),
    Mutation(
        "no look at cells after the mesh has moved",
        "applications/solvers/bolusFoam/bolusFoam.C",
        "meshCheck::requireSoundCells(mesh);",
        "",
        "test_runs.py -k inside_out",
    ),
    Mutation(
        "a step done again moves the mesh on from where it is",
        "applications/solvers/bolusFoam/bolusFoam.C",
        "if (again) mesh.movePoints",
        "if (false) mesh.movePoints",
        "test_runs.py -k done_again",
    ),
    Mutation(
        "a time's name of few digits",
        "applications/solvers/bolusFoam/writtenTime.C",
        "    findName();\n    const fileName folder",
        "    const fileName folder",
        "test_runs.py -k found_again",
    ),
    Mutation(
        "fields written with few digits",
        "applications/solvers/bolusFoam/writtenTime.C",
        "constexpr unsigned leastDigits = 10;",
        "constexpr unsigned leastDigits = 1;",
        "test_runs.py -k lose_digits",
    ),
    Mutation(
        "controlDict is not read again",
        "src/time/stepControl/stepControl.C",
        "    readModified();\n",
        "",
        "test_runs.py -k controlDict",
    ),
    Mutation(
        "residuals of any case in units of the oatcake's",
        "src/rheology/caseScales/caseScales.H",
        "return stress_ / 9600;",
        "return 1;",
        "test_scales.py -k any_strength",
    ),
    Mutation(
        "gas of any case at 0.1/s",
        "src/rheology/caseScales/caseScales.H",
        "return 0.1 / strainRate_;",
        "return 1;",
        "test_scales.py -k any_strength",
    ),
    Mutation(
        "bolus on the wrong side of the interface in transport",
        "src/interface/planarInterface/planarInterface.C",
        "along > 0 ? d",
        "along < 0 ? d",
        "test_physics.py -k rotation",
    ),
    Mutation(
        "radial return with 2 G for 3 G",
        "src/rheology/radialReturn/radialReturn.C",
        "slopeElastic = 3 * G_ * dt",
        "slopeElastic = 2 * G_ * dt",
        "test_rheology.py",
    ),
    Mutation(
        "stress does not turn with the bolus",
        POINT,
        "r.sRot = symm(Q & sOld & Q.T());",
        "r.sRot = sOld;",
        "test_physics.py -k shear",
    ),
    Mutation(
        "crumbs without cohesion",
        GAS,
        "const scalar pt = p + holds_[c];",
        "const scalar pt = p;",
        "test_void.py",
    ),
    Mutation(
        "consistent tangent 10 % off in plastic flow",
        POINT,
        "((r.dqdqTrial - r.theta)",
        "((0.9 * r.dqdqTrial - r.theta)",
        "test_solver.py -k tangent_equals",
    ),
    Mutation(
        "flow stress of the lower end of the table's interval",
        "src/rheology/flowStress/tabulated/tabulatedFlowStress.C",
        "return stresses_[i] + fraction *",
        "return stresses_[i] + 0 * fraction *",
        "test_rheology.py -k tabulated",
    ),
    Mutation(
        "hardening that does not end",
        "src/rheology/flowStress/powerHardening/powerHardeningFlowStress.C",
        "hardensUntil_);\n",
        "GREAT);\n",
        "test_rheology.py -k JLawThatEnds",
    ),
    Mutation(
        "damage whatever the triaxiality",
        "src/rheology/damageModel/triaxialOnsetDamage/triaxialOnsetDamage.H",
        "epsP > epsilonPEq0_ && eta > eta0_",
        "epsP > epsilonPEq0_ && eta < GREAT",
        "test_physics_contact.py -k noFracture",
    ),
    Mutation(
        "damage with the first step of tension",
        "src/rheology/damageModel/triaxialOnsetDamage/triaxialOnsetDamage.H",
        "&& tensileStrain >= tensileStrain_;",
        "&& tensileStrain >= 0;",
        "test_rheology.py -k waits_for_plastic_strain",
    ),
    Mutation(
        "stress that never turns where it should turn later",
        MIXTURE,
        "return mag(r.r.s) / max(mag(whole.s), VSMALL) * whole.s;",
        "return r.r.s;",
        "test_solver.py -k stress_turns",
    ),
    Mutation(
        "rows of stress that turns later never doubled",
        TURNING,
        "max(2 * row_, least)",
        "max(row_, least)",
        "test_solver_contact.py -k more_steps_turn",
    ),
    Mutation(
        "rows of stress that turns later as long as the last",
        TURNING,
        "row_ = 0;",
        "row_ = max(row_, 0);",
        "test_solver_contact.py -k more_steps_turn",
    ),
    Mutation(
        "points of the surface with the cells of one processor",
        "src/functionObjects/cutSurface/cutSurface.C",
        "syncTools::syncPointList(mesh, sum, plusEqOp<scalar>(), scalar(0));",
        "",
        "test_bolus_functions.py -k cut_of_processors",
    ),
    Mutation(
        "lagged friction with twice the pressure",
        FRICTION,
        "k.pn = lagged_ ? state_.p[c] -",
        "k.pn = lagged_ ? 2 * state_.p[c] -",
        "test_solver_contact.py -k lagged_friction",
    ),
    Mutation(
        "gas left out without a look at the other processors",
        SPACE,
        "syncTools::syncPointList(mesh_, points, orEqOp<bool>(), false);",
        "",
        "test_cutting.py -k leave_out_the_same_void",
    ),
    Mutation(
        "a failed linear solution fails those after it",
        TANGENT,
        "    PETSC_CHECK(PCSetFailedReason(pc, solved",
        "    if (!solved) PETSC_CHECK(PCSetFailedReason(pc, solved",
        "test_solver.py -k failed_linear_solution",
    ),
    Mutation(
        "subdomains of Schwarz's method that do not overlap",
        "src/linear/linearOptions/linearOptions.C",
        "-bolus_velocity_pc_asm_overlap 1",
        "-bolus_velocity_pc_asm_overlap 0",
        "test_solver.py -k subdomains_overlap",
    ),
    Mutation(
        "slabs of Schwarz's method that do not overlap",
        SLABS,
        "PCASMSetOverlap(pc, overlap)",
        "PCASMSetOverlap(pc, 0)",
        "test_solver.py -k subdomains_overlap",
    ),
    Mutation(
        "closing gas extrapolated from where they are",
        "src/coupled/coupledSystem/coupledSystemAssemble.C",
        "J.extrapolate(c, weight_[c] / unknowns_.rate0 * t.excess);",
        "",
        "test_cutting.py -k shortcuts",
    ),
    Mutation(
        "consistent tangent where the stress has turned",
        "src/mixture/flowSecant/flowSecant.C",
        "r.r.dqdqTrial = r.r.theta;",
        "",
        "test_gastric.py -k secant",
    ),
    Mutation(
        "pressure of cells with room not eliminated",
        "src/coupled/stepUnknowns/stepUnknowns.C",
        "if (!eliminate_ || !elimination.active()) return;",
        "return;",
        "test_cutting.py -k shortcuts",
    ),
    Mutation(
        "pressure of wisps not eliminated where Newton's method is stuck",
        ELIMINATION,
        "from_ *= 0.05;",
        "from_ *= 0.99;",
        "test_cutting.py -k wisps",
    ),
    Mutation(
        "Newton's method left to crawl",
        NEWTON,
        "stalled_ == 3",
        "false",
        "test_cutting.py -k wisps",
    ),
    Mutation(
        "damage at twice the plastic strain",
        "src/rheology/damageModel/triaxialOnsetDamage/triaxialOnsetDamage.H",
        "epsP > epsilonPEq0_ &&",
        "epsP > 2 * epsilonPEq0_ &&",
        "test_solver_damage.py -k breaks_at_the_plastic_strain",
    ),
    Mutation(
        "damaged bolus keeps its tension",
        GAS,
        "mobility_[c] = cell.damaged || cell.atWall",
        "mobility_[c] = cell.atWall",
        "test_solver_damage.py -k damaged_bar_carries_no_force_in_tension",
    ),
    Mutation(
        "damaged bolus loses its pressure",
        MIXTURE,
        "r.P = -(a * p + (1 - a) * r.pv);",
        "r.P = -(damaged_[c] ? 0 : 1) * (a * p + (1 - a) * r.pv);",
        "test_solver_damage.py -k damaged_bar_carries_pressure",
    ),
    Mutation(
        "broken bolus breaks its neighbours",
        "applications/solvers/bolusFoam/bolusFields.C",
        "strain(undamagedStrain / max(1 - D, SMALL))",
        "strain(epsilonPEq)",
        "test_physics_contact.py -k barInTension",
    ),
    Mutation(
        "nonlocal strain without its length",
        "src/history/nonlocalStrain/nonlocalStrain.C",
        "sqr(length_)",
        "sqr(0.5 * length_)",
        "test_nonlocal.py -k spreads",
    ),
    Mutation(
        "nonlocal strain passes through broken bolus",
        "src/history/nonlocalStrain/nonlocalStrain.C",
        "= max(sound, scalar(0)) + nothing;",
        "= 0 * sound + 1;",
        "test_nonlocal.py -k broken",
    ),
    Mutation(
        "a flow too fast is moved as far as it goes",
        "src/transport/historyTransport/historyTransport.C",
        "if (result.tooFast) return result;",
        "result.tooFast = false;",
        "test_solver_input.py -k too_fast",
    ),
    Mutation(
        "half a time is as good as a whole one",
        "applications/solvers/bolusFoam/writtenTime.C",
        "&& !isFile(mark(folder))",
        "&& false",
        "test_robustness.py -k to_its_end",
    ),
    Mutation(
        "a wall pulls",
        GAS,
        "mobility_[c] = cell.damaged || cell.atWall",
        "mobility_[c] = cell.damaged",
        "test_solver_contact.py -k pulled_away",
    ),
    Mutation(
        "no friction",
        FRICTION,
        "if (k.pn <= 0) return false;",
        "return false;",
        "test_solver_contact.py -k sliding_block",
    ),
    Mutation(
        "friction fades where the bolus ends",
        FRICTION,
        "const scalar w = b.alpha * k.weight[fp];",
        "const scalar w = sqr(b.alpha) * k.weight[fp];",
        "test_physics_contact.py -k slidingBlock",
    ),
    Mutation(
        "symmetry planes count as walls to part from",
        OPERATORS,
        "if (isA<wallPolyPatch>(bm[patchi]))",
        "if (true)",
        "test_physics_contact.py -k separation",
    ),
    Mutation(
        "radii of the wall at another time",
        "src/motility/lumenMotionSolver/lumenMotionSolver.C",
        "known.first() == t",
        "known.first() < GREAT",
        "test_motility.py -k equations_12_to_15",
    ),
    Mutation(
        "quantiles of one rank",
        "src/functionObjects/weightedSample/weightedSample.C",
        "total_ = returnReduce(sum, sumOp<scalar>());",
        "total_ = sum;",
        "test_bolus_functions.py -k quantiles",
    ),
    Mutation(
        "the closed lumen is not sealed",
        SPACE,
        "full[pointNode()[p]] = true;",
        "full[pointNode()[p]] = false;",
        "test_gastric.py -k closed_pylorus",
    ),
    Mutation(
        "pressures wrongly condensed",
        "src/linear/condensedTangent/condensedTangent.C",
        "- b * C_[start + j]",
        "- 0.5 * b * C_[start + j]",
        "test_solver.py -k tangent_equals",
    ),
    Mutation(
        "transport loses a thousandth of what leaves a cell",
        HISTORY,
        "massNew_[own[f]] -= F[f] * dt;",
        "massNew_[own[f]] -= 1.001 * F[f] * dt;",
        "test_solver.py -k mass_stays",
    ),
    Mutation(
        "short sub-steps forget what slow cells give the fast ones",
        HISTORY,
        "    for (const label f : z.given) add(f);",
        "",
        "test_transport.py -k mass_is_kept",
    ),
    Mutation(
        "fast cells leave nothing for what slow ones were to get",
        FLUX,
        "given_[D] += mag(F_[f]) * left * dt;",
        "given_[D] += 0;",
        "test_cases.py -k balanced",
    ),
    Mutation(
        "cells give more than they have",
        FLUX,
        "    takeWhatIsThere(z, alpha, dt, left);",
        "",
        "test_transport.py -k traces",
    ),
    Mutation(
        "what leads out of fast cells has the memory of the start",
        HISTORY,
        "            faces_[f * n + k] = qD[k];\n"
        "            mean_[f * n + k] += qD[k] / fine;",
        "            mean_[f * n + k] += faces_[f * n + k] / fine;",
        "test_cases.py -k less_plastic",
    ),
    Mutation(
        "full steps are never tried",
        NEWTON,
        "mayLeap_ = undampedSteps_ > 0;",
        "mayLeap_ = false;",
        "test_cases.py -k full_steps",
    ),
    Mutation(
        "all cells take the short sub-steps",
        SUBSTEPS,
        "if (work < least)",
        "if (work < 0 * least)",
        "test_transport.py -k fast_cells",
    ),
    Mutation(
        "the logarithmic rate is Jaumann's",
        POINT,
        "if (!elastic_.logarithmic())",
        "if (true)",
        "test_cases.py -k logarithmic",
    ),
    Mutation(
        "processors never ask each other about fast cells",
        SUBSTEPS,
        "fast.shared = exchange_.parts()",
        "fast.shared = false && exchange_.parts()",
        "test_transport.py -k two_ranks",
    ),
    Mutation(
        "memory is carried by the receiving cell's value",
        HISTORY,
        "            qF[k] = qD[k];\n\n",
        "            qF[k] = forward ? qN[k] : qP[k];\n\n",
        "test_physics.py -k rotation",
    ),
    Mutation(
        "processors tell each other the memory of one cell only",
        "src/transport/cellExchange/cellExchange.C",
        "values[cells_[i] * width + k]",
        "values[cells_[0] * width + k]",
        "test_transport.py -k two_ranks",
    ),
    Mutation(
        "all memories of a cell are its pressure",
        PACKED,
        "values_[c * n + k] = q[c];",
        "values_[c * n + k] = all_[0][c];",
        "test_transport.py -k piston",
    ),
    Mutation(
        "a step that is done again keeps the fields that it carried",
        "src/history/historyVariables/historyVariables.C",
        "for (historyVariable& v : variables_) v.restore();",
        "for (historyVariable& v : variables_)\n"
        "    {\n"
        "        if (v.how() != historyVariable::CARRIED) v.restore();\n"
        "    }",
        "test_adding_a_field.py -k done_again",
    ),
    Mutation(
        "fields of the case stand in the mesh",
        "src/history/carriedField/carriedField.C",
        "historyVariable::CARRIED",
        "historyVariable::STANDS",
        "test_adding_a_field.py -k as_far_as_the_piston",
    ),
    Mutation(
        "fields of the case never change of themselves",
        "src/history/carriedFields/carriedFields.C",
        "f.evolve(deltaT);",
        "f.evolve(0);",
        "test_adding_a_field.py -k mean_age",
    ),
    Mutation(
        "the gradient at the rim is that of a whole mesh",
        HISTORY,
        "if (some && !all) rim_.append(c);",
        "if (some && !all && false) rim_.append(c);",
        "test_transport.py -k stressed_disc",
    ),
    Mutation(
        "the pressure is not the first of the memories",
        PACKED,
        "    Swap(used_.first(), used_.last());\n",
        "",
        "test_transport.py -k pressure_leaves",
    ),
    Mutation(
        "waves with exponent 6 for 5",
        "src/motility/antralWaves/antralWaves.C",
        "std::pow(1 - sqr(s), exponent_)",
        "std::pow(1 - sqr(s), exponent_ + 1)",
        "test_motility.py",
    ),
    Mutation(
        "wall 1e-6 off its radius",
        "src/motility/lumenMotion/lumenMotion.H",
        "wall_.radius(x, referenceTime_) - 1)",
        "wall_.radius(x, referenceTime_) - 1 + 1e-6)",
        "test_motility.py",
    ),
    Mutation(
        "plastic dissipation 5 % too large",
        "src/mixture/laminate/laminateEnergy.C",
        "rate * r.r.q * r.r.dEpsP;",
        "1.05 * rate * r.r.q * r.r.dEpsP;",
        "test_energy.py -k dissipates_stress",
    ),
    Mutation(
        "friction work 5 % too large",
        FRICTION,
        "area * factor * (k.slip & k.step)",
        "1.05 * area * factor * (k.slip & k.step)",
        "test_energy.py -k friction_takes",
    ),
    Mutation(
        "external work with half the power",
        "src/functionObjects/externalWork/externalWork.C",
        "work_ += power() *",
        "work_ += 0.5 * power() *",
        "test_function_objects.py",
    ),
    Mutation(
        "tangential force counted as normal",
        "src/functionObjects/contactForce/contactForce.C",
        "normal += Fn;",
        "normal += mag(F[i]);",
        "test_function_objects.py",
    ),
)


def environment() -> dict:
    """Programs and libraries of the copy first."""
    names = {"FOAM_USER_LIBBIN": TREE / "lib", "FOAM_USER_APPBIN": TREE / "bin"}
    paths = {"LD_LIBRARY_PATH": TREE / "lib", "PATH": TREE / "bin"}
    return (
        os.environ
        | {name: str(path) for name, path in names.items()}
        | {n: f"{p}:{os.environ.get(n, '')}" for n, p in paths.items()}
    )


def build(folder: str) -> None:
    """wmake a folder of the copy."""
    library = ["libso"] if folder.startswith("src") else []
    done = subprocess.run(
        ["wmake", *library],
        cwd=TREE / folder,
        env=environment(),
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        sys.exit(f"mutations: {folder} does not build\n{done.stderr[-2000:]}")


def folders(file: str) -> list[str]:
    """Those to build when a file changes: its own and, for a header, those
    that may include it."""
    own = next(p for p in Path(file).parents if (TREE / p / "Make").is_dir())
    found = [str(own)]
    if file.endswith(".H"):
        headers = f"{own.name}/lnInclude"
        found += [
            str(options.parents[1].relative_to(TREE))
            for where in ("src/*", "applications/*/*")
            for options in sorted(TREE.glob(f"{where}/Make/options"))
            if headers in options.read_text()
        ]
    return found


def write(file: str, text: str) -> None:
    """Change a file of the copy and build what depends on it."""
    (TREE / file).write_text(text)
    for folder in folders(file):
        build(folder)


def failing(test: str) -> bool:
    """Whether a test fails with the copy; it must have run."""
    file, *more = test.split()
    done = subprocess.run(
        [
            *(sys.executable, "-m", "pytest", "-q", "-x"),
            *("-p", "no:cacheprovider"),
            f"validation/tests/{file}",
            *more,
        ],
        cwd=ROOT,
        env=environment(),
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode not in (0, 1):
        sys.exit(f"mutations: {test} did not run\n{done.stdout[-2000:]}")
    return done.returncode == 1


def fresh_copy() -> None:
    """Sources with what is built of them, so that little is built again."""
    shutil.rmtree(TREE, ignore_errors=True)
    for name in ("src", "applications"):
        shutil.copytree(
            ROOT / name, TREE / name, symlinks=True, dirs_exist_ok=True
        )
    for name, source in (
        ("lib", "FOAM_USER_LIBBIN"),
        ("bin", "FOAM_USER_APPBIN"),
    ):
        shutil.copytree(os.environ[source], TREE / name, symlinks=True)


def main(names) -> int:
    """Run the mutations, or those whose name holds one of the words given."""
    BASE.mkdir(parents=True, exist_ok=True)
    # Two at once would break each other's copy
    with alone_in(BASE):
        return mutate(names)


def mutate(names) -> int:
    """main, alone in the folder."""
    store = BASE / "mutations.json"
    seen = json.loads(store.read_text()) if store.exists() else {}
    chosen = [
        m for m in MUTATIONS if not names or any(n in m.name for n in names)
    ]
    fresh_copy()
    passed: set[str] = set()
    for number, m in enumerate(chosen, 1):
        sound = (TREE / m.file).read_text()
        if sound.count(m.old) != 1:
            sys.exit(
                f"mutations: {m.name}: {m.file} holds {m.old!r} "
                f"{sound.count(m.old)} times; once is needed"
            )
        test = ROOT / "validation" / "tests" / m.test.split()[0]
        key = hashlib.sha256(
            repr((sound, test.read_text(), m)).encode()
        ).hexdigest()
        if seen.get(m.name, {}).get("key") != key:
            # A test that fails anyway catches nothing
            if m.test not in passed and failing(m.test):
                sys.exit(f"mutations: {m.test} fails without {m.name} as well")
            passed.add(m.test)
            write(m.file, sound.replace(m.old, m.new))
            caught = failing(m.test)
            write(m.file, sound)
            seen[m.name] = {"key": key, "caught": caught, "test": m.test}
            store.write_text(json.dumps(seen, indent=1))
        verdict = "caught" if seen[m.name]["caught"] else "NOT CAUGHT"
        print(
            f"  {number}/{len(chosen)}  {verdict}: {m.name} ({m.test})",
            flush=True,
        )
    return 0 if all(seen[m.name]["caught"] for m in chosen) else 1


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help="words; default: all")
    try:
        sys.exit(main(parser.parse_args().names))
    except FolderBusy as error:
        sys.exit(f"mutations: {error}")
