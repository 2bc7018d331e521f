// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "contactForce.H"
#include "addToRunTimeSelectionTable.H"
#include "volFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(contactForce, 0);
addToRunTimeSelectionTable(functionObject, contactForce, dictionary);
}
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::string Foam::functionObjects::contactForce::title() const
{
    return "Force of the bolus on the wall: full geometry, mesh, per mass";
}


Foam::stringList Foam::functionObjects::contactForce::heads() const
{
    const wordList parts(
        {"axial", "total", "normal", "tangential", "resultant", "tensile"}
    );

    DynamicList<string> heads;
    for (const word& part : parts)
    {
        heads.append(part + " [N]");
    }
    for (const word& part : parts)
    {
        heads.append(part + "_mesh [N]");
    }
    for (const word& part : parts)
    {
        heads.append(part + "_perMass [N/g]");
    }

    return stringList(heads);
}


Foam::scalarList Foam::functionObjects::contactForce::values()
{
    const volVectorField& wallForce =
        mesh_.lookupObject<volVectorField>("wallForce");

    vector net(Zero);
    scalar total = 0;
    scalar normal = 0;
    scalar tangential = 0;
    scalar tensile = 0;

    for (const label patchi : patches_)
    {
        const vectorField& F = wallForce.boundaryField()[patchi];
        const vectorField n(mesh_.boundary()[patchi].nf());

        forAll(F, i)
        {
            const scalar Fn = F[i] & n[i];

            net += F[i];
            total += mag(F[i]);
            normal += Fn;
            tangential += mag(F[i] - Fn * n[i]);
            tensile += max(-Fn, scalar(0));
        }
    }

    reduce(net, sumOp<vector>());

    scalarField sums({total, normal, tangential, tensile});
    reduce(sums, sumOp<scalarField>());

    const scalarList mesh(
        {net & frame_.axis(), sums[0], sums[1], sums[2], mag(net), sums[3]}
    );

    const scalar grams = 1000 * initialMass();

    DynamicList<scalar> row;
    for (const scalar F : mesh)
    {
        row.append(factor() * F);
    }
    row.append(mesh);
    for (const scalar F : mesh)
    {
        row.append(factor() * F / grams);
    }

    return scalarList(row);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::contactForce::contactForce(
    const word& name,
    const Time& runTime,
    const dictionary& dict
) :
    bolusMonitor(name, runTime, dict, typeName, {"mass", "wallForce"}),
    patches_(readPatches("patches", true)),
    frame_(mesh_, entries())
{
    begin();
}


// ************************************************************************* //
