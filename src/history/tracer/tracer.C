// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "tracer.H"

#include "addToRunTimeSelectionTable.H"
#include "entryReader.H"

namespace Foam
{
namespace carriedFieldTypes
{
defineTypeNameAndDebug(tracer, 0);
addToRunTimeSelectionTable(carriedField, tracer, dictionary);

//- The value of the start
static scalar start(const dictionary& coeffs)
{
    entryReader read(coeffs);
    read.has("type");
    const scalar value = read.number(
        "start",
        "where the start time lacks the field [-]",
        entryReader::anything,
        0
    );
    read.rejectOthers();
    return value;
}
}
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::carriedFieldTypes::tracer::tracer(
    const word& name,
    const dictionary& coeffs,
    bolusState& bolus
) :
    carriedField(name, dimless, start(coeffs), bolus)
{}

// ************************************************************************* //
