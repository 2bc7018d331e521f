// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "HerschelBulkleyFlowStress.H"

#include "addToRunTimeSelectionTable.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace flowStresses
{
defineTypeNameAndDebug(HerschelBulkleyFlowStress, 0);
addToRunTimeSelectionTable(flowStress, HerschelBulkleyFlowStress, dictionary);
}
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::flowStresses::HerschelBulkleyFlowStress::HerschelBulkleyFlowStress(
    const dictionary& dict
)
{
    entryReader read(dict);
    read.has("type");

    sigma0_ = read.number(
        "sigma0", "uniaxial yield stress [Pa]", entryReader::nonNegative
    );
    k_ = read.number("k", "consistency [Pa s^n]", entryReader::nonNegative);
    n_ = read.number("n", "exponent [-]", {0, false, 5, true});

    read.rejectOthers();
}


// * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * * //

Foam::scalar Foam::flowStresses::HerschelBulkleyFlowStress::value(
    const scalar rate,
    const scalar
) const
{
    return sigma0_ + k_ * std::pow(rate, n_);
}


Foam::scalar Foam::flowStresses::HerschelBulkleyFlowStress::dRate(
    const scalar rate,
    const scalar
) const
{
    return k_ * n_ * std::pow(std::max(rate, scalar(1e-100)), n_ - 1);
}


Foam::scalar Foam::flowStresses::HerschelBulkleyFlowStress::dEpsP(
    const scalar,
    const scalar
) const
{
    return 0;
}


// ************************************************************************* //
