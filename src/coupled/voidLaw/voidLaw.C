// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "voidLaw.H"

Foam::voidLaw::voidLaw(const dictionary& dict)
:
    zeta_(dict.lookupOrDefault<scalar>("zeta", 20)),
    eta_(dict.lookupOrDefault<scalar>("eta", 1)),
    etaDamaged_(dict.lookupOrDefault<scalar>("etaDamaged", 20)),
    seal_(dict.lookupOrDefault<scalar>("seal", 0.02)),
    closing_(dict.lookupOrDefault<scalar>("closing", 0.5)),
    delta_(dict.lookupOrDefault<scalar>("delta", 2))
{
    auto check = [&](const word& name, const scalar v, const scalar high)
    {
        if (!(v > 0) || v > high)
        {
            FatalIOErrorInFunction(dict)
                << "entry " << name << ": " << v << "; valid are numbers > 0"
                << (high < GREAT ? " and <= " + Foam::name(high) : string())
                << exit(FatalIOError);
        }
    };
    check("zeta", zeta_, GREAT);
    check("eta", eta_, GREAT);
    check("etaDamaged", etaDamaged_, GREAT);
    check("seal", seal_, 0.4);
    check("closing", closing_, 1);
    check("delta", delta_, GREAT);
}

// ************************************************************************* //
