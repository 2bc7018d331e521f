// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "contactWallFvPatchVectorField.H"
#include "addToRunTimeSelectionTable.H"
#include "fvMesh.H"
#include "volFields.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::contactWallFvPatchVectorField::contactWallFvPatchVectorField(
    const fvPatch& p,
    const DimensionedField<vector, volMesh>& iF
) :
    fixedValueFvPatchVectorField(p, iF),
    separation_(true)
{}


Foam::contactWallFvPatchVectorField::contactWallFvPatchVectorField(
    const fvPatch& p,
    const DimensionedField<vector, volMesh>& iF,
    const dictionary& dict
) :
    fixedValueFvPatchVectorField(p, iF, dict, false),
    dict_(dict),
    friction_(frictionLaw::New(dict)),
    separation_(dict.lookupOrDefault("separation", true))
{
    const wordList valid(
        {"type", "patchType", "friction", "separation", "value"}
    );
    for (const entry& e : dict)
    {
        if (!valid.found(e.keyword()))
        {
            FatalIOErrorInFunction(dict)
                << "entry " << e.keyword() << ": unknown on a contactWall;"
                << " valid are " << valid << exit(FatalIOError);
        }
    }

    if (dict.found("value"))
    {
        fvPatchVectorField::operator=(vectorField("value", dict, p.size()));
    }
    else
    {
        fvPatchVectorField::operator=(vector(Zero));
    }
}


Foam::contactWallFvPatchVectorField::contactWallFvPatchVectorField(
    const contactWallFvPatchVectorField& ptf,
    const fvPatch& p,
    const DimensionedField<vector, volMesh>& iF,
    const fvPatchFieldMapper& mapper
) :
    fixedValueFvPatchVectorField(ptf, p, iF, mapper),
    dict_(ptf.dict_),
    separation_(ptf.separation_)
{
    if (dict_.found("friction")) friction_ = frictionLaw::New(dict_);
}


Foam::contactWallFvPatchVectorField::contactWallFvPatchVectorField(
    const contactWallFvPatchVectorField& ptf,
    const DimensionedField<vector, volMesh>& iF
) :
    fixedValueFvPatchVectorField(ptf, iF),
    dict_(ptf.dict_),
    separation_(ptf.separation_)
{
    if (dict_.found("friction")) friction_ = frictionLaw::New(dict_);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

const Foam::frictionLaw& Foam::contactWallFvPatchVectorField::friction() const
{
    if (!friction_.valid())
    {
        FatalErrorInFunction
            << "patch " << patch().name() << " has no friction law: it was "
            << "not constructed from a dictionary" << exit(FatalError);
    }
    return friction_();
}


void Foam::contactWallFvPatchVectorField::updateCoeffs()
{
    if (updated()) return;

    const fvMesh& mesh = internalField().mesh();
    if (mesh.moving())
    {
        const polyPatch& pp = patch().patch();
        const scalar deltaT = mesh.time().deltaTValue();
        const pointField& oldPoints = mesh.oldPoints();
        vectorField v(size());
        forAll(v, i)
        {
            v[i] =
                (pp[i].centre(pp.points()) - pp[i].centre(oldPoints)) / deltaT;
        }
        operator==(v);
    }
    fixedValueFvPatchVectorField::updateCoeffs();
}


void Foam::contactWallFvPatchVectorField::write(Ostream& os) const
{
    fvPatchVectorField::write(os);
    if (friction_.valid()) friction_->write(os);
    os.writeEntry("separation", separation_);
    writeEntry("value", os);
}


// * * * * * * * * * * * * * * Build Macro Function  * * * * * * * * * * * * //

namespace Foam
{
makePatchTypeField(fvPatchVectorField, contactWallFvPatchVectorField);
}

// ************************************************************************* //
