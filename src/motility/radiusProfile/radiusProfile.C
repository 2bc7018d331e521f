// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "radiusProfile.H"
#include "entryReader.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::axialTable Foam::radiusProfile::read(const dictionary& dict)
{
    entryReader read(dict);

    const axialTable table(
        read.table("radius", "x [m], radius of the wall there [m]"),
        read.choice(
            "interpolation",
            "curve between the points of the table",
            axialTable::interpolationTypeNames,
            axialTable::monotoneCubic
        )
    );
    read.rejectOthers();

    const scalarList& r = table.y();

    forAll(r, k)
    {
        const bool closedEnd = (k == 0 || k == r.size() - 1) && r[k] == 0;

        if (!(r[k] > 0) && !closedEnd)
        {
            FatalIOErrorInFunction(dict)
                << "Table 'radius' has the radius " << r[k]
                << " m at x = " << table.x()[k] << " m; valid are radii > 0"
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
