// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "signalReport.H"
#include "Pstream.H"

#include <csignal>
#include <cstdio>
#include <cstring>
#include <unistd.h>

namespace
{

struct watched
{
    int signal;
    const char* name;
    bool everyRank;
    struct sigaction before;
};

watched signals[] = {
    {SIGFPE, "SIGFPE (arithmetic without a result)", true, {}},
    {SIGSEGV, "SIGSEGV (memory that is not there)", true, {}},
    {SIGBUS, "SIGBUS (memory that is not there)", true, {}},
    {SIGILL, "SIGILL (an instruction that this processor lacks)", true, {}},
    {SIGABRT, "SIGABRT", true, {}},
    {SIGTERM, "SIGTERM", false, {}},
    {SIGINT, "SIGINT", false, {}}
};

char place[512] = "";
bool master = true;

void print(const char* text)
{
    // Nothing can be done if that fails
    if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

} // End anonymous namespace


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::signalReport::handle(int signal)
{
    for (watched& w : signals)
    {
        if (w.signal != signal) continue;
        if (w.everyRank || master)
        {
            print("\nbolusFoam: stopped by ");
            print(w.name);
            print(place);
        }
        sigaction(signal, &w.before, nullptr);
        // Whoever prints the stack may hang on what the signal interrupted
        if (w.everyRank) alarm(10);
    }
    // Pending until this one returns
    raise(signal);
}


void Foam::signalReport::prepare()
{
    std::snprintf(
        place,
        sizeof(place),
        " in the step after t = %.10g s%s. The last complete time is %s s:"
        " nothing that was written is lost, and the run can go on from there"
        " (./Allrun run ... -continue)\n",
        time_.value(),
        Pstream::parRun()
            ? (" on rank " + std::to_string(Pstream::myProcNo())).c_str()
            : "",
        written_.c_str()
    );
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::signalReport::signalReport(const Time& time) :
    time_(time),
    written_(time.timeName())
{
    master = Pstream::master();
    prepare();
    for (watched& w : signals)
    {
        sigaction(w.signal, nullptr, &w.before);
        // What the user ignores (nohup) stays ignored
        if (w.before.sa_handler == SIG_IGN) continue;
        struct sigaction action;
        std::memset(&action, 0, sizeof(action));
        action.sa_handler = handle;
        sigemptyset(&action.sa_mask);
        sigaction(w.signal, &action, nullptr);
    }
}


Foam::signalReport::~signalReport()
{
    for (watched& w : signals) sigaction(w.signal, &w.before, nullptr);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::signalReport::written(const word& name)
{
    written_ = name;
    prepare();
}

// ************************************************************************* //
