// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "historyTransport.H"
#include "leastSquaresVectors.H"

// The memory of the bolus on its way through the mesh: see historyTransport.H

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::historyTransport::gradient(
    const zone& z,
    const scalarField& q,
    const scalarField& qNei,
    vectorField& g
) const
{
    const leastSquaresVectors& ls = leastSquaresVectors::New(mesh_);
    const vectorField& pVec = ls.pVectors().primitiveField();
    const vectorField& nVec = ls.nVectors().primitiveField();
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();

    for (const label c : z.cells) g[c] = vector(Zero);
    auto add = [&](const label f)
    {
        if (!full_[f]) return;
        const label P = own[f];
        if (f < nInternal)
        {
            const scalar d = q[nei[f]] - q[P];
            g[P] += d * pVec[f];
            g[nei[f]] -= d * nVec[f];
        }
        else if (coupled_[f])
        {
            const label b = f - nInternal;
            const label i = f - mesh_.boundary()[patch_[b]].start();
            g[P] +=
                (qNei[b] - q[P]) * ls.pVectors().boundaryField()[patch_[b]][i];
        }
    };
    for (const label f : z.faces) add(f);
    for (const label f : z.given) add(f);
}


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


void Foam::historyTransport::faceValues(
    const zone& z,
    const scalarField& q,
    scalarField& qF
)
{
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();
    const scalarField qNei(neighbour(z, q));

    gradient(z, q, qNei, g_);
    const vectorField gNei(neighbour(z, g_));

    // The slope may not count on values that no neighbour has
    for (const label c : z.cells) least_[c] = most_[c] = q[c];
    auto see = [&](const label f)
    {
        if (!full_[f]) return;
        const label P = own[f];
        const bool internal = f < nInternal;
        const scalar qN = internal ? q[nei[f]] : qNei[f - nInternal];
        least_[P] = min(least_[P], qN);
        most_[P] = max(most_[P], qN);
        if (internal)
        {
            const label N = nei[f];
            least_[N] = min(least_[N], q[P]);
            most_[N] = max(most_[N], q[P]);
        }
    };
    for (const label f : z.faces) see(f);
    for (const label f : z.given) see(f);
    const scalarField leastNei(neighbour(z, least_));
    const scalarField mostNei(neighbour(z, most_));
    const scalarField staysNei(neighbour(z, stays_));

    // What an open boundary lets in has no memory
    auto at = [&](const scalarField& cells, const scalarField& beyond, label f)
    {
        return f < nInternal ? cells[nei[f]]
            : coupled_[f]    ? beyond[f - nInternal]
                             : scalar(0);
    };

    for (const label f : z.faces)
    {
        const label P = own[f];
        const bool forward = F_[f] > 0;
        const scalar qN = at(q, qNei, f);
        const scalar qD = forward ? q[P] : qN;
        qF[f] = qD;
        if (F_[f] == 0 || !full_[f]) continue;

        const vector& gD = forward ? g_[P]
            : f < nInternal        ? g_[nei[f]]
                                   : gNei[f - nInternal];

        // Differences on the downwind side and, from the gradient, upwind
        const scalar sign = forward ? 1 : -1;
        const scalar down = sign * (qN - q[P]);
        const scalar up = 2 * sign * (gD & delta_[f]) - down;
        if (up * down <= 0) continue;

        // What leaves with more than the cell's value, leaves the rest with
        // less: no less than a neighbour has
        const scalar room = down > 0
            ? qD - (forward ? least_[P] : at(least_, leastNei, f))
            : (forward ? most_[P] : at(most_, mostNei, f)) - qD;
        const scalar rest = forward ? stays_[P] : at(stays_, staysNei, f);
        const scalar bound = room * min(rest / max(1 - rest, SMALL), scalar(1));
        const scalar slope =
            min(min(mag(up + 2 * down) / 3, 2 * mag(up)),
                2 * min(mag(down), bound));
        qF[f] += 0.5 * (down > 0 ? slope : -slope);
    }
}


void Foam::historyTransport::moveMemory(
    const zone& z,
    const scalar dt,
    scalarField& q,
    const scalarField& qF
)
{
    const scalarField& V = mesh_.V();
    for (const label c : z.cells) carried_[c] = massOld_[c] * q[c];
    for (const label f : z.faces) amount_[f] = F_[f] * qF[f];
    for (const label f : z.given) amount_[f] = F_[f] * qF[f];
    balance(z, dt, amount_, carried_);
    for (const label c : z.moved)
    {
        q[c] = massNew_[c] > 1e-12 * V[c] ? carried_[c] / massNew_[c] : 0;
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
    for (const label d : used_)
    {
        scalarField& q = q_[d];
        scalarField& qF = qF_[d];
        faceValues(z, q, qF);
        const scalarField before(q, z.moved);
        moveMemory(z, dt, q, qF);
        faceValues(z, q, second_);
        UIndirectList<scalar>(q, z.moved) = before;
        for (const label f : z.faces)
        {
            if (heun_[f]) qF[f] = 0.5 * (qF[f] + second_[f]);
        }
    }
}


void Foam::historyTransport::follow(const zone& z, const label fine)
{
    const label nInternal = mesh_.nInternalFaces();
    for (const label d : used_)
    {
        const scalarField& q = q_[d];
        const scalarField qNei(neighbour(z, q));
        for (const label f : z.led)
        {
            const bool forward = flux_[f] > 0;
            const scalar qD = forward ? q[mesh_.faceOwner()[f]]
                : f < nInternal       ? q[mesh_.faceNeighbour()[f]]
                                      : qNei[f - nInternal];
            qF_[d][f] = qD;
            mean_[d][f] += qD / fine;
        }
    }
}


void Foam::historyTransport::setMean(const zone& z)
{
    for (const label d : used_)
    {
        for (const label f : z.led)
        {
            qF_[d][f] = mean_[d][f];
            mean_[d][f] = 0;
        }
    }
}

// ************************************************************************* //
