// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "cellEquations.H"
#include "contactPatches.H"
#include "entryReader.H"
#include "hourglass.H"
#include "volFields.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cellEquations::cellEquations(
    const elastoViscoPlastic& law,
    surroundingPhase& medium,
    bolusState& state,
    const nodalSpace& space,
    const caseScales& scales,
    const dictionary& bolusProperties,
    entryReader& read
) :
    space_(space),
    state_(state),
    interface_(space, contactPatches::separates(state.U), scales, read),
    mixture_(law, medium, state, space, interface_, scales, read),
    elimination_(mixture_, read),
    flow_(mixture_, space.mesh().nCells(), read),
    friction_(space, state),
    secants_(true)
{
    forces_.append(new hourglass(space, read));
    forces_.append(new inertia(space, read));
    cellForce::select(space, bolusProperties, forces_);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::cellEquations::start(const scalar deltaT)
{
    interface_.update(state_.alpha, state_.stress);
    mixture_.start(deltaT);
    friction_.start(deltaT);

    const label nCells = space_.mesh().nCells();
    scalarField rho(nCells);
    scalarField stiffness(nCells);
    forAll(rho, c)
    {
        rho[c] = mixture_.rho(c);
        stiffness[c] = mixture_.stiffness(c);
    }
    const cellForce::stepStart now = {
        deltaT,
        rho,
        mixture_.rhoBolus(),
        state_.mass.primitiveField(),
        stiffness,
        state_.U.primitiveField()
    };
    for (cellForce& force : forces_) force.start(now);
}


void Foam::cellEquations::kinematics(
    const label c,
    const scalarField& q,
    tensor& gradU,
    scalar& dilation
) const
{
    gradU = Zero;
    dilation = space_.wallFlux()[c];
    for (label i = space_.cellStart()[c]; i < space_.cellStart()[c + 1]; ++i)
    {
        const scalar v = q[space_.cellDofs()[i]];
        gradU += v * space_.G()[i];
        dilation += v * space_.h()[i];
    }
    dilation /= space_.V()[c];
}


void Foam::cellEquations::evaluate(
    const label c,
    const scalarField& q,
    const scalar p,
    laminate::result& r
) const
{
    tensor gradU;
    scalar dilation;
    kinematics(c, q, gradU, dilation);
    mixture_.evaluate(c, gradU, dilation, p, r);
}


void Foam::cellEquations::internalForce(
    const label c,
    const scalarField& q,
    const laminate::result& r,
    DynamicList<scalar>& R
) const
{
    const label start = space_.cellStart()[c];
    const label n = space_.cellStart()[c + 1] - start;
    const scalar V = space_.V()[c];

    R.setSize(n);
    for (label i = 0; i < n; ++i)
    {
        R[i] = V * (r.dev && symm(space_.G()[start + i]))
            + r.P * space_.h()[start + i];
    }
    for (const cellForce& force : forces_) force.add(c, q, R, nullptr);
}


void Foam::cellEquations::assemble(
    const label c,
    const scalarField& q,
    const scalar p,
    const scalarField& qLast,
    DynamicList<scalar>& R,
    tangent* t
)
{
    laminate::result r;
    evaluate(c, q, p, r);
    if (!t)
    {
        internalForce(c, q, r, R);
        R.append(r.residual);
        friction_.add(c, bolusOf(c, r), q, nullptr, dS_, R, nullptr);
        return;
    }

    const label start = space_.cellStart()[c];
    const label n = space_.cellStart()[c + 1] - start;
    const tensor* G = &space_.G()[start];
    const scalar* h = &space_.h()[start];
    const scalar V = space_.V()[c];
    scalarField& J = t->J;

    flow_.follow(c, secants_, r);
    scalar slope = r.slope;
    t->excess = 0;
    if (secants_) elimination_.extrapolate(c, r, slope, t->excess);

    // Derivatives in the direction of each unknown; the last is the pressure
    J.setSize((n + 1) * (n + 1));
    d_.setSize(n + 1);
    dS_.setSize(n + 1);
    symG_.setSize(n);
    for (label j = 0; j <= n; ++j)
    {
        if (j < n)
        {
            symG_[j] = symm(G[j]);
            mixture_.derive(c, r, G[j], h[j] / V, d_[j]);
        }
        else
        {
            mixture_.deriveToPressure(c, r, d_[j]);
        }
        dS_[j] = d_[j].s;
        J[n * (n + 1) + j] = d_[j].growth + slope * d_[j].pv;
    }
    for (label i = 0; i < n; ++i)
    {
        scalar* row = &J[i * (n + 1)];
        for (label j = 0; j <= n; ++j)
        {
            row[j] = (d_[j].dev && symG_[i]) + d_[j].P * h[i];
        }
    }

    // The residuals are not asked for
    R.setSize(n);
    for (scalar& value : R) value = 0;
    for (const cellForce& force : forces_) force.add(c, q, R, &J);
    R.append(0);
    friction_.add(c, bolusOf(c, r), q, secants_ ? &qLast : nullptr, dS_, R, &J);
}


void Foam::cellEquations::declare(powerLedger& ledger) const
{
    laminate::declare(ledger);
    ledger.declare("friction");
    for (const cellForce& force : forces_) ledger.declare(force.type());
}


Foam::scalar Foam::cellEquations::accept(
    const label c,
    const scalarField& q,
    const laminate::result& r,
    powerLedger& ledger,
    scalar& slipEnergy
)
{
    const scalar energy = mixture_.book(c, r, ledger);

    const label start = space_.cellStart()[c];
    scalarField R(space_.cellStart()[c + 1] - start);
    for (const cellForce& force : forces_)
    {
        R = 0;
        force.add(c, q, R, nullptr);
        scalar& power = ledger[force.type()];
        forAll(R, i) power += R[i] * q[space_.cellDofs()[start + i]];
    }
    friction_.accept(c, bolusOf(c, r), q, ledger, slipEnergy);
    return energy;
}

// ************************************************************************* //
