// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "coupledSystem.H"
#include "profiling.H"

#include <algorithm>

// The problem that Newton's method solves

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::coupledSystem::assembleResidual(Vec f)
{
    const label nd = space_.nd();
    const unknownLayout& layout = unknowns_.layout();
    const scalarField& q = unknowns_.q();
    PETSC_CHECK(VecSet(f, 0));

    DynamicList<scalar> R;
    DynamicList<PetscInt> rows;
    forAll(solved_, c)
    {
        if (!solved_[c]) continue;
        cells_.assemble(c, q, unknowns_.p()[c], unknowns_.qLast(), R, nullptr);

        // Scaled rows; those of fixed components are negative: left out
        const label n = R.size() - 1;
        rows.clear();
        for (label i = 0; i < n; ++i)
        {
            const label dof = space_.cellDofs()[space_.cellStart()[c] + i];
            const label node = dof / nd;
            rows.append(
                dof % nd < space_.nFixed()[node]
                    ? -1
                    : layout.nodeRow()[node] + dof % nd
            );
            R[i] *= 1 / (unknowns_.P0 * space_.nodeArea()[node]);
        }
        rows.append(layout.firstCellRow() + c);
        R[n] *= weight_[c] / unknowns_.rate0;
        PETSC_CHECK(
            VecSetValues(f, n + 1, rows.cdata(), R.cdata(), ADD_VALUES)
        );
    }

    // Fixed components
    for (const label node : space_.ownedNodes())
    {
        for (label k = 0; k < space_.nFixed()[node]; ++k)
        {
            const PetscInt row = layout.nodeRow()[node] + k;
            const scalar v =
                (q[nd * node + k] - space_.fixedValue(node, k)) / unknowns_.U0;
            PETSC_CHECK(VecSetValues(f, 1, &row, &v, ADD_VALUES));
        }
    }
    PETSC_CHECK(VecAssemblyBegin(f));
    PETSC_CHECK(VecAssemblyEnd(f));
}


void Foam::coupledSystem::assembleTangent()
{
    const label nd = space_.nd();
    condensedTangent& J = *tangent_;
    J.clear(solved_);

    DynamicList<scalar> R;
    cellEquations::tangent t;
    DynamicList<PetscInt> rows;
    DynamicList<PetscInt> cols;
    DynamicList<scalar> rowScale;
    forAll(solved_, c)
    {
        if (!solved_[c]) continue;
        cells_.assemble(
            c, unknowns_.q(), unknowns_.p()[c], unknowns_.qLast(), R, &t
        );

        // As the residual's, but of velocities alone
        const label n = R.size() - 1;
        rows.clear();
        cols.clear();
        rowScale.clear();
        for (label i = 0; i < n; ++i)
        {
            const label dof = space_.cellDofs()[space_.cellStart()[c] + i];
            const label node = dof / nd;
            cols.append(space_.nodeRow()[node] + dof % nd);
            rows.append(dof % nd < space_.nFixed()[node] ? -1 : cols.last());
            rowScale.append(1 / (unknowns_.P0 * space_.nodeArea()[node]));
        }
        rowScale.append(weight_[c] / unknowns_.rate0);
        for (label i = 0; i <= n; ++i)
        {
            for (label j = 0; j <= n; ++j)
            {
                t.J[i * (n + 1) + j] *=
                    rowScale[i] * (j < n ? unknowns_.U0 : unknowns_.P0);
            }
        }
        J.add(c, t.J, rows, cols);
        J.extrapolate(c, weight_[c] / unknowns_.rate0 * t.excess);
    }
    for (const label node : space_.ownedNodes())
    {
        for (label k = 0; k < space_.nFixed()[node]; ++k)
        {
            J.fix(space_.nodeRow()[node] + k);
        }
    }
    J.finish();
}


void Foam::coupledSystem::residual(Vec x, Vec f)
{
    unknowns_.gather(x, solved_, accuracy());
    assembleResidual(f);
}


void Foam::coupledSystem::linearise(
    Vec x,
    const bool anew,
    const scalar accurate
)
{
    unknowns_.gather(x, solved_, accuracy());
    if (anew)
    {
        addProfiling(tangent, "tangent");
        assembleTangent();
    }
    else
    {
        tangent_->reuse();
    }
    tangent_->setAccuracy(accurate);
    unknowns_.linearised();
}


Foam::scalar Foam::coupledSystem::measure(Vec f)
{
    const label nNode = space_.nd() * space_.ownedNodes().size();

    const PetscScalar* v;
    PETSC_CHECK(VecGetArrayRead(f, &v));
    scalar m2 = 0;
    scalar c2 = 0;
    scalar largest = -1;
    label where = -1;
    for (label i = 0; i < nNode + solved_.size(); ++i)
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

    const fvMesh& mesh = space_.mesh();
    Tuple2<scalar, point> worst(largest, point::zero);
    if (where >= nNode)
    {
        worst.second() = mesh.C()[where - nNode];
    }
    else if (where >= 0)
    {
        const label node = space_.ownedNodes()[where / space_.nd()];
        worst.second() = mesh.points()[space_.pointNode().find(node)];
    }
    reduce(worst, maxFirstOp<scalar>());
    report_.worst = worst.second();

    if (!(report_.momentum < GREAT) || !(report_.continuity < GREAT))
    {
        return GREAT;
    }
    return max(report_.momentum, report_.continuity);
}


void Foam::coupledSystem::print(const label it) const
{
    Info << "    Newton " << it << "  stress imbalance " << report_.momentum
         << "  volume rate " << report_.continuity << "  worst at "
         << report_.worst << endl;
}


void Foam::coupledSystem::startWays()
{
    cells_.elimination().start();
}


void Foam::coupledSystem::useSecants(const bool use)
{
    cells_.useSecants(use);
}


bool Foam::coupledSystem::mayEliminateMore() const
{
    return const_cast<coupledSystem&>(*this).cells_.elimination().mayTakeMore();
}


void Foam::coupledSystem::eliminateMore()
{
    cells_.elimination().takeMore();
}


void Foam::coupledSystem::keep()
{
    unknowns_.keep();
}


void Foam::coupledSystem::takeBack(Vec x)
{
    unknowns_.takeBack(x, solved_, accuracy());
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::coupledSystem::checkTangent(const scalar deltaT)
{
    // At the solution of a step: all mechanisms are then in play
    solve(deltaT);

    const Vec x0 = unknowns_.x();
    petscVec x, f0, f1, d, Jd;
    PETSC_CHECK(VecDuplicate(x0, x.set()));
    PETSC_CHECK(VecDuplicate(x0, f0.set()));
    PETSC_CHECK(VecDuplicate(x0, f1.set()));
    PETSC_CHECK(VecDuplicate(x0, d.set()));
    PETSC_CHECK(VecDuplicate(x0, Jd.set()));

    unknowns_.gather(x0, solved_, accuracy());
    unknowns_.linearised();
    unknowns_.eliminate(false);
    cells_.forgetTangent();
    assembleTangent();

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
        PETSC_CHECK(VecWAXPY(x, eps, d, x0));
        residual(x, f1);
        PETSC_CHECK(VecWAXPY(x, -eps, d, x0));
        residual(x, f0);
        PETSC_CHECK(VecAXPY(f1, -1, f0));
        PETSC_CHECK(VecScale(f1, 1 / (2 * eps)));
        PetscReal norm, difference;
        PETSC_CHECK(VecNorm(Jd, NORM_2, &norm));
        PETSC_CHECK(VecAXPY(f1, -1, Jd));
        PETSC_CHECK(VecNorm(f1, NORM_2, &difference));
        worst = max(worst, scalar(difference / norm));
    }
    PETSC_CHECK(PetscRandomDestroy(&random));
    unknowns_.eliminate(true);
    return worst;
}

// ************************************************************************* //
