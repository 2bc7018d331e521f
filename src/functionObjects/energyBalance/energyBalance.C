// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "energyBalance.H"
#include "addToRunTimeSelectionTable.H"
#include "IOdictionary.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(energyBalance, 0);
addToRunTimeSelectionTable(functionObject, energyBalance, dictionary);

//- The sums that bolusFoam keeps, in the order of the columns
static const wordList sums(
    {"walls",
        "closure",
        "elastic",
        "slip",
        "kinetic",
        "plastic",
        "friction",
        "fracture",
        "void",
        "debris",
        "relaxation",
        "hourglass",
        "overfill",
        "transport",
        "outflow",
        "inertiaLoss",
        "residual"}
);
}
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::string Foam::functionObjects::energyBalance::title() const
{
    return "Work of the walls since the start, and where it went";
}


Foam::stringList Foam::functionObjects::energyBalance::heads() const
{
    DynamicList<string> heads;
    for (const word& sum : sums)
    {
        heads.append((sum == "walls" ? word("work") : sum) + " [J]");
    }
    heads.append("relative [-]");
    return stringList(heads);
}


Foam::scalarList Foam::functionObjects::energyBalance::values()
{
    const IOdictionary* books = time_.cfindObject<IOdictionary>("energyBooks");
    if (!books)
    {
        FatalErrorInFunction << "function object " << name()
                             << " needs the energyBooks that bolusFoam keeps;"
                             << " no other solver has them" << exit(FatalError);
    }

    DynamicList<scalar> row;
    for (const word& sum : sums)
    {
        row.append(factor() * books->get<scalar>(sum));
    }
    row.append(
        books->get<scalar>("residual") / books->get<scalar>("largestWork")
    );
    return scalarList(row);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::energyBalance::energyBalance(
    const word& name,
    const Time& runTime,
    const dictionary& dict
) :
    bolusMonitor(name, runTime, dict, typeName, {"mass"}, {})
{
    begin();
}


// ************************************************************************* //
