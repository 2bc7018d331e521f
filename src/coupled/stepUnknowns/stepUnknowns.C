// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "stepUnknowns.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::stepUnknowns::stepUnknowns(
    const nodalSpace& space,
    cellEquations& cells,
    const caseScales& scales
) :
    space_(space),
    cells_(cells),
    layout_(space, x_),
    q_(space.nd() * space.nNodes(), Zero),
    p_(space.mesh().nCells(), Zero),
    shift_(space.mesh().nCells(), Zero),
    eliminate_(true),
    U0(0.01 * scales.strainRate()),
    P0(1e4 * scales.stressRatio()),
    rate0(10 * scales.strainRate())
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::stepUnknowns::start(
    const vectorField& pointU,
    const scalarField& pStart,
    const boolList& solved,
    const scalar residual
)
{
    space_.fromPoints(pointU, q_);
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
                / U0;
        }
    }
    forAll(solved, c) v[i++] = solved[c] ? pStart[c] / P0 : 0;
    PETSC_CHECK(VecRestoreArray(x_, &v));

    shift_ = 0;
    gather(x_, solved, residual);
    qLast_ = q_;
}


void Foam::stepUnknowns::gather(
    Vec x,
    const boolList& solved,
    const scalar residual
)
{
    layout_.gather(x, U0, P0, q_, p_);
    p_ += shift_;

    const pressureElimination& elimination = cells_.elimination();
    if (!eliminate_ || !elimination.active()) return;
    pGiven_ = p_;
    tensor gradU;
    scalar dilation;
    forAll(p_, c)
    {
        if (!solved[c] || !elimination.takes(c)) continue;
        cells_.kinematics(c, q_, gradU, dilation);
        p_[c] = elimination.solve(c, gradU, dilation, p_[c], residual);
    }
}


void Foam::stepUnknowns::linearised()
{
    if (cells_.elimination().active()) shift_ += p_ - pGiven_;
    qLast_ = q_;
}


void Foam::stepUnknowns::takeBack(
    Vec x,
    const boolList& solved,
    const scalar residual
)
{
    shift_ = keptShift_;
    gather(x, solved, residual);
    qLast_ = q_;
}

// ************************************************************************* //
