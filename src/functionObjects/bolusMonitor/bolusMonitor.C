// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "bolusMonitor.H"
#include "IOdictionary.H"
#include "mathematicalConstants.H"
#include "OSspecific.H"
#include "volFields.H"
#include "wallPolyPatch.H"
#include "wedgeFrame.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(bolusMonitor, 0);
}
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::functionObjects::bolusMonitor::rejectUnknown() const
{
    // What OpenFOAM itself reads, of all versions since v1912
    static const wordHashSet stock(
        {"type",
            "libs",
            "functionObjectLibs",
            "region",
            "subRegion",
            "enabled",
            "log",
            "errors",
            "errorHandler",
            "timeStart",
            "timeEnd",
            "nStepsToStartTimeChange",
            "controlMode",
            "triggerStart",
            "triggerEnd",
            "deltaTCoeff",
            "minDeltaTCoeff",
            "executeControl",
            "executeInterval",
            "writeControl",
            "writeInterval",
            "outputControl",
            "outputInterval",
            "writeToFile",
            "useUserTime",
            "updateHeader",
            "useNamePrefix",
            "field",
            "fields",
            "object",
            "objects",
            "result"}
    );

    entries_->rejectOthers(stock, " and those that every function object has");
}


Foam::scalar Foam::functionObjects::bolusMonitor::readDensity() const
{
    const word dictName("bolusProperties");

    const IOdictionary* registered = mesh_.cfindObject<IOdictionary>(dictName);
    if (!registered)
    {
        registered = time_.cfindObject<IOdictionary>(dictName);
    }

    autoPtr<IOdictionary> own;
    if (!registered)
    {
        own.reset(new IOdictionary(IOobject(
            dictName,
            time_.constant(),
            mesh_,
            IOobject::MUST_READ,
            IOobject::NO_WRITE,
            false
        )));
        registered = own.get();
    }

    return entryReader(*registered)
        .number("rho", "density of the bolus [kg/m3]", entryReader::positive);
}


void Foam::functionObjects::bolusMonitor::openTable()
{
    if (!writeToFile_)
    {
        return;
    }

    const fileName dir(
        baseTimeDir().path() / Time::timeName(time_.startTime().value())
    );

    word free(fileName_);
    for (label i = 2; isFile(dir / (free + ".dat")); ++i)
    {
        free = fileName_ + "_" + Foam::name(i);
    }

    resetFile(free);
}


bool Foam::functionObjects::bolusMonitor::ready() const
{
    for (const word& f : fields_)
    {
        if (!mesh_.foundObject<regIOobject>(f))
        {
            return false;
        }
    }

    return true;
}


void Foam::functionObjects::bolusMonitor::requireFields() const
{
    if (!ready())
    {
        FatalErrorInFunction
            << "function object " << name() << " needs the fields " << fields_
            << "; the solver has " << mesh_.sortedNames<regIOobject>()
            << exit(FatalError);
    }
}


void Foam::functionObjects::bolusMonitor::settleInitialMass()
{
    if (initialMass_ >= 0)
    {
        return;
    }

    initialMass_ = factor_ * rho_
        * gSum(scalarField(field("mass").primitiveField() * mesh_.V().field()));
    setProperty("initialMass", initialMass_);

    if (initialMass_ < VSMALL)
    {
        FatalErrorInFunction << "function object " << name()
                             << ": the field mass holds " << initialMass_
                             << " kg of bolus at time " << time_.timeName()
                             << "; there must be some to relate the results to"
                             << exit(FatalError);
    }
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

void Foam::functionObjects::bolusMonitor::requireEveryStep(
    const dictionary& dict
) const
{
    const word control(
        dict.lookupOrDefault<word>("executeControl", "timeStep")
    );
    const scalar interval(dict.lookupOrDefault<scalar>("executeInterval", 1));

    if (control != "timeStep" || interval != 1)
    {
        FatalIOErrorInFunction(dict)
            << "Entries 'executeControl' " << control << ", executeInterval "
            << interval << ": " << name() << " sums over time and must see"
            << " every time step; valid is executeControl timeStep,"
            << " executeInterval 1, or neither entry. To write fewer rows use"
            << " writeControl" << exit(FatalIOError);
    }
}


Foam::labelHashSet Foam::functionObjects::bolusMonitor::readPatches(
    const word& entry,
    const bool walls
)
{
    const polyBoundaryMesh& patches = mesh_.boundaryMesh();
    labelHashSet chosen;

    if (!entries().has(entry))
    {
        for (const polyPatch& pp : patches)
        {
            if (walls ? bool(isA<wallPolyPatch>(pp))
                      : pp.type() == polyPatch::typeName)
            {
                chosen.insert(pp.index());
            }
        }

        return chosen;
    }

    for (const wordRe& pattern : entries().dict().get<wordRes>(entry))
    {
        bool matched = false;
        for (const polyPatch& pp : patches)
        {
            if (pattern.match(pp.name()))
            {
                chosen.insert(pp.index());
                matched = true;
            }
        }

        if (!matched)
        {
            entries().refuse(
                entry,
                "no patch is called " + pattern + "; valid are "
                    + entryReader::list(patches.names())
            );
        }
    }

    return chosen;
}


Foam::entryReader& Foam::functionObjects::bolusMonitor::entries()
{
    return *entries_;
}


void Foam::functionObjects::bolusMonitor::begin()
{
    rejectUnknown();
    // The dictionary need not outlive the construction
    entries_.clear();

    openTable();

    if (writeToFile())
    {
        OFstream& os = file();

        writeHeader(os, title());
        writeHeaderValue(os, "full geometry / mesh [-]", factor_);
        writeCommented(os, "Time [s]");
        for (const string& head : heads())
        {
            writeTabbed(os, head);
        }
        os << endl;
    }

    const bool fresh = initialMass_ < 0;
    if (fresh && ready())
    {
        settleInitialMass();
        initialise();
        write();
    }
}


void Foam::functionObjects::bolusMonitor::initialise()
{}


void Foam::functionObjects::bolusMonitor::accumulate(const scalar, const scalar)
{}


Foam::scalar Foam::functionObjects::bolusMonitor::restored(
    const word& sum
) const
{
    return getProperty<scalar>(sum, 0);
}


const Foam::volScalarField& Foam::functionObjects::bolusMonitor::field(
    const word& fieldName
) const
{
    return mesh_.lookupObject<volScalarField>(fieldName);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::bolusMonitor::bolusMonitor(
    const word& name,
    const Time& runTime,
    const dictionary& dict,
    const word& type,
    const wordList& fields
) :
    fvMeshFunctionObject(name, runTime, dict),
    writeFile(mesh_, name, type),
    fields_(fields),
    entries_(new entryReader(dict)),
    factor_(
        entries().number(
            "geometryFactor",
            "full geometry over the mesh [-]",
            entryReader::positive,
            constant::mathematical::twoPi / wedgeFrame(mesh_).angle()
        )
    ),
    rho_(readDensity()),
    initialMass_(getProperty<scalar>("initialMass", -1)),
    summedUpTo_(getProperty<scalar>("summedUpTo", runTime.value())),
    lastRow_(-GREAT)
{
    fvMeshFunctionObject::read(dict);
    writeFile::read(dict);

    // More than OpenFOAM's 6 digits: the books are balanced to parts in a
    // million, and the differences of rows must carry them
    writePrecision_ = entries().wholeNumber(
        "writePrecision", "digits of the table", entryReader::positive, 9
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::bolusMonitor::read(const dictionary& dict)
{
    WarningInFunction
        << "t " << time_.value() << " s: entries of " << name()
        << " have changed. They count from the next start on (-continue); it"
        << " goes on with the old ones" << endl;

    return true;
}


bool Foam::functionObjects::bolusMonitor::execute()
{
    requireFields();

    if (initialMass_ < 0)
    {
        settleInitialMass();
        initialise();
    }

    // Not deltaT: a solver may already have set that of the next step
    const scalar now = time_.value();
    if (now > summedUpTo_)
    {
        accumulate(summedUpTo_, now);
    }
    summedUpTo_ = now;
    setProperty("summedUpTo", summedUpTo_);

    return true;
}


bool Foam::functionObjects::bolusMonitor::write()
{
    // Time::run() calls this; a solver may ask it more than once a step
    if (time_.value() == lastRow_)
    {
        return true;
    }
    lastRow_ = time_.value();

    const scalarList row(values());

    if (writeToFile())
    {
        OFstream& os = file();

        // Not writeCurrentTime: it rounds to the precision of time folders
        os << setw(charWidth()) << time_.value();
        for (const scalar value : row)
        {
            os << tab << setw(charWidth()) << value;
        }
        os << endl;
    }

    return true;
}


// ************************************************************************* //
