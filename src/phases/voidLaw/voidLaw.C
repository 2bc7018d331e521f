// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "voidLaw.H"
#include "entryReader.H"

Foam::voidLaw::voidLaw(const dictionary& dict, const caseScales& scales)
{
    entryReader read(dict);
    const entryReader::interval& positive = entryReader::positive;

    // What the entries are made for; without it they are as they stand
    scalar stress = 1;
    scalar viscosity = 1;
    if (read.has("madeFor"))
    {
        const dictionary& sub = entryReader::subDictionary(
            dict, "madeFor", "stress and strainRate that the entries are for"
        );
        entryReader of(sub);
        const caseScales made(
            of.number("strainRate", "that the entries are for [1/s]", positive),
            of.number("stress", "that the entries are for [Pa]", positive)
        );
        of.rejectOthers();
        stress = scales.stress() / made.stress();
        viscosity = stress * made.strainRate() / scales.strainRate();
    }
    const scalar s = scales.stressRatio() / stress;
    const scalar v = scales.viscosity() / viscosity;

    zeta_ = viscosity
        * read.number("zeta", "volumetric viscosity [Pa s]", positive, 20 * v);
    eta_ =
        viscosity * read.number("eta", "shear viscosity [Pa s]", positive, v);
    etaDamaged_ = viscosity
        * read.number(
            "etaDamaged",
            "shear viscosity of damaged bolus [Pa s]",
            positive,
            20 * v
        );
    delta_ = stress
        * read.number(
            "delta", "rounding of the contact's corner [Pa]", positive, 2 * s
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
    cohesion_ = read.number(
        "cohesion",
        "tension that damaged bolus holds [Pa]",
        entryReader::nonNegative,
        0
    );
    read.rejectOthers();
}

// ************************************************************************* //
