// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "antralWaves.H"
#include "DynamicList.H"

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
                << "Entry 'wavelength' has " << lambda[k]
                << " m at x = " << x[k] << " m; valid are wavelengths > 0"
                << exit(FatalIOError);
        }

        if (k > 0 && mag(lambda[k] - lambda[k - 1]) >= x[k] - x[k - 1])
        {
            FatalIOErrorInFunction(dict)
                << "Entry 'wavelength' changes from " << lambda[k - 1]
                << " m at x = " << x[k - 1] << " m to " << lambda[k]
                << " m at x = " << x[k]
                << " m; valid are slopes between -1 and 1"
                << exit(FatalIOError);
        }

        if (number_ > 1 && lambda[k] > spacing_)
        {
            FatalIOErrorInFunction(dict)
                << "Entry 'spacing' is " << spacing_
                << " m; valid are at least the largest wavelength, here "
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
                << "Entry 'occlusion' has " << C[k]
                << " at x = " << occlusion_.x()[k]
                << " m; valid are occlusions >= 0 and < 1:"
                << " 1 closes the lumen, more inverts the cells"
                << exit(FatalIOError);
        }
    }
}


void Foam::antralWaves::readFades(entryReader& read)
{
    fades_.resize(number_, fade{false, 0, 0, byTravel});

    if (!read.has("fadeOut"))
    {
        return;
    }

    entryReader all(read.section("fadeOut", "waves that fade out"));

    forAll(fades_, i)
    {
        const word name("wave" + Foam::name(i));

        if (!all.has(name))
        {
            continue;
        }

        entryReader wave(all.section(name, "from, to [m]"));
        fade& f = fades_[i];

        f.active = true;
        f.from = wave.number(
            "from",
            "where the fade-out begins [m], not before the waves start,",
            {start_, true, VGREAT, true}
        );
        f.to = wave.number(
            "to",
            "where it ends [m], beyond 'from',",
            {f.from, false, VGREAT, true}
        );
        f.by = wave.choice(
            "fadeBy", "what the fade-out goes by", placeTypeNames, byTravel
        );
        wave.rejectOthers();
    }
    all.rejectOthers();
}


Foam::scalar Foam::antralWaves::leadPoint(const label i, const scalar t) const
{
    const scalar lambda = wavelength_.value(start_);

    const scalar behind = reading_ == centreReading ? lambda / 2 : lambda;

    return start_ - behind - i * spacing_ + speed_ * t;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::antralWaves::antralWaves(entryReader read) :
    number_(read.wholeNumber("number", "waves", {0, true, 1000, true})),
    start_(
        read.number("start", "where waves start [m]", entryReader::anything)
    ),
    spacing_(
        read.number("spacing", "between waves [m]", entryReader::positive)
    ),
    speed_(read.number("speed", "of the waves [m/s]", entryReader::positive)),
    wavelength_(read.table("wavelength", "x [m], wavelength [m]")),
    occlusion_(read.table("occlusion", "x [m], occlusion [-]")),
    exponent_(
        read.number("exponent", "of the shape [-]", entryReader::positive)
    ),
    occlusionBy_(read.choice(
        "occlusionBy",
        "where the occlusion is taken",
        placeTypeNames,
        byPosition
    )),
    reading_(read.choice(
        "reading",
        "reading of Eq. 14",
        readingTypeNames,
        centreReading
    )),
    fades_()
{
    check(read.dict());
    readFades(read);
    read.rejectOthers();
}


Foam::antralWaves::antralWaves(const dictionary& dict) :
    antralWaves(entryReader(dict))
{}


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
