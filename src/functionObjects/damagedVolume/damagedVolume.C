// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "damagedVolume.H"
#include "addToRunTimeSelectionTable.H"
#include "volFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(damagedVolume, 0);
addToRunTimeSelectionTable(functionObject, damagedVolume, dictionary);
}
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::string Foam::functionObjects::damagedVolume::title() const
{
    return "Volume of damaged bolus (D times bolus), full geometry";
}


Foam::stringList Foam::functionObjects::damagedVolume::heads() const
{
    return stringList({"bolus [m3]", "damaged [m3]", "fraction [-]"});
}


Foam::scalarList Foam::functionObjects::damagedVolume::values()
{
    const scalarField& D = field("D");
    const scalarField volume(
        field("alpha").primitiveField() * mesh_.V().field()
    );

    const scalar bolus = factor() * gSum(volume);
    const scalar damaged = factor() * gSum(scalarField(D * volume));

    return scalarList({bolus, damaged, damaged / max(bolus, VSMALL)});
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::damagedVolume::damagedVolume(
    const word& name,
    const Time& runTime,
    const dictionary& dict
) :
    bolusMonitor(name, runTime, dict, typeName, {"alpha", "mass", "D"})
{
    begin();
}


// ************************************************************************* //
