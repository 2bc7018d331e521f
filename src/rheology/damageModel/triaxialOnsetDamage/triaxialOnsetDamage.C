// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "triaxialOnsetDamage.H"

#include "addToRunTimeSelectionTable.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace damageModels
{
defineTypeNameAndDebug(triaxialOnsetDamage, 0);
addToRunTimeSelectionTable(damageModel, triaxialOnsetDamage, dictionary);
}
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::damageModels::triaxialOnsetDamage::triaxialOnsetDamage(
    const dictionary& dict
)
{
    entryReader read(dict);
    read.has("type");

    epsilonPEq0_ = read.number(
        "epsilonPEq0", "plastic strain at onset [-]", entryReader::nonNegative
    );
    eta0_ = read.number(
        "eta0", "triaxiality at onset [-]", entryReader::nonNegative
    );
    residualStrength_ = read.number(
        "residualStrength",
        "flow stress of damaged over that of intact material [-]",
        {0, false, 1, true},
        1e-4
    );
    tensileStrain_ = read.number(
        "tensileStrain",
        "plastic strain that has to come under tension [-]",
        entryReader::nonNegative,
        0
    );
    nonlocalLength_ = read.number(
        "nonlocalLength",
        "length over which the plastic strain is averaged [m]",
        entryReader::nonNegative,
        0
    );

    read.rejectOthers();
}


// ************************************************************************* //
