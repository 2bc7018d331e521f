// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "entryReader.H"

#include "FlatOutput.H"
#include "OStringStream.H"

#include <sstream>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::entryReader::interval Foam::entryReader::anything =
    {-VGREAT, true, VGREAT, true};

const Foam::entryReader::interval Foam::entryReader::positive =
    {0, false, VGREAT, true};

const Foam::entryReader::interval Foam::entryReader::nonNegative =
    {0, true, VGREAT, true};


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

// The interval in the words of an error message
std::string inWords(const Foam::entryReader::interval& valid)
{
    std::ostringstream os;

    if (valid.lower > -Foam::VGREAT)
    {
        os << (valid.includesLower ? ">= " : "> ") << valid.lower;
    }
    if (valid.upper < Foam::VGREAT)
    {
        os << (os.tellp() > 0 ? " and " : "")
           << (valid.includesUpper ? "<= " : "< ") << valid.upper;
    }

    return os.tellp() > 0 ? os.str() : "a number";
}


// The value of an entry in the words of an error message
std::string inWords(const Foam::entry& found)
{
    if (found.isDict())
    {
        return "a dictionary";
    }

    Foam::OStringStream os;
    for (const Foam::token& t : found.stream())
    {
        os << (os.str().empty() ? "" : " ") << t;
    }

    return "'" + os.str() + "'";
}

} // End anonymous namespace


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::entryReader::entryReader(const dictionary& dict) :
    dict_(dict),
    known_()
{}


// * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * * //

bool Foam::entryReader::has(const word& key)
{
    if (!known_.found(key)) known_.append(key);

    return dict_.found(key);
}


void Foam::entryReader::require(const word& key, const string& meaning)
{
    if (!has(key))
    {
        FatalIOErrorInFunction(dict_)
            << "Missing entry " << key << ": " << meaning.c_str() << nl
            << "Entries found: " << flatOutput(dict_.sortedToc())
            << exit(FatalIOError);
    }
}


void Foam::entryReader::requireList(const word& key, const string& meaning)
{
    require(key, meaning);
    const token first(dict_.lookup(key));
    if (!first.isPunctuation() && !(first.isLabel() && first.labelToken() > 0))
    {
        FatalIOErrorInFunction(dict_)
            << "Entry " << key << " begins with " << first.info()
            << "; valid is a " << meaning.c_str() << exit(FatalIOError);
    }
}


Foam::scalar Foam::entryReader::number(
    const word& key,
    const string& meaning,
    const interval& valid
)
{
    require(key, meaning + ", must be " + inWords(valid));

    const entry& found = *dict_.findEntry(key);

    if (found.isDict() || found.stream().size() != 1
        || !found.stream()[0].isNumber())
    {
        FatalIOErrorInFunction(dict_)
            << "Entry " << key << " is " << inWords(found).c_str()
            << "; valid is one number: " << meaning.c_str() << ", "
            << inWords(valid).c_str() << exit(FatalIOError);
    }

    const scalar value = found.stream()[0].number();

    if (!valid.contains(value))
    {
        FatalIOErrorInFunction(dict_)
            << "Entry " << key << " is " << value << "; " << meaning.c_str()
            << " must be " << inWords(valid).c_str() << exit(FatalIOError);
    }

    return value;
}


Foam::scalar Foam::entryReader::number(
    const word& key,
    const string& meaning,
    const interval& valid,
    const scalar defaultValue
)
{
    return has(key) ? number(key, meaning, valid) : defaultValue;
}


Foam::label Foam::entryReader::wholeNumber(
    const word& key,
    const string& meaning,
    const interval& valid,
    const label defaultValue
)
{
    const scalar value = number(key, meaning, valid, defaultValue);

    if (value != label(value))
    {
        FatalIOErrorInFunction(dict_)
            << "Entry " << key << " is " << value << "; " << meaning.c_str()
            << " must be a whole number" << exit(FatalIOError);
    }

    return label(value);
}


Foam::word Foam::entryReader::choice(
    const word& key,
    const string& meaning,
    const UList<word>& valid,
    const word& defaultValue
)
{
    if (!defaultValue.empty() && !has(key))
    {
        return defaultValue;
    }

    require(key, meaning);

    const entry& found = *dict_.findEntry(key);

    if (!found.isDict() && found.stream().size() == 1)
    {
        const token& t = found.stream()[0];

        for (const word& option : valid)
        {
            if (t.isWord() && t.wordToken() == option)
            {
                return option;
            }
        }
    }

    FatalIOErrorInFunction(dict_)
        << "Entry " << key << " is " << inWords(found).c_str() << "; "
        << meaning.c_str() << ", valid are " << flatOutput(valid)
        << exit(FatalIOError);

    return word::null;
}


void Foam::entryReader::rejectOthers() const
{
    for (const word& key : dict_.toc())
    {
        if (!known_.found(key))
        {
            wordList valid(known_);
            sort(valid);

            FatalIOErrorInFunction(dict_)
                << "Unknown entry " << key << "; valid entries are "
                << flatOutput(valid) << exit(FatalIOError);
        }
    }
}


const Foam::dictionary& Foam::entryReader::subDictionary(
    const dictionary& dict,
    const word& key,
    const string& meaning
)
{
    if (!dict.isDict(key))
    {
        FatalIOErrorInFunction(dict)
            << (dict.found(key) ? "Not a dictionary: " : "Missing dictionary ")
            << key << ": " << meaning.c_str() << nl
            << "Entries found: " << flatOutput(dict.sortedToc())
            << exit(FatalIOError);
    }

    return dict.subDict(key);
}


// ************************************************************************* //
