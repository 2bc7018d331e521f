// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "runLock.H"

#include "OSspecific.H"
#include "Pstream.H"
#include "PstreamReduceOps.H"
#include "error.H"

#include <cerrno>
#include <climits>
#include <cstdlib>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

std::string Foam::runLock::take(const fileName& folder)
{
    char real[PATH_MAX];
    const char* given = std::getenv("BOLUSFOAM_LOCK");
    if (given && ::realpath(folder.c_str(), real) && std::string(given) == real)
    {
        return "";
    }

    const fileName name(folder / ".bolusFoamLock");
    file_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ >= 0 && ::flock(file_, LOCK_EX | LOCK_NB) == 0)
    {
        const std::string text(
            std::to_string(::getpid()) + " bolusFoam on " + hostName() + "\n"
        );
        if (::ftruncate(file_, 0) != 0
            || ::write(file_, text.c_str(), text.size()) < 0)
        {
            Info << "The lock " << name << " could not be written" << endl;
        }
        return "";
    }
    if (file_ >= 0 && errno == EWOULDBLOCK)
    {
        char text[200] = "";
        const ssize_t n = ::pread(file_, text, sizeof(text) - 1, 0);
        std::string owner(text, n > 0 ? n : 0);
        owner.erase(owner.find_last_not_of("\n") + 1);
        return owner.empty() ? "another process" : "process " + owner;
    }

    Info << "The folder " << folder << " takes no lock: nothing keeps another"
         << " run out of it" << nl << endl;
    return "";
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::runLock::runLock(const fileName& folder) :
    file_(-1)
{
    std::string owner;
    if (Pstream::master()) owner = take(folder);

    bool busy = !owner.empty();
    reduce(busy, orOp<bool>());
    if (busy)
    {
        // The others know no name
        FatalErrorInFunction
            << "the case " << folder << " is in use by "
            << (owner.empty() ? "another process" : owner.c_str())
            << ": two runs in one folder would mix their results. Wait for it"
            << " or stop it, or run in a copy" << exit(FatalError);
    }
}


Foam::runLock::~runLock()
{
    if (file_ >= 0) ::close(file_);
}

// ************************************************************************* //
