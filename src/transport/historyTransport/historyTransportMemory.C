// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "historyTransport.H"

// The memory of the bolus on its way through the mesh: see historyTransport.H

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::historyTransport::balance(
    const zone& z,
    const scalar dt,
    const scalarField& amount,
    scalarField& cells
) const
{
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();
    auto add = [&](const label f)
    {
        cells[own[f]] -= amount[f] * dt;
        if (f < nInternal) cells[nei[f]] += amount[f] * dt;
    };
    for (const label f : z.faces) add(f);
    for (const label f : z.given) add(f);
}


void Foam::historyTransport::faceValues(const zone& z, scalarField& faces)
{
    const label n = n_;
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();

    // Of a cell, or beyond a boundary face
    auto of = [n](const scalarField& cells, const label c)
    { return &cells[c * n]; };
    auto beyond = [&](const scalarField& values, const label b)
    { return &values[coupledPlace_[b] * n]; };

    exchange(z, memory_, n, memoryNei_);
    gradient(
        z, memory_, n, [&](const label b) { return beyond(memoryNei_, b); }
    );
    exchange(z, gradient_, 3 * n, gradientNei_);

    // The slope may not count on values that no neighbour has
    for (const label c : z.cells)
    {
        for (label i = c * n; i < (c + 1) * n; ++i)
        {
            least_[i] = most_[i] = memory_[i];
        }
    }
    auto see = [&](const label f)
    {
        if (!full_[f]) return;
        const bool internal = f < nInternal;
        const scalar* qP = of(memory_, own[f]);
        const scalar* qN =
            internal ? of(memory_, nei[f]) : beyond(memoryNei_, f - nInternal);
        scalar* least = &least_[own[f] * n];
        scalar* most = &most_[own[f] * n];
        for (label k = 0; k < n; ++k)
        {
            least[k] = min(least[k], qN[k]);
            most[k] = max(most[k], qN[k]);
        }
        if (!internal) return;
        least = &least_[nei[f] * n];
        most = &most_[nei[f] * n];
        for (label k = 0; k < n; ++k)
        {
            least[k] = min(least[k], qP[k]);
            most[k] = max(most[k], qP[k]);
        }
    };
    for (const label f : z.faces) see(f);
    for (const label f : z.given) see(f);
    exchange(z, least_, n, leastNei_);
    exchange(z, most_, n, mostNei_);

    for (const label f : z.faces)
    {
        const label P = own[f];
        const bool internal = f < nInternal;
        const label b = f - nInternal;
        const bool forward = F_[f] > 0;
        scalar* qF = &faces[f * n];

        // What an open boundary lets in has no memory
        if (!forward && !internal && !coupled_[f])
        {
            for (label k = 0; k < n; ++k) qF[k] = 0;
            continue;
        }
        const scalar* qP = of(memory_, P);
        const scalar* qN = internal ? of(memory_, nei[f])
            : coupled_[f]           ? beyond(memoryNei_, b)
                                    : nullptr;
        const scalar* qD = forward ? qP : qN;
        if (F_[f] == 0 || !full_[f])
        {
            for (label k = 0; k < n; ++k) qF[k] = qD[k];
            continue;
        }

        // Of the donor
        auto donor = [&](const scalarField& cells,
                         const scalarField& others,
                         const label width)
        {
            return forward ? &cells[P * width]
                : internal ? &cells[nei[f] * width]
                           : &others[coupledPlace_[b] * width];
        };
        const scalar* gD = donor(gradient_, gradientNei_, 3 * n);
        const scalar* least = donor(least_, leastNei_, n);
        const scalar* most = donor(most_, mostNei_, n);
        const scalar rest = *donor(stays_, staysNei_, 1);
        const scalar part = min(rest / max(1 - rest, SMALL), scalar(1));
        const vector& d = delta_[f];
        const scalar sign = forward ? 1 : -1;

        for (label k = 0; k < n; ++k)
        {
            qF[k] = qD[k];

            // Differences on the downwind side and, from the gradient, upwind
            const scalar along =
                gD[k] * d.x() + gD[n + k] * d.y() + gD[2 * n + k] * d.z();
            const scalar down = sign * (qN[k] - qP[k]);
            const scalar up = 2 * sign * along - down;
            if (up * down <= 0) continue;

            // What leaves with more than the cell's value, leaves the rest
            // with less: no less than a neighbour has
            const scalar room = down > 0 ? qD[k] - least[k] : most[k] - qD[k];
            const scalar slope =
                min(min(mag(up + 2 * down) / 3, 2 * mag(up)),
                    2 * min(mag(down), room * part));
            qF[k] += 0.5 * (down > 0 ? slope : -slope);
        }
    }
}


void Foam::historyTransport::moveMemory(
    const zone& z,
    const scalar dt,
    const scalarField& faces
)
{
    const label n = n_;
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();
    const scalarField& V = mesh_.V();

    for (const label c : z.cells)
    {
        for (label i = c * n; i < (c + 1) * n; ++i)
        {
            carried_[i] = massOld_[c] * memory_[i];
        }
    }
    auto carry = [&](const label f)
    {
        const scalar F = F_[f];
        const scalar* qF = &faces[f * n];
        scalar* from = &carried_[own[f] * n];
        for (label k = 0; k < n; ++k) from[k] -= F * qF[k] * dt;
        if (f >= nInternal) return;
        scalar* to = &carried_[nei[f] * n];
        for (label k = 0; k < n; ++k) to[k] += F * qF[k] * dt;
    };
    for (const label f : z.faces) carry(f);
    for (const label f : z.given) carry(f);
    for (const label c : z.moved)
    {
        const bool empty = massNew_[c] <= 1e-12 * V[c];
        for (label i = c * n; i < (c + 1) * n; ++i)
        {
            memory_[i] = empty ? 0 : carried_[i] / massNew_[c];
        }
    }
}


void Foam::historyTransport::setMemoryFlux(const zone& z, const scalar dt)
{
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();
    const scalarField& V = mesh_.V();

    setMasses(z, dt);

    // Part of a cell's mass that stays in it
    for (const label c : z.cells) stays_[c] = 0;
    auto leave = [&](const label f)
    {
        if (F_[f] > 0)
            stays_[own[f]] += F_[f] * dt;
        else if (f < nInternal)
            stays_[nei[f]] -= F_[f] * dt;
    };
    for (const label f : z.faces) leave(f);
    for (const label f : z.given) leave(f);
    for (const label c : z.cells)
    {
        const scalar all = max(massOld_[c], 1e-12 * V[c]);
        stays_[c] = max(1 - stays_[c] / all, scalar(0));
    }

    // Heun: faces at the start, and once more with what comes of that; not
    // where a cell empties, whose rest would take the difference alone, nor
    // where a cell is not moved now
    for (const label c : z.cells) calm_[c] = 0;
    for (const label c : z.moved) calm_[c] = stays_[c];
    const scalarField calmNei(neighbour(z, calm_));
    for (const label f : z.faces)
    {
        heun_[f] = full_[f]
            && min(calm_[own[f]],
                   f < nInternal ? calm_[nei[f]] : calmNei[f - nInternal])
                > 0.5;
    }
    exchange(z, stays_, 1, staysNei_);

    const label n = n_;
    faceValues(z, memoryF_);
    auto copy = [&](const scalarField& from, scalarField& to)
    {
        for (const label c : z.moved)
        {
            for (label i = c * n; i < (c + 1) * n; ++i) to[i] = from[i];
        }
    };
    copy(memory_, start_);
    moveMemory(z, dt, memoryF_);
    faceValues(z, second_);
    copy(start_, memory_);
    for (const label f : z.faces)
    {
        if (!heun_[f]) continue;
        for (label i = f * n; i < (f + 1) * n; ++i)
        {
            memoryF_[i] = 0.5 * (memoryF_[i] + second_[i]);
        }
    }
}


void Foam::historyTransport::follow(const zone& z, const label fine)
{
    const label n = n_;
    const label nInternal = mesh_.nInternalFaces();
    exchange(z, memory_, n, memoryNei_);
    for (const label f : z.led)
    {
        const bool forward = flux_[f] > 0;
        const scalar* qD = forward ? &memory_[mesh_.faceOwner()[f] * n]
            : f < nInternal ? &memory_[mesh_.faceNeighbour()[f] * n]
                            : &memoryNei_[coupledPlace_[f - nInternal] * n];
        for (label k = 0; k < n; ++k)
        {
            memoryF_[f * n + k] = qD[k];
            mean_[f * n + k] += qD[k] / fine;
        }
    }
}


void Foam::historyTransport::setMean(const zone& z)
{
    for (const label f : z.led)
    {
        for (label i = f * n_; i < (f + 1) * n_; ++i)
        {
            memoryF_[i] = mean_[i];
            mean_[i] = 0;
        }
    }
}

// ************************************************************************* //
