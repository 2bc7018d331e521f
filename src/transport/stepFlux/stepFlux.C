// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "stepFlux.H"
#include "nodalSpace.H"
#include "surfaceFields.H"
#include "volFields.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::stepFlux::stepFlux(const fvMesh& mesh, const cellExchange& exchange) :
    mesh_(mesh),
    exchange_(exchange),
    deltaT_(0),
    flux_(mesh.nFaces(), Zero),
    delta_(mesh.nFaces(), Zero),
    extent_(mesh.nFaces(), -1),
    V0_(mesh.nCells(), Zero),
    Vold_(mesh.nCells(), Zero),
    V_(mesh.nCells(), Zero)
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::stepFlux::set(const surfaceScalarField& phiRel, const scalar deltaT)
{
    deltaT_ = deltaT;
    V0_ = mesh_.moving() ? mesh_.V0().field() : mesh_.V().field();

    // In one list; sides of the slice have no flux
    flux_ = 0;
    extent_ = -1;
    const volVectorField& C = mesh_.C();
    const label nInternal = mesh_.nInternalFaces();
    faces_.clear();
    for (label f = 0; f < nInternal; ++f)
    {
        flux_[f] = phiRel[f];
        delta_[f] = C[mesh_.neighbour()[f]] - C[mesh_.owner()[f]];
        faces_.append(f);
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        const fvsPatchScalarField& phip = phiRel.boundaryField()[patchi];
        const vectorField d(patch.delta());
        forAll(phip, i)
        {
            const label f = patch.patch().start() + i;
            flux_[f] = phip[i];
            delta_[f] = d[i];
            if (flux_[f] != 0 || exchange_.coupled(f)) faces_.append(f);
        }
    }
}


void Foam::stepFlux::setVolumes(
    const transportZone& z,
    const label sub,
    const label n
)
{
    const scalarField& V1 = mesh_.V();
    for (const label c : z.cells)
    {
        Vold_[c] = V0_[c] + scalar(sub - 1) / n * (V1[c] - V0_[c]);
        V_[c] = V0_[c] + scalar(sub) / n * (V1[c] - V0_[c]);
    }
}


void Foam::stepFlux::courant(scalarField& Co) const
{
    Co.setSize(mesh_.nCells());
    Co = 0;
    for (const label f : faces_)
    {
        const label D = donor(f);
        if (D >= 0) Co[D] += mag(flux_[f]);
    }
    const scalarField& V1 = mesh_.V();
    forAll(Co, c) Co[c] *= deltaT_ / min(V0_[c], V1[c]);
}


Foam::vector Foam::stepFlux::direction(const label facei) const
{
    return (flux_[facei] > 0 ? 1 : -1) / max(mag(delta_[facei]), VSMALL)
        * delta_[facei];
}


Foam::scalar Foam::stepFlux::extent(
    const label facei,
    const vector& direction
) const
{
    scalar& extent = extent_[facei];
    if (extent < 0)
    {
        extent =
            nodalSpace::extent(mesh_, mesh_.points(), donor(facei), direction);
    }
    return extent;
}

// ************************************************************************* //
