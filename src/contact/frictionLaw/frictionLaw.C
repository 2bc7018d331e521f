// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "frictionLaw.H"

namespace Foam
{
defineTypeNameAndDebug(frictionLaw, 0);
defineRunTimeSelectionTable(frictionLaw, dictionary);
}


Foam::autoPtr<Foam::frictionLaw> Foam::frictionLaw::New(const dictionary& dict)
{
    const dictionary& friction = dict.subDict("friction");
    const word type(friction.get<word>("type"));

    auto cstrIter = dictionaryConstructorTablePtr_->cfind(type);
    if (!cstrIter.found())
    {
        FatalIOErrorInFunction(friction)
            << "entry type: unknown friction law " << type << "; valid are "
            << dictionaryConstructorTablePtr_->sortedToc()
            << exit(FatalIOError);
    }
    return cstrIter()(friction);
}


void Foam::frictionLaw::write(Ostream& os) const
{
    os.beginBlock("friction");
    os.writeEntry("type", type());
    os.endBlock();
}

// ************************************************************************* //
