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
}
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::string Foam::functionObjects::energyBalance::title() const
{
    return "Work of the walls since the start, and where it went";
}


const Foam::dictionary& Foam::functionObjects::energyBalance::books() const
{
    const IOdictionary* found = time_.cfindObject<IOdictionary>("energyLedger");
    if (!found)
    {
        // One of input: postProcess goes on after others
        FatalIOErrorInFunction(time_.controlDict())
            << "function object " << name() << " needs the energyLedger that"
            << " bolusFoam keeps; no other solver has them"
            << exit(FatalIOError);
    }
    return *found;
}


Foam::stringList Foam::functionObjects::energyBalance::heads() const
{
    DynamicList<string> heads({"work [J]", "closure [J]"});
    for (const word& part : books().get<wordList>("parts"))
    {
        heads.append(part + " [J]");
    }
    heads.append("residual [J]");
    heads.append("relative [-]");
    return stringList(heads);
}


Foam::scalarList Foam::functionObjects::energyBalance::values()
{
    const dictionary& kept = books();

    DynamicList<scalar> row;
    auto append = [&](const word& sum)
    { row.append(factor() * kept.get<scalar>(sum)); };

    append("walls");
    append("closure");
    for (const word& part : kept.get<wordList>("parts")) append(part);
    append("residual");
    row.append(kept.get<scalar>("residual") / kept.get<scalar>("largestWork"));
    return scalarList(row);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::energyBalance::energyBalance(
    const word& name,
    const Time& runTime,
    const dictionary& dict
) :
    bolusMonitor(name, runTime, dict, typeName, {"mass"})
{
    begin();
}


// ************************************************************************* //
