// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "weightedSample.H"
#include "ListOps.H"
#include "Pstream.H"
#include "PstreamReduceOps.H"
#include "Tuple2.H"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace
{

// Numbers in the order of the values that they stand for
std::uint64_t rank(const double value)
{
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    const std::uint64_t sign = std::uint64_t(1) << 63;
    return bits & sign ? ~bits : bits | sign;
}


double ranked(std::uint64_t bits)
{
    const std::uint64_t sign = std::uint64_t(1) << 63;
    bits = bits & sign ? bits & ~sign : ~bits;
    double value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
}

} // End anonymous namespace


Foam::weightedSample::weightedSample(
    const scalarUList& values,
    const scalarUList& weights
)
{
    using sample = Tuple2<scalar, scalar>;
    List<sample> all(values.size());
    forAll(all, i) all[i] = sample(values[i], weights[i]);
    sort(all);

    values_.setSize(all.size());
    sums_.setSize(all.size());
    scalar sum = 0;
    forAll(all, i)
    {
        values_[i] = all[i].first();
        sums_[i] = (sum += all[i].second());
    }

    total_ = returnReduce(sum, sumOp<scalar>());
    least_ = values_.empty() ? GREAT : values_.first();
    most_ = values_.empty() ? -GREAT : values_.last();
    reduce(least_, minOp<scalar>());
    reduce(most_, maxOp<scalar>());
}


Foam::scalar Foam::weightedSample::weightTo(const scalar value) const
{
    const label n = std::upper_bound(values_.begin(), values_.end(), value)
        - values_.begin();
    return returnReduce(n > 0 ? sums_[n - 1] : 0, sumOp<scalar>());
}


Foam::scalar Foam::weightedSample::quantile(const scalar part) const
{
    if (least_ > most_) return 0;

    // The least value that has the weight: found by halves of the range of
    // numbers, in 64 sums at most, and exactly
    std::uint64_t low = rank(least_);
    std::uint64_t high = rank(most_);
    while (low < high)
    {
        const std::uint64_t middle = low + (high - low) / 2;
        if (weightTo(ranked(middle)) < part * total_)
        {
            low = middle + 1;
        }
        else
        {
            high = middle;
        }
    }
    return ranked(high);
}

// ************************************************************************* //
