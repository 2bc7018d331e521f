// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "entryReader.H"

#include "FlatOutput.H"
#include "OStringStream.H"
#include "Switch.H"

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
    bool apart = false;
    for (const Foam::token& t : found.stream())
    {
        const bool closing =
            t.isPunctuation() && t.pToken() == Foam::token::END_LIST;
        os << (apart && !closing ? " " : "") << t;
        apart = !t.isPunctuation() || t.pToken() != Foam::token::BEGIN_LIST;
    }

    return os.str();
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
            << "Missing entry '" << key << "': " << meaning.c_str() << nl
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
            << "Entry '" << key << "' begins with " << first.info()
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
            << "Entry '" << key << "' is " << inWords(found).c_str()
            << "; valid is one number: " << meaning.c_str() << ", "
            << inWords(valid).c_str() << exit(FatalIOError);
    }

    const scalar value = found.stream()[0].number();

    if (!valid.contains(value))
    {
        FatalIOErrorInFunction(dict_)
            << "Entry '" << key << "' is " << value << "; " << meaning.c_str()
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
            << "Entry '" << key << "' is " << value << "; " << meaning.c_str()
            << " must be a whole number" << exit(FatalIOError);
    }

    return label(value);
}


Foam::label Foam::entryReader::wholeNumber(
    const word& key,
    const string& meaning,
    const interval& valid
)
{
    require(key, meaning + ", must be a whole number " + inWords(valid));
    return wholeNumber(key, meaning, valid, 0);
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
        << "Entry '" << key << "' is " << inWords(found).c_str() << "; "
        << meaning.c_str() << ", valid are " << flatOutput(valid)
        << exit(FatalIOError);

    return word::null;
}


Foam::word Foam::entryReader::name(const word& key, const string& meaning)
{
    require(key, meaning);

    return dict_.get<word>(key);
}


bool Foam::entryReader::flag(
    const word& key,
    const string& meaning,
    const bool defaultValue
)
{
    if (!has(key)) return defaultValue;

    const entry& found = *dict_.findEntry(key);
    if (!found.isDict() && found.stream().size() == 1)
    {
        const token& t = found.stream()[0];
        const Switch value(t.isWord() ? t.wordToken() : word::null, true);
        if (value.valid()) return value;
    }
    refuse(key, meaning + ", valid are yes and no");

    return defaultValue;
}


Foam::vector Foam::entryReader::direction(
    const word& key,
    const string& meaning,
    const vector& defaultValue
)
{
    if (mag(defaultValue) < VSMALL) require(key, meaning + ", a vector");

    const vector v(value<vector>(key, defaultValue));

    // Written so that NaN fails as well
    if (!(mag(v) > VSMALL))
    {
        refuse(key, meaning + ", valid are vectors of length > 0");
    }

    return v / mag(v);
}


Foam::scalarList Foam::entryReader::numbers(
    const word& key,
    const string& meaning
)
{
    requireList(key, meaning);

    return dict_.get<scalarList>(key);
}


Foam::Tuple2<Foam::scalar, Foam::scalar> Foam::entryReader::pair(
    const word& key,
    const string& meaning
)
{
    const scalarList found(numbers(key, "list of two numbers: " + meaning));

    if (found.size() != 2)
    {
        refuse(key, "valid are two numbers: " + meaning);
    }

    return Tuple2<scalar, scalar>(found[0], found[1]);
}


Foam::List<Foam::Tuple2<Foam::scalar, Foam::scalar>> Foam::entryReader::table(
    const word& key,
    const string& meaning
)
{
    requireList(key, "table ((x0 y0) (x1 y1) ...): " + meaning);

    const List<Tuple2<scalar, scalar>> points(
        dict_.get<List<Tuple2<scalar, scalar>>>(key)
    );

    if (points.size() < 2)
    {
        FatalIOErrorInFunction(dict_)
            << "Entry '" << key << "' has " << points.size()
            << " point(s); valid are tables of at least 2: " << key
            << " ((x0 y0) (x1 y1) ...), " << meaning.c_str()
            << exit(FatalIOError);
    }

    for (label k = 1; k < points.size(); ++k)
    {
        if (!(points[k].first() > points[k - 1].first()))
        {
            FatalIOErrorInFunction(dict_)
                << "Entry '" << key << "' is not sorted: " << points[k].first()
                << " of point " << k << " follows " << points[k - 1].first()
                << "; valid are tables whose first column increases from"
                << " point to point" << exit(FatalIOError);
        }
    }

    return points;
}


const Foam::dictionary& Foam::entryReader::section(
    const word& key,
    const string& meaning
)
{
    has(key);

    return subDictionary(dict_, key, meaning);
}


Foam::string Foam::entryReader::list(const UList<word>& names)
{
    OStringStream os;
    os << flatOutput(names);

    return os.str();
}


void Foam::entryReader::refuse(const word& key, const string& valid) const
{
    const entry* found = dict_.findEntry(key);

    FatalIOErrorInFunction(dict_)
        << "Entry '" << key << "' is "
        << (found ? inWords(*found) : "missing").c_str() << "; "
        << valid.c_str() << exit(FatalIOError);
}


namespace Foam
{

//- Entries that had another name once, and what they are called
static const HashTable<word>& renamedEntries()
{
    static const HashTable<word> names(
        {{"fullSteps", "undampedSteps"},
            {"lagFrictionBelow", "explicitPressureBelow"},
            {"lagTurningBelow", "splitRotationBelow"},
            {"lagTurningSteps", "splitRotationSteps"},
            {"eliminateRoom", "eliminateAbove"},
            {"overfillTime", "overshootTime"},
            {"leastRoom", "leastAvailable"},
            {"voidLayers", "gasLayers"},
            {"squeeze", "overshootTolerance"},
            {"memoryAbove", "historyAbove"},
            {"seal", "growthThreshold"}}
    );
    return names;
}

} // End namespace Foam


void Foam::entryReader::rejectOthers(
    const wordHashSet& others,
    const string& whose
) const
{
    for (const word& key : dict_.toc())
    {
        if (!known_.found(key) && !others.found(key))
        {
            const auto now = renamedEntries().cfind(key);
            if (now.found() && known_.found(now.val()))
            {
                FatalIOErrorInFunction(dict_)
                    << "Entry '" << key << "' is now called " << now.val()
                    << exit(FatalIOError);
            }

            wordList valid(known_);
            sort(valid);

            FatalIOErrorInFunction(dict_)
                << "Unknown entry '" << key << "'; valid entries are "
                << flatOutput(valid) << whose.c_str() << exit(FatalIOError);
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
            << (dict.found(key) ? "Not a dictionary: '"
                                : "Missing dictionary '")
            << key << "': " << meaning.c_str() << nl
            << "Entries found: " << flatOutput(dict.sortedToc())
            << exit(FatalIOError);
    }

    return dict.subDict(key);
}


// ************************************************************************* //
