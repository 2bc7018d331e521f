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


void Foam::overflow::setCells(const scalarField& alpha, const scalar fullest)
{
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();

    for (const label f : faces_) isFace_[f] = false;
    for (const label c : cells_) isCell_[c] = false;
    full_.clear();
    faces_.clear();
    cells_.clear();
    auto add = [&](const label f)
    {
        if (!open_[f] || isFace_[f]) return;
        isFace_[f] = true;
        faces_.append(f);
    };
    auto touch = [&](const label c)
    {
        if (isCell_[c]) return;
        isCell_[c] = true;
        cells_.append(c);
    };
    forAll(alpha, c)
    {
        if (alpha[c] <= fullest) continue;
        full_.append(c);
        for (const label f : mesh_.cells()[c]) add(f);
    }
    // The cell beyond may be too full
    for (const label f : exchange_.faces()) add(f);
    for (const label f : faces_)
    {
        touch(own[f]);
        if (f < nInternal) touch(nei[f]);
    }
}


Foam::scalar Foam::overflow::room(
    const label facei,
    const label celli,
    const scalarField& alpha
) const
{
    const bool internal = facei < mesh_.nInternalFaces();
    const label b = internal ? -1 : exchange_.at(facei);
    const label own = mesh_.faceOwner()[facei];
    const label other = !internal ? -1
        : own == celli            ? mesh_.faceNeighbour()[facei]
                                  : own;
    return internal ? max(1 - alpha[other], scalar(0)) * mesh_.V()[other]
                    : max(1 - alphaBeyond_[b], scalar(0)) * VBeyond_[b];
}


void Foam::overflow::setShares(const scalarField& alpha, const bool first)
{
    const scalarField& V = mesh_.V();
    exchange_.cells(alpha, 1, alphaBeyond_);
    for (const label c : full_)
    {
        if (!first)
        {
            excess_[c] = alpha[c] - (1 + overshootTolerance_);
            continue;
        }
        // In proportion to the room around; half of it at most, because other
        // cells may want it too
        scalar around = 0;
        for (const label f : mesh_.cells()[c])
        {
            if (open_[f]) around += room(f, c, alpha);
        }
        if (around > VSMALL)
        {
            share_[c] = min((alpha[c] - 1) * V[c] / around, scalar(0.5));
        }
    }
    exchange_.cells(share_, 1, shareBeyond_);
    exchange_.cells(excess_, 1, excessBeyond_);
}


Foam::scalar Foam::overflow::setFluxes(
    const scalarField& alpha,
    const scalar deltaT,
    scalarField& total
)
{
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const scalarField& V = mesh_.V();
    const scalarField& rho = memory_.rho();

    // Mass over the faces, with the density of where it comes from
    exchange_.cells(rho, 1, rhoBeyond_);
    scalar passed = 0;
    for (const label f : faces_)
    {
        const label P = own[f];
        const bool internal = f < nInternal;
        const label b = internal ? -1 : exchange_.at(f);
        const label N = internal ? mesh_.faceNeighbour()[f] : -1;
        const scalar rhoN = internal ? rho[N] : rhoBeyond_[b];
        const scalar roomP = max(1 - alpha[P], scalar(0)) * V[P];
        F_[f] = share_[P] * rho[P] * room(f, P, alpha)
            - (internal ? share_[N] : shareBeyond_[b]) * rhoN * roomP;

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
    for (const label c : full_) share_[c] = excess_[c] = 0;
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
    for (const label c : cells_)
    {
        mass_[c] = m[c] * V[c];
        for (label i = c * n; i < (c + 1) * n; ++i)
        {
            carried_[i] = mass_[c] * q[i];
        }
    }
    for (const label f : faces_)
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
    for (const label c : cells_)
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
    overshootTolerance_(read.number(
        "overshootTolerance",
        "beyond 1, what full cells take of what fits nowhere [-]",
        {0, false, 0.1, true},
        0.005
    )),
    isFace_(mesh.nFaces(), false),
    isCell_(mesh.nCells(), false),
    share_(mesh.nCells(), Zero),
    excess_(mesh.nCells(), Zero),
    F_(mesh.nFaces(), Zero),
    mass_(mesh.nCells(), Zero)
{}


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
        if (gMax(alpha)
            < (first ? 1 + tolerance : 1 + 1.8 * overshootTolerance_))
        {
            break;
        }
        setCells(alpha, 1 + (first ? 0.1 * tolerance : overshootTolerance_));
        setShares(alpha, first);
        spilled += setFluxes(alpha, deltaT, total);
        move(m, alpha);
    }

    return returnReduce(spilled, sumOp<scalar>());
}

// ************************************************************************* //
