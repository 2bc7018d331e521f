// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "retainedMass.H"
#include "addToRunTimeSelectionTable.H"
#include "surfaceFields.H"
#include "volFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(retainedMass, 0);
addToRunTimeSelectionTable(functionObject, retainedMass, dictionary);
}
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::functionObjects::retainedMass::massBeyond(
    const scalar position
) const
{
    const scalarField& m = field("mass");
    const scalarField& V = mesh_.V();
    const vectorField& C = mesh_.C();

    scalar volume = 0;
    forAll(m, celli)
    {
        if (frame_.along(C[celli]) > position)
        {
            volume += m[celli] * V[celli];
        }
    }

    return factor() * rho() * returnReduce(volume, sumOp<scalar>());
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::string Foam::functionObjects::retainedMass::title() const
{
    return "Mass of the bolus, full geometry; fractions of the mass at start";
}


Foam::stringList Foam::functionObjects::retainedMass::heads() const
{
    return stringList(
        {"inside [kg]",
            "emptied [kg]",
            "retained [-]",
            "upstream [-]",
            "balanceError [-]",
            "passedWhileClosed [-]",
            "alphaMin [-]",
            "alphaMax [-]"}
    );
}


Foam::scalarList Foam::functionObjects::retainedMass::values()
{
    const scalar M = initialMass();
    const scalar inside = massBeyond(-GREAT);
    const scalarField& alpha = field("alpha");

    return scalarList(
        {inside,
            emptied_,
            inside / M,
            (inside - massBeyond(throat_)) / M,
            (inside + emptied_ - M) / M,
            passedWhileClosed_ / M,
            gMin(alpha),
            gMax(alpha)}
    );
}


void Foam::functionObjects::retainedMass::initialise()
{
    passed_ = massBeyond(throat_);
}


void Foam::functionObjects::retainedMass::accumulate(
    const scalar t0,
    const scalar t1
)
{
    const surfaceScalarField& flux =
        mesh_.lookupObject<surfaceScalarField>("massFlux");

    scalar out = 0;
    for (const label patchi : outlets_)
    {
        out += sum(flux.boundaryField()[patchi]);
    }
    reduce(out, sumOp<scalar>());

    emptied_ += factor() * rho() * out * (t1 - t0);

    const scalar passed = emptied_ + massBeyond(throat_);
    const scalar overlap = min(t1, closed_.second()) - max(t0, closed_.first());
    if (overlap > 0)
    {
        passedWhileClosed_ += (passed - passed_) * overlap / (t1 - t0);
    }
    passed_ = passed;

    setProperty("emptied", emptied_);
    setProperty("passed", passed_);
    setProperty("passedWhileClosed", passedWhileClosed_);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::retainedMass::retainedMass(
    const word& name,
    const Time& runTime,
    const dictionary& dict
) :
    bolusMonitor(name, runTime, dict, typeName, {"alpha", "mass", "massFlux"}),
    outlets_(readPatches("outlets", false)),
    frame_(mesh_, entries()),
    throat_(
        entries().number(
            "throat",
            "along the axis [m]",
            entryReader::anything,
            GREAT
        )
    ),
    closed_(GREAT, GREAT),
    emptied_(restored("emptied")),
    passed_(restored("passed")),
    passedWhileClosed_(restored("passedWhileClosed"))
{
    requireEveryStep(dict);

    if (dict.found("throat"))
    {
        scalar low = GREAT;
        scalar high = -GREAT;
        for (const point& p : mesh_.points())
        {
            low = min(low, frame_.along(p));
            high = max(high, frame_.along(p));
        }
        reduce(low, minOp<scalar>());
        reduce(high, maxOp<scalar>());
        if (!(throat_ >= low && throat_ <= high))
        {
            FatalIOErrorInFunction(dict)
                << "Entry 'throat' is " << throat_
                << " m; valid are places in the mesh, from " << low << " m to "
                << high << " m along its axis" << exit(FatalIOError);
        }
    }

    if (entries().has("closedBetween"))
    {
        closed_ = entries().pair("closedBetween", "(from to) [s]");
        if (!(closed_.first() < closed_.second()))
        {
            entries().refuse(
                "closedBetween",
                "valid are two times [s], the first before the second"
            );
        }
    }

    begin();
}


// ************************************************************************* //
