// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "voidLaw.H"
#include "entryReader.H"

Foam::voidLaw::voidLaw(const dictionary& dict, const scalar strainRate)
{
    // Viscosities of the defaults are made for 0.1/s
    const scalar slow = 0.1 / strainRate;

    entryReader read(dict);
    const entryReader::interval& positive = entryReader::positive;

    zeta_ = read.number("zeta", "volumetric viscosity [Pa s]", positive, 20 * slow);
    eta_ = read.number("eta", "shear viscosity [Pa s]", positive, slow);
    etaDamaged_ = read.number(
        "etaDamaged",
        "shear viscosity of damaged bolus [Pa s]",
        positive,
        20 * slow
    );
    seal_ = read.number(
        "seal",
        "void fraction that bolus tolerates [-]",
        {0, false, 0.4, true},
        0.4
    );
    closing_ = read.number(
        "closing",
        "largest part of the void closed in a step [-]",
        {0, false, 1, true},
        0.5
    );
    delta_ = read.number(
        "delta", "rounding of the contact's corner [Pa]", positive, 2
    );
    cohesion_ = read.number(
        "cohesion",
        "tension that damaged bolus holds [Pa]",
        entryReader::nonNegative,
        0
    );
    read.rejectOthers();
}

// ************************************************************************* //
