// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "writtenTime.H"

#include "OFstream.H"
#include "OSspecific.H"
#include "PstreamReduceOps.H"

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


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::writtenTime::writtenTime(Time& time) :
    time_(time)
{
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
    const fileName folder(time_.timePath());
    // Until it is written again, what is there is not to be trusted
    rm(mark(folder));
    bool written = time_.writeNow();
    reduce(written, andOp<bool>());
    if (!written) fail(folder);
    pending_ = folder;
}


void Foam::writtenTime::complete()
{
    if (pending_.empty()) return;

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
}

// ************************************************************************* //
