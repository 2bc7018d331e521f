// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "axialFrame.H"
#include "IOdictionary.H"
#include "Time.H"
#include "polyMesh.H"
#include "wedgeFrame.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::axialFrame::axialFrame(const polyMesh& mesh, entryReader& read) :
    axis_(1, 0, 0),
    origin_(Zero)
{
    const wedgeFrame wedge(mesh);
    if (wedge.valid())
    {
        axis_ = wedge.axis();
        origin_ = wedge.origin() - (wedge.origin() & axis_) * axis_;
    }

    IOobject io(
        "motilityProperties",
        mesh.time().constant(),
        mesh.time(),
        IOobject::MUST_READ,
        IOobject::NO_WRITE,
        false
    );
    if (io.typeHeaderOk<IOdictionary>(true))
    {
        const IOdictionary motility(io);
        axis_ = motility.lookupOrDefault<vector>("axis", vector(1, 0, 0));
        origin_ = motility.lookupOrDefault<point>("origin", point(Zero));
    }

    axis_ = read.direction("axis", "of increasing x", axis_);
    origin_ = read.value("origin", origin_);

    // Meshes are written with some ten digits, people write fewer
    if (wedge.valid() && mag(axis_ ^ wedge.axis()) > 1e-4)
    {
        FatalIOErrorInFunction(read.dict())
            << "Entry 'axis' is " << axis_
            << ", not along the axis of the wedge"
            << " mesh; valid is " << wedge.axis() << ", or the opposite, or no"
            << " entry" << exit(FatalIOError);
    }
}


// ************************************************************************* //
