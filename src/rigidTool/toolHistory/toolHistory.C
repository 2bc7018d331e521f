// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "toolHistory.H"


#include <algorithm>

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::toolHistory::toolHistory(
    entryReader& read,
    const scalar start,
    const scalar end
)
{
    const bool constant = read.has("speed");

    if (constant == read.has("history"))
    {
        FatalIOErrorInFunction(read.dict())
            << "Entries 'speed' and 'history': "
            << (constant ? "both are" : "neither is")
            << " there; valid is one of them: speed v; or history ((t v) ...)"
            << exit(FatalIOError);
    }

    if (constant)
    {
        const scalar first = min(start, scalar(0));
        t_ = scalarList({first, max(end, first) + 1});
        v_ = scalarList(
            2, read.number("speed", "of the tool [m/s]", entryReader::anything)
        );
        s_ = scalarList({first * v_[0], t_[1] * v_[0]});
        return;
    }

    const List<Tuple2<scalar, scalar>> points(
        read.table("history", "time [s], speed [m/s]")
    );

    t_.resize(points.size());
    v_.resize(points.size());
    s_.resize(points.size());

    forAll(points, k)
    {
        t_[k] = points[k].first();
        v_[k] = points[k].second();

        if (k == 0)
        {
            s_[k] = 0;
            continue;
        }

        s_[k] = s_[k - 1] + 0.5 * (v_[k - 1] + v_[k]) * (t_[k] - t_[k - 1]);
    }

    const scalar slack = 1e-9 * (mag(end) + mag(start));

    if (t_.first() > start + slack || t_.last() < end - slack)
    {
        FatalIOErrorInFunction(read.dict())
            << "Entry 'history' goes from t = " << t_.first() << " s to "
            << t_.last() << " s and does not cover the run, " << start
            << " s to " << end << " s; valid is a table that does"
            << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::toolHistory::travel(const scalar t) const
{
    if (t <= t_.first())
    {
        return s_.first();
    }
    if (t >= t_.last())
    {
        return s_.last();
    }

    const label k =
        label(std::upper_bound(t_.begin(), t_.end(), t) - t_.begin()) - 1;

    const scalar dt = t - t_[k];
    const scalar slope = (v_[k + 1] - v_[k]) / (t_[k + 1] - t_[k]);

    return s_[k] + dt * (v_[k] + 0.5 * slope * dt);
}


void Foam::toolHistory::extremes(
    const scalar start,
    const scalar end,
    scalar& smallest,
    scalar& largest
) const
{
    smallest = min(travel(start), travel(end));
    largest = max(travel(start), travel(end));

    auto visit = [&](const scalar t)
    {
        if (t > start && t < end)
        {
            smallest = min(smallest, travel(t));
            largest = max(largest, travel(t));
        }
    };

    forAll(t_, k)
    {
        visit(t_[k]);

        // Where the tool turns round
        if (k > 0 && v_[k - 1] * v_[k] < 0)
        {
            visit(
                t_[k - 1]
                + (t_[k] - t_[k - 1]) * v_[k - 1] / (v_[k - 1] - v_[k])
            );
        }
    }
}


// ************************************************************************* //
