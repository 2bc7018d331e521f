// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers
/*---------------------------------------------------------------------------*\
Application
    bolusFoam

Description
    A solid food bolus - elastic, viscoplastic, breaking - in a moving lumen:
    one-fluid VOF on a dynamic mesh, velocity and pressure solved together.

    A step: the mesh moves; velocity, pressure and stress follow from
    equilibrium (coupledSystem); bolus and memory move with the velocity
    (historyTransport); what has met the criterion breaks (damageModel).
    A step that does not converge is done again, shorter.

Usage
    \b bolusFoam [-checkTangent]

    constant/bolusProperties (elastoViscoPlastic, surroundingPhase),
    constant/dynamicMeshDict, system/fvSolution (coupledSystem,
    historyTransport), system/controlDict (stepControl), 0/alpha, 0/U
    (contactWall on walls, zeroGradient on open boundaries).

\*---------------------------------------------------------------------------*/

#include "petscHandles.H"
#include "argList.H"
#include "dynamicFvMesh.H"
#include "profiling.H"
#include "bolusFields.H"
#include "carriedFields.H"
#include "energyLedger.H"
#include "historyTransport.H"
#include "meshCheck.H"
#include "progress.H"
#include "runLock.H"
#include "signalReport.H"
#include "stepControl.H"
#include "surroundingPhase.H"
#include "writtenTime.H"

using namespace Foam;

//- The step cannot be made short enough
static void giveUp(
    const Time& runTime,
    const stepControl& control,
    const coupledSystem::report& solved
)
{
    FatalErrorInFunction
        << "no convergence at t = " << runTime.value()
        << " s with the smallest step allowed (minDeltaT "
        << control.minDeltaT() << " s): " << solved.reason << ", worst at "
        << solved.worst << " m. Nothing written is lost: the last written"
        << " time is " << runTime.times().last().name()
        << " s; the run can go on from there with other settings"
        << exit(FatalError);
}


//- OpenFOAM goes on without a function object that it cannot read: hours later
//  its results would be missing
static void requireFunctionObjects(const Time& runTime)
{
    const functionObjectList& made = runTime.functionObjects();
    if (!made.status()) return; // -noFunctionObjects

    for (const entry& e : runTime.controlDict().subOrEmptyDict("functions"))
    {
        if (!e.isDict() || !e.dict().lookupOrDefault("enabled", true)) continue;
        if (made.findObjectID(e.keyword()) < 0)
        {
            FatalIOErrorInFunction(e.dict())
                << "Entry '" << e.keyword() << "' of functions: this function"
                << " object could not be read, for the reason in the warning"
                << " above; valid are a right one, or none (enabled no)"
                << exit(FatalIOError);
        }
    }
}


//- Numerics count from the start of a run. With runTimeModifiable OpenFOAM
//  reads fvSolution again, and says so: then it must be told what for
static void tellWhatCountsLater(const fvMesh& mesh, SHA1Digest& before)
{
    dictionary ours;
    for (const word& name : {word("bolus"), word("transport")})
    {
        ours.add(name, mesh.solutionDict().subOrEmptyDict(name));
    }
    const SHA1Digest now(ours.digest());
    if (!before.empty() && now != before)
    {
        WarningInFunction
            << "t " << mesh.time().value() << " s: entries bolus or transport"
            << " of fvSolution have changed. They count from the next start on"
            << " (-continue); this run goes on with the old ones" << endl;
    }
    before = now;
}


int main(int argc, char* argv[])
{
    argList::addNote(
        "Solid bolus in a moving lumen: elastoviscoplastic VOF with damage,"
        " velocity and pressure coupled"
    );
    argList::addBoolOption(
        "checkTangent",
        "compare the tangent with finite differences after each step"
    );

    #include "setRootCase.H"
    #include "createTime.H"
    const runLock folder(runTime.globalPath());
    petscSession petsc;
    signalReport signals(runTime);
    meshCheck::requireMesh(runTime);
    writtenTime written(runTime);

    autoPtr<dynamicFvMesh> meshPtr(
        dynamicFvMesh::New(IOobject(
            dynamicFvMesh::defaultRegion,
            runTime.timeName(),
            runTime,
            IOobject::MUST_READ
        ))
    );
    dynamicFvMesh& mesh = meshPtr();

    const IOdictionary properties(IOobject(
        "bolusProperties",
        runTime.constant(),
        mesh,
        IOobject::MUST_READ,
        IOobject::NO_WRITE
    ));
    const elastoViscoPlastic law(properties);
    const caseScales scales(runTime.controlDict(), law);
    autoPtr<surroundingPhase> medium(surroundingPhase::New(properties, scales));
    const dictionary& solver = mesh.solutionDict().subOrEmptyDict("bolus");

    autoPtr<bolusFields> fieldsPtr;
    {
        // What is no number is found and named
        const trapsOff noTraps;
        fieldsPtr.reset(new bolusFields(mesh, law));
    }
    bolusFields& fields = fieldsPtr();
    carriedFields carried(properties, fields);
    coupledSystem system(law, medium.ref(), fields, scales, properties, solver);
    // The bolus takes its momentum along
    if (system.inertia() > 0) fields.history["U"].carry();
    historyTransport transport(
        fields,
        law.elastic().K(),
        system.space().axes(),
        mesh.solutionDict().subOrEmptyDict("transport")
    );
    stepControl control(runTime);
    energyLedger energy(runTime, fields, law, system);
    progress report(runTime, fields, control, energy);

    SHA1Digest numerics;

    Info << "Starting at t = " << runTime.value() << " s" << nl << endl;

    while (runTime.run())
    {
        // OpenFOAM has just read them
        if (runTime.timeIndex() == runTime.startTimeIndex())
        {
            requireFunctionObjects(runTime);
        }
        if (written.complete()) signals.written(written.name());
        tellWhatCountsLater(mesh, numerics);
        fields.history.store();
        signals.step();
        control.start();

        coupledSystem::report solved;
        historyTransport::report moved;
        bool done = false;
        label overfull = 0;
        const scalar fullest = gMax(fields.alpha.primitiveField());
        bool again = false;
        while (!done)
        {
            {
                // Motion solvers that move on from where the mesh is
                if (again) mesh.movePoints(pointField(mesh.oldPoints()));
                again = true;
                addProfiling(motion, "mesh motion");
                mesh.update();
                meshCheck::requireSoundCells(mesh);
            }
            {
                addProfiling(equilibrium, "equilibrium");
                solved = system.solve(runTime.deltaTValue());
            }

            if (solved.converged)
            {
                if (args.found("checkTangent"))
                {
                    Info << "Tangent against finite differences: "
                         << system.checkTangent(runTime.deltaTValue()) << endl;
                }
                system.accept(fields.phi, fields.wallForce, fields.wallPower);
                addProfiling(transport, "transport");
                moved = transport.advance(
                    fields.phi, runTime.deltaTValue(), fields.massFlux
                );
                // A piece that nothing holds was shot off; bolus burst
                if (moved.tooFast || !(moved.alphaMax < transport.burst()))
                {
                    fields.history.restore();
                    solved.converged = false;
                    solved.reason = moved.tooFast
                        ? "flow too fast for maxSubSteps"
                        : "alpha beyond all bounds";
                }
            }

            if (!solved.converged)
            {
                Info << "t " << runTime.value() << " s, dt "
                     << runTime.deltaTValue() << " s: not converged ("
                     << solved.reason << ", stress imbalance "
                     << solved.momentum << ", volume rate " << solved.continuity
                     << ", worst at " << solved.worst << "): shorter step"
                     << endl;
                if (!control.retry()) giveUp(runTime, control, solved);
                continue;
            }

            // A cell cannot hold more than it has room for: the step was too
            // long for the gas that it had to close. Where two shorter ones
            // do not help, the excess is worked off in the steps to come
            done = moved.alphaMax <= max(transport.maxAlpha(), fullest)
                || overfull == 2 || !control.retry();
            if (!done)
            {
                fields.history.restore();
                ++overfull;
            }
        }

        carried.evolve(runTime.deltaTValue());
        fields.damage(system.damageAbove());
        fields.derive();
        energy.step(system, runTime.deltaTValue());

        control.done(solved.iterations, moved.bulkCourant);
        report.step(
            solved,
            moved,
            system.accepted().bolusRate,
            system.accepted().flowRate
        );

        if (control.write())
        {
            addProfiling(write, "write");
            written.write();
        }
    }
    written.complete();

    if (runTime.timeIndex() == runTime.startTimeIndex())
    {
        Info << "Nothing left to do: the last written time, "
             << runTime.timeName() << " s, is at or beyond endTime "
             << runTime.endTime().value() << " s. A later endTime goes on"
             << endl;
    }
    report.summary(system.linearIterations());
    Info << "End" << nl << endl;

    return 0;
}

// ************************************************************************* //
