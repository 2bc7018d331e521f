// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "stepControl.H"
#include "caseScales.H"
#include "entryReader.H"

namespace Foam
{

//- A state of time in which nothing is to be written
struct quietTimeState : public TimeState
{
    quietTimeState(const TimeState& state) :
        TimeState(state)
    {
        writeTime_ = false;
    }
};

} // End namespace Foam


Foam::stepControl::stepControl(Time& time) :
    time_(time),
    before_(time),
    memory_(IOobject(
        "stepControl",
        time.timeName(),
        "uniform",
        time,
        IOobject::READ_IF_PRESENT,
        IOobject::AUTO_WRITE
    )),
    patience_(memory_.lookupOrDefault<label>("patience", 0)),
    steps_(memory_.lookupOrDefault<label>("steps", 0)),
    rejected_(memory_.lookupOrDefault<label>("rejected", 0)),
    iterations_(memory_.lookupOrDefault<label>("iterations", 0)),
    writeInterval_(0),
    strainRate_(caseScales::readStrainRate(time.controlDict()))
{
    read();

    deltaT_ = entryReader(time_.controlDict())
                  .number("deltaT", "first step [s]", entryReader::positive);
    memory_.readIfPresent("deltaT", deltaT_);
}


void Foam::stepControl::read()
{
    const dictionary& dict = time_.controlDict();

    // Others read this dictionary too: only what looks like one of ours can be
    // told to be misspelt
    const wordList own(
        {"maxDeltaT", "minDeltaT", "maxCourant", "easyIterations", "strainRate"}
    );
    for (const word& key : dict.toc())
    {
        const word begin(key.substr(0, 3));
        const bool similar = begin == "max" || begin == "min" || begin == "eas"
            || key.substr(0, 6) == "strain";
        if (similar && !own.found(key))
        {
            FatalIOErrorInFunction(dict)
                << "Unknown entry '" << key << "'; valid entries are "
                << flatOutput(own) << exit(FatalIOError);
        }
    }

    const scalar slow = 0.1 / caseScales::readStrainRate(dict);
    const auto& positive = entryReader::positive;
    entryReader read(dict);
    const scalar maxDeltaT =
        read.number("maxDeltaT", "largest step [s]", positive, 0.05 * slow);
    const scalar minDeltaT =
        read.number("minDeltaT", "smallest step [s]", positive, 1e-5 * slow);
    const scalar maxCourant =
        read.number("maxCourant", "Courant number [-]", positive, 1);
    const label easyIterations = read.wholeNumber(
        "easyIterations", "Newton iterations of an easy step", positive, 8
    );
    if (minDeltaT > maxDeltaT)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'minDeltaT' is " << minDeltaT << "; valid are numbers up"
            << " to maxDeltaT, " << maxDeltaT << " s" << exit(FatalIOError);
    }

    scalar writeInterval = 0;
    const word control(read.name("writeControl", "when to write"));
    if (control == "adjustableRunTime" || control == "adjustable")
    {
        writeInterval =
            read.number("writeInterval", "time between outputs [s]", positive);
    }

    // All of them are good
    maxDeltaT_ = maxDeltaT;
    minDeltaT_ = minDeltaT;
    maxCourant_ = maxCourant;
    easyIterations_ = easyIterations;
    writeInterval_ = writeInterval;
}


void Foam::stepControl::readModified()
{
    const SHA1Digest digest(time_.controlDict().digest());
    if (digest == digest_) return;
    const bool first = digest_.empty();
    digest_ = digest;
    if (first) return;

    // A run of hours does not end at a slip of the pen
    const bool throws = FatalIOError.throwExceptions();
    try
    {
        read();
        if (caseScales::readStrainRate(time_.controlDict()) != strainRate_)
        {
            WarningInFunction
                << "t " << time_.value() << " s: strainRate has changed. It"
                << " counts from the next start on (-continue); this run goes"
                << " on with " << strainRate_ << " /s" << endl;
        }
        Info << "t " << time_.value() << " s: controlDict has changed: endTime "
             << time_.endTime().value() << " s, maxDeltaT " << maxDeltaT_
             << " s, minDeltaT " << minDeltaT_ << " s, maxCourant "
             << maxCourant_ << ", easyIterations " << easyIterations_
             << ", writeInterval " << writeInterval_ << " s" << endl;
    }
    catch (const IOerror& bad)
    {
        Info << "t " << time_.value() << " s: controlDict has changed, and is"
             << " not taken over: " << bad.message().c_str() << endl;
    }
    FatalIOError.throwExceptions(throws);
}


void Foam::stepControl::advance(const scalar deltaT)
{
    time_.setDeltaT(deltaT, false);
    ++time_;

    // OpenFOAM decides now whether to write, before the step, which may yet be
    // rejected; and by times counted from the start of the run, which need not
    // be those of a former run. Left so, function objects would write their
    // state into folders of their own. write() decides instead
    if (writeInterval_ > 0)
    {
        static_cast<TimeState&>(time_) = quietTimeState(time_);
    }
}


void Foam::stepControl::start()
{
    readModified();
    scalar dt = min(deltaT_, maxDeltaT_);

    // Meet the next event in equal steps
    scalar toEvent = time_.endTime().value() - time_.value();
    if (writeInterval_ > 0)
    {
        const scalar n = std::floor(time_.value() / writeInterval_ + 1e-6) + 1;
        toEvent = min(toEvent, n * writeInterval_ - time_.value());
    }
    if (toEvent > 1e-9 * dt)
    {
        dt = toEvent / std::ceil(toEvent / dt - 1e-6);
    }
    before_ = time_;
    advance(dt);
}


bool Foam::stepControl::retry()
{
    const scalar dt = 0.4 * time_.deltaTValue();
    if (dt < minDeltaT_) return false;

    ++rejected_;
    patience_ = 3;
    deltaT_ = dt;
    static_cast<TimeState&>(time_) = before_;
    advance(dt);
    return true;
}


void Foam::stepControl::done(const label iterations, const scalar courant)
{
    ++steps_;
    iterations_ += iterations;

    const scalar dt = time_.deltaTValue();
    if (patience_ > 0)
    {
        --patience_;
    }
    else if (iterations <= easyIterations_)
    {
        deltaT_ = min(1.3 * max(deltaT_, dt), maxDeltaT_);
    }
    else if (iterations > 2 * easyIterations_)
    {
        deltaT_ = max(0.7 * dt, minDeltaT_);
    }
    if (courant > SMALL)
    {
        deltaT_ = min(deltaT_, max(dt * maxCourant_ / courant, minDeltaT_));
    }

    // As a token: set() would round to the digits that are written
    memory_.add("deltaT", deltaT_, true);
    memory_.set("patience", patience_);
    memory_.set("steps", steps_);
    memory_.set("rejected", rejected_);
    memory_.set("iterations", iterations_);
}


bool Foam::stepControl::write() const
{
    if (writeInterval_ == 0) return time_.writeTime();

    // Asked to stop, by a signal or by a changed controlDict
    if (time_.stopAt() == Time::stopAtControls::saWriteNow) return true;

    const scalar n = std::round(time_.value() / writeInterval_);
    return mag(time_.value() - n * writeInterval_) < 1e-6 * time_.deltaTValue();
}

// ************************************************************************* //
