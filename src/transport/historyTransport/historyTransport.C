// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "historyTransport.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::historyTransport::setFluxes(
    const transportZone& z,
    const label sub,
    const label n,
    const label left
)
{
    const scalarField& alpha = state_.alpha.primitiveField();
    step_.setVolumes(z, sub, n);
    bolusFlux_.set(z, alpha, n, left);
    // What leads out of the zone has been followed by now
    historyFlux_.set(
        z, alpha, state_.mass.primitiveField(), step_.deltaT() / n
    );
}


void Foam::historyTransport::move(
    const transportZone& z,
    const label sub,
    const label n
)
{
    // Those of z may be others by now
    step_.setVolumes(z, sub, n);
    historyFlux_.move(
        z,
        step_.deltaT() / n,
        state_.mass.primitiveFieldRef(),
        state_.alpha.primitiveFieldRef()
    );
}


void Foam::historyTransport::total(surfaceScalarField& massFlux)
{
    const scalarField& total = bolusFlux_.total();
    const label nInternal = mesh_.nInternalFaces();
    for (label f = 0; f < nInternal; ++f) massFlux[f] = total[f];
    for (fvsPatchScalarField& Fp : massFlux.boundaryFieldRef())
    {
        const label start = Fp.patch().start();
        forAll(Fp, i) Fp[i] = total[start + i];
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::historyTransport::historyTransport(
    bolusState& state,
    const scalar bulkModulus,
    const tensor& axes,
    entryReader&& read
) :
    mesh_(state.history.mesh()),
    state_(state),
    exchange_(mesh_),
    memory_(state.history, bulkModulus, axes),
    step_(mesh_, exchange_),
    subSteps_(mesh_, exchange_, step_, read),
    bolusFlux_(mesh_, exchange_, step_, memory_, read),
    historyFlux_(mesh_, exchange_, step_, bolusFlux_, memory_, read),
    overflow_(mesh_, exchange_, memory_, read),
    maxAlpha_(read.number(
        "maxAlpha",
        "fullest cell of a step [-]",
        {1, false, GREAT, true},
        1.2
    ))
{
    read.rejectOthers();
}


Foam::historyTransport::historyTransport(
    bolusState& state,
    const scalar bulkModulus,
    const tensor& axes,
    const dictionary& dict
) :
    historyTransport(state, bulkModulus, axes, entryReader(dict))
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::historyTransport::report Foam::historyTransport::advance(
    const surfaceScalarField& phi,
    const scalar deltaT,
    surfaceScalarField& massFlux
)
{
    surfaceScalarField& phiRel = state_.phiRel;
    phiRel = phi;
    if (mesh_.moving()) phiRel -= mesh_.phi();
    step_.set(phiRel, deltaT);

    scalarField& alpha = state_.alpha.primitiveFieldRef();
    scalarField& m = state_.mass.primitiveFieldRef();

    report result;
    result.tooFast = !subSteps_.begin(m);
    result.courant = subSteps_.courant();
    result.bulkCourant = subSteps_.bulkCourant();
    result.subSteps = result.slowSubSteps = 0;
    result.alphaMax = result.spilled = 0;
    if (result.tooFast) return result;

    // The solution has changed the pressure, and with it the volume
    memory_.pack();
    forAll(alpha, c) alpha[c] = m[c] * memory_.shrunk()[c];

    bolusFlux_.begin();
    historyFlux_.begin();
    const labelPair steps = subSteps_.divide();
    const label coarse = steps.first();
    const label fine = steps.second();
    const label all = coarse * fine;
    result.slowSubSteps = coarse;
    result.subSteps = all;
    subSteps_.setZones(fine > 1 ? coarse : 0, slow_, fast_);
    for (label i = 0; i < coarse; ++i)
    {
        // Between slow cells, with what fast ones take and give at the start
        if (fine > 1) bolusFlux_.upwind(fast_, alpha);
        setFluxes(slow_, i + 1, coarse, 1);

        // Fast ones and their neighbours
        for (label j = 0; fine > 1 && j < fine; ++j)
        {
            historyFlux_.follow(fast_, fine);
            setFluxes(fast_, i * fine + j + 1, all, fine - j);
            move(fast_, i * fine + j + 1, all);
        }
        historyFlux_.setMean(fast_);
        move(slow_, i + 1, coarse);
    }

    result.spilled = overflow_.spill(m, alpha, deltaT, bolusFlux_.total());

    memory_.unpack();
    state_.mass.correctBoundaryConditions();
    state_.alpha.correctBoundaryConditions();
    result.alphaMax = gMax(alpha);
    total(massFlux);
    return result;
}

// ************************************************************************* //
