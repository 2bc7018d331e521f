// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "historyTransport.H"
#include "leastSquaresVectors.H"

// The memory of the bolus on its way through the mesh: see historyTransport.H

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::historyTransport::gradient(
    const scalarField& q,
    const scalarField& qNei,
    const boolList& use,
    vectorField& g
) const
{
    const leastSquaresVectors& ls = leastSquaresVectors::New(mesh_);
    const surfaceVectorField& pVec = ls.pVectors();
    const surfaceVectorField& nVec = ls.nVectors();
    const labelUList& own = mesh_.owner();
    const labelUList& nei = mesh_.neighbour();

    g = vector(Zero);
    forAll(nei, f)
    {
        if (!use[f]) continue;
        const scalar d = q[nei[f]] - q[own[f]];
        g[own[f]] += d * pVec[f];
        g[nei[f]] -= d * nVec[f];
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        if (!patch.coupled()) continue;
        forAll(patch, i)
        {
            const label f = patch.start() + i;
            if (!use[f]) continue;
            const label c = patch.faceCells()[i];
            g[c] += (qNei[f - mesh_.nInternalFaces()] - q[c])
                * pVec.boundaryField()[patchi][i];
        }
    }
}


void Foam::historyTransport::faceValues(
    const scalarField& q,
    const scalarField& F,
    const vectorField& delta,
    const boolList& full,
    const scalarField& stays,
    scalarField& qF
) const
{
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();
    const scalarField qNei(neighbour(q));

    vectorField g(q.size());
    gradient(q, qNei, full, g);
    const scalarField gx(neighbour(g.component(0)));
    const scalarField gy(neighbour(g.component(1)));
    const scalarField gz(neighbour(g.component(2)));

    // The slope may not count on values that no neighbour has
    scalarField least(q);
    scalarField most(q);
    forAll(full, f)
    {
        if (!full[f]) continue;
        const label P = own[f];
        const bool internal = f < nInternal;
        const scalar qN = internal ? q[nei[f]] : qNei[f - nInternal];
        least[P] = min(least[P], qN);
        most[P] = max(most[P], qN);
        if (internal)
        {
            least[nei[f]] = min(least[nei[f]], q[P]);
            most[nei[f]] = max(most[nei[f]], q[P]);
        }
    }
    const scalarField leastNei(neighbour(least));
    const scalarField mostNei(neighbour(most));
    const scalarField staysNei(neighbour(stays));

    // What an open boundary lets in has no memory
    auto at = [&](const scalarField& cells, const scalarField& beyond, label f)
    {
        return f < nInternal ? cells[nei[f]]
            : mesh_.boundary()[patch_[f - nInternal]].coupled()
            ? beyond[f - nInternal]
            : scalar(0);
    };

    forAll(F, f)
    {
        const label P = own[f];
        const bool forward = F[f] > 0;
        const scalar qN = at(q, qNei, f);
        const scalar qD = forward ? q[P] : qN;
        qF[f] = qD;
        if (F[f] == 0 || !full[f]) continue;

        const label b = f - nInternal;
        const vector gD = forward ? g[P]
            : f < nInternal       ? g[nei[f]]
                                  : vector(gx[b], gy[b], gz[b]);

        // Differences on the downwind side and, from the gradient, upwind
        const scalar sign = forward ? 1 : -1;
        const scalar down = sign * (qN - q[P]);
        const scalar up = 2 * sign * (gD & delta[f]) - down;
        if (up * down <= 0) continue;

        // What leaves with more than the cell's value, leaves the rest with
        // less: no less than a neighbour has
        const scalar room = down > 0
            ? qD - (forward ? least[P] : at(least, leastNei, f))
            : (forward ? most[P] : at(most, mostNei, f)) - qD;
        const scalar rest = forward ? stays[P] : at(stays, staysNei, f);
        const scalar bound = room * min(rest / max(1 - rest, SMALL), scalar(1));
        const scalar slope =
            min(min(mag(up + 2 * down) / 3, 2 * mag(up)),
                2 * min(mag(down), bound));
        qF[f] += 0.5 * (down > 0 ? slope : -slope);
    }
}


void Foam::historyTransport::moveMemory(
    const scalarField& F,
    const scalar dt,
    const scalarField& massOld,
    const scalarField& massNew,
    const vectorField& delta,
    const boolList& full
)
{
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();

    auto move = [&](const scalarField& q, const scalarField& qF)
    {
        scalarField result(massOld * q);
        forAll(F, f)
        {
            const scalar amount = F[f] * qF[f] * dt;
            result[own[f]] -= amount;
            if (f < nInternal) result[nei[f]] += amount;
        }
        forAll(result, c)
        {
            result[c] =
                massNew[c] > 1e-12 * mesh_.V()[c] ? result[c] / massNew[c] : 0;
        }
        return result;
    };

    // Part of a cell's mass that stays in it
    scalarField stays(massOld.size(), Zero);
    forAll(F, f)
    {
        if (F[f] > 0)
            stays[own[f]] += F[f] * dt;
        else if (f < nInternal)
            stays[nei[f]] -= F[f] * dt;
    }
    forAll(stays, c)
    {
        const scalar all = max(massOld[c], 1e-12 * mesh_.V()[c]);
        stays[c] = max(1 - stays[c] / all, scalar(0));
    }

    // Heun: faces at the start, and once more with what comes of that; not
    // where a cell empties, whose rest would take the difference alone
    const scalarField staysNei(neighbour(stays));
    boolList heun(full);
    forAll(heun, f)
    {
        const scalar beyond =
            f < nInternal ? stays[nei[f]] : staysNei[f - nInternal];
        heun[f] = full[f] && min(stays[own[f]], beyond) > 0.5;
    }
    scalarField first(F.size());
    scalarField second(F.size());
    for (scalarField& q : q_)
    {
        faceValues(q, F, delta, full, stays, first);
        faceValues(move(q, first), F, delta, full, stays, second);
        forAll(first, f)
        {
            if (heun[f]) first[f] = 0.5 * (first[f] + second[f]);
        }
        q = move(q, first);
    }
}

// ************************************************************************* //
