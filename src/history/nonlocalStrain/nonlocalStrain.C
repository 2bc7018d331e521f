// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "nonlocalStrain.H"

#include "fvMatrices.H"
#include "gaussLaplacianScheme.H"
#include "harmonic.H"
#include "zeroGradientFvPatchFields.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::nonlocalStrain::nonlocalStrain(const fvMesh& mesh, const scalar length) :
    length_(length),
    average_(
        IOobject(
            "nonlocalStrain",
            mesh.time().timeName(),
            mesh,
            IOobject::READ_IF_PRESENT,
            IOobject::AUTO_WRITE
        ),
        mesh,
        dimensionedScalar("e", dimless, 0.0),
        zeroGradientFvPatchScalarField::typeName
    )
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

const Foam::volScalarField& Foam::nonlocalStrain::update(
    const scalarField& sound,
    const scalarField& strain
)
{
    const fvMesh& mesh = average_.mesh();

    // Cells without sound bolus keep a row of their own
    const scalar nothing = 1e-9;

    volScalarField weight(
        IOobject("soundBolus", mesh.time().timeName(), mesh),
        mesh,
        dimensionedScalar("w", dimless, 0.0),
        zeroGradientFvPatchScalarField::typeName
    );
    weight.primitiveFieldRef() = max(sound, scalar(0)) + nothing;
    weight.correctBoundaryConditions();

    const surfaceScalarField conductance(
        "l2w",
        dimensionedScalar("l2", dimArea, sqr(length_))
            * harmonic(mesh).interpolate(weight) * mesh.magSf()
    );

    fvScalarMatrix equation(
        fv::gaussLaplacianScheme<scalar, scalar>::fvmLaplacianUncorrected(
            conductance, mesh.nonOrthDeltaCoeffs(), average_
        )
    );
    equation.negate();
    equation.diag() += weight.primitiveField() * mesh.V();
    equation.source() += max(sound, scalar(0)) * strain * mesh.V();

    dictionary control;
    control.add("solver", word("PCG"));
    control.add("preconditioner", word("DIC"));
    control.add("tolerance", scalar(1e-10));
    control.add("relTol", scalar(0));
    equation.solve(control);

    forAll(average_, c)
    {
        if (sound[c] <= 0) average_[c] = 0;
    }
    average_.correctBoundaryConditions();

    return average_;
}

// ************************************************************************* //
