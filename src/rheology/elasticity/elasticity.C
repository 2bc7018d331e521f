// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "elasticity.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::elasticity::elasticity(const dictionary& dict)
{
    entryReader read(dict);

    // The bound keeps squares of it within what a computer counts
    E_ = read.number("E", "Young's modulus [Pa]", {0, false, 1e12, true});
    nu_ = read.number("nu", "Poisson's ratio [-]", {0, true, 0.5, false});

    const wordList rates({"Jaumann", "logarithmic"});
    logarithmic_ =
        read.choice(
            "objectiveRate", "rate of the stress that turns", rates, "Jaumann"
        )
        == "logarithmic";

    read.rejectOthers();
}


// ************************************************************************* //
