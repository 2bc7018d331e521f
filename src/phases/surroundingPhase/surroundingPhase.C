// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "surroundingPhase.H"
#include "entryReader.H"

namespace Foam
{
defineTypeNameAndDebug(surroundingPhase, 0);
defineRunTimeSelectionTable(surroundingPhase, dictionary);
}

// * * * * * * * * * * * * * * * * Selectors * * * * * * * * * * * * * * * * //

Foam::autoPtr<Foam::surroundingPhase> Foam::surroundingPhase::New(
    const dictionary& bolusProperties,
    const caseScales& scales
)
{
    if (bolusProperties.found("void"))
    {
        FatalIOErrorInFunction(bolusProperties)
            << "Entry 'void' is now called gasCoeffs" << exit(FatalIOError);
    }

    const wordList names(
        bolusProperties.lookupOrDefault<wordList>("phases", {"bolus", "gas"})
    );
    const wordList valid(dictionaryConstructorTablePtr_->sortedToc());
    if (names.size() != 2 || names[0] != "bolus"
        || !dictionaryConstructorTablePtr_->found(names[1]))
    {
        FatalIOErrorInFunction(bolusProperties)
            << "Entry 'phases' is " << names << "; valid is (bolus X), with one"
            << " of " << valid << " for X" << exit(FatalIOError);
    }

    const word& name = names[1];
    return dictionaryConstructorTablePtr_->cfind(name).val()(
        bolusProperties.subOrEmptyDict(name + "Coeffs"), scales
    );
}

// ************************************************************************* //
