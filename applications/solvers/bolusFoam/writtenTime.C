// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "writtenTime.H"

#include "OFstream.H"
#include "OSspecific.H"
#include "Pstream.H"
#include "PstreamReduceOps.H"

namespace Foam
{

//- Digits of the names of times, which Time lets its own kind change only
struct nameDigits : public Time
{
    static int& value()
    {
        return precision_;
    }
};

//- Of case A, half a second after a restart, the force is another one by 4e-5
//  with 6 digits, 6e-7 with 8, 2e-9 with 10
constexpr unsigned leastDigits = 10;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::fileName Foam::writtenTime::mark(const fileName& folder)
{
    return folder / "uniform" / "complete";
}


void Foam::writtenTime::fail(const fileName& folder) const
{
    FatalErrorInFunction
        << "time " << time_.timeName() << " s could not be written to its end"
        << " in " << folder << ": is the disk full, or the case read-only?"
        << " Nothing that was complete before is lost; -continue goes on from"
        << " the last complete time" << exit(FatalError);
}


void Foam::writtenTime::requireDigits() const
{
    const dictionary& dict = time_.controlDict();

    const unsigned digits = IOstream::defaultPrecision();
    if (time_.writeFormat() == IOstream::ASCII && digits < leastDigits)
    {
        FatalIOErrorInFunction(dict)
            << "entry writePrecision: " << digits << " with writeFormat ascii;"
            << " valid are " << leastDigits
            << " and more, or writeFormat binary:"
            << " with fewer digits a run that goes on from what was written"
            << " would be another run" << exit(FatalIOError);
    }
}


void Foam::writtenTime::findName()
{
    // A step's rounding error is not worth a digit. With fewer than all digits
    // OpenFOAM might not find the time again, and start from none
    const scalar enough = 1e-9 * time_.deltaTValue();
    if (mag(readScalar(time_.timeName()) - time_.value()) > enough)
    {
        static_cast<TimeState&>(time_).dimensionedScalar::name() =
            Time::timeName(time_.value(), 17);
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::writtenTime::writtenTime(Time& time) :
    time_(time)
{
    // OpenFOAM takes all digits that a number has where it needs them to find
    // the folder: the names to come are those of a run that did not stop
    nameDigits::value() =
        time.controlDict().lookupOrDefault<label>("timePrecision", 6);
    requireDigits();

    const fileName folder(time.timePath());
    if (isFile(folder / "uniform" / "time") && !isFile(mark(folder)))
    {
        FatalErrorInFunction
            << "time " << time.timeName() << " s in " << folder
            << " is not complete (no uniform/complete): the run that wrote it"
            << " was stopped meanwhile. Put that folder aside to start from"
            << " the time before, as ./Allrun run -continue does"
            << exit(FatalError);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::writtenTime::write()
{
    findName();
    const fileName folder(time_.timePath());
    // Until it is written again, what is there is not to be trusted
    rm(mark(folder));
    // Dictionaries are ascii whatever the fields are; and controlDict may have
    // changed since the start
    const bool ascii = time_.writeFormat() == IOstream::ASCII;
    const unsigned digits = IOstream::defaultPrecision();
    const unsigned least = ascii ? leastDigits : 17u;
    if (ascii && digits < least)
    {
        WarningInFunction << "t " << time_.value() << " s: writePrecision is "
                          << digits << " now: written with " << least
                          << " digits all the same, so that"
                          << " a run that goes on from here is the same run"
                          << endl;
    }
    IOstream::defaultPrecision(max(digits, least));
    bool written = time_.writeNow();
    IOstream::defaultPrecision(digits);
    reduce(written, andOp<bool>());
    if (!written) fail(folder);
    pending_ = folder;
    pendingName_ = time_.timeName();
}


bool Foam::writtenTime::complete()
{
    if (pending_.empty()) return false;

    mkDir(pending_ / "uniform");
    bool written;
    {
        OFstream file(mark(pending_));
        file << "All of this time was written." << endl;
        written = file.good();
    }
    reduce(written, andOp<bool>());
    if (!written) fail(pending_);
    pending_.clear();
    return true;
}

// ************************************************************************* //
