// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "subSteps.H"
#include "Pstream.H"
#include "PstreamReduceOps.H"

#include <algorithm>

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::subSteps::setLargest(const scalarField& mass)
{
    // Classes of a twentieth of a decade, from 0.001 to 1000
    scalarField classes(120, Zero);
    const scalarField& V = mesh_.V();
    courant_ = 0;
    forAll(Co_, c)
    {
        // Down to traces of what counts as empty in equilibrium (1e-6): they
        // add 0.3 % sub-steps (cases A to C), and stay within a cell in each
        if (mass[c] < 1e-9) continue;
        courant_ = max(courant_, Co_[c]);
        const label i =
            label(std::floor(20 * (std::log10(max(Co_[c], scalar(1e-3))) + 3)));
        classes[min(i, classes.size() - 1)] += mass[c] * V[c];
    }
    reduce(courant_, maxOp<scalar>());
    reduce(classes, sumOp<scalarField>());

    const scalar total = sum(classes);
    scalar above = 0;
    label i = classes.size() - 1;
    while (i > 0 && above + classes[i] < 0.01 * total) above += classes[i--];
    bulkCourant_ = min(courant_, std::pow(10.0, (i + 1) / 20.0 - 3));
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::subSteps::subSteps(
    const fvMesh& mesh,
    const cellExchange& exchange,
    const stepFlux& step,
    entryReader& read
) :
    mesh_(mesh),
    exchange_(exchange),
    step_(step),
    maxCourant_(read.number(
        "maxCourant",
        "Courant number of a sub-step [-]",
        {0, false, 0.5, true},
        0.3
    )),
    maxSubSteps_(label(
        read.number("maxSubSteps", "sub-steps", {1, true, 1e6, true}, 1000)
    )),
    local_(
        read.choice(
            "localSubSteps",
            "short ones for fast cells",
            wordList({"yes", "no"}),
            "yes"
        )
        == "yes"
    ),
    courant_(0),
    bulkCourant_(0),
    needed_(0),
    fast_(mesh.nCells(), Zero),
    touched_(mesh.nCells(), Zero)
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::subSteps::begin(const scalarField& mass)
{
    step_.courant(Co_);
    setLargest(mass);
    // Compared as a number: it may be beyond what a label holds
    const scalar needed = std::ceil(courant_ / maxCourant_);
    const bool feasible = needed <= maxSubSteps_;
    needed_ = feasible ? max(label(needed), 1) : 0;
    return feasible;
}


Foam::labelPair Foam::subSteps::divide() const
{
    if (needed_ == 1 || !local_) return labelPair(needed_, 1);

    // Cells that need more than i sub-steps, at least
    labelField above(needed_ + 1, Zero);
    for (const scalar x : Co_)
    {
        const scalar steps = min(x / maxCourant_, scalar(needed_));
        ++above[label(std::ceil(steps))];
    }
    reduce(above, sumOp<labelField>());
    for (label i = needed_ - 1; i >= 0; --i) above[i] += above[i + 1];
    const scalar nCells = above[0];

    // Least work, if short steps of a part, with the cells around it, save
    // enough to be worth their trouble
    labelPair best(needed_, 1);
    scalar least = 0.8 * needed_ * nCells;
    for (label fine = 2; fine <= needed_; ++fine)
    {
        const label coarse = (needed_ + fine - 1) / fine;
        if (coarse * (fine - 1) >= needed_) continue;
        const scalar fast =
            coarse < needed_ ? min(2.0 * above[coarse + 1], nCells) : 0;
        const scalar work = coarse * (nCells + fine * fast);
        if (work < least)
        {
            least = work;
            best = labelPair(coarse, fine);
        }
    }
    return best;
}


void Foam::subSteps::setZones(
    const label coarse,
    transportZone& slow,
    transportZone& fast
)
{
    const label nInternal = mesh_.nInternalFaces();
    const label nCells = mesh_.nCells();
    const auto coupled = [&](const label f) { return exchange_.coupled(f); };

    // Fast cells, the faces of these, and the cells on both sides
    forAll(fast_, c)
    {
        // None where all cells take the same
        fast_[c] = coarse > 0 && Co_[c] > maxCourant_ * coarse ? 1 : 0;
    }
    exchange_.cells(fast_, 1, fastBeyond_);
    touched_ = 0;
    DynamicList<label> fastFaces, slowFaces, given, ledFaces;
    for (const label f : step_.faces())
    {
        const label P = mesh_.faceOwner()[f];
        const label N = f < nInternal ? mesh_.faceNeighbour()[f] : -1;
        const scalar beyond = N >= 0 ? fast_[N]
            : coupled(f)             ? fastBeyond_[exchange_.at(f)]
                                     : 0;
        if (fast_[P] + beyond > 0)
        {
            fastFaces.append(f);
            touched_[P] = 1;
            if (N >= 0) touched_[N] = 1;
        }
        else
        {
            slowFaces.append(f);
        }
    }
    exchange_.cells(touched_, 1, touchedBeyond_);
    for (const label f : slowFaces)
    {
        const label P = mesh_.faceOwner()[f];
        const label N = f < nInternal ? mesh_.faceNeighbour()[f] : P;
        if (touched_[P] + touched_[N] > 0) given.append(f);

        const label D = step_.donor(f);
        const bool led = D >= 0
            ? touched_[D] > 0
            : coupled(f) && touchedBeyond_[exchange_.at(f)] > 0;
        if (led) ledFaces.append(f);
    }

    DynamicList<label> inside, outside;
    for (label c = 0; c < nCells; ++c)
    {
        (touched_[c] > 0 ? inside : outside).append(c);
    }

    slow.cells = identity(nCells);
    slow.moved = outside;
    slow.faces = slowFaces;
    slow.given = fastFaces;
    slow.shared = exchange_.parts();

    fast.cells = inside;
    fast.moved = inside;
    fast.faces = fastFaces;
    fast.given = given;
    fast.led = ledFaces;
    fast.shared = exchange_.parts()
        && returnReduce(
            std::any_of(fastFaces.begin(), fastFaces.end(), coupled)
                || std::any_of(given.begin(), given.end(), coupled),
            orOp<bool>()
        );
}

// ************************************************************************* //
