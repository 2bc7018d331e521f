// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "fragments.H"
#include "addToRunTimeSelectionTable.H"
#include "Map.H"
#include "Tuple2.H"
#include "cutSurface.H"
#include "regionSplit.H"
#include "syncTools.H"
#include "volFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(fragments, 0);
addToRunTimeSelectionTable(functionObject, fragments, dictionary);
}
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::string Foam::functionObjects::fragments::title() const
{
    return "Connected pieces of the bolus, full geometry";
}


Foam::stringList Foam::functionObjects::fragments::heads() const
{
    stringList found(
        {"pieces [-]", "smallFragments [-]", "smallFragmentMass [kg]"}
    );
    for (label i = 1; i <= largest_; ++i)
    {
        found.append("mass" + Foam::name(i) + " [kg]");
        found.append("area" + Foam::name(i) + " [m2]");
    }
    return found;
}


Foam::scalarList Foam::functionObjects::fragments::values()
{
    const volScalarField& alpha = field("alpha");
    const scalarField& mass = field("mass");

    boolList in;
    in.setSize(mesh_.nCells());
    forAll(in, c) in[c] = alpha[c] > isoValue_;
    if (intact_)
    {
        const scalarField& D = field("D");
        forAll(in, c) in[c] = in[c] && D[c] <= 0.5;
    }

    // A face connects where there is bolus on both sides
    boolList inBeyond;
    syncTools::swapBoundaryCellList(mesh_, in, inBeyond);
    const labelList& owner = mesh_.faceOwner();
    const label nInternal = mesh_.nInternalFaces();
    boolList blocked(mesh_.nFaces());
    forAll(blocked, f)
    {
        const bool other = f < nInternal ? in[mesh_.faceNeighbour()[f]]
                                         : inBeyond[f - nInternal];
        blocked[f] = !(in[owner[f]] && other);
    }
    const regionSplit regions(mesh_, blocked);

    Map<scalar> masses;
    forAll(in, c)
    {
        if (in[c]) masses(regions[c], 0) += mass[c] * mesh_.V()[c];
    }
    auto add = [](const Map<scalar>& a, const Map<scalar>& b)
    {
        Map<scalar> sums(a);
        forAllConstIters(b, iter) sums(iter.key(), 0) += iter.val();
        return sums;
    };
    reduce(masses, add);

    // Interfaces are in cells on either side of isoValue
    labelList piece(mesh_.nCells(), -1);
    forAll(in, c)
        if (in[c]) piece[c] = regions[c];
    labelList beyond;
    syncTools::swapBoundaryCellList(mesh_, piece, beyond);
    const labelList inside(piece);
    auto heavier = [&](label& mine, const label other)
    {
        if (other >= 0 && (mine < 0 || masses[other] > masses[mine]))
        {
            mine = other;
        }
    };
    forAll(owner, f)
    {
        const label P = owner[f];
        const bool internal = f < nInternal;
        const label N = internal ? mesh_.faceNeighbour()[f] : -1;
        if (inside[P] < 0)
        {
            heavier(piece[P], internal ? inside[N] : beyond[f - nInternal]);
        }
        if (internal && inside[N] < 0) heavier(piece[N], inside[P]);
    }

    const cutSurface surface(alpha, isoValue_, patches_);
    Map<scalar> areas;
    forAll(piece, c)
    {
        if (piece[c] < 0) continue;
        areas(piece[c], 0) += surface.free()[c] + surface.contact()[c];
    }
    reduce(areas, add);

    // The heaviest first; equal ones in the order of their numbers
    List<Tuple2<scalar, label>> order;
    forAllConstIters(masses, iter)
    {
        order.append(Tuple2<scalar, label>(-iter.val(), iter.key()));
    }
    Foam::sort(order);

    scalarList found(3 + 2 * largest_, Zero);
    label row = 3;
    for (const Tuple2<scalar, label>& one : order)
    {
        const scalar kg = -factor() * rho() * one.first();
        if (kg < crumb_ * initialMass())
        {
            found[1] += 1;
            found[2] += kg;
            continue;
        }
        found[0] += 1;
        if (row < found.size())
        {
            found[row++] = kg;
            found[row++] = factor() * areas(one.second(), 0);
        }
    }
    return found;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::fragments::fragments(
    const word& name,
    const Time& runTime,
    const dictionary& dict
) :
    bolusMonitor(
        name,
        runTime,
        dict,
        typeName,
        dict.lookupOrDefault("intact", false) ? wordList({"alpha", "mass", "D"})
                                              : wordList({"alpha", "mass"})
    ),
    patches_(readPatches("patches", true)),
    intact_(
        entries().flag("intact", "only what is not damaged connects", false)
    ),
    isoValue_(
        entries().number(
            "isoValue",
            "volume fraction [-]",
            {0, false, 1, false},
            0.5
        )
    ),
    crumb_(entries().number("crumb", "part [-]", {0, true, 1, false}, 0.01)),
    largest_(
        entries().wholeNumber(
            "largest",
            "pieces that have columns",
            entryReader::positive,
            4
        )
    )
{
    begin();
}

// ************************************************************************* //
