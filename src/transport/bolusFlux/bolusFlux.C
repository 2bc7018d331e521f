// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "bolusFlux.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::bolusFlux::takeWhatIsThere(
    const transportZone& z,
    const scalarField& alpha,
    const scalar dt,
    const label left
)
{
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();
    const scalarField& shrunk = memory_.shrunk();

    // Out over given faces until the end, and over others now, of the volume
    for (const label c : z.cells) given_[c] = out_[c] = 0;
    for (const label f : z.given)
    {
        const label D = F_[f] > 0 ? own[f] : f < nInternal ? nei[f] : -1;
        if (D >= 0) given_[D] += mag(F_[f]) * left * dt;
    }
    for (const label f : z.faces)
    {
        const label D = low_[f] > 0 ? own[f] : f < nInternal ? nei[f] : -1;
        if (D >= 0) out_[D] += mag(low_[f]) * dt;
    }
    for (const label c : z.cells)
    {
        const scalar rest =
            max(alpha[c] * step_.Vold(c) - given_[c] * shrunk[c], scalar(0));
        part_[c] = out_[c] > rest ? rest / out_[c] : scalar(1);
    }
    exchange(z, part_, partBeyond_);
    for (const label f : z.faces)
    {
        if (low_[f] > 0)
            low_[f] *= part_[own[f]];
        else if (f < nInternal)
            low_[f] *= part_[nei[f]];
        else if (exchange_.coupled(f))
            low_[f] *= partBeyond_[exchange_.at(f)];
    }
}


void Foam::bolusFlux::setLimits(
    const transportZone& z,
    const scalarField& alpha,
    const scalar dt,
    const label left
)
{
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();
    const scalarField& shrunk = memory_.shrunk();

    // What leaves a cell may not count on what comes in, which may be less
    // compressed. What is given goes on until the end of the coarse sub-step,
    // and is kept in reserve
    for (const label c : z.cells)
    {
        alphaLow_[c] = alphaLeft_[c] = alpha[c] * step_.Vold(c) / step_.V(c);
        Pp_[c] = Pm_[c] = later_[c] = 0;
    }
    for (const label f : z.faces)
    {
        const label P = own[f];
        const scalar VP = step_.V(P);
        alphaLow_[P] -= low_[f] * dt / VP;
        alphaLeft_[P] -= max(low_[f], scalar(0)) * dt / VP;
        (anti_[f] > 0 ? Pm_ : Pp_)[P] += mag(anti_[f]) * dt / VP;
        if (f < nInternal)
        {
            const label N = nei[f];
            const scalar VN = step_.V(N);
            alphaLow_[N] += low_[f] * dt / VN;
            alphaLeft_[N] += min(low_[f], scalar(0)) * dt / VN;
            (anti_[f] > 0 ? Pp_ : Pm_)[N] += mag(anti_[f]) * dt / VN;
        }
    }
    auto take = [&](const label c, const scalar F)
    {
        // Volume of bolus at the cell's compression of now
        const scalar part = F * shrunk[c] * dt / step_.V(c);
        alphaLow_[c] -= part;
        alphaLeft_[c] -= max(part, scalar(0)) * left;
        later_[c] -= part * (left - 1);
    };
    for (const label f : z.given)
    {
        take(own[f], F_[f]);
        if (f < nInternal) take(nei[f], -F_[f]);
    }
    for (const label c : z.cells)
    {
        const scalar room = 1 - alphaLow_[c] - max(later_[c], scalar(0));
        Rp_[c] =
            Pp_[c] > VSMALL ? min(max(room, scalar(0)) / Pp_[c], scalar(1)) : 1;
        Rm_[c] = Pm_[c] > VSMALL
            ? min(max(alphaLeft_[c], scalar(0)) / Pm_[c], scalar(1))
            : 1;
    }
    exchange(z, Rp_, RpBeyond_);
    exchange(z, Rm_, RmBeyond_);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::bolusFlux::bolusFlux(
    const fvMesh& mesh,
    const cellExchange& exchange,
    const stepFlux& step,
    const packedHistory& memory,
    entryReader& read
) :
    mesh_(mesh),
    exchange_(exchange),
    step_(step),
    memory_(memory),
    swept_(mesh, exchange, step, memory, read)
{
    for (
        scalarField* cells :
        {&alphaLow_,
            &alphaLeft_,
            &later_,
            &Pp_,
            &Pm_,
            &Rp_,
            &Rm_,
            &given_,
            &out_,
            &part_}
    )
    {
        cells->setSize(mesh_.nCells(), Zero);
    }
    for (scalarField* faces : {&low_, &anti_, &F_, &total_})
    {
        faces->setSize(mesh_.nFaces(), Zero);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::bolusFlux::upwind(const transportZone& z, const scalarField& alpha)
{
    exchange(z, alpha, alphaBeyond_);
    exchange(z, memory_.rho(), rhoBeyond_);
    for (const label f : z.faces)
    {
        const label D = step_.donor(f);
        F_[f] = 0;
        if (D >= 0)
            F_[f] = step_.flux(f) * alpha[D] * memory_.rho()[D];
        else if (exchange_.coupled(f))
        {
            const label b = exchange_.at(f);
            F_[f] = step_.flux(f) * alphaBeyond_[b] * rhoBeyond_[b];
        }
    }
}


void Foam::bolusFlux::set(
    const transportZone& z,
    const scalarField& alpha,
    const label n,
    const label left
)
{
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();
    const scalar dt = step_.deltaT() / n;

    exchange(z, alpha, alphaBeyond_);
    exchange(z, memory_.rho(), rhoBeyond_);
    swept_.set(z, alpha, alphaBeyond_, dt);

    // Bolus over the faces, by upwinding and beyond it
    for (const label f : z.faces)
    {
        const scalar flux = step_.flux(f);
        low_[f] = flux * (flux > 0 ? alpha[own[f]] : beyond(f, alpha));
    }
    takeWhatIsThere(z, alpha, dt, left);
    for (const label f : z.faces)
    {
        anti_[f] = f < nInternal || exchange_.coupled(f)
            ? step_.flux(f) * swept_[f] - low_[f]
            : 0;
    }
    setLimits(z, alpha, dt, left);

    // Flux of mass: the donor's compression goes with it
    for (const label f : z.faces)
    {
        const label P = own[f];
        const bool internal = f < nInternal;
        const label b = exchange_.coupled(f) ? exchange_.at(f) : -1;
        scalar a = low_[f];
        if (anti_[f] != 0)
        {
            const scalar RpN = internal ? Rp_[nei[f]] : RpBeyond_[b];
            const scalar RmN = internal ? Rm_[nei[f]] : RmBeyond_[b];
            a +=
                anti_[f] * (anti_[f] > 0 ? min(Rm_[P], RpN) : min(Rp_[P], RmN));
        }
        if (a == 0)
        {
            F_[f] = 0;
            continue;
        }
        const label D = step_.donor(f);
        F_[f] = a * (D >= 0 ? memory_.rho()[D] : rhoBeyond_[b]);
        total_[f] += F_[f] / n;
    }
}

// ************************************************************************* //
