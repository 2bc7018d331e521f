// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "caseScales.H"
#include "elastoViscoPlastic.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::caseScales::caseScales(
    const dictionary& controlDict,
    const elastoViscoPlastic& law
) :
    strainRate_(readStrainRate(controlDict)),
    stress_(min(law.flow().value(strainRate_, 1), 0.096 * law.elastic().E()))
{
    if (!(stress_ > 0))
    {
        FatalErrorInFunction
            << "the flow stress at strainRate " << strainRate_
            << " /s and a plastic strain of 1 is " << stress_
            << " Pa; valid is a law with a flow stress > 0 there"
            << exit(FatalError);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::caseScales::readStrainRate(const dictionary& controlDict)
{
    const scalar rate = controlDict.lookupOrDefault<scalar>("strainRate", 0.1);
    if (!(rate > 0))
    {
        FatalIOErrorInFunction(controlDict)
            << "entry strainRate: " << rate << "; valid are numbers > 0 [1/s]"
            << exit(FatalIOError);
    }
    return rate;
}

// ************************************************************************* //
