// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "axialTable.H"

#include <algorithm>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::axialTable::interpolationType>
    Foam::axialTable::interpolationTypeNames({
        {interpolationType::linear, "linear"},
        {interpolationType::monotoneCubic, "monotoneCubic"},
    });


// * * * * * * * * * * * * * Local Helper Functions  * * * * * * * * * * * * //

namespace
{

// Slope at an end, from the spacing h0 and secant d0 of the interval at the
// end and those of its neighbour
Foam::scalar endSlope(
    const Foam::scalar h0,
    const Foam::scalar h1,
    const Foam::scalar d0,
    const Foam::scalar d1
)
{
    const Foam::scalar slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);

    if (slope * d0 <= 0)
    {
        return 0;
    }

    if (d0 * d1 <= 0 && Foam::mag(slope) > 3 * Foam::mag(d0))
    {
        return 3 * d0;
    }

    return slope;
}

} // End anonymous namespace


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::axialTable::setSlopes()
{
    const label n = x_.size();

    scalarList h(n - 1);
    scalarList d(n - 1);

    for (label k = 0; k < n - 1; ++k)
    {
        h[k] = x_[k + 1] - x_[k];
        d[k] = (y_[k + 1] - y_[k]) / h[k];
    }

    slope_.resize(n);

    if (n == 2)
    {
        slope_ = d[0];
        return;
    }

    for (label k = 1; k < n - 1; ++k)
    {
        if (d[k - 1] * d[k] <= 0)
        {
            slope_[k] = 0;
        }
        else
        {
            const scalar w1 = 2 * h[k] + h[k - 1];
            const scalar w2 = h[k] + 2 * h[k - 1];

            slope_[k] = (w1 + w2) / (w1 / d[k - 1] + w2 / d[k]);
        }
    }

    slope_[0] = endSlope(h[0], h[1], d[0], d[1]);
    slope_[n - 1] = endSlope(h[n - 2], h[n - 3], d[n - 2], d[n - 3]);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::axialTable::axialTable(
    const List<Tuple2<scalar, scalar>>& points,
    const interpolationType interpolation
) :
    x_(points.size()),
    y_(points.size()),
    slope_(),
    interpolation_(interpolation)
{
    forAll(points, k)
    {
        x_[k] = points[k].first();
        y_[k] = points[k].second();
    }

    if (interpolation_ == monotoneCubic)
    {
        setSlopes();
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::axialTable::value(const scalar x) const
{
    if (x <= x_.first())
    {
        return y_.first();
    }

    if (x >= x_.last())
    {
        return y_.last();
    }

    const label k =
        label(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin()) - 1;

    const scalar h = x_[k + 1] - x_[k];
    const scalar s = (x - x_[k]) / h;

    if (interpolation_ == linear)
    {
        return (1 - s) * y_[k] + s * y_[k + 1];
    }

    const scalar d = (y_[k + 1] - y_[k]) / h;

    // Horner form of the cubic in x - x_k
    const scalar c2 = (3 * d - 2 * slope_[k] - slope_[k + 1]) / h;
    const scalar c3 = (slope_[k] + slope_[k + 1] - 2 * d) / sqr(h);
    const scalar dx = x - x_[k];

    return y_[k] + dx * (slope_[k] + dx * (c2 + dx * c3));
}


// ************************************************************************* //
