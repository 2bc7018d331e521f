// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "splitRotation.H"
#include "Time.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::splitRotation::splitRotation(
    const Time& time,
    const caseScales& scales,
    entryReader& read
) :
    below_(read.number(
        "splitRotationBelow",
        "longest step whose turning of the stress may be lagged [s]",
        entryReader::nonNegative,
        1e-3 * scales.time()
    )),
    most_(read.wholeNumber(
        "splitRotationSteps",
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
    now_(false),
    time_(time),
    step_(-1),
    rowBefore_(row_),
    leftBefore_(left_)
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::splitRotation::start(const scalar deltaT)
{
    if (time_.timeIndex() == step_)
    {
        row_ = rowBefore_;
        left_ = leftBefore_;
    }
    step_ = time_.timeIndex();
    rowBefore_ = row_;
    leftBefore_ = left_;
    now_ = left_ > 0 && deltaT <= below_;
}


void Foam::splitRotation::begin()
{
    const label least = least_;
    now_ = true;
    row_ = min(max(2 * row_, least), most_);
    left_ = row_;
}


void Foam::splitRotation::accept()
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
