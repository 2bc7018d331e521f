// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "wallEnergy.H"
#include "addToRunTimeSelectionTable.H"
#include "PstreamReduceOps.H"
#include "fvMesh.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(wallEnergy, 0);
addToRunTimeSelectionTable(functionObject, wallEnergy, dictionary);
}
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::string Foam::functionObjects::wallEnergy::title() const
{
    return "Strain energy of the wall, full geometry";
}


Foam::stringList Foam::functionObjects::wallEnergy::heads() const
{
    return stringList({"energy [J]", "hoopMax [-]", "hoopMin [-]"});
}


Foam::scalarList Foam::functionObjects::wallEnergy::values()
{
    auto radius = [&](const point& x) { return mag(x - (x & axis_) * axis_); };

    scalar energy = 0;
    scalar most = 0;
    scalar least = GREAT;
    for (const label patchi : patches_)
    {
        const polyPatch& patch = mesh_.boundaryMesh()[patchi];
        for (const face& f : static_cast<const faceList&>(patch))
        {
            const scalar A0 = f.mag(relaxed_);
            const scalar hoop =
                radius(f.centre(mesh_.points())) / radius(f.centre(relaxed_));
            const scalar axial = f.mag(mesh_.points()) / (A0 * hoop);
            energy += law_.membrane(hoop, axial) * thickness_ * A0;
            most = max(most, hoop);
            least = min(least, hoop);
        }
    }
    return scalarList(
        {factor() * returnReduce(energy, sumOp<scalar>()),
            returnReduce(most, maxOp<scalar>()),
            returnReduce(least, minOp<scalar>())}
    );
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::wallEnergy::wallEnergy(
    const word& name,
    const Time& runTime,
    const dictionary& dict
) :
    bolusMonitor(
        name,
        runTime,
        dict,
        typeName,
        {"alpha", "mass"},
        []()
        {
            wordList known({"patches", "axis", "thickness"});
            known.append(vanDerWaals::entries());
            return known;
        }()
    ),
    patches_(readPatches(dict, "patches", true)),
    axis_(readAxis(dict)),
    thickness_(dict.get<scalar>("thickness")),
    law_(dict),
    relaxed_(IOobject(
        "points",
        runTime.constant(),
        polyMesh::meshSubDir,
        mesh_,
        IOobject::MUST_READ,
        IOobject::NO_WRITE,
        false
    ))
{
    if (!(thickness_ > 0))
    {
        FatalIOErrorInFunction(dict)
            << "entry thickness: " << thickness_ << "; valid are lengths > 0 m"
            << exit(FatalIOError);
    }

    begin();
}

// ************************************************************************* //
