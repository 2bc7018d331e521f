// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "historyTransport.H"
#include "labelIOList.H"

// Bolus that has no room where it came to: see historyTransport.H

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::historyTransport::spill()
{
    // First to where there is room; where the bolus around is full, it takes
    // a little more than fits
    const label nFirst = 5;
    const label nPasses = 100;
    const scalar tolerance = 1e-4;
    const scalar squeezed = 1 + squeeze_;
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const scalarField& V = mesh_.V();
    const scalarField VNei(neighbour(V));
    scalarField& m = state_.mass.primitiveFieldRef();
    scalarField& alpha = state_.alpha.primitiveFieldRef();

    if (gMax(alpha) < 1 + tolerance) return 0;

    // Faces that let something pass
    boolList open(coupled_);
    for (label f = 0; f < nInternal; ++f) open[f] = true;
    if (mesh_.foundObject<labelIOList>("closedPoints"))
    {
        boolList closed(mesh_.nPoints(), false);
        for (const label p : mesh_.lookupObject<labelIOList>("closedPoints"))
        {
            closed[p] = true;
        }
        forAll(open, f)
        {
            bool all = true;
            for (const label p : mesh_.faces()[f]) all = all && closed[p];
            if (all) open[f] = false;
        }
    }

    scalar spilled = 0;
    for (label pass = 0; pass < nPasses; ++pass)
    {
        const bool first = pass < nFirst;
        if (gMax(alpha) < (first ? 1 + tolerance : 1 + 1.8 * squeeze_))
        {
            break;
        }

        // Room of the cells; excess goes where there is room, in proportion
        scalarField room(V.size());
        forAll(room, c) room[c] = max(1 - alpha[c], scalar(0)) * V[c];
        const scalarField roomNei(neighbour(room));

        scalarField around(V.size(), Zero);
        forAll(own, f)
        {
            if (!open[f]) continue;
            if (f < nInternal)
            {
                const label N = mesh_.faceNeighbour()[f];
                around[own[f]] += room[N];
                around[N] += room[own[f]];
            }
            else
            {
                around[own[f]] += roomNei[f - nInternal];
            }
        }

        // Part of the cell's excess per volume of room; half of the room at
        // most, because other cells may want it too
        scalarField share(V.size(), Zero);
        scalarField excess(V.size(), Zero);
        forAll(share, c)
        {
            const scalar e = alpha[c] - 1;
            if (first && e > 0.1 * tolerance && around[c] > VSMALL)
            {
                share[c] = min(e * V[c] / around[c], scalar(0.5));
            }
            if (!first) excess[c] = max(alpha[c] - squeezed, scalar(0));
        }
        const scalarField shareNei(neighbour(share));
        const scalarField excessNei(neighbour(excess));

        // Mass over the faces, with the density of where it comes from
        scalarField rho(V.size());
        forAll(rho, c) rho[c] = std::exp(p(c) / K_);
        const scalarField rhoNei(neighbour(rho));
        scalarField F(own.size(), Zero);
        forAll(own, f)
        {
            if (!open[f]) continue;
            const label P = own[f];
            const bool internal = f < nInternal;
            const label b = f - nInternal;
            const label N = internal ? mesh_.faceNeighbour()[f] : -1;
            const scalar rhoN = internal ? rho[N] : rhoNei[b];
            F[f] = share[P] * rho[P] * (internal ? room[N] : roomNei[b])
                - (internal ? share[N] : shareNei[b]) * rhoN * room[P];

            // What is beyond "squeezed" levels out, a twelfth a face: stable
            // with up to six faces
            const scalar level =
                excess[P] - (internal ? excess[N] : excessNei[b]);
            F[f] += level * min(V[P], internal ? V[N] : VNei[b]) / 12
                * (level > 0 ? rho[P] : rhoN);

            if (F[f] > 0)
                spilled += F[f];
            else if (internal)
                spilled -= F[f];
            total_[f] += F[f] / deltaT_;
        }

        scalarField mNew(m * V);
        forAll(F, f)
        {
            mNew[own[f]] -= F[f];
            if (f < nInternal) mNew[mesh_.faceNeighbour()[f]] += F[f];
        }
        for (label k = 0; k < n_; ++k)
        {
            scalarField q(V.size());
            forAll(q, c) q[c] = memory_[c * n_ + k];
            const scalarField qNei(neighbour(q));
            scalarField mq(m * V * q);
            forAll(F, f)
            {
                if (F[f] == 0) continue;
                const bool internal = f < nInternal;
                const label N = internal ? mesh_.faceNeighbour()[f] : -1;
                const scalar qF = F[f] > 0 ? q[own[f]]
                    : internal             ? q[N]
                                           : qNei[f - nInternal];
                mq[own[f]] -= F[f] * qF;
                if (internal) mq[N] += F[f] * qF;
            }
            forAll(q, c)
            {
                memory_[c * n_ + k] =
                    mNew[c] > 1e-12 * V[c] ? mq[c] / mNew[c] : 0;
            }
        }
        m = mNew / V;
        forAll(alpha, c) alpha[c] = m[c] * std::exp(-p(c) / K_);
    }

    return returnReduce(spilled, sumOp<scalar>());
}

// ************************************************************************* //
