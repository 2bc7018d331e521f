// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "coupledSystem.H"
#include "globalIndex.H"
#include "profiling.H"

#include <algorithm>

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::coupledSystem::setPetsc(const dictionary& dict)
{
    string options("-bolus_snes_type newtonls -bolus_snes_linesearch_type bt ");
    const word solver(dict.lookupOrDefault<word>("linearSolver", "direct"));
    if (solver == "direct")
    {
        // Approximate minimum fill: with METIS the fastest of MUMPS's
        // orderings for 55,000 unknowns in the plane on two ranks (a fifth
        // less than quasi-dense minimum degree); on one rank 9 % less for
        // 14,000, the same for 4,000
        options += "-bolus_velocity_ksp_type preonly -bolus_velocity_pc_type lu"
                   " -bolus_velocity_pc_factor_mat_solver_type mumps"
                   " -bolus_velocity_mat_mumps_icntl_14 80"
                   " -bolus_velocity_mat_mumps_icntl_7 2"
                   // The rows are scaled: MUMPS need not look for scales
                   " -bolus_velocity_mat_mumps_icntl_8 0 ";
    }
    else if (solver == "schwarz")
    {
        // Preconditioned from the right: judged by the residual itself. The
        // subdomains are partitioned by PTScotch, where PETSc has it; what is
        // of low rank to 1e-3 in their factors is taken so.
        options += "-bolus_velocity_ksp_type gmres"
                   " -bolus_velocity_ksp_pc_side right"
                   " -bolus_velocity_ksp_gmres_restart 100"
                   " -bolus_velocity_ksp_gmres_cgs_refinement_type"
                   " refine_ifneeded"
                   " -bolus_velocity_ksp_max_it 500"
                   " -bolus_velocity_pc_type asm"
                   " -bolus_velocity_pc_asm_overlap 1"
                   " -bolus_velocity_pc_asm_blocks "
            + Foam::name(subdomains_ * Pstream::nProcs())
            + " -bolus_velocity_sub_pc_type lu"
              " -bolus_velocity_sub_pc_factor_mat_solver_type mumps"
              " -bolus_velocity_sub_mat_mumps_icntl_14 80"
              // PORD: in 3D with 200,000 rows a third of the time of QAMD, with
              // 390,000 as fast
              " -bolus_velocity_sub_mat_mumps_icntl_7 4"
              " -bolus_velocity_sub_mat_mumps_icntl_8 0"
              " -bolus_velocity_sub_mat_mumps_icntl_35 2"
              " -bolus_velocity_sub_mat_mumps_cntl_7 1e-3 ";
    }
    else
    {
        FatalIOErrorInFunction(dict)
            << "entry linearSolver: " << solver
            << "; valid are direct (small and plane meshes) and schwarz"
            << " (large three-dimensional ones)" << exit(FatalIOError);
    }
    options += dict.lookupOrDefault<string>("petscOptions", "");
    petscCheck(
        PetscOptionsInsertString(nullptr, options.c_str()), "petscOptions"
    );

    const label nVelocities = space_.nRowsOwned();
    petscCheck(
        VecCreateMPI(
            PETSC_COMM_WORLD,
            nVelocities + mesh_.nCells(),
            PETSC_DETERMINE,
            x_.set()
        ),
        "VecCreateMPI"
    );
    PETSC_CHECK(VecSetOption(x_, VEC_IGNORE_NEGATIVE_INDICES, PETSC_TRUE));
    PETSC_CHECK(VecDuplicate(x_, f_.set()));

    // The pressures of each processor follow its velocities
    const globalIndex velocities(nVelocities);
    const globalIndex cells(mesh_.nCells());
    firstCellRow_ = velocities.toGlobal(0) + nVelocities + cells.toGlobal(0);
    nodeRow_ = space_.nodeRow();
    for (label& row : nodeRow_)
    {
        row += cells.toGlobal(velocities.whichProcID(row), 0);
    }

    DynamicList<PetscInt> rows;
    for (const label row : nodeRow_)
    {
        for (label k = 0; k < space_.nd(); ++k) rows.append(row + k);
    }
    forAll(pCell_, c) rows.append(firstCellRow_ + c);

    petscIS from;
    PETSC_CHECK(ISCreateGeneral(
        PETSC_COMM_SELF,
        rows.size(),
        rows.cdata(),
        PETSC_COPY_VALUES,
        from.set()
    ));
    PETSC_CHECK(VecCreateSeq(PETSC_COMM_SELF, rows.size(), local_.set()));
    petscCheck(
        VecScatterCreate(x_, from, local_, nullptr, scatter_.set()),
        "VecScatterCreate"
    );

    tangent_.reset(new condensedTangent(space_, scatter_, local_, slabs_));

    PETSC_CHECK(SNESCreate(PETSC_COMM_WORLD, snes_.set()));
    PETSC_CHECK(SNESSetOptionsPrefix(snes_, "bolus_"));
    PETSC_CHECK(SNESSetFunction(snes_, f_, residualFunction, this));
    PETSC_CHECK(SNESSetJacobian(
        snes_, tangent_->matrix(), tangent_->matrix(), jacobianFunction, this
    ));
    PETSC_CHECK(
        SNESSetConvergenceTest(snes_, convergedFunction, this, nullptr)
    );
    PETSC_CHECK(SNESSetTolerances(snes_, 0, 0, 1e-12, maxIterations_, 10000));
    tangent_->attach(snes_);
    petscCheck(SNESSetFromOptions(snes_), "petscOptions of fvSolution");
}


void Foam::coupledSystem::gather(Vec x)
{
    PETSC_CHECK(
        VecScatterBegin(scatter_, x, local_, INSERT_VALUES, SCATTER_FORWARD)
    );
    PETSC_CHECK(
        VecScatterEnd(scatter_, x, local_, INSERT_VALUES, SCATTER_FORWARD)
    );

    const PetscScalar* v;
    PETSC_CHECK(VecGetArrayRead(local_, &v));
    label i = 0;
    forAll(q_, j) q_[j] = U0_ * v[i++];
    forAll(pCell_, c) pCell_[c] = P0_ * v[i++] + shift_[c];
    PETSC_CHECK(VecRestoreArrayRead(local_, &v));

    if (!eliminate_ || eliminateRoom_ == 0) return;
    pGiven_ = pCell_;
    forAll(pCell_, c)
    {
        if (solved_[c] && room_[c] > eliminateFrom_ * a_[c]) solvePressure(c);
    }
}


void Foam::coupledSystem::assemble(Vec f, condensedTangent* J) const
{
    const label nd = space_.nd();

    if (f) PETSC_CHECK(VecSet(f, 0));
    if (J) J->clear(solved_);

    DynamicList<scalar> R;
    cellTangent tangent;
    DynamicList<PetscInt> rows;
    DynamicList<PetscInt> cols;
    DynamicList<scalar> rowScale;

    forAll(pCell_, c)
    {
        if (!solved_[c]) continue;
        assembleCell(c, R, J ? &tangent : nullptr);

        // Scaled rows; those of fixed components are negative: left out.
        // The residual's rows are those of x_, the tangent's of velocities
        const label n = R.size() - 1;
        rows.clear();
        cols.clear();
        rowScale.clear();
        for (label i = 0; i < n; ++i)
        {
            const label dof = space_.cellDofs()[space_.cellStart()[c] + i];
            const label node = dof / nd;
            const labelList& row = f ? nodeRow_ : space_.nodeRow();
            cols.append(row[node] + dof % nd);
            rows.append(dof % nd < space_.nFixed()[node] ? -1 : cols.last());
            rowScale.append(1 / (P0_ * space_.nodeArea()[node]));
        }
        rowScale.append(weight_[c] / rate0_);

        if (f)
        {
            rows.append(firstCellRow_ + c);
            for (label i = 0; i <= n; ++i) R[i] *= rowScale[i];
            PETSC_CHECK(
                VecSetValues(f, n + 1, rows.cdata(), R.cdata(), ADD_VALUES)
            );
        }
        else
        {
            for (label i = 0; i <= n; ++i)
            {
                for (label j = 0; j <= n; ++j)
                {
                    tangent.J[i * (n + 1) + j] *=
                        rowScale[i] * (j < n ? U0_ : P0_);
                }
            }
            J->add(c, tangent.J, rows, cols);
            J->extrapolate(c, weight_[c] / rate0_ * tangent.excess);
        }
    }

    // Fixed components
    for (const label node : space_.ownedNodes())
    {
        for (label k = 0; k < space_.nFixed()[node]; ++k)
        {
            if (f)
            {
                const PetscInt row = nodeRow_[node] + k;
                const scalar v =
                    (q_[nd * node + k] - space_.fixedValue(node, k)) / U0_;
                PETSC_CHECK(VecSetValues(f, 1, &row, &v, ADD_VALUES));
            }
            else
            {
                J->fix(space_.nodeRow()[node] + k);
            }
        }
    }

    if (f)
    {
        PETSC_CHECK(VecAssemblyBegin(f));
        PETSC_CHECK(VecAssemblyEnd(f));
    }
    if (J) J->finish();
}


void Foam::coupledSystem::computeNorms(Vec f)
{
    const label nNode = space_.nd() * space_.ownedNodes().size();

    const PetscScalar* v;
    PETSC_CHECK(VecGetArrayRead(f, &v));
    scalar m2 = 0;
    scalar c2 = 0;
    scalar largest = -1;
    label where = -1;
    for (label i = 0; i < nNode + mesh_.nCells(); ++i)
    {
        (i < nNode ? m2 : c2) +=
            sqr(i < nNode ? v[i] : v[i] / weight_[i - nNode]);
        if (mag(v[i]) > largest)
        {
            largest = mag(v[i]);
            where = i;
        }
    }
    PETSC_CHECK(VecRestoreArrayRead(f, &v));

    label n = 0;
    for (const label node : space_.ownedNodes())
    {
        if (!space_.frozen()[node]) n += space_.nd();
    }
    label nc = std::count(solved_.begin(), solved_.end(), true);
    reduce(m2, sumOp<scalar>());
    reduce(c2, sumOp<scalar>());
    reduce(n, sumOp<label>());
    reduce(nc, sumOp<label>());
    report_.momentum = std::sqrt(m2 / max(n, 1));
    report_.continuity = std::sqrt(c2 / max(nc, 1));

    Tuple2<scalar, point> worst(largest, point::zero);
    if (where >= nNode)
    {
        worst.second() = mesh_.C()[where - nNode];
    }
    else if (where >= 0)
    {
        const label node = space_.ownedNodes()[where / space_.nd()];
        worst.second() = mesh_.points()[space_.pointNode().find(node)];
    }
    reduce(worst, maxFirstOp<scalar>());
    report_.worst = worst.second();
}


PetscErrorCode
Foam::coupledSystem::residualFunction(SNES, Vec x, Vec f, void* ctx)
{
    addProfiling(residual, "residual");
    coupledSystem& system = *static_cast<coupledSystem*>(ctx);
    system.gather(x);
    system.assemble(f, nullptr);
    return 0;
}


PetscErrorCode
Foam::coupledSystem::jacobianFunction(SNES, Vec x, Mat, Mat, void* ctx)
{
    coupledSystem& system = *static_cast<coupledSystem*>(ctx);
    system.gather(x);
    if (system.eliminateRoom_ > 0)
    {
        system.shift_ += system.pCell_ - system.pGiven_;
    }

    // With the same tangent the next iteration gains about what the last one
    // did: where that is enough, it saves a factorisation
    if (system.residual_ * system.contraction_ > system.tolerance_)
    {
        addProfiling(tangent, "tangent");
        system.assemble(nullptr, &*system.tangent_);
    }
    else
    {
        system.tangent_->reuse();
    }

    // As accurate as this iteration can make use of (Eisenstat and Walker
    // 1996, choice 2)
    const scalar useful = 0.1 * system.tolerance_ / system.residual_;
    system.tangent_->setAccuracy(
        min(max(max(sqr(system.contraction_), useful), scalar(1e-5)),
            system.linearTolerance_)
    );
    system.qLast_ = system.q_;
    return 0;
}


PetscErrorCode Foam::coupledSystem::convergedFunction(
    SNES snes,
    PetscInt it,
    PetscReal,
    PetscReal,
    PetscReal,
    SNESConvergedReason* reason,
    void* ctx
)
{
    coupledSystem& system = *static_cast<coupledSystem*>(ctx);
    Vec f;
    PETSC_CHECK(SNESGetFunction(snes, &f, nullptr, nullptr));
    system.computeNorms(f);

    const report& r = system.report_;
    const scalar residual = max(r.momentum, r.continuity);
    system.contraction_ = it > 0 ? residual / system.residual_ : 1;
    system.residual_ = residual;
    system.stalled_ =
        it > 0 && system.contraction_ > 0.8 ? system.stalled_ + 1 : 0;
    if (system.monitor_)
    {
        Info << "    Newton " << label(it) << "  stress imbalance "
             << r.momentum << "  volume rate " << r.continuity << "  worst at "
             << r.worst << endl;
    }
    if (system.leap_ && residual < system.bestResidual_)
    {
        Vec x;
        PETSC_CHECK(SNESGetSolution(snes, &x));
        PETSC_CHECK(VecCopy(x, system.best_));
        system.bestShift_ = system.shift_;
        system.bestResidual_ = residual;
    }
    *reason = SNES_CONVERGED_ITERATING;
    if (!(r.momentum < GREAT) || !(r.continuity < GREAT))
    {
        *reason = SNES_DIVERGED_FNORM_NAN;
    }
    else if (residual < system.tolerance_)
    {
        *reason = SNES_CONVERGED_FNORM_ABS;
    }
    else if (
        system.spent_ + it >= system.maxIterations_
        || (system.leap_ && it >= system.fullSteps_)
    )
    {
        *reason = SNES_DIVERGED_MAX_IT;
    }
    else if (system.mayGiveWay() && system.stalled_ == 3)
    {
        *reason = SNES_DIVERGED_LINE_SEARCH;
    }
    return 0;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

SNESConvergedReason Foam::coupledSystem::iterate()
{
    stalled_ = 0;
    {
        const trapsOff noTraps;
        petscCheck(SNESSolve(snes_, nullptr, x_), "SNESSolve");
    }
    SNESConvergedReason reason;
    PetscInt iterations;
    PETSC_CHECK(SNESGetConvergedReason(snes_, &reason));
    PETSC_CHECK(SNESGetIterationNumber(snes_, &iterations));
    report_.iterations += iterations;
    spent_ += iterations;
    return reason;
}


SNESConvergedReason Foam::coupledSystem::leap()
{
    SNESLineSearch search;
    PETSC_CHECK(SNESGetLineSearch(snes_, &search));
    SNESLineSearchType type;
    PETSC_CHECK(SNESLineSearchGetType(search, &type));
    const string given(type); // SetType lets go of it
    if (!best_) PETSC_CHECK(VecDuplicate(x_, best_.set()));
    // Half of what was ever reached: the line search between two leaps may lead
    // uphill in this measure, and the two would lead each other in a circle
    const scalar enough = 0.5 * std::min(residual_, bestResidual_);
    PETSC_CHECK(VecCopy(x_, best_));
    bestShift_ = shift_;
    bestResidual_ = residual_;

    leap_ = true;
    PETSC_CHECK(SNESLineSearchSetType(search, SNESLINESEARCHBASIC));
    const SNESConvergedReason reason = iterate();
    PETSC_CHECK(SNESLineSearchSetType(search, given.c_str()));
    leap_ = false;

    if (reason < 0)
    {
        PETSC_CHECK(VecCopy(best_, x_));
        shift_ = bestShift_;
        gather(x_);
        qLast_ = q_;
        mayLeap_ = bestResidual_ < enough;
    }
    return reason;
}


SNESConvergedReason Foam::coupledSystem::newton()
{
    // The secants (see assembleCell, followTurn) and closeVoid may lead uphill;
    // then the tangent takes over from there, and so on. Before that, full
    // steps: the residual has corners (yield, slip, contact), and a line
    // search may find no way down from one, where a full step passes it. Where
    // that fails, pressures of cells with less room follow at once as well: in
    // a step of any length a few of them can hold the line search of all.
    // What has not converged by maxIterations of all this together hardly ever
    // does: a shorter step, or one that lags something, is cheaper.
    secant_ = true;
    leap_ = false;
    mayLeap_ = fullSteps_ > 0;
    bestResidual_ = GREAT;
    eliminateFrom_ = eliminateRoom_;
    spent_ = 0;
    SNESConvergedReason reason;
    for (label attempt = 0; attempt < 4;)
    {
        reason = iterate();
        if (reason > 0 || reason == SNES_DIVERGED_FNORM_NAN
            || spent_ >= maxIterations_)
        {
            break;
        }
        if (mayLeap_)
        {
            const SNESConvergedReason leapt = leap();
            if (leapt > 0) return leapt;
            // As long as it brings something
            if (mayLeap_) continue;
        }
        if (reason != SNES_DIVERGED_LINE_SEARCH) break;
        if (mayEliminateMore())
        {
            eliminateFrom_ *= 0.05;
        }
        else
        {
            secant_ = !secant_;
        }
        ++attempt;
    }
    return reason;
}


const Foam::coupledSystem::report& Foam::coupledSystem::solve(
    const scalar deltaT
)
{
    deltaT_ = deltaT;
    space_.update(deltaT);
    freeze();

    // Start from the last velocity, fixed components at their new values
    space_.fromPoints(state_.pointU.primitiveField(), q_);
    const label nd = space_.nd();
    PetscScalar* v;
    PETSC_CHECK(VecGetArray(x_, &v));
    label i = 0;
    for (const label node : space_.ownedNodes())
    {
        for (label k = 0; k < nd; ++k)
        {
            v[i++] = (k < space_.nFixed()[node] ? space_.fixedValue(node, k)
                                                : q_[nd * node + k])
                / U0_;
        }
    }
    forAll(solved_, c) v[i++] = solved_[c] ? state_.pStart[c] / P0_ : 0;
    PETSC_CHECK(VecRestoreArray(x_, &v));

    shift_ = 0;
    gather(x_);
    qLast_ = q_;
    sLast_ = Zero;
    report_.iterations = 0;
    lagged_ = false;
    turningLagged_ = turnLater_ > 0 && deltaT_ <= lagTurningBelow_;
    SNESConvergedReason reason = newton();

    // Turning may take more stress from what shears than strain gives it
    if (reason < 0 && !turningLagged_ && deltaT_ <= lagTurningBelow_)
    {
        turningLagged_ = true;
        turnLaterRow_ =
            min(max(2 * turnLaterRow_, leastLagTurningSteps_),
                lagTurningSteps_);
        turnLater_ = turnLaterRow_;
        reason = newton();
    }

    // Where the threshold of a face falls faster than its load as it begins to
    // slip, there is no equilibrium to be found: the thing snaps. A threshold
    // that waits for the next step leaves one
    if (reason < 0 && rubs_ && deltaT_ <= lagFrictionBelow_)
    {
        lagged_ = true;
        reason = newton();
    }
    report_.frictionLagged = lagged_;
    report_.turningLagged = turningLagged_;
    report_.converged = reason > 0;
    report_.reason = SNESConvergedReasons[reason];

    // Bolus that is shut in may find balance at any pressure: where that is a
    // multiple of the bulk modulus, nothing that follows can be right
    scalar strain = 0;
    forAll(a_, c)
    {
        if (a_[c] > 0) strain = max(strain, mag(pCell_[c]));
    }
    strain = returnReduce(strain, maxOp<scalar>()) / law_.elastic().K();
    if (report_.converged && strain > 100)
    {
        report_.converged = false;
        report_.reason = "pressureOf100BulkModuli";
    }
    return report_;
}


Foam::scalar Foam::coupledSystem::checkTangent(const scalar deltaT)
{
    // At the solution of a step: all mechanisms are then in play
    solve(deltaT);

    petscVec x, f0, f1, d, Jd;
    PETSC_CHECK(VecDuplicate(x_, x.set()));
    PETSC_CHECK(VecDuplicate(x_, f0.set()));
    PETSC_CHECK(VecDuplicate(x_, f1.set()));
    PETSC_CHECK(VecDuplicate(x_, d.set()));
    PETSC_CHECK(VecDuplicate(x_, Jd.set()));

    gather(x_);
    if (eliminateRoom_ > 0) shift_ += pCell_ - pGiven_;
    eliminate_ = false;
    qLast_ = q_;
    sLast_ = Zero;
    assemble(nullptr, &*tangent_);

    PetscRandom random;
    PETSC_CHECK(PetscRandomCreate(PETSC_COMM_WORLD, &random));
    PETSC_CHECK(PetscRandomSetInterval(random, -1, 1));

    // Central differences in random directions
    scalar worst = 0;
    for (label i = 0; i < 5; ++i)
    {
        PETSC_CHECK(VecSetRandom(d, random));
        PETSC_CHECK(MatMult(tangent_->matrix(), d, Jd));
        const scalar eps = 1e-7;
        PETSC_CHECK(VecWAXPY(x, eps, d, x_));
        residualFunction(snes_, x, f1, this);
        PETSC_CHECK(VecWAXPY(x, -eps, d, x_));
        residualFunction(snes_, x, f0, this);
        PETSC_CHECK(VecAXPY(f1, -1, f0));
        PETSC_CHECK(VecScale(f1, 1 / (2 * eps)));
        PetscReal norm, difference;
        PETSC_CHECK(VecNorm(Jd, NORM_2, &norm));
        PETSC_CHECK(VecAXPY(f1, -1, Jd));
        PETSC_CHECK(VecNorm(f1, NORM_2, &difference));
        worst = max(worst, scalar(difference / norm));
    }
    PETSC_CHECK(PetscRandomDestroy(&random));
    eliminate_ = true;
    return worst;
}

// ************************************************************************* //
