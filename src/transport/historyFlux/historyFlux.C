// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "historyFlux.H"
#include "leastSquaresGradient.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::historyFlux::setMasses(
    const transportZone& z,
    const scalarField& m,
    const scalar dt
)
{
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();
    const scalarField& F = bolus_.F();
    for (const label c : z.cells)
    {
        massOld_[c] = massNew_[c] = m[c] * step_.Vold(c);
    }
    auto add = [&](const label f)
    {
        massNew_[own[f]] -= F[f] * dt;
        if (f < nInternal) massNew_[nei[f]] += F[f] * dt;
    };
    for (const label f : z.faces) add(f);
    for (const label f : z.given) add(f);
}


void Foam::historyFlux::setStays(const transportZone& z, const scalar dt)
{
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();
    const scalarField& V = mesh_.V();
    const scalarField& F = bolus_.F();

    for (const label c : z.cells) stays_[c] = 0;
    auto leave = [&](const label f)
    {
        if (F[f] > 0)
            stays_[own[f]] += F[f] * dt;
        else if (f < nInternal)
            stays_[nei[f]] -= F[f] * dt;
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
    exchange(z, calm_, 1, beyond_.stays);
    for (const label f : z.faces)
    {
        heun_[f] = full_[f]
            && min(calm_[own[f]],
                   f < nInternal ? calm_[nei[f]]
                                 : beyond_.stays[exchange_.at(f)])
                > 0.5;
    }
    exchange(z, stays_, 1, beyond_.stays);
}


void Foam::historyFlux::setFull(
    const transportZone& z,
    const scalarField& alpha
)
{
    // Memory is interpolated only between cells with bolus
    auto set = [&](const label f)
    {
        full_[f] = min(alpha[mesh_.faceOwner()[f]], bolus_.beyond(f, alpha))
            > historyAbove_;
    };
    for (const label f : z.faces) set(f);
    for (const label f : z.given) set(f);

    rim_.clear();
    for (const label c : z.cells)
    {
        if (alpha[c] <= historyAbove_) continue;
        bool all = true;
        bool some = false;
        for (const label f : mesh_.cells()[c])
        {
            if (f >= mesh_.nInternalFaces() && !exchange_.coupled(f)) continue;
            all = all && full_[f];
            some = some || full_[f];
        }
        if (some && !all) rim_.append(c);
    }
}


void Foam::historyFlux::setBounds(const transportZone& z)
{
    const label n = memory_.n();
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();
    const scalarField& q = memory_.values();

    for (const label c : z.cells)
    {
        for (label i = c * n; i < (c + 1) * n; ++i) least_[i] = most_[i] = q[i];
    }
    auto widen = [&](const label c, const scalar* other)
    {
        scalar* least = &least_[c * n];
        scalar* most = &most_[c * n];
        for (label k = 0; k < n; ++k)
        {
            least[k] = min(least[k], other[k]);
            most[k] = max(most[k], other[k]);
        }
    };
    auto see = [&](const label f)
    {
        if (!full_[f]) return;
        const bool internal = f < nInternal;
        widen(
            own[f],
            internal ? &q[nei[f] * n] : &beyond_.memory[exchange_.at(f, n)]
        );
        if (internal) widen(nei[f], &q[own[f] * n]);
    };
    for (const label f : z.faces) see(f);
    for (const label f : z.given) see(f);
    exchange(z, least_, n, beyond_.least);
    exchange(z, most_, n, beyond_.most);
}


void Foam::historyFlux::setFaces(const transportZone& z, scalarField& faces)
{
    const label n = memory_.n();
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();
    const scalarField& q = memory_.values();
    const scalarField& F = bolus_.F();

    exchange(z, q, n, beyond_.memory);
    const auto full = [&](const label f) { return full_[f]; };
    leastSquaresGradient::set(
        mesh_, exchange_, z, q, beyond_.memory, n, full, gradient_
    );
    const auto delta = [&](const label f) { return step_.delta(f); };
    for (const label c : rim_)
    {
        leastSquaresGradient::setAtRim(
            mesh_, exchange_, c, q, beyond_.memory, n, full, delta, gradient_
        );
    }
    exchange(z, gradient_, 3 * n, beyond_.gradient);

    // The slope may not count on values that no neighbour has
    setBounds(z);

    for (const label f : z.faces)
    {
        const label P = own[f];
        const bool internal = f < nInternal;
        const bool coupled = exchange_.coupled(f);
        const bool forward = F[f] > 0;
        scalar* qF = &faces[f * n];

        // What an open boundary lets in has no memory
        if (!forward && !internal && !coupled)
        {
            for (label k = 0; k < n; ++k) qF[k] = 0;
            continue;
        }
        const scalar* qP = &q[P * n];
        const scalar* qN = internal ? &q[nei[f] * n]
            : coupled               ? &beyond_.memory[exchange_.at(f, n)]
                                    : nullptr;
        const scalar* qD = forward ? qP : qN;
        if (F[f] == 0 || !full_[f])
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
                           : &others[exchange_.at(f, width)];
        };
        const scalar* gD = donor(gradient_, beyond_.gradient, 3 * n);
        const scalar* least = donor(least_, beyond_.least, n);
        const scalar* most = donor(most_, beyond_.most, n);
        const scalar rest = *donor(stays_, beyond_.stays, 1);
        const scalar part = min(rest / max(1 - rest, SMALL), scalar(1));
        const vector& d = step_.delta(f);
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


void Foam::historyFlux::carry(
    const transportZone& z,
    const scalar dt,
    const scalarField& faces
)
{
    const label n = memory_.n();
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const labelList& nei = mesh_.faceNeighbour();
    const scalarField& V = mesh_.V();
    scalarField& q = memory_.values();

    for (const label c : z.cells)
    {
        for (label i = c * n; i < (c + 1) * n; ++i)
        {
            carried_[i] = massOld_[c] * q[i];
        }
    }
    auto pass = [&](const label f)
    {
        const scalar F = bolus_.F()[f];
        const scalar* qF = &faces[f * n];
        scalar* from = &carried_[own[f] * n];
        for (label k = 0; k < n; ++k) from[k] -= F * qF[k] * dt;
        if (f >= nInternal) return;
        scalar* to = &carried_[nei[f] * n];
        for (label k = 0; k < n; ++k) to[k] += F * qF[k] * dt;
    };
    for (const label f : z.faces) pass(f);
    for (const label f : z.given) pass(f);
    for (const label c : z.moved)
    {
        const bool empty = massNew_[c] <= 1e-12 * V[c];
        for (label i = c * n; i < (c + 1) * n; ++i)
        {
            q[i] = empty ? 0 : carried_[i] / massNew_[c];
        }
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::historyFlux::historyFlux(
    const fvMesh& mesh,
    const cellExchange& exchange,
    const stepFlux& step,
    const bolusFlux& bolus,
    packedHistory& memory,
    entryReader& read
) :
    mesh_(mesh),
    exchange_(exchange),
    step_(step),
    bolus_(bolus),
    memory_(memory),
    historyAbove_(read.number(
        "historyAbove",
        "alpha of cells between which memory is interpolated [-]",
        {0, true, 1, false},
        0.05
    )),
    massOld_(mesh.nCells(), Zero),
    massNew_(mesh.nCells(), Zero),
    stays_(mesh.nCells(), Zero),
    calm_(mesh.nCells(), Zero),
    full_(mesh.nFaces(), false),
    heun_(mesh.nFaces(), false)
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::historyFlux::begin()
{
    const label size = memory_.values().size();
    for (scalarField* cells : {&carried_, &least_, &most_, &start_})
    {
        cells->setSize(size);
    }
    gradient_.setSize(3 * size);
    for (scalarField* faces : {&faces_, &mean_, &second_})
    {
        if (faces->size() == mesh_.nFaces() * memory_.n()) continue;
        faces->setSize(mesh_.nFaces() * memory_.n());
        *faces = 0;
    }
}


void Foam::historyFlux::set(
    const transportZone& z,
    const scalarField& alpha,
    const scalarField& m,
    const scalar dt
)
{
    setFull(z, alpha);
    setMasses(z, m, dt);
    setStays(z, dt);

    const label n = memory_.n();
    setFaces(z, faces_);
    auto copy = [&](const scalarField& from, scalarField& to)
    {
        for (const label c : z.moved)
        {
            for (label i = c * n; i < (c + 1) * n; ++i) to[i] = from[i];
        }
    };
    copy(memory_.values(), start_);
    carry(z, dt, faces_);
    setFaces(z, second_);
    copy(start_, memory_.values());
    for (const label f : z.faces)
    {
        if (!heun_[f]) continue;
        for (label i = f * n; i < (f + 1) * n; ++i)
        {
            faces_[i] = 0.5 * (faces_[i] + second_[i]);
        }
    }
}


void Foam::historyFlux::follow(const transportZone& z, const label fine)
{
    const label n = memory_.n();
    const scalarField& q = memory_.values();
    exchange(z, q, n, beyond_.memory);
    for (const label f : z.led)
    {
        const label D = step_.donor(f);
        const scalar* qD =
            D >= 0 ? &q[D * n] : &beyond_.memory[exchange_.at(f, n)];
        for (label k = 0; k < n; ++k)
        {
            faces_[f * n + k] = qD[k];
            mean_[f * n + k] += qD[k] / fine;
        }
    }
}


void Foam::historyFlux::setMean(const transportZone& z)
{
    const label n = memory_.n();
    for (const label f : z.led)
    {
        for (label i = f * n; i < (f + 1) * n; ++i)
        {
            faces_[i] = mean_[i];
            mean_[i] = 0;
        }
    }
}


void Foam::historyFlux::move(
    const transportZone& z,
    const scalar dt,
    scalarField& m,
    scalarField& alpha
)
{
    setMasses(z, m, dt);
    carry(z, dt, faces_);
    for (const label c : z.moved)
    {
        m[c] = massNew_[c] / step_.V(c);
        memory_.compress(c);
        alpha[c] = m[c] * memory_.shrunk()[c];
    }
}

// ************************************************************************* //
