// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "historyTransport.H"

#include <algorithm>

// Sub-steps, and which cells take the short ones: see historyTransport.H

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalarField Foam::historyTransport::courant() const
{
    const label nInternal = mesh_.nInternalFaces();
    scalarField Co(mesh_.nCells(), Zero);
    for (const label f : faces_)
    {
        if (flux_[f] > 0)
            Co[mesh_.faceOwner()[f]] += flux_[f];
        else if (f < nInternal)
            Co[mesh_.faceNeighbour()[f]] -= flux_[f];
    }
    const scalarField& V1 = mesh_.V();
    forAll(Co, c) Co[c] *= deltaT_ / min(V0_[c], V1[c]);
    return Co;
}


void Foam::historyTransport::largest(
    const scalarField& Co,
    scalar& most,
    scalar& bulk
) const
{
    // Classes of a twentieth of a decade, from 0.001 to 1000
    scalarField classes(120, Zero);
    const scalarField& V = mesh_.V();
    most = 0;
    forAll(Co, c)
    {
        if (state_.mass[c] < 1e-9) continue;
        most = max(most, Co[c]);
        const label i =
            label(std::floor(20 * (std::log10(max(Co[c], scalar(1e-3))) + 3)));
        classes[min(i, classes.size() - 1)] += state_.mass[c] * V[c];
    }
    reduce(most, maxOp<scalar>());
    reduce(classes, sumOp<scalarField>());

    const scalar total = sum(classes);
    scalar above = 0;
    label i = classes.size() - 1;
    while (i > 0 && above + classes[i] < 0.01 * total) above += classes[i--];
    bulk = min(most, std::pow(10.0, (i + 1) / 20.0 - 3));
}


Foam::labelPair Foam::historyTransport::divide(
    const scalarField& Co,
    const label needed
) const
{
    if (needed == 1 || !localSubSteps_) return labelPair(needed, 1);

    // Cells that need more than i sub-steps, at least
    labelField above(needed + 1, Zero);
    for (const scalar x : Co)
    {
        const scalar steps = min(x / maxCourant_, scalar(needed));
        ++above[label(std::ceil(steps))];
    }
    reduce(above, sumOp<labelField>());
    for (label i = needed - 1; i >= 0; --i) above[i] += above[i + 1];
    const scalar nCells = above[0];

    // Least work, if short steps of a part, with the cells around it, save
    // enough to be worth their trouble
    labelPair best(needed, 1);
    scalar least = 0.8 * needed * nCells;
    for (label fine = 2; fine <= needed; ++fine)
    {
        const label coarse = (needed + fine - 1) / fine;
        if (coarse * (fine - 1) >= needed) continue;
        const scalar fast =
            coarse < needed ? min(2.0 * above[coarse + 1], nCells) : 0;
        const scalar work = coarse * (nCells + fine * fast);
        if (work < least)
        {
            least = work;
            best = labelPair(coarse, fine);
        }
    }
    return best;
}


void Foam::historyTransport::setZones(
    const scalarField& Co,
    const label coarse,
    zone& slow,
    zone& fast
) const
{
    const label nInternal = mesh_.nInternalFaces();
    const label nCells = mesh_.nCells();

    // Fast cells, the faces of these, and the cells on both sides
    scalarField quick(nCells, Zero);
    forAll(quick, c) quick[c] = Co[c] > maxCourant_ * coarse ? 1 : 0;
    const scalarField quickNei(neighbour(quick));
    boolList touched;
    touched.setSize(nCells, false);
    DynamicList<label> fastFaces, slowFaces, given, ledFaces;
    for (const label f : faces_)
    {
        const label P = mesh_.faceOwner()[f];
        const label N = f < nInternal ? mesh_.faceNeighbour()[f] : -1;
        const scalar beyond = N >= 0 ? quick[N]
            : coupled_[f]            ? quickNei[f - nInternal]
                                     : 0;
        if (quick[P] + beyond > 0)
        {
            fastFaces.append(f);
            touched[P] = true;
            if (N >= 0) touched[N] = true;
        }
        else
        {
            slowFaces.append(f);
        }
    }
    scalarField part(nCells, Zero);
    forAll(part, c) part[c] = touched[c] ? 1 : 0;
    const scalarField partNei(neighbour(part));
    for (const label f : slowFaces)
    {
        const label P = mesh_.faceOwner()[f];
        const label N = f < nInternal ? mesh_.faceNeighbour()[f] : P;
        if (touched[P] || touched[N]) given.append(f);

        const bool led = flux_[f] > 0 ? touched[P]
            : f < nInternal ? touched[N]
                            : coupled_[f] && partNei[f - nInternal] > 0;
        if (led) ledFaces.append(f);
    }

    DynamicList<label> inside, outside;
    forAll(touched, c) (touched[c] ? inside : outside).append(c);

    slow.cells = identity(nCells);
    slow.moved = outside;
    slow.faces = slowFaces;
    slow.given = fastFaces;
    slow.shared = parts_;

    fast.cells = inside;
    fast.moved = inside;
    fast.faces = fastFaces;
    fast.given = given;
    fast.led = ledFaces;
    const auto shared = [&](const label f) { return coupled_[f]; };
    fast.shared = parts_
        && returnReduce(
            std::any_of(fastFaces.begin(), fastFaces.end(), shared)
                || std::any_of(given.begin(), given.end(), shared),
            orOp<bool>()
        );
}

// ************************************************************************* //
