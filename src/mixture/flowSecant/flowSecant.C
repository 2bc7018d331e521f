// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "flowSecant.H"
#include "entryReader.H"
#include "unitConversion.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::flowSecant::flowSecant(
    const laminate& mixture,
    const label nCells,
    entryReader& read
) :
    mixture_(mixture),
    sLast_(nCells, Zero)
{
    const scalar angle = read.number(
        "secantAngle",
        "by which the stress may turn between two iterations [degrees]",
        {0, true, 180, true},
        45
    );
    cos_ = angle < 180 ? std::cos(degToRad(angle)) : -GREAT;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::flowSecant::follow(
    const label c,
    const bool allowed,
    laminate::result& r
)
{
    // Without bolus there is no stress
    if (mixture_.alphaEff(c) <= SMALL) return;

    const scalar along = r.r.s && sLast_[c];
    const scalar norms = mag(r.r.s) * mag(sLast_[c]);
    sLast_[c] = r.r.s;

    if (allowed && r.r.dEpsP > 0 && along < cos_ * norms)
    {
        r.r.dqdqTrial = r.r.theta;
    }
}

// ************************************************************************* //
