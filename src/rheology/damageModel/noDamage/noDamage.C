// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "noDamage.H"

#include "addToRunTimeSelectionTable.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace damageModels
{
defineTypeNameAndDebug(noDamage, 0);
addToRunTimeSelectionTable(damageModel, noDamage, dictionary);
}
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::damageModels::noDamage::noDamage(const dictionary& dict)
{
    entryReader read(dict);
    read.has("type");

    // So that damage is switched off by its type alone
    read.has("epsilonPEq0");
    read.has("eta0");
    read.has("residualStrength");
    read.rejectOthers();
}


// ************************************************************************* //
