// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "flowStress.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
defineTypeNameAndDebug(flowStress, 0);
defineRunTimeSelectionTable(flowStress, dictionary);
}


// * * * * * * * * * * * * * * * * * Selector  * * * * * * * * * * * * * * * //

Foam::autoPtr<Foam::flowStress> Foam::flowStress::New(
    const dictionary& bolusDict
)
{
    const dictionary& dict = entryReader::subDictionary(
        bolusDict, typeName, "flow stress law, { type ...; }"
    );

    const word modelType = entryReader(dict).choice(
        "type", "flow stress law", dictionaryConstructorTablePtr_->sortedToc()
    );

    return (*dictionaryConstructorTablePtr_->cfind(modelType))(dict);
}


// ************************************************************************* //
