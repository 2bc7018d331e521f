// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "coulombFriction.H"
#include "addToRunTimeSelectionTable.H"

namespace Foam
{
defineTypeNameAndDebug(coulombFriction, 0);
addToRunTimeSelectionTable(frictionLaw, coulombFriction, dictionary);
}


Foam::coulombFriction::coulombFriction(const dictionary& dict) :
    coulombFriction(entryReader(dict))
{}


Foam::coulombFriction::coulombFriction(entryReader read) :
    mu_(
        read.number("mu", "friction coefficient [-]", entryReader::nonNegative)
    ),
    g0_(read.number(
        "elasticSlip",
        "slip at which sticking ends [m]",
        entryReader::positive,
        1e-5
    ))
{
    read.require("type", "the law");
    read.rejectOthers();
}


void Foam::coulombFriction::factor(
    const scalar pn,
    const scalar slip,
    scalar& f,
    scalar& dfdpn,
    scalar& dfdslip
) const
{
    dfdpn = mu_ / max(slip, g0_);
    f = dfdpn * pn;
    dfdslip = slip > g0_ ? -f / slip : 0;
}


void Foam::coulombFriction::write(Ostream& os) const
{
    os.beginBlock("friction");
    os.writeEntry("type", type());
    os.writeEntry("mu", mu_);
    os.writeEntry("elasticSlip", g0_);
    os.endBlock();
}

// ************************************************************************* //
