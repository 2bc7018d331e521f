// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "wallEnergy.H"
#include "addToRunTimeSelectionTable.H"
#include "Pstream.H"
#include "PstreamReduceOps.H"
#include "fvMesh.H"
#include "pointIOField.H"

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
    return stringList(
        {"energy [J]", "hoopMax [-]", "hoopMin [-]", "beyondLaw [-]"}
    );
}


Foam::scalarList Foam::functionObjects::wallEnergy::values()
{
    scalar energy = 0;
    scalar area = 0;
    scalar beyond = 0;
    scalar most = 0;
    scalar least = GREAT;
    label facei = 0;
    for (const label patchi : patches_)
    {
        const polyPatch& patch = mesh_.boundaryMesh()[patchi];
        for (const face& f : static_cast<const faceList&>(patch))
        {
            const scalar A0 = relaxedArea_[facei];
            const scalar hoop = frame_.radius(f.centre(mesh_.points()))
                / relaxedRadius_[facei++];
            const scalar axial = f.mag(mesh_.points()) / (A0 * hoop);
            const scalar thick = law_.thickness(hoop, axial);
            energy += law_.energy(hoop, axial, thick) * thickness_ * A0;
            area += A0;
            if (law_.beyond(hoop, axial, thick)) beyond += A0;
            most = max(most, hoop);
            least = min(least, hoop);
        }
    }
    reduce(area, sumOp<scalar>());
    reduce(beyond, sumOp<scalar>());
    if (beyond > 0 && !told_)
    {
        told_ = true;
        WarningInFunction
            << "t " << time_.value() << " s: the wall is deformed beyond the"
            << " range of its law on " << 100 * beyond / area
            << " % of its area (hoop stretch "
            << returnReduce(least, minOp<scalar>())
            << "); its energy there is a lower bound. The column beyondLaw of "
            << name() << " has that part at all times" << endl;
    }
    return scalarList(
        {factor() * returnReduce(energy, sumOp<scalar>()),
            returnReduce(most, maxOp<scalar>()),
            returnReduce(least, minOp<scalar>()),
            beyond / area}
    );
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::wallEnergy::wallEnergy(
    const word& name,
    const Time& runTime,
    const dictionary& dict
) :
    bolusMonitor(name, runTime, dict, typeName, {"alpha", "mass"}),
    patches_(readPatches("patches", true)),
    frame_(mesh_, entries()),
    thickness_(
        entries().number(
            "thickness",
            "of the relaxed wall [m]",
            entryReader::positive
        )
    ),
    law_(entries()),
    told_(false)
{
    const pointIOField relaxed(IOobject(
        "points",
        runTime.constant(),
        polyMesh::meshSubDir,
        mesh_,
        IOobject::MUST_READ,
        IOobject::NO_WRITE,
        false
    ));
    for (const label patchi : patches_)
    {
        const polyPatch& patch = mesh_.boundaryMesh()[patchi];
        for (const face& f : static_cast<const faceList&>(patch))
        {
            relaxedArea_.append(f.mag(relaxed));
            relaxedRadius_.append(frame_.radius(f.centre(relaxed)));
        }
    }

    begin();
}

// ************************************************************************* //
