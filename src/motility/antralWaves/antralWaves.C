// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "antralWaves.H"
#include "DynamicList.H"
#include "dictionaryCheck.H"

#include <algorithm>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::antralWaves::readingType>
    Foam::antralWaves::readingTypeNames({
        {readingType::centreReading, "centre"},
        {readingType::tailReading, "tail"},
    });


const Foam::Enum<Foam::antralWaves::placeType>
    Foam::antralWaves::placeTypeNames({
        {placeType::byPosition, "position"},
        {placeType::byTravel, "travel"},
    });


// * * * * * * * * * * * * * Local Helper Functions  * * * * * * * * * * * * //

namespace
{

// The dictionary, once its entries are known to be complete and known, so
// that the first member that is read can rely on it
const Foam::dictionary& checked(const Foam::dictionary& dict)
{
    Foam::dictionaryCheck::entries(
        dict,
        {"number",
            "start",
            "spacing",
            "speed",
            "wavelength",
            "occlusion",
            "exponent"},
        {"reading", "occlusionBy", "fadeOut"}
    );

    return dict;
}

} // End anonymous namespace


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::antralWaves::fade::value(const scalar x) const
{
    return active ? min(1, max(0, (to - x) / (to - from))) : 1;
}


void Foam::antralWaves::check(const dictionary& dict) const
{
    const scalarList& x = wavelength_.x();
    const scalarList& lambda = wavelength_.y();

    forAll(lambda, k)
    {
        if (!(lambda[k] > 0))
        {
            FatalIOErrorInFunction(dict)
                << "Table 'wavelength' has " << lambda[k]
                << " m at x = " << x[k]
                << " m; a wavelength must be greater than 0"
                << exit(FatalIOError);
        }

        if (k > 0 && mag(lambda[k] - lambda[k - 1]) >= x[k] - x[k - 1])
        {
            FatalIOErrorInFunction(dict)
                << "Table 'wavelength' changes from " << lambda[k - 1]
                << " m at x = " << x[k - 1] << " m to " << lambda[k]
                << " m at x = " << x[k]
                << " m; its slope must be between -1 and 1"
                << exit(FatalIOError);
        }

        if (number_ > 1 && lambda[k] > spacing_)
        {
            FatalIOErrorInFunction(dict)
                << "Entry 'spacing' is " << spacing_
                << " m; it must be at least the largest wavelength, here "
                << *std::max_element(lambda.begin(), lambda.end())
                << " m, or waves overlap" << exit(FatalIOError);
        }
    }

    const scalarList& C = occlusion_.y();

    forAll(C, k)
    {
        if (!(C[k] >= 0 && C[k] < 1))
        {
            FatalIOErrorInFunction(dict)
                << "Table 'occlusion' has " << C[k]
                << " at x = " << occlusion_.x()[k]
                << " m; an occlusion must be at least 0 and less than 1:"
                << " 1 closes the lumen, more inverts the cells"
                << exit(FatalIOError);
        }
    }
}


void Foam::antralWaves::readFades(const dictionary& dict)
{
    fades_.resize(number_, fade{false, 0, 0, byTravel});

    if (!dict.found("fadeOut"))
    {
        return;
    }

    const dictionary& fadeDict = dictionaryCheck::section(dict, "fadeOut");

    wordList names(number_);
    forAll(names, i)
    {
        names[i] = "wave" + Foam::name(i);
    }

    dictionaryCheck::entries(fadeDict, {}, names);

    forAll(names, i)
    {
        if (!fadeDict.found(names[i]))
        {
            continue;
        }

        const dictionary& waveDict =
            dictionaryCheck::section(fadeDict, names[i]);

        dictionaryCheck::entries(waveDict, {"from", "to"}, {"fadeBy"});

        fade& f = fades_[i];

        f.active = true;
        f.from = waveDict.get<scalar>("from");
        f.to = waveDict.get<scalar>("to");
        f.by = dictionaryCheck::option(
            waveDict, "fadeBy", placeTypeNames, byTravel
        );

        if (!(f.from >= start_))
        {
            FatalIOErrorInFunction(waveDict)
                << "Entry 'from' is " << f.from
                << " m; it must be at least where the waves start, " << start_
                << " m" << exit(FatalIOError);
        }

        if (!(f.to > f.from))
        {
            FatalIOErrorInFunction(waveDict)
                << "Entry 'to' is " << f.to
                << " m; it must be greater than 'from', " << f.from << " m"
                << exit(FatalIOError);
        }
    }
}


Foam::scalar Foam::antralWaves::leadPoint(const label i, const scalar t) const
{
    const scalar lambda = wavelength_.value(start_);

    const scalar behind = reading_ == centreReading ? lambda / 2 : lambda;

    return start_ - behind - i * spacing_ + speed_ * t;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::antralWaves::antralWaves(const dictionary& dict) :
    number_(
        dictionaryCheck::inRange(checked(dict), "number", label(0), label(1001))
    ),
    start_(dict.get<scalar>("start")),
    spacing_(dictionaryCheck::positive(dict, "spacing")),
    speed_(dictionaryCheck::positive(dict, "speed")),
    wavelength_(dict, "wavelength"),
    occlusion_(dict, "occlusion"),
    exponent_(dictionaryCheck::positive(dict, "exponent")),
    occlusionBy_(
        dictionaryCheck::option(dict, "occlusionBy", placeTypeNames, byPosition)
    ),
    reading_(
        dictionaryCheck::option(
            dict,
            "reading",
            readingTypeNames,
            centreReading
        )
    ),
    fades_()
{
    check(dict);
    readFades(dict);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::antralWaves::centre(const label i, const scalar t) const
{
    const scalar lead = leadPoint(i, t);

    if (reading_ == centreReading)
    {
        return lead;
    }

    // The tip is the root of x - lambda(x)/2 = tail. The left side grows with
    // x and is linear between the points of the table, constant slope 1
    // outside: find the interval, then solve the linear equation.

    const scalarList& x = wavelength_.x();
    const scalarList& lambda = wavelength_.y();

    if (lead <= x.first() - lambda.first() / 2)
    {
        return lead + lambda.first() / 2;
    }

    for (label k = 1; k < x.size(); ++k)
    {
        const scalar g0 = x[k - 1] - lambda[k - 1] / 2;
        const scalar g1 = x[k] - lambda[k] / 2;

        if (lead <= g1)
        {
            return x[k - 1] + (lead - g0) / (g1 - g0) * (x[k] - x[k - 1]);
        }
    }

    return lead + lambda.last() / 2;
}


Foam::scalar Foam::antralWaves::arrivalTime(const label i, const scalar x) const
{
    const scalar lead =
        reading_ == centreReading ? x : x - wavelength_.value(x) / 2;

    return (lead - leadPoint(i, 0)) / speed_;
}


Foam::scalar Foam::antralWaves::occlusion(
    const label i,
    const scalar x,
    const scalar t
) const
{
    const scalar half = wavelength_.value(x) / 2;

    // Distance from the middle of the window over half its length
    const scalar s = reading_ == centreReading
        ? (x - leadPoint(i, t)) / half
        : (x - leadPoint(i, t)) / half - 1;

    if (mag(s) >= 1)
    {
        return 0;
    }

    const auto place = [&](const placeType by)
    { return by == byTravel ? centre(i, t) : x; };

    scalar C = occlusion_.value(place(occlusionBy_));

    if (fades_[i].active)
    {
        C *= fades_[i].value(place(fades_[i].by));
    }

    // xi (lambda - xi)/(lambda/2)^2 = 1 - s^2
    return C * std::pow(1 - sqr(s), exponent_);
}


Foam::scalar Foam::antralWaves::occlusion(const scalar x, const scalar t) const
{
    scalar sum = 0;

    for (label i = 0; i < number_; ++i)
    {
        sum += occlusion(i, x, t);
    }

    return sum;
}


Foam::scalarList Foam::antralWaves::eventTimes() const
{
    DynamicList<scalar> times;

    for (label i = 0; i < number_; ++i)
    {
        for (const scalar x : occlusion_.x())
        {
            times.append(arrivalTime(i, x));
        }

        if (fades_[i].active)
        {
            times.append(arrivalTime(i, fades_[i].from));
            times.append(arrivalTime(i, fades_[i].to));
        }
    }

    return scalarList(times);
}


// ************************************************************************* //
