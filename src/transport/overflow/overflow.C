// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "overflow.H"
#include "labelIOList.H"

namespace Foam
{

//- First to where there is room; where the bolus around is full, it takes a
//  little more than fits
static const label nFirst = 5;
static const label nPasses = 100;
static const scalar tolerance = 1e-4;

} // End namespace Foam

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::overflow::setOpen()
{
    open_ = exchange_.coupled();
    for (label f = 0; f < mesh_.nInternalFaces(); ++f) open_[f] = true;
    if (!mesh_.foundObject<labelIOList>("closedPoints")) return;

    boolList closed(mesh_.nPoints(), false);
    for (const label p : mesh_.lookupObject<labelIOList>("closedPoints"))
    {
        closed[p] = true;
    }
    forAll(open_, f)
    {
        bool all = true;
        for (const label p : mesh_.faces()[f]) all = all && closed[p];
        if (all) open_[f] = false;
    }
}


void Foam::overflow::setShares(const scalarField& alpha, const bool first)
{
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const scalarField& V = mesh_.V();

    // Room of the cells; excess goes where there is room, in proportion
    forAll(room_, c) room_[c] = max(1 - alpha[c], scalar(0)) * V[c];
    exchange_.cells(room_, 1, roomBeyond_);

    around_ = 0;
    forAll(own, f)
    {
        if (!open_[f]) continue;
        if (f < nInternal)
        {
            const label N = mesh_.faceNeighbour()[f];
            around_[own[f]] += room_[N];
            around_[N] += room_[own[f]];
        }
        else
        {
            around_[own[f]] += roomBeyond_[exchange_.at(f)];
        }
    }

    // Part of the cell's excess per volume of room; half of the room at
    // most, because other cells may want it too
    share_ = 0;
    excess_ = 0;
    forAll(share_, c)
    {
        const scalar e = alpha[c] - 1;
        if (first && e > 0.1 * tolerance && around_[c] > VSMALL)
        {
            share_[c] = min(e * V[c] / around_[c], scalar(0.5));
        }
        if (!first) excess_[c] = max(alpha[c] - (1 + squeeze_), scalar(0));
    }
    exchange_.cells(share_, 1, shareBeyond_);
    exchange_.cells(excess_, 1, excessBeyond_);
}


Foam::scalar Foam::overflow::setFluxes(const scalar deltaT, scalarField& total)
{
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const scalarField& V = mesh_.V();
    const scalarField& rho = memory_.rho();

    // Mass over the faces, with the density of where it comes from
    exchange_.cells(rho, 1, rhoBeyond_);
    scalar passed = 0;
    F_ = 0;
    forAll(own, f)
    {
        if (!open_[f]) continue;
        const label P = own[f];
        const bool internal = f < nInternal;
        const label b = internal ? -1 : exchange_.at(f);
        const label N = internal ? mesh_.faceNeighbour()[f] : -1;
        const scalar rhoN = internal ? rho[N] : rhoBeyond_[b];
        F_[f] = share_[P] * rho[P] * (internal ? room_[N] : roomBeyond_[b])
            - (internal ? share_[N] : shareBeyond_[b]) * rhoN * room_[P];

        // What is beyond "squeezed" levels out, a twelfth a face: stable
        // with up to six faces
        const scalar level =
            excess_[P] - (internal ? excess_[N] : excessBeyond_[b]);
        F_[f] += level * min(V[P], internal ? V[N] : VBeyond_[b]) / 12
            * (level > 0 ? rho[P] : rhoN);

        if (F_[f] > 0)
            passed += F_[f];
        else if (internal)
            passed -= F_[f];
        total[f] += F_[f] / deltaT;
    }
    return passed;
}


void Foam::overflow::move(scalarField& m, scalarField& alpha)
{
    const label n = memory_.n();
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const scalarField& V = mesh_.V();
    scalarField& q = memory_.values();

    exchange_.cells(q, n, memoryBeyond_);
    carried_.setSize(q.size());
    forAll(m, c)
    {
        mass_[c] = m[c] * V[c];
        for (label i = c * n; i < (c + 1) * n; ++i)
            carried_[i] = mass_[c] * q[i];
    }
    forAll(F_, f)
    {
        if (F_[f] == 0) continue;
        const bool internal = f < nInternal;
        const label P = own[f];
        const label N = internal ? mesh_.faceNeighbour()[f] : -1;
        const scalar* qF = F_[f] > 0 ? &q[P * n]
            : internal               ? &q[N * n]
                                     : &memoryBeyond_[exchange_.at(f, n)];
        mass_[P] -= F_[f];
        if (internal) mass_[N] += F_[f];
        for (label k = 0; k < n; ++k)
        {
            carried_[P * n + k] -= F_[f] * qF[k];
            if (internal) carried_[N * n + k] += F_[f] * qF[k];
        }
    }
    forAll(m, c)
    {
        const bool empty = mass_[c] <= 1e-12 * V[c];
        for (label i = c * n; i < (c + 1) * n; ++i)
        {
            q[i] = empty ? 0 : carried_[i] / mass_[c];
        }
        m[c] = mass_[c] / V[c];
        memory_.compress(c);
        alpha[c] = m[c] * memory_.shrunk()[c];
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::overflow::overflow(
    const fvMesh& mesh,
    const cellExchange& exchange,
    packedHistory& memory,
    entryReader& read
) :
    mesh_(mesh),
    exchange_(exchange),
    memory_(memory),
    squeeze_(read.number(
        "squeeze",
        "beyond 1, what full cells take of what fits nowhere [-]",
        {0, false, 0.1, true},
        0.005
    )),
    F_(mesh.nFaces(), Zero)
{
    for (scalarField* cells : {&room_, &around_, &share_, &excess_, &mass_})
    {
        cells->setSize(mesh_.nCells(), Zero);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::overflow::spill(
    scalarField& m,
    scalarField& alpha,
    const scalar deltaT,
    scalarField& total
)
{
    if (gMax(alpha) < 1 + tolerance) return 0;

    setOpen();
    exchange_.cells(mesh_.V(), 1, VBeyond_);
    scalar spilled = 0;
    for (label pass = 0; pass < nPasses; ++pass)
    {
        const bool first = pass < nFirst;
        if (gMax(alpha) < (first ? 1 + tolerance : 1 + 1.8 * squeeze_))
        {
            break;
        }
        setShares(alpha, first);
        spilled += setFluxes(deltaT, total);
        move(m, alpha);
    }

    return returnReduce(spilled, sumOp<scalar>());
}

// ************************************************************************* //
