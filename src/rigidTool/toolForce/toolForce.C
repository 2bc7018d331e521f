// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "toolForce.H"
#include "addToRunTimeSelectionTable.H"
#include "rigidToolMotionSolver.H"
#include "uniformDimensionedFields.H"
#include "volFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(toolForce, 0);
addToRunTimeSelectionTable(functionObject, toolForce, dictionary);
}
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::string Foam::functionObjects::toolForce::title() const
{
    return "Force of the bolus on the tool, by pressure and friction";
}


Foam::stringList Foam::functionObjects::toolForce::heads() const
{
    return stringList(
        {"travel [m]",
            "axial [N]",
            "axialPressure [N]",
            "axialFriction [N]",
            "lateral_mesh [N]",
            "lateralPressure_mesh [N]",
            "lateralFriction_mesh [N]",
            "torque_mesh [N m]",
            "torquePressure_mesh [N m]",
            "torqueFriction_mesh [N m]",
            "tensile_mesh [N]"}
    );
}


Foam::scalarList Foam::functionObjects::toolForce::values()
{
    const volVectorField& wallForce =
        mesh_.lookupObject<volVectorField>("wallForce");

    const word& travelName = rigidToolMotionSolver::travelName;
    const scalar travel =
        mesh_.foundObject<uniformDimensionedScalarField>(travelName)
        ? mesh_.lookupObject<uniformDimensionedScalarField>(travelName).value()
        : 0;
    const point axisPoint(origin_ + travel * direction_);

    // Force and torque: pressure, friction
    vector force[2] = {Zero, Zero};
    vector torque[2] = {Zero, Zero};
    scalar tensile = 0;

    for (const label patchi : patches_)
    {
        const vectorField& F = wallForce.boundaryField()[patchi];
        const vectorField n(mesh_.boundary()[patchi].nf());
        const vectorField& C = mesh_.boundary()[patchi].Cf();

        forAll(F, i)
        {
            const scalar Fn = F[i] & n[i];
            const vector part[2] = {Fn * n[i], F[i] - Fn * n[i]};

            for (label k = 0; k < 2; ++k)
            {
                force[k] += part[k];
                torque[k] += (C[i] - axisPoint) ^ part[k];
            }
            tensile += max(-Fn, scalar(0));
        }
    }

    for (label k = 0; k < 2; ++k)
    {
        reduce(force[k], sumOp<vector>());
        reduce(torque[k], sumOp<vector>());
    }
    reduce(tensile, sumOp<scalar>());

    DynamicList<scalar> row({travel});

    auto append = [&](const scalar pressure, const scalar friction)
    {
        row.append(pressure + friction);
        row.append(pressure);
        row.append(friction);
    };

    const vector across(axis_ ^ direction_);

    append(
        -factor() * (force[0] & direction_), -factor() * (force[1] & direction_)
    );
    append(force[0] & across, force[1] & across);
    append(torque[0] & axis_, torque[1] & axis_);
    row.append(tensile);

    return scalarList(row);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::toolForce::toolForce(
    const word& name,
    const Time& runTime,
    const dictionary& dict
) :
    bolusMonitor(name, runTime, dict, typeName, {"mass", "wallForce"}),
    patches_(readPatches("patches", true)),
    direction_(entries().direction("direction", "of the way")),
    axis_(entries().direction("axis", "of the tool", vector(0, 0, 1))),
    origin_(entries().value("origin", point(Zero)))
{
    begin();
}


// ************************************************************************* //
