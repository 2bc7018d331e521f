// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "bolusFields.H"

namespace Foam
{

//- A result of each step, which is written and read with the state
template<class Type>
static GeometricField<Type, fvPatchField, volMesh> result(
    const fvMesh& mesh,
    const word& name,
    const dimensionSet& dims,
    const word& patches
)
{
    return GeometricField<Type, fvPatchField, volMesh>(
        IOobject(
            name,
            mesh.time().timeName(),
            mesh,
            IOobject::READ_IF_PRESENT,
            IOobject::AUTO_WRITE
        ),
        mesh,
        dimensioned<Type>(name, dims, Zero),
        patches
    );
}

static IOobject transient(const fvMesh& mesh, const word& name)
{
    return IOobject(
        name,
        mesh.time().timeName(),
        mesh,
        IOobject::NO_READ,
        IOobject::NO_WRITE
    );
}

} // End namespace Foam


Foam::bolusFields::bolusFields(
    const fvMesh& mesh,
    const elastoViscoPlastic& law
) :
    bolusState(mesh, law.elastic().K()),
    mesh_(mesh),
    law_(law),
    sigmaEq(result<scalar>(mesh, "sigmaEq", dimPressure, "zeroGradient")),
    triaxiality(result<scalar>(mesh, "triaxiality", dimless, "zeroGradient")),
    wallForce(result<vector>(mesh, "wallForce", dimForce, "calculated")),
    wallPower(result<scalar>(mesh, "wallPower", dimPower, "calculated")),
    phi(transient(mesh, "phi"),
        mesh,
        dimensionedScalar("phi", dimVolume / dimTime, 0.0)),
    massFlux(
        transient(mesh, "massFlux"),
        mesh,
        dimensionedScalar("massFlux", dimVolume / dimTime, 0.0)
    )
{
    if (law.damage().nonlocalLength() > 0)
    {
        average_.reset(new nonlocalStrain(mesh, law.damage().nonlocalLength()));
    }
    derive();
}


void Foam::bolusFields::derive()
{
    forAll(alpha, c)
    {
        const bool bolus = alpha[c] > 0.5;
        sigmaEq[c] =
            bolus ? elastoViscoPlastic::sigmaEq(deviator[c]) : scalar(0);
        triaxiality[c] = bolus && sigmaEq[c] > SMALL ? -p[c] / sigmaEq[c] : 0;
    }
    sigmaEq.correctBoundaryConditions();
    triaxiality.correctBoundaryConditions();
    stress.correctBoundaryConditions();
}


Foam::scalar Foam::bolusFields::damage(const scalar thinnest)
{
    if (!law_.damage().active()) return 0;

    scalarField strain(undamagedStrain / max(1 - D, SMALL));
    if (average_.valid())
    {
        const scalarField sound(mass * max(1 - D, scalar(0)));
        strain = average_->update(sound, strain);
    }

    // Also in the cells of the surface: a break must not stop at a skin
    scalar volume = 0;
    forAll(D, c)
    {
        if (alpha[c] < thinnest || D[c] > 0.5) continue;
        const scalar q = elastoViscoPlastic::sigmaEq(deviator[c]);
        const scalar tensile = tensileStrain[c] / max(1 - D[c], SMALL);
        if (q < SMALL || !law_.damage().onset(strain[c], tensile, -p[c] / q))
            continue;
        D[c] = 1;
        undamagedStrain[c] = 0;
        tensileStrain[c] = 0;
        volume += mass[c] * mesh_.V()[c];
    }
    D.correctBoundaryConditions();
    undamagedStrain.correctBoundaryConditions();
    tensileStrain.correctBoundaryConditions();
    reduce(volume, sumOp<scalar>());
    return volume;
}


Foam::scalar Foam::bolusFields::totalMass() const
{
    return gSum(mass.primitiveField() * mesh_.V().field());
}

// ************************************************************************* //
