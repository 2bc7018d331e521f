// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "pressureElimination.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::pressureElimination::pressureElimination(
    const laminate& mixture,
    entryReader& read
) :
    mixture_(mixture),
    closingPressure_(read.number(
        "closingPressure",
        "to which one iteration may close a gas [Pa]",
        entryReader::nonNegative,
        0
    )),
    eliminateAbove_(read.number(
        "eliminateAbove",
        "from which on pressure is found cell by cell [-]",
        entryReader::nonNegative,
        0
    )),
    from_(eliminateAbove_)
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::pressureElimination::solve(
    const label c,
    const tensor& gradU,
    const scalar dilation,
    const scalar given,
    const scalar residual
) const
{
    scalar p = given;
    scalar lower = -GREAT;
    scalar upper = GREAT;
    laminate::result r;
    laminate::derivative d;
    for (label i = 0; i < 50; ++i)
    {
        mixture_.evaluate(c, gradU, dilation, p, r);
        if (mag(r.residual) < residual) break;

        // The residual grows with the pressure
        (r.residual < 0 ? lower : upper) = p;

        mixture_.deriveToPressure(c, r, d);
        scalar next = p - r.residual / (d.growth + r.slope * d.pv);
        if (!(next > lower && next < upper)) next = 0.5 * (lower + upper);
        if (next == p) break;
        p = next;
    }

    // Where the gas is used up it would rise without bounds
    if (r.pv > closingPressure_)
    {
        p = max(given, p - (r.pv - closingPressure_));
    }
    return p;
}


void Foam::pressureElimination::extrapolate(
    const label c,
    const laminate::result& r,
    scalar& slope,
    scalar& excess
) const
{
    slope = r.slope;
    excess = 0;
    if (r.growth >= 0) return;

    const surroundingPhase& medium = mixture_.medium();
    const scalar a = mixture_.alphaEff(c);
    const scalar pv = medium.closingPressure(c, a, -r.growth, closingPressure_);
    // Nearer than that, the tangent leads there in one or two iterations
    if (pv <= 3 * max(r.pv, scalar(0))) return;

    scalar rate;
    medium.shrinking(c, a, pv, rate, slope);
    excess = r.growth + rate + slope * (r.pv - pv) - r.residual;
}

// ************************************************************************* //
