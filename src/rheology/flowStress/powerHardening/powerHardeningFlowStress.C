// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "powerHardeningFlowStress.H"

#include "addToRunTimeSelectionTable.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace flowStresses
{
defineTypeNameAndDebug(powerHardeningFlowStress, 0);
addToRunTimeSelectionTable(flowStress, powerHardeningFlowStress, dictionary);
}
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::flowStresses::powerHardeningFlowStress::powerHardeningFlowStress(
    const dictionary& dict
)
{
    entryReader read(dict);
    read.has("type");

    sigmaY_ = read.number(
        "sigmaY", "initial yield stress [Pa]", entryReader::nonNegative
    );
    H_ = read.number("H", "hardening modulus [Pa]", entryReader::nonNegative);
    m_ = read.number("m", "exponent [-]", {0, false, 5, true});
    hardensUntil_ = read.number(
        "hardensUntil",
        "plastic strain at which hardening ends [-]",
        entryReader::positive,
        GREAT
    );

    read.rejectOthers();
}


// * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * * //

Foam::scalar Foam::flowStresses::powerHardeningFlowStress::value(
    const scalar,
    const scalar epsP
) const
{
    const scalar hardening = std::min(std::max(epsP, scalar(0)), hardensUntil_);

    return sigmaY_ + H_ * std::pow(hardening, m_);
}


Foam::scalar Foam::flowStresses::powerHardeningFlowStress::dRate(
    const scalar,
    const scalar
) const
{
    return 0;
}


Foam::scalar Foam::flowStresses::powerHardeningFlowStress::dEpsP(
    const scalar,
    const scalar epsP
) const
{
    if (epsP > hardensUntil_)
    {
        return 0;
    }

    return H_ * m_ * std::pow(std::max(epsP, scalar(1e-100)), m_ - 1);
}


// ************************************************************************* //
