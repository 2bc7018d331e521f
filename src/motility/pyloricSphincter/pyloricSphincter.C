// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "pyloricSphincter.H"
#include "dictionaryCheck.H"

#include <algorithm>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::pyloricSphincter::rampType>
    Foam::pyloricSphincter::rampTypeNames({
        {rampType::linearRamp, "linear"},
        {rampType::smoothRamp, "smooth"},
    });


const Foam::Enum<Foam::pyloricSphincter::triggerType>
    Foam::pyloricSphincter::triggerTypeNames({
        {triggerType::noTrigger, "none"},
        {triggerType::waveTrigger, "wave"},
        {triggerType::scheduleTrigger, "schedule"},
    });


// * * * * * * * * * * * * * Local Helper Functions  * * * * * * * * * * * * //

namespace
{

// The dictionary, once its entries are known to be complete and known
const Foam::dictionary& checked(const Foam::dictionary& dict)
{
    Foam::dictionaryCheck::entries(
        dict,
        {"position",
            "length",
            "relativeOcclusion",
            "exponent",
            "closingRate",
            "trigger"},
        {"openingRate", "ramp"}
    );

    return dict;
}

} // End anonymous namespace


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::pyloricSphincter::readTrigger(
    const dictionary& dict,
    const antralWaves& waves
)
{
    // Here and not in the entries of each type: the type decides on the rest
    if (!dict.found("type"))
    {
        FatalIOErrorInFunction(dict)
            << "Missing entry 'type'; valid are: "
            << dictionaryCheck::list(triggerTypeNames.toc()).c_str()
            << exit(FatalIOError);
    }

    switch (dictionaryCheck::option(dict, "type", triggerTypeNames, noTrigger))
    {
        case noTrigger:
        {
            dictionaryCheck::entries(dict, {"type"});
            break;
        }

        case waveTrigger:
        {
            dictionaryCheck::entries(
                dict, {"type", "position", "closeWave"}, {"openWave"}
            );

            if (!waves.size())
            {
                FatalIOErrorInFunction(dict)
                    << "Entry 'type' is wave, but there are no waves"
                    << " (waves.number is 0); use schedule or none"
                    << exit(FatalIOError);
            }

            const scalar x = dict.get<scalar>("position");

            for (const bool closing : {true, false})
            {
                const word name(closing ? "closeWave" : "openWave");

                if (dict.found(name))
                {
                    const label i = dictionaryCheck::inRange(
                        dict, name, label(0), waves.size()
                    );

                    addEvents({waves.arrivalTime(i, x)}, closing);
                }
            }
            break;
        }

        case scheduleTrigger:
        {
            dictionaryCheck::entries(dict, {"type", "closeTimes", "openTimes"});

            addEvents(dict.get<scalarList>("closeTimes"), true);
            addEvents(dict.get<scalarList>("openTimes"), false);
            break;
        }
    }

    checkEvents(dict);
}


void Foam::pyloricSphincter::addEvents(
    const scalarList& times,
    const bool closing
)
{
    for (const scalar t : times)
    {
        events_.append(event{t, closing});
    }
}


void Foam::pyloricSphincter::checkEvents(const dictionary& dict)
{
    std::stable_sort(
        events_.begin(),
        events_.end(),
        [](const event& a, const event& b) { return a.time < b.time; }
    );

    for (label i = 1; i < events_.size(); ++i)
    {
        const event& last = events_[i - 1];
        const event& next = events_[i];

        if (last.closing == next.closing)
        {
            FatalIOErrorInFunction(dict)
                << "Two " << (next.closing ? "closings" : "openings")
                << " follow each other, at " << last.time << " s and "
                << next.time << " s; closings and openings must alternate"
                << exit(FatalIOError);
        }

        if (next.time < last.time + duration(last))
        {
            FatalIOErrorInFunction(dict)
                << "The " << (next.closing ? "closing" : "opening") << " at "
                << next.time << " s begins before the "
                << (last.closing ? "closing" : "opening") << " at " << last.time
                << " s is complete, at " << last.time + duration(last)
                << " s; move one of them or"
                << " raise the rate" << exit(FatalIOError);
        }
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::pyloricSphincter::pyloricSphincter(
    const dictionary& dict,
    const antralWaves& waves
) :
    position_(checked(dict).get<scalar>("position")),
    length_(dictionaryCheck::positive(dict, "length")),
    relativeOcclusion_(
        dictionaryCheck::inRange(
            dict,
            "relativeOcclusion",
            scalar(0),
            scalar(1)
        )
    ),
    exponent_(dictionaryCheck::positive(dict, "exponent")),
    closingRate_(dictionaryCheck::positive(dict, "closingRate")),
    openingRate_(
        dict.found("openingRate")
            ? dictionaryCheck::positive(dict, "openingRate")
            : closingRate_
    ),
    ramp_(dictionaryCheck::option(dict, "ramp", rampTypeNames, smoothRamp)),
    events_()
{
    readTrigger(dictionaryCheck::section(dict, "trigger"), waves);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::pyloricSphincter::shape(const scalar x) const
{
    // x' (lambda_s - x')/(lambda_s/2)^2 = 1 - s^2
    const scalar s = 2 * (x - position_) / length_ - 1;

    return mag(s) < 1 ? std::pow(1 - sqr(s), exponent_) : 0;
}


Foam::scalar Foam::pyloricSphincter::closure(const scalar t) const
{
    // The last event that has begun decides; it found the sphincter at rest
    // in the opposite state
    label i = events_.size() - 1;

    while (i >= 0 && events_[i].time > t)
    {
        --i;
    }

    if (i < 0)
    {
        return events_.size() && !events_.first().closing ? 1 : 0;
    }

    const event& e = events_[i];

    const scalar s = min(scalar(1), (t - e.time) / duration(e));
    const scalar done = ramp_ == linearRamp ? s : sqr(s) * (3 - 2 * s);

    return e.closing ? done : 1 - done;
}


Foam::scalarList Foam::pyloricSphincter::eventTimes() const
{
    scalarList times(2 * events_.size());

    forAll(events_, i)
    {
        times[2 * i] = events_[i].time;
        times[2 * i + 1] = events_[i].time + duration(events_[i]);
    }

    return times;
}


// ************************************************************************* //
