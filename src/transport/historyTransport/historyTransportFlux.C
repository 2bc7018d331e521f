// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "historyTransport.H"
#include "planarInterface.H"
#include "nodalSpace.H"
#include "syncTools.H"

// Bolus over the faces in one sub-step: see historyTransport.H

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::historyTransport::setSwept(
    const zone& z,
    const scalarField& alphaNei,
    const scalar dt
)
{
    const label nInternal = mesh_.nInternalFaces();
    const scalarField& alpha = state_.alpha.primitiveField();

    auto extent = [&](const label c, const vector& dir)
    { return nodalSpace::extent(mesh_, mesh_.points(), c, dir); };

    // By the processor of the donor cell, which tells the other one
    for (const label f : z.faces)
    {
        const bool internal = f < nInternal;
        const bool forward = flux_[f] > 0;
        if (!internal && !(coupled_[f] && forward)) continue;
        const label P = mesh_.faceOwner()[f];
        const label D = forward ? P : mesh_.faceNeighbour()[f];
        swept_[f] = alpha[D];
        if (alpha[D] < 1e-9 || alpha[D] > 1 - 1e-9 || flux_[f] == 0) continue;

        const vector e =
            (forward ? 1 : -1) / max(mag(delta_[f]), VSMALL) * delta_[f];
        const vector g(
            gradient_[3 * D], gradient_[3 * D + 1], gradient_[3 * D + 2]
        );
        const vector tangential = g - (g & e) * e;
        const scalar steep = mag(tangential);
        const scalar along = (g & e) * extent(D, e);
        const scalar across =
            steep > VSMALL ? steep * extent(D, tangential / steep) : 0;
        swept_[f] = planarInterface::swept(
            alpha[D],
            along,
            across,
            min(mag(flux_[f]) * (dt / Vold_[D]), scalar(1))
        );

        // Where alpha varies but little there is no interface, and broken
        // bolus is a heap of crumbs, not a body with a surface: there nothing
        // may become steeper than it is
        const scalar aA = !internal ? alphaNei[f - nInternal]
            : forward               ? alpha[mesh_.faceNeighbour()[f]]
                                    : alpha[P];
        const scalar within =
            min(max(swept_[f], min(alpha[D], aA)), max(alpha[D], aA));
        const scalar broken =
            damage_ < 0 ? scalar(0) : memory_[D * n_ + damage_];
        const scalar sound = min(max(1 - broken, scalar(0)), scalar(1));
        const scalar sharp =
            sound * min((mag(along) + across) / interfaceJump_, scalar(1));
        swept_[f] = sharp * swept_[f] + (1 - sharp) * within;
    }

    if (!z.shared) return;
    SubList<scalar> here(swept_, mesh_.nFaces() - nInternal, nInternal);
    scalarField there(here);
    syncTools::swapBoundaryFaceList(mesh_, there);
    for (const label f : z.faces)
    {
        const label b = f - nInternal;
        if (b >= 0 && flux_[f] <= 0) here[b] = there[b];
    }
}


void Foam::historyTransport::upwind(const zone& z)
{
    const label nInternal = mesh_.nInternalFaces();
    const scalarField& alpha = state_.alpha.primitiveField();
    const scalarField alphaNei(neighbour(z, alpha));
    const scalarField pNei(neighbour(z, memory_, n_));
    for (const label f : z.faces)
    {
        const label D = flux_[f] > 0 ? mesh_.faceOwner()[f]
            : f < nInternal          ? mesh_.faceNeighbour()[f]
                                     : -1;
        const label b = f - nInternal;
        // Through an open boundary void comes in
        const bool bolus = D >= 0 || coupled_[f];
        a_[f] =
            bolus ? flux_[f] * (D >= 0 ? alpha[D] : alphaNei[b]) : scalar(0);
        F_[f] = bolus ? a_[f] * std::exp((D >= 0 ? p(D) : pNei[b]) / K_)
                      : scalar(0);
    }
}


void Foam::historyTransport::takeWhatIsThere(
    const zone& z,
    const scalar dt,
    const label left
)
{
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();
    const scalarField& alpha = state_.alpha.primitiveField();

    // Out over given faces until the end, and over others now, of the volume
    scalarField& given = given_;
    scalarField& now = stays_;
    scalarField& part = calm_;
    for (const label c : z.cells) given[c] = now[c] = 0;
    for (const label f : z.given)
    {
        const label D = F_[f] > 0 ? own[f] : f < nInternal ? nei[f] : -1;
        if (D >= 0) given[D] += mag(F_[f]) * left * dt;
    }
    for (const label f : z.faces)
    {
        const label D = low_[f] > 0 ? own[f] : f < nInternal ? nei[f] : -1;
        if (D >= 0) now[D] += mag(low_[f]) * dt;
    }
    for (const label c : z.cells)
    {
        const scalar rest =
            max(alpha[c] * Vold_[c] - given[c] * std::exp(-p(c) / K_),
                scalar(0));
        part[c] = now[c] > rest ? rest / now[c] : scalar(1);
    }
    const scalarField partNei(neighbour(z, part));
    for (const label f : z.faces)
    {
        if (low_[f] > 0)
            low_[f] *= part[own[f]];
        else if (f < nInternal)
            low_[f] *= part[nei[f]];
        else if (coupled_[f])
            low_[f] *= partNei[f - nInternal];
    }
}


void Foam::historyTransport::setBolusFlux(
    const zone& z,
    const label sub,
    const label n,
    const label left
)
{
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();
    const scalarField& alpha = state_.alpha.primitiveField();
    const scalar dt = deltaT_ / n;

    setVolumes(z, sub, n);
    const scalarField alphaNei(neighbour(z, alpha));
    const scalarField pNei(neighbour(z, memory_, n_));
    // Bolus beyond the face: through an open boundary void comes in
    auto beyond = [&](const label f)
    {
        return f < nInternal ? alpha[nei[f]]
            : coupled_[f]    ? alphaNei[f - nInternal]
                             : scalar(0);
    };

    for (const label f : z.faces) full_[f] = true;
    for (const label f : z.given) full_[f] = true;
    gradient(z, alpha, 1, [&](const label b) { return &alphaNei[b]; });
    setSwept(z, alphaNei, dt);

    // Bolus over the faces, by upwinding and beyond it
    for (const label f : z.faces)
    {
        low_[f] = flux_[f] * (flux_[f] > 0 ? alpha[own[f]] : beyond(f));
    }
    takeWhatIsThere(z, dt, left);
    for (const label f : z.faces)
    {
        anti_[f] =
            f < nInternal || coupled_[f] ? flux_[f] * swept_[f] - low_[f] : 0;
    }

    // Limit what goes beyond upwinding. What leaves a cell may not count on
    // what comes in, which may be less compressed. What is given goes on until
    // the end of the coarse sub-step, and is kept in reserve
    for (const label c : z.cells)
    {
        alphaLow_[c] = alphaLeft_[c] = alpha[c] * Vold_[c] / V_[c];
        Pp_[c] = Pm_[c] = later_[c] = 0;
    }
    for (const label f : z.faces)
    {
        const label P = own[f];
        alphaLow_[P] -= low_[f] * dt / V_[P];
        alphaLeft_[P] -= max(low_[f], scalar(0)) * dt / V_[P];
        (anti_[f] > 0 ? Pm_ : Pp_)[P] += mag(anti_[f]) * dt / V_[P];
        if (f < nInternal)
        {
            const label N = nei[f];
            alphaLow_[N] += low_[f] * dt / V_[N];
            alphaLeft_[N] += min(low_[f], scalar(0)) * dt / V_[N];
            (anti_[f] > 0 ? Pp_ : Pm_)[N] += mag(anti_[f]) * dt / V_[N];
        }
    }
    auto take = [&](const label c, const scalar F)
    {
        // Volume of bolus at the cell's compression of now
        const scalar part = F * std::exp(-p(c) / K_) * dt / V_[c];
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
    const scalarField RpNei(neighbour(z, Rp_));
    const scalarField RmNei(neighbour(z, Rm_));

    // Flux of mass: the donor's compression goes with it
    for (const label f : z.faces)
    {
        const label P = own[f];
        const bool internal = f < nInternal;
        const label b = f - nInternal;
        a_[f] = low_[f];
        if (anti_[f] != 0)
        {
            const scalar RpN = internal ? Rp_[nei[f]] : RpNei[b];
            const scalar RmN = internal ? Rm_[nei[f]] : RmNei[b];
            a_[f] +=
                anti_[f] * (anti_[f] > 0 ? min(Rm_[P], RpN) : min(Rp_[P], RmN));
        }
        if (a_[f] == 0)
        {
            F_[f] = 0;
            continue;
        }
        const scalar pD = flux_[f] > 0 ? p(P) : internal ? p(nei[f]) : pNei[b];
        F_[f] = a_[f] * std::exp(pD / K_);
        total_[f] += F_[f] / n;
    }

    // Memory is interpolated only between cells with bolus
    for (const label f : z.faces)
    {
        full_[f] = min(alpha[own[f]], beyond(f)) > memoryAbove_;
    }
    for (const label f : z.given)
    {
        full_[f] = min(alpha[own[f]], beyond(f)) > memoryAbove_;
    }
}


void Foam::historyTransport::setVolumes(
    const zone& z,
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


void Foam::historyTransport::setMasses(const zone& z, const scalar dt)
{
    const scalarField& m = state_.mass.primitiveField();
    for (const label c : z.cells) massOld_[c] = massNew_[c] = m[c] * Vold_[c];
    balance(z, dt, F_, massNew_);
}


void Foam::historyTransport::move(const zone& z, const label sub, const label n)
{
    scalarField& m = state_.mass.primitiveFieldRef();
    scalarField& alpha = state_.alpha.primitiveFieldRef();
    const scalar dt = deltaT_ / n;

    // Those of z may be others by now
    setVolumes(z, sub, n);
    setMasses(z, dt);
    moveMemory(z, dt, memoryF_);
    for (const label c : z.moved)
    {
        m[c] = massNew_[c] / V_[c];
        alpha[c] = m[c] * std::exp(-p(c) / K_);
    }
}

// ************************************************************************* //
