// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "inertia.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
defineTypeNameAndDebug(inertia, 0);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::inertia::inertia(const nodalSpace& space, entryReader& read) :
    cellForce(space),
    densityScale_(read.number(
        "inertia",
        "density scale of inertia [-]",
        entryReader::nonNegative,
        0
    ))
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::inertia::start(const stepStart& now)
{
    if (densityScale_ == 0) return;
    UOld_ = now.U;
    pointMass_.setSize(now.mass.size());
    forAll(pointMass_, c)
    {
        pointMass_[c] = densityScale_ * now.rhoBolus * now.mass[c]
            * space_.V()[c] / space_.mesh().cellPoints()[c].size() / now.deltaT;
    }
}


void Foam::inertia::add(
    const label c,
    const scalarField& q,
    UList<scalar>& R,
    scalarField* J
) const
{
    if (densityScale_ == 0 || pointMass_[c] == 0) return;

    const label n = R.size();
    const label* dof = &space_.cellDofs()[space_.cellStart()[c]];
    const scalar m = pointMass_[c];
    for (const label p : space_.mesh().cellPoints()[c])
    {
        const label s = space_.slot(c, space_.pointNode()[p]);
        for (label k = 0; k < space_.nd(); ++k)
        {
            R[s + k] += m * (q[dof[s + k]] - (UOld_[c] & space_.shape(p, k)));
            if (J) (*J)[(s + k) * (n + 1) + s + k] += m;
        }
    }
}

// ************************************************************************* //
