// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "historyVariables.H"

#include "pointMesh.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::IOobject Foam::historyVariables::io(
    const word& name,
    const IOobject::readOption read
) const
{
    return IOobject(
        name, mesh_.time().timeName(), mesh_, read, IOobject::AUTO_WRITE
    );
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::historyVariables::historyVariables(const fvMesh& mesh) :
    mesh_(mesh)
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::surfaceScalarField& Foam::historyVariables::faces(
    const word& name,
    const dimensionSet& dims
)
{
    return add<surfaceScalarField>(
        io(name, IOobject::READ_IF_PRESENT),
        historyVariable::STANDS,
        mesh_,
        dimensionedScalar(name, dims, 0)
    );
}


Foam::pointVectorField& Foam::historyVariables::points(
    const word& name,
    const dimensionSet& dims
)
{
    return add<pointVectorField>(
        io(name, IOobject::READ_IF_PRESENT),
        historyVariable::STANDS,
        pointMesh::New(mesh_),
        dimensionedVector(name, dims, Zero)
    );
}


Foam::historyVariable& Foam::historyVariables::operator[](const word& name)
{
    for (historyVariable& v : variables_)
    {
        if (v.name() == name) return v;
    }
    FatalErrorInFunction << "no history variable " << name << exit(FatalError);
    return variables_[0];
}


void Foam::historyVariables::store()
{
    for (historyVariable& v : variables_) v.store();
}


void Foam::historyVariables::restore()
{
    for (historyVariable& v : variables_) v.restore();
}

// ************************************************************************* //
