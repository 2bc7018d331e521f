// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "dictionaryCheck.H"

// * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * * //

Foam::string Foam::dictionaryCheck::list(const wordList& names)
{
    string text;

    for (const word& name : names)
    {
        text += (text.empty() ? "" : ", ") + name;
    }

    return text.empty() ? string("none") : text;
}


void Foam::dictionaryCheck::entries(
    const dictionary& dict,
    const wordList& required,
    const wordList& optional
)
{
    const wordList given(dict.toc());

    // A misspelt entry is both unknown and missing: name what was typed
    for (const word& name : given)
    {
        if (!required.found(name) && !optional.found(name))
        {
            FatalIOErrorInFunction(dict)
                << "Unknown entry '" << name << "'" << nl
                << "    required entries: " << list(required).c_str() << nl
                << "    optional entries: " << list(optional).c_str()
                << exit(FatalIOError);
        }
    }

    for (const word& name : required)
    {
        if (!given.found(name))
        {
            FatalIOErrorInFunction(dict)
                << "Missing entry '" << name << "'" << nl
                << "    required entries: " << list(required).c_str() << nl
                << "    optional entries: " << list(optional).c_str()
                << exit(FatalIOError);
        }
    }
}


const Foam::dictionary& Foam::dictionaryCheck::section(
    const dictionary& dict,
    const word& name
)
{
    if (!dict.isDict(name))
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << name << "' must be a sub-dictionary: " << name
            << " { ... }" << exit(FatalIOError);
    }

    return dict.subDict(name);
}


void Foam::dictionaryCheck::isList(
    const dictionary& dict,
    const word& name,
    const string& valid
)
{
    // A bare number would be taken for the length of a list
    const token first(dict.lookup(name));
    if (!first.isPunctuation() && !(first.isLabel() && first.labelToken() > 0))
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << name << "' begins with " << first.info()
            << "; valid is " << valid.c_str() << exit(FatalIOError);
    }
}


Foam::List<Foam::Tuple2<Foam::scalar, Foam::scalar>>
Foam::dictionaryCheck::table(const dictionary& dict, const word& name)
{
    isList(dict, name, "a table ((x0 y0) (x1 y1) ...)");
    return dict.get<List<Tuple2<scalar, scalar>>>(name);
}


Foam::scalar Foam::dictionaryCheck::positive(
    const dictionary& dict,
    const word& name
)
{
    const scalar value = dict.get<scalar>(name);

    // Written so that NaN fails as well
    if (!(value > 0 && value < GREAT))
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << name << "' is " << value
            << "; it must be a number greater than 0" << exit(FatalIOError);
    }

    return value;
}


Foam::scalar Foam::dictionaryCheck::inRange(
    const dictionary& dict,
    const word& name,
    const scalar lower,
    const scalar upper
)
{
    const scalar value = dict.get<scalar>(name);

    if (!(value >= lower && value < upper))
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << name << "' is " << value << "; it must be at least "
            << lower << " and less than " << upper << exit(FatalIOError);
    }

    return value;
}


Foam::label Foam::dictionaryCheck::inRange(
    const dictionary& dict,
    const word& name,
    const label lower,
    const label upper
)
{
    const label value = dict.get<label>(name);

    if (value < lower || value >= upper)
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << name << "' is " << value
            << "; it must be a whole number from " << lower << " to "
            << upper - 1 << exit(FatalIOError);
    }

    return value;
}


// ************************************************************************* //
