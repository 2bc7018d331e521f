// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "newtonSolver.H"
#include "dictionary.H"
#include "entryReader.H"
#include "profiling.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

PetscErrorCode
Foam::newtonSolver::residualFunction(SNES, Vec x, Vec f, void* ctx)
{
    addProfiling(residual, "residual");
    static_cast<newtonSolver*>(ctx)->problem_.residual(x, f);
    return 0;
}


PetscErrorCode
Foam::newtonSolver::tangentFunction(SNES, Vec x, Mat, Mat, void* ctx)
{
    newtonSolver& self = *static_cast<newtonSolver*>(ctx);

    // With the same tangent the next iteration gains about what the last one
    // did: where that is enough, it saves a factorisation
    const bool anew = self.residual_ * self.contraction_ > self.tolerance_;
    const scalar useful = 0.1 * self.tolerance_ / self.residual_;
    self.problem_.linearise(
        x,
        anew,
        min(max(max(sqr(self.contraction_), useful), scalar(1e-5)),
            self.linearTolerance_)
    );
    return 0;
}


SNESConvergedReason Foam::newtonSolver::judge(const label it, Vec f)
{
    const scalar residual = problem_.measure(f);
    contraction_ = it > 0 ? residual / residual_ : 1;
    residual_ = residual;
    stalled_ = it > 0 && contraction_ > 0.8 ? stalled_ + 1 : 0;
    if (monitor_) problem_.print(it);
    if (leap_ && residual < bestResidual_)
    {
        Vec x;
        PETSC_CHECK(SNESGetSolution(snes_, &x));
        PETSC_CHECK(VecCopy(x, best_));
        problem_.keep();
        bestResidual_ = residual;
    }
    if (!(residual < GREAT)) return SNES_DIVERGED_FNORM_NAN;
    if (residual < tolerance_) return SNES_CONVERGED_FNORM_ABS;
    if (spent_ + it >= maxIterations_ || (leap_ && it >= undampedSteps_))
    {
        return SNES_DIVERGED_MAX_IT;
    }
    if (mayGiveWay() && stalled_ == 3) return SNES_DIVERGED_LINE_SEARCH;
    return SNES_CONVERGED_ITERATING;
}


PetscErrorCode Foam::newtonSolver::convergedFunction(
    SNES snes,
    PetscInt it,
    PetscReal,
    PetscReal,
    PetscReal,
    SNESConvergedReason* reason,
    void* ctx
)
{
    Vec f;
    PETSC_CHECK(SNESGetFunction(snes, &f, nullptr, nullptr));
    *reason = static_cast<newtonSolver*>(ctx)->judge(it, f);
    return 0;
}


SNESConvergedReason Foam::newtonSolver::iterate(Vec x)
{
    stalled_ = 0;
    {
        const trapsOff noTraps;
        petscCheck(SNESSolve(snes_, nullptr, x), "SNESSolve");
    }
    SNESConvergedReason reason;
    PetscInt iterations;
    PETSC_CHECK(SNESGetConvergedReason(snes_, &reason));
    PETSC_CHECK(SNESGetIterationNumber(snes_, &iterations));
    spent_ += iterations;
    return reason;
}


SNESConvergedReason Foam::newtonSolver::leap(Vec x)
{
    SNESLineSearch search;
    PETSC_CHECK(SNESGetLineSearch(snes_, &search));
    SNESLineSearchType type;
    PETSC_CHECK(SNESLineSearchGetType(search, &type));
    const string given(type); // SetType lets go of it
    if (!best_) PETSC_CHECK(VecDuplicate(x, best_.set()));
    // Half of what was ever reached: the line search between two leaps may lead
    // uphill in this measure, and the two would lead each other in a circle
    const scalar enough = 0.5 * std::min(residual_, bestResidual_);
    PETSC_CHECK(VecCopy(x, best_));
    problem_.keep();
    bestResidual_ = residual_;

    leap_ = true;
    PETSC_CHECK(SNESLineSearchSetType(search, SNESLINESEARCHBASIC));
    const SNESConvergedReason reason = iterate(x);
    PETSC_CHECK(SNESLineSearchSetType(search, given.c_str()));
    leap_ = false;

    if (reason < 0)
    {
        PETSC_CHECK(VecCopy(best_, x));
        problem_.takeBack(x);
        mayLeap_ = bestResidual_ < enough;
    }
    return reason;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::newtonSolver::newtonSolver(
    newtonProblem& problem,
    const dictionary& dict,
    entryReader& read
) :
    problem_(problem),
    linearTolerance_(1e-3),
    leap_(false),
    mayLeap_(false),
    bestResidual_(GREAT),
    residual_(GREAT),
    contraction_(1),
    stalled_(0),
    spent_(0),
    reason_(SNES_CONVERGED_ITERATING)
{
    tolerance_ = read.number(
        "tolerance",
        "rms of the scaled residuals [-]",
        {0, false, 1e-2, true},
        1e-6
    );
    maxIterations_ = read.wholeNumber(
        "maxIterations", "of Newton's method", {1, true, 1e5, true}, 60
    );
    undampedSteps_ = read.wholeNumber(
        "undampedSteps",
        "iterations without line search",
        {0, true, 1e5, true},
        0
    );
    monitor_ = dict.lookupOrDefault("monitor", false);
    read.has("monitor");
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::newtonSolver::create(
    Vec x,
    Mat tangent,
    const scalar linearTolerance
)
{
    linearTolerance_ = linearTolerance;
    PETSC_CHECK(VecDuplicate(x, f_.set()));
    PETSC_CHECK(SNESCreate(PETSC_COMM_WORLD, snes_.set()));
    PETSC_CHECK(SNESSetOptionsPrefix(snes_, "bolus_"));
    PETSC_CHECK(SNESSetFunction(snes_, f_, residualFunction, this));
    PETSC_CHECK(
        SNESSetJacobian(snes_, tangent, tangent, tangentFunction, this)
    );
    PETSC_CHECK(
        SNESSetConvergenceTest(snes_, convergedFunction, this, nullptr)
    );
    // A step of no length is no convergence: judge() decides alone
    PETSC_CHECK(SNESSetTolerances(snes_, 0, 0, 0, maxIterations_, 10000));
}


bool Foam::newtonSolver::solve(Vec x)
{
    bool secants = true;
    problem_.useSecants(secants);
    problem_.startWays();
    leap_ = false;
    mayLeap_ = undampedSteps_ > 0;
    bestResidual_ = GREAT;
    spent_ = 0;
    for (label attempt = 0; attempt < 4;)
    {
        reason_ = iterate(x);
        if (reason_ > 0 || reason_ == SNES_DIVERGED_FNORM_NAN
            || spent_ >= maxIterations_)
        {
            break;
        }
        if (mayLeap_)
        {
            const SNESConvergedReason leapt = leap(x);
            if (leapt > 0)
            {
                reason_ = leapt;
                break;
            }
            // As long as it brings something
            if (mayLeap_) continue;
        }
        // PETSc calls a failed search a local minimum where a random vector
        // tells it so: no reason to give up
        if (reason_ != SNES_DIVERGED_LINE_SEARCH
            && reason_ != SNES_DIVERGED_LOCAL_MIN)
        {
            break;
        }
        if (problem_.mayEliminateMore())
        {
            problem_.eliminateMore();
        }
        else
        {
            secants = !secants;
            problem_.useSecants(secants);
        }
        ++attempt;
    }
    return reason_ > 0;
}


Foam::word Foam::newtonSolver::reason() const
{
    return SNESConvergedReasons[reason_];
}

// ************************************************************************* //
