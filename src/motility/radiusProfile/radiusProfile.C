// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "radiusProfile.H"
#include "dictionaryCheck.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::axialTable Foam::radiusProfile::read(const dictionary& dict)
{
    dictionaryCheck::entries(dict, {"radius"}, {"interpolation"});

    const axialTable table(
        dict,
        "radius",
        dictionaryCheck::option(
            dict,
            "interpolation",
            axialTable::interpolationTypeNames,
            axialTable::monotoneCubic
        )
    );

    const scalarList& r = table.y();

    forAll(r, k)
    {
        const bool closedEnd = (k == 0 || k == r.size() - 1) && r[k] == 0;

        if (!(r[k] > 0) && !closedEnd)
        {
            FatalIOErrorInFunction(dict)
                << "Table 'radius' has the radius " << r[k]
                << " m at x = " << table.x()[k]
                << " m; a radius must be greater than 0"
                << " (only the first and the last may be 0)"
                << exit(FatalIOError);
        }
    }

    return table;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::radiusProfile::radiusProfile(const dictionary& dict) :
    radius_(read(dict))
{}


// ************************************************************************* //
