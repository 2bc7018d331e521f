// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "elastoViscoPlastic.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::elastoViscoPlastic::elastoViscoPlastic(
    const dictionary& bolusProperties
) :
    rho_(entryReader(bolusProperties)
            .number("rho", "density [kg/m3]", entryReader::positive)),
    elastic_(
        entryReader::subDictionary(
            bolusProperties,
            "elasticity",
            "{ E ... [Pa]; nu ...; }"
        )
    ),
    flow_(flowStress::New(bolusProperties)),
    damage_(damageModel::New(bolusProperties)),
    return_(*flow_, elastic_.G())
{}


// ************************************************************************* //
