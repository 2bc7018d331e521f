// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "cellForce.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
defineTypeNameAndDebug(cellForce, 0);
defineRunTimeSelectionTable(cellForce, dictionary);
}


// * * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * //

void Foam::cellForce::addToPoints(
    const label c,
    const vector& force,
    UList<scalar>& R
) const
{
    const labelList& points = space_.mesh().cellPoints()[c];
    for (const label p : points)
    {
        const label s = space_.slot(c, space_.pointNode()[p]);
        for (label k = 0; k < space_.nd(); ++k)
        {
            R[s + k] -= (force & space_.shape(p, k)) / points.size();
        }
    }
}


// * * * * * * * * * * * * * * * * Selectors * * * * * * * * * * * * * * * * //

void Foam::cellForce::select(
    const nodalSpace& space,
    const dictionary& bolusProperties,
    PtrList<cellForce>& forces
)
{
    const wordList names(
        bolusProperties.lookupOrDefault<wordList>("forces", wordList())
    );
    forAll(names, i)
    {
        const word& name = names[i];
        const bool twice = i != names.rfind(name) || i != names.find(name);
        if (twice || !dictionaryConstructorTablePtr_
            || !dictionaryConstructorTablePtr_->found(name))
        {
            FatalIOErrorInFunction(bolusProperties)
                << "Entry 'forces' has " << name << (twice ? " twice" : "")
                << "; valid are, each once: "
                << (dictionaryConstructorTablePtr_
                           ? dictionaryConstructorTablePtr_->sortedToc()
                           : wordList())
                << exit(FatalIOError);
        }
        forces.append(dictionaryConstructorTablePtr_->cfind(name).val()(
            space, bolusProperties.subOrEmptyDict(name + "Coeffs")
        ));
    }
}

// ************************************************************************* //
