// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "bolusFields.H"
#include "pointMesh.H"

#include <cmath>

namespace Foam
{

//- A field that is read if it is there, at its value without load otherwise
template<class Type>
static GeometricField<Type, fvPatchField, volMesh> field(
    const fvMesh& mesh,
    const word& name,
    const dimensioned<Type>& value
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
        value,
        "zeroGradient"
    );
}

//- A field of boundary values
template<class Type>
static GeometricField<Type, fvPatchField, volMesh> boundaryField(
    const fvMesh& mesh,
    const word& name,
    const dimensionSet& dims
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
        "calculated"
    );
}

static IOobject mustRead(const fvMesh& mesh, const word& name)
{
    return IOobject(
        name,
        mesh.time().timeName(),
        mesh,
        IOobject::MUST_READ,
        IOobject::AUTO_WRITE
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

//- How many values of a list are no numbers
template<class Type>
static label notNumbers(const UList<Type>& values)
{
    label n = 0;
    for (const Type& value : values)
    {
        for (direction d = 0; d < pTraits<Type>::nComponents; ++d)
        {
            // Not by <, which traps where there is no number
            if (!std::isfinite(component(value, d)))
            {
                ++n;
                break;
            }
        }
    }
    return n;
}


//- Stop if a field of a start has values below 0 or above the highest, but for
//  round-off
static void requireWithin(
    const volScalarField& f,
    const scalar highest,
    const char* valid
)
{
    const scalar roundOff = 1e-6;
    const scalar low = gMin(f.primitiveField());
    const scalar high = gMax(f.primitiveField());
    if (low < -roundOff || high > highest + roundOff)
    {
        FatalErrorInFunction << "field " << f.name() << ": values from " << low
                             << " to " << high << "; valid are " << valid
                             << exit(FatalError);
    }
}


//- Stop if a field was read that holds what is no number
struct requireNumbers
{
    template<class Old, class Field>
    void operator()(const Old&, const label, const Field& f) const
    {
        label n = notNumbers(f.primitiveField());
        n += boundary(f);
        reduce(n, sumOp<label>());
        if (n > 0)
        {
            FatalErrorInFunction
                << "field " << f.name() << " of time " << f.time().timeName()
                << ": " << n << " values are no finite numbers (nan, inf) in "
                << f.objectPath() << "; valid are numbers. Put that time aside"
                << " to start from the one before" << exit(FatalError);
        }
    }

    template<class Field>
    label boundary(const Field& f) const
    {
        label n = 0;
        for (const auto& patch : f.boundaryField()) n += notNumbers(patch);
        return n;
    }

    //- Point fields have no values of their own there
    label boundary(const pointVectorField&) const
    {
        return 0;
    }
};

} // End namespace Foam


Foam::bolusFields::bolusFields(
    const fvMesh& mesh,
    const elastoViscoPlastic& law
) :
    mesh_(mesh),
    law_(law),
    alpha(mustRead(mesh, "alpha"), mesh),
    U(mustRead(mesh, "U"), mesh),
    p(field<scalar>(mesh, "p", dimensionedScalar("p", dimPressure, 0.0))),
    mass(field<scalar>(mesh, "mass", dimensionedScalar("m", dimless, -1.0))),
    deviator(
        field<symmTensor>(
            mesh,
            "deviator",
            dimensionedSymmTensor("s", dimPressure, Zero)
        )
    ),
    epsilonPEq(
        field<scalar>(mesh, "epsilonPEq", dimensionedScalar("e", dimless, 0.0))
    ),
    D(field<scalar>(mesh, "D", dimensionedScalar("D", dimless, 0.0))),
    soundStrain(
        field<scalar>(
            mesh,
            "soundStrain",
            dimensionedScalar("e", dimless, -1.0)
        )
    ),
    tensileStrain(
        field<scalar>(
            mesh,
            "tensileStrain",
            dimensionedScalar("e", dimless, 0.0)
        )
    ),
    theta(field<scalar>(mesh, "theta", dimensionedScalar("t", dimless, 1.0))),
    pStart(
        IOobject(
            "pStart",
            mesh.time().timeName(),
            mesh,
            IOobject::READ_IF_PRESENT,
            IOobject::AUTO_WRITE
        ),
        p
    ),
    pointU(
        IOobject(
            "pointU",
            mesh.time().timeName(),
            mesh,
            IOobject::READ_IF_PRESENT,
            IOobject::AUTO_WRITE
        ),
        pointMesh::New(mesh),
        dimensionedVector("U", dimVelocity, Zero)
    ),
    stress(
        field<symmTensor>(
            mesh,
            "stress",
            dimensionedSymmTensor("s", dimPressure, Zero)
        )
    ),
    sigmaEq(
        field<scalar>(mesh, "sigmaEq", dimensionedScalar("s", dimPressure, 0.0))
    ),
    triaxiality(
        field<scalar>(mesh, "triaxiality", dimensionedScalar("t", dimless, 0.0))
    ),
    elasticSlip(boundaryField<vector>(mesh, "elasticSlip", dimLength)),
    wallForce(boundaryField<vector>(mesh, "wallForce", dimForce)),
    wallPower(boundaryField<scalar>(mesh, "wallPower", dimPower)),
    phi(transient(mesh, "phi"),
        mesh,
        dimensionedScalar("phi", dimVolume / dimTime, 0.0)),
    phiRel(
        IOobject(
            "phiRel",
            mesh.time().timeName(),
            mesh,
            IOobject::READ_IF_PRESENT,
            IOobject::AUTO_WRITE
        ),
        mesh,
        dimensionedScalar("phi", dimVolume / dimTime, 0.0)
    ),
    massFlux(
        transient(mesh, "massFlux"),
        mesh,
        dimensionedScalar("massFlux", dimVolume / dimTime, 0.0)
    ),
    state{
        alpha,
        mass,
        U,
        p,
        deviator,
        epsilonPEq,
        D,
        soundStrain,
        tensileStrain,
        theta,
        pointU,
        elasticSlip,
        pStart,
        stress,
        phiRel
    }
{
    forState(requireNumbers());

    // What is there without a memory is a start: transport may leave a cell
    // overfull, people may not
    if (min(mass).value() < -0.5)
    {
        requireWithin(alpha, 1, "0 (void) to 1 (bolus)");
        requireWithin(D, 1, "0 (sound) to 1 (damaged)");
        requireWithin(epsilonPEq, GREAT, "numbers >= 0");
        requireWithin(tensileStrain, GREAT, "numbers >= 0");
        mass = alpha
            * exp(p / dimensionedScalar("K", dimPressure, law.elastic().K()));
    }
    mass.correctBoundaryConditions();
    if (min(soundStrain).value() < -0.5)
    {
        soundStrain = (1 - D) * epsilonPEq;
    }
    soundStrain.correctBoundaryConditions();
    if (law.damage().nonlocalLength() > 0)
    {
        average_.reset(new nonlocalStrain(mesh, law.damage().nonlocalLength()));
    }
    derive();
}


template<class Operation>
void Foam::bolusFields::forState(const Operation& op)
{
    volScalarField* scalars[] = {
        &alpha,
        &mass,
        &p,
        &epsilonPEq,
        &D,
        &soundStrain,
        &tensileStrain,
        &theta,
        &pStart
    };
    volVectorField* vectors[] = {&U, &elasticSlip};
    volSymmTensorField* tensors[] = {&deviator, &stress};
    surfaceScalarField* fluxes[] = {&phiRel};
    pointVectorField* points[] = {&pointU};

    label i = 0;
    for (auto* f : scalars) op(oldScalars_, i++, *f);
    i = 0;
    for (auto* f : vectors) op(oldVectors_, i++, *f);
    i = 0;
    for (auto* f : tensors) op(oldTensors_, i++, *f);
    i = 0;
    for (auto* f : fluxes) op(oldFluxes_, i++, *f);
    i = 0;
    for (auto* f : points) op(oldPoints_, i++, *f);
}


namespace Foam
{

struct storeField
{
    template<class Field>
    void operator()(PtrList<Field>& old, const label i, const Field& f) const
    {
        if (i < old.size())
        {
            old[i] == f;
            return;
        }
        IOobject io(f.name() + "Start", f.instance(), f.db());
        io.registerObject() = false;
        old.append(new Field(io, f));
    }
};

struct restoreField
{
    template<class Field>
    void operator()(PtrList<Field>& old, const label i, Field& f) const
    {
        f == old[i];
    }
};

} // End namespace Foam


void Foam::bolusFields::store()
{
    forState(storeField());
}


void Foam::bolusFields::restore()
{
    forState(restoreField());
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

    scalarField strain(soundStrain / max(1 - D, SMALL));
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
        soundStrain[c] = 0;
        tensileStrain[c] = 0;
        volume += mass[c] * mesh_.V()[c];
    }
    D.correctBoundaryConditions();
    soundStrain.correctBoundaryConditions();
    tensileStrain.correctBoundaryConditions();
    reduce(volume, sumOp<scalar>());
    return volume;
}


Foam::scalar Foam::bolusFields::totalMass() const
{
    return gSum(mass.primitiveField() * mesh_.V().field());
}

// ************************************************************************* //
