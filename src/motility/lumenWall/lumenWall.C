// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "lumenWall.H"
#include "DynamicList.H"
#include "Tuple2.H"

#include <algorithm>

// * * * * * * * * * * * * * Local Helper Functions  * * * * * * * * * * * * //

namespace
{

// Positions of a mesh are written with some ten digits [m]
constexpr Foam::scalar positionTolerance = 1e-9;

} // End anonymous namespace


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::autoPtr<Foam::pyloricSphincter> Foam::lumenWall::readSphincter(
    entryReader& read,
    const antralWaves& waves
)
{
    if (!read.has("sphincter"))
    {
        return nullptr;
    }

    return autoPtr<pyloricSphincter>::New(
        read.section("sphincter", "constriction that closes"), waves
    );
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::lumenWall::lumenWall(entryReader& read) :
    dict_(read.dict()),
    residualGap_(read.number(
        "residualGap",
        "smallest radius of the lumen [m]",
        entryReader::positive,
        5e-5
    )),
    profile_(read.section("profile", "radius of the open lumen")),
    waves_(read.section("waves", "contraction waves")),
    sphincter_(readSphincter(read, waves_))
{
    if (hasSphincter())
    {
        const scalar xP = sphincter().position();

        if (xP < profile_.xMin() - positionTolerance
            || xP > profile_.xMax() + positionTolerance)
        {
            FatalIOErrorInFunction(dict_.subDict("sphincter"))
                << "Entry 'position' is " << xP
                << " m; valid are places in the profile, from "
                << profile_.xMin() << " m to " << profile_.xMax()
                << " m, which gives the radius there" << exit(FatalIOError);
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::lumenWall::openRadius(const scalar x) const
{
    if (hasSphincter() && x > sphincter().position())
    {
        return profile_.radius(sphincter().position())
            * (1 - sphincter().relativeOcclusion() * sphincter().shape(x));
    }

    return profile_.radius(x);
}


Foam::scalar Foam::lumenWall::radius(const scalar x, const scalar t) const
{
    scalar r = openRadius(x) * (1 - waves_.occlusion(x, t));

    if (hasSphincter())
    {
        const scalar throat = profile_.radius(sphincter().position())
            * (1 - sphincter().relativeOcclusion());

        r -= sphincter().closure(t) * throat * sphincter().shape(x);
    }

    return max(r, residualGap_);
}


void Foam::lumenWall::checkCovers(const scalar xMin, const scalar xMax) const
{
    const scalar neededEnd =
        hasSphincter() ? min(xMax, sphincter().position()) : xMax;

    if (profile_.xMin() > xMin + positionTolerance
        || profile_.xMax() < neededEnd - positionTolerance)
    {
        FatalIOErrorInFunction(dict_)
            << "Entry 'profile.radius' reaches from x = " << profile_.xMin()
            << " m to " << profile_.xMax()
            << " m and does not cover the mesh: it must reach from " << xMin
            << " m to " << neededEnd << " m" << exit(FatalIOError);
    }

    const auto requireInProfile = [&](const dictionary& dict, const word& name)
    {
        const scalar x = dict.get<scalar>(name);
        if (!(x >= profile_.xMin() && x <= profile_.xMax()))
        {
            FatalIOErrorInFunction(dict)
                << "Entry '" << name << "' is " << x
                << " m; valid are places in the table 'profile.radius', from "
                << profile_.xMin() << " m to " << profile_.xMax() << " m"
                << exit(FatalIOError);
        }
    };
    if (waves_.size()) requireInProfile(dict_.subDict("waves"), "start");
    if (hasSphincter())
    {
        const dictionary& trigger =
            dict_.subDict("sphincter").subDict("trigger");
        if (trigger.found("position")) requireInProfile(trigger, "position");
    }

    // As fine as any mesh needs, and cheap
    const label nSamples = 1000;

    scalar xNarrow = xMin;

    for (label i = 1; i <= nSamples; ++i)
    {
        const scalar x = xMin + (xMax - xMin) * i / nSamples;

        if (openRadius(x) < openRadius(xNarrow))
        {
            xNarrow = x;
        }
    }

    if (!(openRadius(xNarrow) > residualGap_))
    {
        FatalIOErrorInFunction(dict_)
            << "Entry 'residualGap' is " << residualGap_
            << " m; valid is less than the smallest radius of the open"
            << " lumen, which is " << openRadius(xNarrow)
            << " m at x = " << xNarrow << " m" << exit(FatalIOError);
    }
}


Foam::scalarList Foam::lumenWall::eventTimes() const
{
    DynamicList<scalar> times(waves_.eventTimes());

    if (hasSphincter())
    {
        times.append(sphincter().eventTimes());
    }

    std::sort(times.begin(), times.end());

    // The same event may come from a wave and from the sphincter, with
    // rounding errors between them
    const auto end = std::unique(
        times.begin(),
        times.end(),
        [](const scalar a, const scalar b) { return b - a < 1e-9; }
    );

    times.resize(label(end - times.begin()));

    return scalarList(times);
}


void Foam::lumenWall::writeTimeline(Ostream& os, const scalar xMax) const
{
    typedef Tuple2<scalar, string> entry;

    DynamicList<entry> entries;

    for (label i = 0; i < waves_.size(); ++i)
    {
        const string wave("wave " + Foam::name(i));

        if (waves_.fades(i))
        {
            const scalar x = waves_.fadeEnd(i);

            entries.append(entry(
                waves_.arrivalTime(i, x),
                wave + " faded out, tip at x = " + Foam::name(x) + " m"
            ));
        }

        if (!waves_.fades(i) || waves_.fadeEnd(i) > xMax)
        {
            entries.append(entry(
                waves_.arrivalTime(i, xMax),
                wave + " leaves, tip at x = " + Foam::name(xMax) + " m"
            ));
        }
    }

    if (hasSphincter())
    {
        const scalarList times(sphincter().eventTimes());

        forAll(sphincter().events(), i)
        {
            const bool closing = sphincter().events()[i].closing;

            entries.append(entry(
                times[2 * i], closing ? "sphincter closes" : "sphincter opens"
            ));
            entries.append(entry(
                times[2 * i + 1],
                closing ? "sphincter closed" : "sphincter open"
            ));
        }
    }

    std::stable_sort(
        entries.begin(),
        entries.end(),
        [](const entry& a, const entry& b) { return a.first() < b.first(); }
    );

    os << "Motility timeline" << nl;

    for (const entry& e : entries)
    {
        os << "    t = " << e.first() << " s: " << e.second().c_str() << nl;
    }

    os << endl;
}


// ************************************************************************* //
