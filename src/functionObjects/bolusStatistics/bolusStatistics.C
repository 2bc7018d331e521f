// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "bolusStatistics.H"
#include "addToRunTimeSelectionTable.H"
#include "Pstream.H"
#include "PstreamReduceOps.H"
#include "Tuple2.H"
#include "volFields.H"
#include "weightedSample.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(bolusStatistics, 0);
addToRunTimeSelectionTable(functionObject, bolusStatistics, dictionary);
}
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::string Foam::functionObjects::bolusStatistics::title() const
{
    return "Triaxiality, plastic strain and pressure of the bolus";
}


Foam::stringList Foam::functionObjects::bolusStatistics::heads() const
{
    return stringList(
        {"eta05 [-]",
            "eta50 [-]",
            "eta95 [-]",
            "eps50 [-]",
            "eps95 [-]",
            "eps100 [-]",
            "pMin [Pa]",
            "pMax [Pa]",
            "xMin [m]",
            "xMax [m]"}
    );
}


Foam::scalarList Foam::functionObjects::bolusStatistics::values()
{
    const scalarField& alpha = field("alpha");
    const scalarField& D = field("D");
    const scalarField& eta = field("triaxiality");
    const scalarField& stress = field("sigmaEq");
    const scalarField& strain = field("epsilonPEq");
    const scalarField& p = field("p");
    const vectorField& C = mesh_.C();

    using valueAt = Tuple2<scalar, scalar>;
    DynamicList<scalar> etas, etaVolume, strains, volumes;
    valueAt low(GREAT, 0), high(-GREAT, 0);
    forAll(alpha, c)
    {
        if (alpha[c] <= 0.5) continue;
        const scalar volume = alpha[c] * mesh_.V()[c];
        strains.append(strain[c]);
        volumes.append(volume);
        if (D[c] <= 0.5 && stress[c] > loaded_)
        {
            etas.append(eta[c]);
            etaVolume.append(volume);
        }
        const scalar x = frame_.along(C[c]);
        if (p[c] < low.first()) low = valueAt(p[c], x);
        if (p[c] > high.first()) high = valueAt(p[c], x);
    }
    reduce(low, minFirstOp<scalar>());
    reduce(high, maxFirstOp<scalar>());
    if (low.first() > 0.5 * GREAT) low = high = valueAt(0, 0);

    const weightedSample loads(etas, etaVolume);
    const weightedSample strained(strains, volumes);
    return scalarList(
        {loads.quantile(0.05),
            loads.quantile(0.5),
            loads.quantile(0.95),
            strained.quantile(0.5),
            strained.quantile(0.95),
            strained.quantile(1),
            low.first(),
            high.first(),
            low.second(),
            high.second()}
    );
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::bolusStatistics::bolusStatistics(
    const word& name,
    const Time& runTime,
    const dictionary& dict
) :
    bolusMonitor(
        name,
        runTime,
        dict,
        typeName,
        {"alpha", "mass", "D", "triaxiality", "sigmaEq", "epsilonPEq", "p"}
    ),
    frame_(mesh_, entries()),
    loaded_(
        entries().number(
            "loaded",
            "von Mises stress above which the triaxiality counts [Pa]",
            entryReader::nonNegative
        )
    )
{
    begin();
}

// ************************************************************************* //
