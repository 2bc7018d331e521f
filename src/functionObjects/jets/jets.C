// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "jets.H"
#include "addToRunTimeSelectionTable.H"
#include "volFields.H"
#include "weightedSample.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(jets, 0);
addToRunTimeSelectionTable(functionObject, jets, dictionary);
}
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::string Foam::functionObjects::jets::title() const
{
    return "Fastest flow of the bolus upstream of the pylorus and in it";
}


Foam::stringList Foam::functionObjects::jets::heads() const
{
    return stringList(
        {"back [m/s]", "back99 [m/s]", "out [m/s]", "out99 [m/s]"}
    );
}


Foam::scalarList Foam::functionObjects::jets::values()
{
    const scalarField& alpha = field("alpha");
    const vectorField& C = mesh_.C();
    const scalarField u(
        mesh_.lookupObject<volVectorField>("U").primitiveField() & frame_.axis()
    );

    DynamicList<scalar> back, backVolume, out, outVolume;
    forAll(alpha, c)
    {
        if (alpha[c] <= 0.5) continue;
        const scalar volume = alpha[c] * mesh_.V()[c];
        const scalar x = frame_.along(C[c]);
        if (x < pylorus_.first())
        {
            back.append(max(-u[c], scalar(0)));
            backVolume.append(volume);
        }
        else if (x < pylorus_.second())
        {
            out.append(max(u[c], scalar(0)));
            outVolume.append(volume);
        }
    }
    const weightedSample upstream(back, backVolume);
    const weightedSample inside(out, outVolume);
    return scalarList(
        {upstream.quantile(1),
            upstream.quantile(0.99),
            inside.quantile(1),
            inside.quantile(0.99)}
    );
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::jets::jets(
    const word& name,
    const Time& runTime,
    const dictionary& dict
) :
    bolusMonitor(name, runTime, dict, typeName, {"alpha", "mass", "U"}),
    frame_(mesh_, entries()),
    pylorus_(entries().pair("pylorus", "(from to) along the axis [m]"))
{
    if (pylorus_.first() >= pylorus_.second())
    {
        entries().refuse(
            "pylorus", "valid are two coordinates [m], the first one lower"
        );
    }

    begin();
}

// ************************************************************************* //
