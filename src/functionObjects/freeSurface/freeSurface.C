// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "freeSurface.H"
#include "addToRunTimeSelectionTable.H"
#include "cutSurface.H"
#include "volFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(freeSurface, 0);
addToRunTimeSelectionTable(functionObject, freeSurface, dictionary);
}
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::string Foam::functionObjects::freeSurface::title() const
{
    return "External surface of the bolus, full geometry";
}


Foam::stringList Foam::functionObjects::freeSurface::heads() const
{
    return stringList(
        {"volume [m3]",
            "freeArea [m2]",
            "contactArea [m2]",
            "externalArea [m2]",
            "surfaceToVolume [1/m]"}
    );
}


Foam::scalarList Foam::functionObjects::freeSurface::values()
{
    const volScalarField& alpha = field("alpha");
    const cutSurface surface(alpha, isoValue_, patches_);
    const scalar freeArea = factor() * gSum(surface.free());
    const scalar contactArea = factor() * gSum(surface.contact());

    const scalar volume = factor()
        * gSum(scalarField(alpha.primitiveField() * mesh_.V().field()));

    return scalarList(
        {volume,
            freeArea,
            contactArea,
            freeArea + contactArea,
            (freeArea + contactArea) / max(volume, VSMALL)}
    );
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::freeSurface::freeSurface(
    const word& name,
    const Time& runTime,
    const dictionary& dict
) :
    bolusMonitor(name, runTime, dict, typeName, {"alpha", "mass"}),
    patches_(readPatches("patches", true)),
    isoValue_(
        entries().number(
            "isoValue",
            "volume fraction [-]",
            {0, false, 1, false},
            0.5
        )
    )
{
    begin();
}


// ************************************************************************* //
