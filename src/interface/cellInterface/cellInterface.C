// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "cellInterface.H"
#include "caseScales.H"
#include "entryReader.H"
#include "fvcGrad.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cellInterface::cellInterface(
    const nodalSpace& space,
    const boolList& separates,
    const caseScales& scales,
    entryReader& read
) :
    space_(space),
    interfaceJump_(read.number(
        "interfaceJump",
        "of alpha at an interface [-]",
        {0, false, 1, true},
        0.2
    )),
    partingTension_(read.number(
        "partingTension",
        "tension at which a wall cell parts from the wall [Pa]",
        entryReader::nonNegative,
        0.1 * scales.stressRatio()
    )),
    separates_(separates),
    sharpness_(space.mesh().nCells(), Zero),
    N_(space.mesh().nCells(), Zero)
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::cellInterface::update(
    const volScalarField& alpha,
    const volSymmTensorField& stress
)
{
    const volVectorField gradAlpha(fvc::grad(alpha));
    forAll(N_, c)
    {
        vector n = gradAlpha[c];
        if (space_.nd() == 2) n -= (n & space_.normal()) * space_.normal();
        const scalar magN = mag(n);
        const scalar h = space_.cellSize(c, n / max(magN, VSMALL));
        scalar sharp = min(magN * h / interfaceJump_, scalar(1));
        sharpness_[c] = sharp;

        const vector& nw = space_.cellWallNormal()[c];
        const bool wall = atWall(c);
        if (wall && (nw & stress[c] & nw) > partingTension_) sharp = 0;
        const symmTensor interface =
            magN > SMALL ? sqr(n / magN) : symmTensor(Zero);
        const symmTensor otherwise =
            wall ? sqr(nw) : symmTensor((1.0 / 3.0) * symmTensor::I);
        N_[c] = sharp * interface + (1 - sharp) * otherwise;
    }
}

// ************************************************************************* //
