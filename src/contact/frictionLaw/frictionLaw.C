// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "entryReader.H"
#include "frictionLaw.H"

namespace Foam
{
defineTypeNameAndDebug(frictionLaw, 0);
defineRunTimeSelectionTable(frictionLaw, dictionary);
}


Foam::autoPtr<Foam::frictionLaw> Foam::frictionLaw::New(const dictionary& dict)
{
    const dictionary& friction =
        entryReader::subDictionary(dict, "friction", "law of the wall");
    const word type(entryReader(friction).choice(
        "type", "friction law", dictionaryConstructorTablePtr_->sortedToc()
    ));

    return dictionaryConstructorTablePtr_->cfind(type)()(friction);
}


void Foam::frictionLaw::write(Ostream& os) const
{
    os.beginBlock("friction");
    os.writeEntry("type", type());
    os.endBlock();
}

// ************************************************************************* //
