// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "externalWork.H"
#include "addToRunTimeSelectionTable.H"
#include "volFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(externalWork, 0);
addToRunTimeSelectionTable(functionObject, externalWork, dictionary);
}
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::functionObjects::externalWork::power() const
{
    const volScalarField& wallPower = field("wallPower");

    scalar power = 0;
    for (const label patchi : patches_)
    {
        power += sum(wallPower.boundaryField()[patchi]);
    }

    return returnReduce(power, sumOp<scalar>());
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::string Foam::functionObjects::externalWork::title() const
{
    return "Work of the wall on the bolus";
}


Foam::stringList Foam::functionObjects::externalWork::heads() const
{
    return stringList(
        {"power [W]",
            "work [J]",
            "work_perMass [mJ/g]",
            "power_mesh [W]",
            "work_mesh [J]"}
    );
}


Foam::scalarList Foam::functionObjects::externalWork::values()
{
    const scalar P = power();

    // J/kg is mJ/g
    return scalarList(
        {factor() * P,
            factor() * work_,
            factor() * work_ / initialMass(),
            P,
            work_}
    );
}


void Foam::functionObjects::externalWork::accumulate(
    const scalar t0,
    const scalar t1
)
{
    work_ += power() * (t1 - t0);
    setProperty("work", work_);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::externalWork::externalWork(
    const word& name,
    const Time& runTime,
    const dictionary& dict
) :
    bolusMonitor(name, runTime, dict, typeName, {"mass", "wallPower"}),
    patches_(readPatches("patches", true)),
    work_(restored("work"))
{
    requireEveryStep(dict);
    begin();
}


// ************************************************************************* //
