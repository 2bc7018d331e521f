// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "pyloricSphincter.H"

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


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::pyloricSphincter::readTrigger(
    const dictionary& dict,
    const antralWaves& waves
)
{
    entryReader read(dict);

    switch (read.choice("type", "what starts the motion", triggerTypeNames))
    {
        case noTrigger:
        {
            break;
        }

        case waveTrigger:
        {
            if (!waves.size())
            {
                read.refuse(
                    "type",
                    "there are no waves (waves.number is 0), valid are"
                    " schedule and none"
                );
            }

            const scalar x = read.number(
                "position", "of the tip [m]", entryReader::anything
            );
            read.require("closeWave", "number of the wave that closes");

            for (const bool closing : {true, false})
            {
                const word name(closing ? "closeWave" : "openWave");

                if (read.has(name))
                {
                    const label i = read.wholeNumber(
                        name,
                        "number of a wave",
                        {0, true, scalar(waves.size() - 1), true}
                    );

                    addEvents({waves.arrivalTime(i, x)}, closing);
                }
            }
            break;
        }

        case scheduleTrigger:
        {
            addEvents(read.numbers("closeTimes", "list of times [s]"), true);
            addEvents(read.numbers("openTimes", "list of times [s]"), false);
            break;
        }
    }

    read.rejectOthers();
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
    entryReader read,
    const antralWaves& waves
) :
    position_(read.number(
        "position",
        "beginning of the pylorus [m]",
        entryReader::anything
    )),
    length_(
        read.number("length", "of the sphincter [m]", entryReader::positive)
    ),
    relativeOcclusion_(read.number(
        "relativeOcclusion",
        "of the open sphincter [-]",
        {0, true, 1, false}
    )),
    exponent_(
        read.number("exponent", "of the shape [-]", entryReader::positive)
    ),
    closingRate_(
        read.number("closingRate", "rate [1/s]", entryReader::positive)
    ),
    openingRate_(read.number(
        "openingRate",
        "rate [1/s]",
        entryReader::positive,
        closingRate_
    )),
    ramp_(
        read.choice("ramp", "path of the closure", rampTypeNames, smoothRamp)
    ),
    events_()
{
    readTrigger(read.section("trigger", "what starts the motion"), waves);
    read.rejectOthers();
}


Foam::pyloricSphincter::pyloricSphincter(
    const dictionary& dict,
    const antralWaves& waves
) :
    pyloricSphincter(entryReader(dict), waves)
{}


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
