// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "weightedSample.H"
#include "ListListOps.H"
#include "ListOps.H"
#include "Pstream.H"

Foam::weightedSample::weightedSample(
    const scalarUList& values,
    const scalarUList& weights
)
{
    List<scalarList> all(Pstream::nProcs());
    List<scalarList> allWeights(Pstream::nProcs());
    all[Pstream::myProcNo()] = values;
    allWeights[Pstream::myProcNo()] = weights;
    Pstream::gatherList(all);
    Pstream::gatherList(allWeights);
    Pstream::scatterList(all);
    Pstream::scatterList(allWeights);

    const scalarList unsorted(
        ListListOps::combine<scalarList>(all, accessOp<scalarList>())
    );
    const scalarList weight(
        ListListOps::combine<scalarList>(allWeights, accessOp<scalarList>())
    );
    labelList order;
    sortedOrder(unsorted, order);
    values_.setSize(order.size());
    sums_.setSize(order.size());
    scalar sum = 0;
    forAll(order, i)
    {
        values_[i] = unsorted[order[i]];
        sums_[i] = (sum += weight[order[i]]);
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
