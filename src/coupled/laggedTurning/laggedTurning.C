// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "laggedTurning.H"
#include "Time.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::laggedTurning::laggedTurning(
    const Time& time,
    const caseScales& scales,
    entryReader& read
) :
    below_(read.number(
        "lagTurningBelow",
        "longest step whose turning of the stress may be lagged [s]",
        entryReader::nonNegative,
        1e-3 * scales.time()
    )),
    most_(read.wholeNumber(
        "lagTurningSteps",
        "most steps in a row whose turning of the stress is lagged",
        {least_, true, 1e5, true},
        least_
    )),
    memory_(IOobject(
        "coupledSystem",
        time.timeName(),
        "uniform",
        time,
        IOobject::READ_IF_PRESENT,
        IOobject::AUTO_WRITE
    )),
    row_(memory_.lookupOrDefault<label>("turnLaterRow", 0)),
    left_(memory_.lookupOrDefault<label>("turnLater", 0)),
    now_(false)
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::laggedTurning::begin()
{
    const label least = least_;
    now_ = true;
    row_ = min(max(2 * row_, least), most_);
    left_ = row_;
}


void Foam::laggedTurning::accept()
{
    if (now_)
    {
        --left_;
    }
    else
    {
        row_ = 0;
    }
    memory_.set("turnLaterRow", row_);
    memory_.set("turnLater", left_);
}

// ************************************************************************* //
