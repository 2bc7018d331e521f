// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "damageModel.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
defineTypeNameAndDebug(damageModel, 0);
defineRunTimeSelectionTable(damageModel, dictionary);
}


// * * * * * * * * * * * * * * * * * Selector  * * * * * * * * * * * * * * * //

Foam::autoPtr<Foam::damageModel> Foam::damageModel::New(
    const dictionary& bolusDict
)
{
    const dictionary& dict = entryReader::subDictionary(
        bolusDict,
        "damage",
        "damage model, { type none; } or { type triaxialOnset; ... }"
    );

    const word modelType = entryReader(dict).choice(
        "type", "damage model", dictionaryConstructorTablePtr_->sortedToc()
    );

    return (*dictionaryConstructorTablePtr_->cfind(modelType))(dict);
}


// ************************************************************************* //
