// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "powerLedger.H"
#include "error.H"

namespace Foam
{

static label place(const wordList& names, const word& name)
{
    const label i = names.find(name);
    if (i < 0)
    {
        FatalErrorInFunction << "no power of the name " << name
                             << " was declared; valid are " << names
                             << abort(FatalError);
    }
    return i;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::powerLedger::declare(const word& name)
{
    if (names_.found(name))
    {
        FatalErrorInFunction << "two takers of power of the name " << name
                             << exit(FatalError);
    }
    names_.append(name);
    values_.append(0);
}


void Foam::powerLedger::clear()
{
    values_ = 0;
}


Foam::scalar& Foam::powerLedger::operator[](const word& name)
{
    return values_[place(names_, name)];
}


Foam::scalar Foam::powerLedger::operator[](const word& name) const
{
    return values_[place(names_, name)];
}

// ************************************************************************* //
