// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "carriedField.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
defineTypeNameAndDebug(carriedField, 0);
defineRunTimeSelectionTable(carriedField, dictionary);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::carriedField::carriedField(
    const word& name,
    const dimensionSet& dims,
    const scalar start,
    bolusState& bolus
) :
    bolus_(bolus),
    q_(bolus.history.cells<scalar>(name, dims, start, historyVariable::CARRIED))
{}


// * * * * * * * * * * * * * * * * * Selector  * * * * * * * * * * * * * * * //

Foam::autoPtr<Foam::carriedField> Foam::carriedField::New(
    const word& name,
    const dictionary& coeffs,
    bolusState& bolus
)
{
    dictionary dict(coeffs);
    if (!dict.found("type")) dict.add("type", name);

    const word type = entryReader(dict).choice(
        "type",
        "what kind of field " + name + " is",
        dictionaryConstructorTablePtr_->sortedToc()
    );

    return (*dictionaryConstructorTablePtr_->cfind(type))(name, dict, bolus);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::carriedField::evolve(const scalar)
{}

// ************************************************************************* //
