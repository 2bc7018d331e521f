// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "tabulatedFlowStress.H"

#include "Tuple2.H"
#include "addToRunTimeSelectionTable.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace flowStresses
{
defineTypeNameAndDebug(tabulatedFlowStress, 0);
addToRunTimeSelectionTable(flowStress, tabulatedFlowStress, dictionary);
}
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

inline Foam::label Foam::flowStresses::tabulatedFlowStress::interval(
    const scalar rate
) const
{
    // Tables are short: a linear search beats a bisection
    label i = rates_.size() - 1;
    while (i > 0 && rate < rates_[i])
    {
        --i;
    }

    return i;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::flowStresses::tabulatedFlowStress::tabulatedFlowStress(
    const dictionary& dict
)
{
    entryReader read(dict);
    read.has("type");

    read.requireList(
        "table",
        "list of (plastic strain rate [1/s], flow stress [Pa]) from rate 0 on"
    );
    const List<Tuple2<scalar, scalar>> table =
        dict.get<List<Tuple2<scalar, scalar>>>("table");

    logarithmic_ = read.choice(
                       "interpolation",
                       "interpolation in the rate",
                       wordList({"linear", "logarithmic"}),
                       "linear"
                   )
        == "logarithmic";

    read.rejectOthers();

    if (table.empty())
    {
        FatalIOErrorInFunction(dict)
            << "Entry table is empty; valid is a list of at least one point "
            << "(plastic strain rate [1/s], flow stress [Pa])"
            << exit(FatalIOError);
    }

    if (table[0].first() != 0)
    {
        FatalIOErrorInFunction(dict)
            << "Entry table begins at the rate " << table[0].first()
            << " 1/s; the first point must be at rate 0 (where plastic flow "
            << "begins)" << exit(FatalIOError);
    }

    rates_.setSize(table.size());
    stresses_.setSize(table.size());

    forAll(table, i)
    {
        rates_[i] = table[i].first();
        stresses_[i] = table[i].second();

        if (stresses_[i] < 0)
        {
            FatalIOErrorInFunction(dict)
                << "Entry table has the stress " << stresses_[i]
                << " Pa at point " << i << "; stresses must be >= 0"
                << exit(FatalIOError);
        }
        if (i > 0 && rates_[i] <= rates_[i - 1])
        {
            FatalIOErrorInFunction(dict)
                << "Entry table is not sorted: rate " << rates_[i]
                << " 1/s at point " << i << " follows " << rates_[i - 1]
                << "; rates must rise" << exit(FatalIOError);
        }
        if (i > 0 && stresses_[i] < stresses_[i - 1])
        {
            FatalIOErrorInFunction(dict)
                << "Entry table softens: stress " << stresses_[i]
                << " Pa at point " << i << " follows " << stresses_[i - 1]
                << "; stresses must not fall with the rate"
                << exit(FatalIOError);
        }
    }
}


// * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * * //

Foam::scalar Foam::flowStresses::tabulatedFlowStress::value(
    const scalar rate,
    const scalar
) const
{
    const label i = interval(rate);

    if (i == rates_.size() - 1)
    {
        return stresses_[i];
    }

    const scalar fraction = logarithmic_ && i > 0
        ? std::log(rate / rates_[i]) / std::log(rates_[i + 1] / rates_[i])
        : (rate - rates_[i]) / (rates_[i + 1] - rates_[i]);

    return stresses_[i] + fraction * (stresses_[i + 1] - stresses_[i]);
}


Foam::scalar Foam::flowStresses::tabulatedFlowStress::dRate(
    const scalar rate,
    const scalar
) const
{
    const label i = interval(rate);

    if (i == rates_.size() - 1)
    {
        return 0;
    }

    const scalar rise = stresses_[i + 1] - stresses_[i];

    return logarithmic_ && i > 0
        ? rise / (rate * std::log(rates_[i + 1] / rates_[i]))
        : rise / (rates_[i + 1] - rates_[i]);
}


Foam::scalar Foam::flowStresses::tabulatedFlowStress::dEpsP(
    const scalar,
    const scalar
) const
{
    return 0;
}


// ************************************************************************* //
