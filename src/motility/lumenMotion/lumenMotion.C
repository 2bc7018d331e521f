// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "lumenMotion.H"
#include "IOdictionary.H"
#include "Pstream.H"
#include "PstreamReduceOps.H"
#include "Time.H"
#include "polyMesh.H"
#include "wedgeFrame.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::lumenMotion::lumenMotion(entryReader read) :
    wall_(read),
    origin_(read.value("origin", point(Zero))),
    axis_(read.direction("axis", "of the lumen", vector(1, 0, 0))),
    referenceTime_(read.number(
        "referenceTime",
        "of the mesh [s]",
        entryReader::anything,
        0
    ))
{
    read.rejectOthers();
}


Foam::lumenMotion::lumenMotion(const dictionary& dict) :
    lumenMotion(entryReader(dict))
{}


// * * * * * * * * * * * * * * * * Selectors * * * * * * * * * * * * * * * * //

Foam::autoPtr<Foam::lumenMotion> Foam::lumenMotion::New(const Time& runTime)
{
    const IOdictionary dict(IOobject(
        "motilityProperties",
        runTime.constant(),
        runTime,
        IOobject::MUST_READ,
        IOobject::NO_WRITE,
        false
    ));

    return autoPtr<lumenMotion>::New(dict);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::lumenMotion::checkCovers(const pointField& points0) const
{
    scalar xMin = GREAT;
    scalar xMax = -GREAT;

    for (const point& p : points0)
    {
        const scalar x = axial(p);

        xMin = min(xMin, x);
        xMax = max(xMax, x);
    }

    reduce(xMin, minOp<scalar>());
    reduce(xMax, maxOp<scalar>());

    wall_.checkCovers(xMin, xMax);
}


Foam::scalar Foam::lumenMotion::outermost(const pointField& points0) const
{
    scalar ratio = 0;

    for (const point& p : points0)
    {
        ratio =
            max(ratio, mag(radial(p)) / wall_.radius(axial(p), referenceTime_));
    }

    return returnReduce(ratio, maxOp<scalar>());
}


void Foam::lumenMotion::checkAxis(
    const polyMesh& mesh,
    const pointField& points0,
    const scalar tolerance
) const
{
    const wedgeFrame wedge(mesh);
    if (!wedge.valid()) return;

    scalar largest = 0;
    for (const point& p : points0)
    {
        largest = max(largest, mag(wedge.fromAxis(p)));
    }
    reduce(largest, maxOp<scalar>());

    const scalar apart = wedgeFrame::apart(mesh, wedge, origin_, axis_);
    if (!(apart <= tolerance * largest))
    {
        FatalErrorInFunction
            << "Entries 'origin' " << origin_ << " m and 'axis' " << axis_
            << " of constant/motilityProperties are up to " << apart
            << " m away from the axis of the wedge mesh, through "
            << wedge.origin() << " m along " << wedge.axis()
            << "; valid is that axis, in one of its two directions"
            << exit(FatalError);
    }
}


void Foam::lumenMotion::checkWall(
    const pointField& points0,
    const scalar tolerance
) const
{
    const scalar ratio = outermost(points0);

    if (!(mag(ratio - 1) <= tolerance))
    {
        FatalErrorInFunction
            << "The outermost points of constant/polyMesh are at " << ratio
            << " times the radius of the wall at the reference time; within"
            << " the wallTolerance, " << tolerance
            << ", it must be 1. Run gastricMesh after blockMesh, and both"
            << " again after a change of constant/motilityProperties"
            << exit(FatalError);
    }
}


// ************************************************************************* //
