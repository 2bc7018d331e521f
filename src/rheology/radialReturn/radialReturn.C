// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "radialReturn.H"

#include "error.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::radialReturn::radialReturn(const flowStress& flow, const scalar G) :
    flow_(flow),
    G_(G)
{}


// * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * * //

Foam::radialReturn::result Foam::radialReturn::solve(
    const scalar qTrial,
    const scalar epsPOld,
    const scalar dt,
    const scalar strengthFactor
) const
{
    const scalar excess = qTrial - strengthFactor * flow_.value(0, epsPOld);

    if (excess <= 0)
    {
        return {qTrial, 1, 0};
    }

    const scalar slopeElastic = 3 * G_ * dt;

    // Roundoff of the residual; all its terms are below qTrial at the root
    const scalar tolerance = 1e-14 * qTrial;

    // Bracket of the rate. With a law that does not soften, the residual is
    // < 0 at the lower end and >= 0 at the upper end.
    scalar lower = 0;
    scalar upper = excess / slopeElastic;

    scalar rate = upper;
    scalar flow = 0;
    scalar slopeFlow = 0;
    scalar lastResidual = VGREAT;

    // The bisections alone would end it within 200 iterations (100 to find a
    // lower end among all doubles, 10 for the exponent, 52 for the mantissa);
    // in practice it is below 10
    for (label iter = 0; iter < 200; ++iter)
    {
        const scalar epsP = epsPOld + rate * dt;

        flow = strengthFactor * flow_.value(rate, epsP);
        slopeFlow = strengthFactor
            * (flow_.dRate(rate, epsP) + dt * flow_.dEpsP(rate, epsP));

        const scalar residual = flow + slopeElastic * rate - qTrial;
        const scalar slope = slopeFlow + slopeElastic;

        if (std::abs(residual) <= tolerance)
        {
            break;
        }

        (residual < 0 ? lower : upper) = rate;

        if (upper - lower <= 1e-15 * upper)
        {
            break;
        }

        scalar next = rate - residual / slope;

        if (residual > 0 && next < 0.2 * rate)
        {
            // Newton's method for the same residual as a function of ln rate
            next = rate * std::exp(-residual / (slope * rate));
        }

        const bool gainsLittle =
            iter > 4 && std::abs(residual) > 0.2 * lastResidual;

        if (gainsLittle || !(next > lower && next < upper))
        {
            // Bisect the exponent while the bracket spans decades
            next = lower == 0       ? 1e-3 * upper
                : upper > 4 * lower ? std::sqrt(lower) * std::sqrt(upper)
                                    : 0.5 * (lower + upper);
        }

        lastResidual = std::abs(residual);
        rate = next;
    }

    // Both sides give q; take the one that amplifies the error of rate less
    const scalar q =
        slopeFlow < slopeElastic ? flow : qTrial - slopeElastic * rate;

    return {q, slopeFlow / (slopeFlow + slopeElastic), rate * dt};
}


// ************************************************************************* //
