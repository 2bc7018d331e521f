// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "progress.H"
#include "OSspecific.H"

#include <iomanip>

Foam::progress::progress(
    const Time& time,
    const bolusFields& fields,
    const stepControl& control,
    const energyLedger& energy
) :
    time_(time),
    fields_(fields),
    control_(control),
    energy_(energy),
    lastLine_(-GREAT),
    startTime_(time.value()),
    books_(IOobject(
        "bolusBooks",
        time.timeName(),
        "uniform",
        time,
        IOobject::READ_IF_PRESENT,
        IOobject::AUTO_WRITE
    )),
    initial_(books_.lookupOrDefault<scalar>("initial", fields.totalMass())),
    emptied_(books_.lookupOrDefault<scalar>("emptied", 0)),
    overfull_(books_.lookupOrDefault<label>("overfull", 0)),
    lagged_(books_.lookupOrDefault<label>("explicitPressure", 0)),
    turned_(books_.lookupOrDefault<label>("turned", 0)),
    turning_(false),
    spilled_(books_.lookupOrDefault<scalar>("spilled", 0)),
    alphaMin_(gMin(fields.alpha.primitiveField())),
    alphaMax_(gMax(fields.alpha.primitiveField())),
    massError_(0),
    typicalRate_(caseScales::readStrainRate(time.controlDict())),
    largestRate_(books_.lookupOrDefault<scalar>("largestRate", 0)),
    strain_(books_.lookupOrDefault<scalar>("strain", 0)),
    strainTime_(books_.lookupOrDefault<scalar>("strainTime", 0))
{
    if (!(initial_ > 0))
    {
        FatalErrorInFunction
            << "field alpha: there is no bolus in the domain; valid is a"
            << " field with alpha = 1 somewhere (setAlphaField)"
            << exit(FatalError);
    }
    massError_ = (fields_.totalMass() + emptied_ - initial_) / initial_;
    books_.add("initial", initial_, true);
    books_.add("emptied", emptied_, true);

    if (Pstream::master())
    {
        const fileName dir(
            time.globalPath() / "postProcessing" / "solver" / time.timeName()
        );
        mkDir(dir);
        file_.reset(new OFstream(dir / "steps.dat"));
        file_() << "# time [s]" << tab << "deltaT [s]" << tab
                << "NewtonIterations [-]" << tab << "rejected [-]" << tab
                << "explicitPressure [-]" << tab << "splitRotation [-]" << tab
                << "courant [-]" << tab << "subSteps [-]" << tab
                << "slowSubSteps [-]" << tab << "massError [-]" << tab
                << "alphaMin [-]" << tab << "alphaMax [-]" << tab
                << "epsilonPEqMin [-]" << tab << "cpuTime [s]" << endl;
    }
}


void Foam::progress::step(
    const coupledSystem::report& solved,
    const historyTransport::report& moved,
    const scalar bolusRate,
    const scalar flowRate
)
{
    scalar out = 0;
    for (const fvsPatchScalarField& F : fields_.massFlux.boundaryField())
    {
        if (!F.coupled()) out += sum(F);
    }
    reduce(out, sumOp<scalar>());
    emptied_ += out * time_.deltaTValue();
    books_.add("emptied", emptied_, true);
    spilled_ += moved.spilled;
    books_.add("spilled", spilled_, true);
    if (moved.alphaMax > 1.01)
    {
        books_.set("overfull", ++overfull_);
        Info << "t " << time_.value() << " s: a cell is overfull, alpha "
             << moved.alphaMax << " (step " << overfull_
             << " of this kind): the excess is worked off in the next steps"
             << endl;
    }

    if (solved.explicitPressure)
    {
        books_.set("explicitPressure", ++lagged_);
        Info << "t " << time_.value() << " s, dt " << time_.deltaTValue()
             << " s: friction with the contact pressure of the step's start"
             << " (step " << lagged_ << " of this kind)" << endl;
    }

    if (solved.rotationSplit)
    {
        books_.set("turned", ++turned_);
        if (!turning_)
        {
            Info << "t " << time_.value() << " s, dt " << time_.deltaTValue()
                 << " s: the stress turns after equilibrium was found, here and"
                 << " in the next steps (step " << turned_ << " of this kind)"
                 << endl;
        }
    }
    turning_ = solved.rotationSplit;

    massError_ = (fields_.totalMass() + emptied_ - initial_) / initial_;
    const scalar low = gMin(fields_.alpha.primitiveField());
    const scalar high = gMax(fields_.alpha.primitiveField());
    alphaMin_ = min(alphaMin_, low);
    alphaMax_ = max(alphaMax_, high);

    largestRate_ = max(largestRate_, flowRate);
    strain_ += bolusRate * time_.deltaTValue();
    strainTime_ += time_.deltaTValue();
    books_.add("largestRate", largestRate_, true);
    books_.add("strain", strain_, true);
    books_.add("strainTime", strainTime_, true);
    if (control_.steps() == 20) tellRate();

    // Below 0 only if the transport has gone wrong
    const scalar leastStrain = gMin(fields_.epsilonPEq.primitiveField());
    if (leastStrain < -1e-9)
    {
        Info << "t " << time_.value() << " s: a plastic strain is "
             << leastStrain << ": the transport has gone wrong" << endl;
    }

    if (file_.valid())
    {
        file_() << time_.value() << tab << time_.deltaTValue() << tab
                << solved.iterations << tab << control_.rejected() << tab
                << lagged_ << tab << turned_ << tab << moved.courant << tab
                << moved.subSteps << tab << moved.slowSubSteps << tab
                << massError_ << tab << low << tab << high << tab << leastStrain
                << tab << time_.elapsedCpuTime() << endl;
    }

    // Not time_.run(), which would execute the function objects
    const bool last =
        time_.value() >= time_.endTime().value() - 0.5 * time_.deltaTValue();
    const scalar now = clock_.elapsedTime();
    if (now - lastLine_ < 1 && !last) return;
    lastLine_ = now;

    const scalar done = time_.value() - startTime_;
    // Bounded: it is counted in whole minutes
    const scalar left =
        min(now * (time_.endTime().value() - time_.value()) / max(done, VSMALL),
            scalar(6e5));

    char line[256];
    snprintf(
        line,
        sizeof(line),
        "t %9.5f s  dt %8.2e  Newton %2d  Co %6.2f  rejected %d  "
        "mass error %9.2e  alpha %9.2e..1%+8.1e  left %d:%02d min",
        time_.value(),
        time_.deltaTValue(),
        int(solved.iterations),
        moved.courant,
        int(control_.rejected()),
        massError_,
        low,
        high - 1,
        int(left) / 60,
        int(left) % 60
    );
    Info << line << endl;
}


void Foam::progress::tellRate() const
{
    // What is at rest has no rate
    const bool slow = strain_ > 1e-6 && largestRate_ < typicalRate_ / 30;
    const bool fast = strain_ > 30 * typicalRate_ * strainTime_;
    if (!slow && !fast) return;

    WarningInFunction
        << "the bolus deforms at " << strain_ / strainTime_
        << " /s in the mean, at most " << largestRate_
        << " /s where it does, and the case's strainRate (controlDict) is "
        << typicalRate_
        << " /s: tolerances, the void's viscosities and other artificial"
        << " numbers are made for that one and may be felt. Set strainRate to"
        << " that of the bolus" << endl;
}


void Foam::progress::summary(const label linearIterations) const
{
    Info << nl << "Summary" << nl << "    end time         " << time_.value()
         << " s" << nl << "    cells            "
         << returnReduce(fields_.alpha.mesh().nCells(), sumOp<label>()) << nl
         << "    cores            " << Pstream::nProcs() << nl
         << "    steps            " << control_.steps() << nl
         << "    rejected steps   " << control_.rejected() << nl
         << "    friction lagged  " << lagged_ << " steps" << nl
         << "    turning lagged   " << turned_ << " steps" << nl
         << "    Newton iterations " << control_.iterations() << nl
         << "    linear iterations " << linearIterations << nl
         << "    mass error       " << massError_ << nl
         << "    overfull steps   " << overfull_ << " (alpha above 1.01)" << nl
         << "    spilled          " << spilled_ / initial_ << " of the bolus"
         << nl << "    alpha            " << alphaMin_ << " to " << alphaMax_
         << nl;
    Info << "    strain rate      " << strain_ / max(strainTime_, VSMALL)
         << " /s mean of the bolus, at most " << largestRate_
         << " /s where it deforms" << nl;
    tellRate();
    energy_.report();
    Info << "    clock time       " << clock_.elapsedTime() << " s" << nl
         << endl;
}

// ************************************************************************* //
