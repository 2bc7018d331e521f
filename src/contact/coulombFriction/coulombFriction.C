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
    mu_(dict.get<scalar>("mu")),
    g0_(dict.lookupOrDefault<scalar>("elasticSlip", 1e-5))
{
    if (mu_ < 0)
    {
        FatalIOErrorInFunction(dict)
            << "entry mu: " << mu_ << " is no friction coefficient;"
            << " valid are numbers >= 0" << exit(FatalIOError);
    }
    if (g0_ <= 0)
    {
        FatalIOErrorInFunction(dict)
            << "entry elasticSlip: " << g0_ << " m; valid are numbers > 0"
            << exit(FatalIOError);
    }
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
