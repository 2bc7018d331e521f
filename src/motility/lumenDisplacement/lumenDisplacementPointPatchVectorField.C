// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "lumenDisplacementPointPatchVectorField.H"
#include "Time.H"
#include "addToRunTimeSelectionTable.H"
#include "pointPatchFields.H"
#include "polyMesh.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::lumenDisplacementPointPatchVectorField::
    lumenDisplacementPointPatchVectorField(
        const pointPatch& p,
        const DimensionedField<vector, pointMesh>& iF
    ) :
    fixedValuePointPatchField<vector>(p, iF),
    motion_(),
    p0_(p.localPoints())
{}


Foam::lumenDisplacementPointPatchVectorField::
    lumenDisplacementPointPatchVectorField(
        const pointPatch& p,
        const DimensionedField<vector, pointMesh>& iF,
        const dictionary& dict
    ) :
    fixedValuePointPatchField<vector>(p, iF, dict),
    motion_(),
    p0_(dict.found("p0") ? pointField("p0", dict, p.size()) : p.localPoints())
{}


Foam::lumenDisplacementPointPatchVectorField::
    lumenDisplacementPointPatchVectorField(
        const lumenDisplacementPointPatchVectorField& ptf,
        const pointPatch& p,
        const DimensionedField<vector, pointMesh>& iF,
        const pointPatchFieldMapper& mapper
    ) :
    fixedValuePointPatchField<vector>(ptf, p, iF, mapper),
    motion_(ptf.motion_),
    p0_(ptf.p0_, mapper)
{}


Foam::lumenDisplacementPointPatchVectorField::
    lumenDisplacementPointPatchVectorField(
        const lumenDisplacementPointPatchVectorField& ptf,
        const DimensionedField<vector, pointMesh>& iF
    ) :
    fixedValuePointPatchField<vector>(ptf, iF),
    motion_(ptf.motion_),
    p0_(ptf.p0_)
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::lumenDisplacementPointPatchVectorField::autoMap(
    const pointPatchFieldMapper& mapper
)
{
    fixedValuePointPatchField<vector>::autoMap(mapper);

    p0_.autoMap(mapper);
}


void Foam::lumenDisplacementPointPatchVectorField::rmap(
    const pointPatchField<vector>& ptf,
    const labelList& addressing
)
{
    const auto& other =
        refCast<const lumenDisplacementPointPatchVectorField>(ptf);

    fixedValuePointPatchField<vector>::rmap(other, addressing);

    p0_.rmap(other.p0_, addressing);
}


void Foam::lumenDisplacementPointPatchVectorField::updateCoeffs()
{
    if (updated())
    {
        return;
    }

    const Time& runTime = internalField().mesh()().time();

    if (!motion_)
    {
        motion_.reset(lumenMotion::New(runTime).ptr());

        motion_->checkCovers(p0_);
        motion_->checkAxis(internalField().mesh()(), p0_, 1e-5);
        motion_->checkWall(p0_, 1e-5);
    }

    vectorField& displacement = *this;

    forAll(displacement, i)
    {
        displacement[i] = motion_->displacement(p0_[i], runTime.value());
    }

    fixedValuePointPatchField<vector>::updateCoeffs();
}


void Foam::lumenDisplacementPointPatchVectorField::write(Ostream& os) const
{
    pointPatchField<vector>::write(os);

    p0_.writeEntry("p0", os);

    Field<vector>::writeEntry("value", os);
}


// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

namespace Foam
{
makePointPatchTypeField(
    pointPatchVectorField,
    lumenDisplacementPointPatchVectorField
);
}


// ************************************************************************* //
