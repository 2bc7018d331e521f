// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "lumenMotion.H"
#include "IOdictionary.H"
#include "Pstream.H"
#include "PstreamReduceOps.H"
#include "Time.H"
#include "dictionaryCheck.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::vector Foam::lumenMotion::readAxis(const dictionary& dict)
{
    const vector axis(dict.getOrDefault<vector>("axis", vector(1, 0, 0)));

    if (!(mag(axis) > SMALL))
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'axis' is " << axis
            << "; it must be a direction, for example (1 0 0)"
            << exit(FatalIOError);
    }

    return axis / mag(axis);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::lumenMotion::lumenMotion(const dictionary& dict) :
    wall_(dict),
    origin_(dict.getOrDefault<point>("origin", point(0, 0, 0))),
    axis_(readAxis(dict)),
    referenceTime_(dict.getOrDefault<scalar>("referenceTime", 0))
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


// ************************************************************************* //
