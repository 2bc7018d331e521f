// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "hourglass.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
defineTypeNameAndDebug(hourglass, 0);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::hourglass::hourglass(const nodalSpace& space, entryReader& read) :
    cellForce(space),
    coefficient_(read.number(
        "hourglass",
        "hourglass control [-]",
        entryReader::nonNegative,
        0.05
    ))
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::hourglass::start(const stepStart& now)
{
    eta_ = coefficient_ * now.stiffness;
}


void Foam::hourglass::add(
    const label c,
    const scalarField& q,
    UList<scalar>& R,
    scalarField* J
) const
{
    const label n = R.size();
    const label* dof = &space_.cellDofs()[space_.cellStart()[c]];
    const scalar* H = &space_.hourglass()[space_.hourglassStart()[c]];
    const scalar kappa = eta_[c] * space_.hourglassScale()[c];
    for (label i = 0; i < n; ++i)
    {
        for (label j = 0; j < n; ++j) R[i] += kappa * H[i * n + j] * q[dof[j]];
    }
    if (!J) return;
    for (label i = 0; i < n; ++i)
    {
        for (label j = 0; j < n; ++j)
        {
            (*J)[i * (n + 1) + j] += kappa * H[i * n + j];
        }
    }
}

// ************************************************************************* //
