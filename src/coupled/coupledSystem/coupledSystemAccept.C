// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "coupledSystem.H"
#include "contactPatches.H"
#include "wallReaction.H"

// The solution becomes the state

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::coupledSystem::acceptCell(
    const label c,
    const laminate::result& r,
    const vectorField& v
)
{
    const laminate& mixture = cells_.mixture();
    state_.stress[c] = r.dev + r.P * symmTensor::I;

    const labelList& pts = space_.mesh().cellPoints()[c];
    vector U = Zero;
    for (const label p : pts) U += v[p];
    U /= pts.size();
    if (space_.wedge())
    {
        // The mean over the two sides has lost the cosine of the radius
        const vector& e2 = space_.radial();
        U += (1 / std::cos(0.5 * space_.wedgeAngle()) - 1) * (U & e2) * e2;
    }
    state_.U[c] = U;
    state_.p[c] = unknowns_.p()[c];

    if (mixture.alphaEff(c) == 0)
    {
        state_.deviator[c] = Zero;
        state_.theta[c] = 1;
        return;
    }
    state_.deviator[c] = turning_.now() ? mixture.turned(c, r) : r.r.s;
    state_.theta[c] = r.r.theta;
    const scalar strain = (1 - state_.D[c]) * (r.r.epsP - state_.epsilonPEq[c]);
    state_.undamagedStrain[c] += strain;
    const scalar q = elastoViscoPlastic::sigmaEq(r.r.s);
    if (q > SMALL && law_.damage().tension(-r.p / q))
    {
        state_.tensileStrain[c] += strain;
    }
    state_.epsilonPEq[c] = r.r.epsP;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::coupledSystem::accept(
    surfaceScalarField& phi,
    volVectorField& wallForce,
    volScalarField& wallPower
)
{
    unknowns_.gather(unknowns_.x(), solved_, accuracy());
    const scalarField& q = unknowns_.q();
    state_.pStart.primitiveFieldRef() = unknowns_.p();
    turning_.accept();

    vectorField& v = state_.pointU.primitiveFieldRef();
    space_.toPoints(q, v);
    space_.flux(v, phi);

    // Forces of the cells on their nodes, which walls must hold; a second
    // time without the pressure on the wall faces, as in the momentum rows
    scalarField force(q.size(), Zero);
    scalarField rowForce(q.size(), Zero);
    scalarField pressure(solved_.size(), Zero);
    DynamicList<scalar> R;

    powerLedger& power = solution_.power;
    power.clear();
    solution_.slipEnergy = 0;
    solution_.elasticEnergy.setSize(solved_.size());
    const boolList held(contactPatches::heldNodes(state_.U, space_));
    const label nd = space_.nd();
    scalar volume = 0;
    scalar rateVolume = 0;
    scalar rate2Volume = 0;

    forAll(solved_, c)
    {
        laminate::result r;
        if (!solved_[c])
        {
            r.p = unknowns_.p()[c];
            r.P = 0;
            r.dev = Zero;
            solution_.elasticEnergy[c] = 0;
            cells_.friction().forget(c);
            acceptCell(c, r, v);
            continue;
        }

        cells_.evaluate(c, q, unknowns_.p()[c], r);
        cells_.internalForce(c, q, r, R);
        const scalar rate = std::sqrt(2.0 / 3) * mag(dev(symm(r.gradU)));
        const scalar bolus = cells_.mixture().alphaEff(c) * space_.V()[c];
        volume += bolus;
        rateVolume += bolus * rate;
        rate2Volume += bolus * sqr(rate);
        forAll(R, i)
        {
            const label j = space_.cellStart()[c] + i;
            const label dof = space_.cellDofs()[j];
            const label node = dof / nd;
            rowForce[dof] += R[i];
            force[dof] += R[i]
                + r.P * (space_.V()[c] * tr(space_.G()[j]) - space_.h()[j]);
            // What moves nodes without being a wall
            if (held[node] && dof % nd < space_.nFixed()[node])
            {
                power["closure"] += R[i] * q[dof];
            }
        }
        pressure[c] = r.P;
        solution_.elasticEnergy[c] =
            cells_.accept(c, q, r, power, solution_.slipEnergy);
        acceptCell(c, r, v);
    }
    reduce(volume, sumOp<scalar>());
    reduce(rateVolume, sumOp<scalar>());
    reduce(rate2Volume, sumOp<scalar>());
    solution_.flowRate = rate2Volume / max(rateVolume, VSMALL);
    solution_.bolusRate = rateVolume / max(volume, VSMALL);
    state_.U.correctBoundaryConditions();
    state_.p.correctBoundaryConditions();

    wallReaction::start(state_.U, pressure, wallForce, wallPower);
    wallReaction::distribute(
        space_, state_.U, force, rowForce, wallForce, wallPower
    );
    wallReaction::book(pressure, wallPower, power);
}

// ************************************************************************* //
