// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "weightedSample.H"
#include "ListOps.H"
#include "Pstream.H"
#include "PstreamReduceOps.H"
#include "Tuple2.H"

Foam::weightedSample::weightedSample(
    const scalarUList& values,
    const scalarUList& weights
)
{
    using sample = Tuple2<scalar, scalar>;
    List<sample> all(values.size());
    forAll(all, i) all[i] = sample(values[i], weights[i]);
    reduce(
        all,
        [](const List<sample>& a, const List<sample>& b)
        {
            List<sample> both(a);
            both.append(b);
            return both;
        }
    );
    sort(all);

    values_.setSize(all.size());
    sums_.setSize(all.size());
    scalar sum = 0;
    forAll(all, i)
    {
        values_[i] = all[i].first();
        sums_[i] = (sum += all[i].second());
    }
}


Foam::scalar Foam::weightedSample::quantile(const scalar part) const
{
    if (values_.empty()) return 0;

    label i = 0;
    while (i < sums_.size() - 1 && sums_[i] < part * sums_.last()) ++i;
    return values_[i];
}

// ************************************************************************* //
