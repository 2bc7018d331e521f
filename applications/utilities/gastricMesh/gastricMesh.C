// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers
/*---------------------------------------------------------------------------*\
Application
    gastricMesh

Description
    Gives a straight tube of unit radius the shape of the stomach: every point
    of constant/polyMesh moves radially, r -> r R(x, t0), with R the radius of
    the wall of constant/motilityProperties at its reference time t0. Planes
    x = const of the mesh stay planes x = const.

        r   [-]   distance from the axis in the mesh of unit radius
        R   [m]   radius of the wall (see lumenWall)

    blockMesh cannot make this shape itself: its edges are curves through
    points and not the profile, and would have to be made anew with each
    change of the profile.

Usage
    \verbatim
    blockMesh
    gastricMesh
    \endverbatim
    The mesh of blockMesh is a wedge or a cylinder about the axis of
    constant/motilityProperties (default: x) with the largest radius 1; the
    length along the axis is in m.

Limits
    Serial; run it before decomposePar.

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "Time.H"
#include "lumenMotion.H"
#include "pointIOField.H"
#include "polyMesh.H"

using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

int main(int argc, char* argv[])
{
    argList::addNote(
        "Give a straight mesh of unit radius the shape of the stomach"
        " in constant/motilityProperties"
    );
    argList::noParallel();
    argList::noFunctionObjects();

    #include "setRootCase.H"
    #include "createTime.H"

    const autoPtr<lumenMotion> motion(lumenMotion::New(runTime));

    IOobject io(
        "points",
        runTime.constant(),
        polyMesh::meshSubDir,
        runTime,
        IOobject::MUST_READ,
        IOobject::NO_WRITE,
        false
    );

    if (!io.typeHeaderOk<pointIOField>(true))
    {
        FatalErrorInFunction
            << "No mesh: there is no file "
            << runTime.constant() / polyMesh::meshSubDir / "points"
            << "; run blockMesh first" << exit(FatalError);
    }

    pointIOField points(io);

    scalar maxRadius = 0;
    for (const point& p : points)
    {
        maxRadius = max(maxRadius, mag(motion->radial(p)));
    }

    // blockMesh writes ten digits
    if (mag(maxRadius - 1) > 1e-6)
    {
        FatalErrorInFunction
            << "The largest distance of a point from the axis is " << maxRadius
            << "; it must be 1, the radius of the mesh of"
            << " blockMesh. If the mesh has already got its shape, or the"
            << " motility has changed, run blockMesh again first"
            << exit(FatalError);
    }

    motion->checkCovers(points);

    scalar minWall = GREAT;
    scalar maxWall = 0;

    for (point& p : points)
    {
        const scalar R =
            motion->wall().radius(motion->axial(p), motion->referenceTime());

        minWall = min(minWall, R);
        maxWall = max(maxWall, R);

        p += (R - 1) * motion->radial(p);
    }

    Info << "gastricMesh: " << points.size() << " points, wall radius "
         << minWall << " m to " << maxWall << " m" << nl << endl;

    // All digits: the wall is to be met to 1e-9 m
    IOstream::defaultPrecision(max(17u, IOstream::defaultPrecision()));

    if (!points.write())
    {
        FatalErrorInFunction << "Cannot write " << points.objectPath()
                             << exit(FatalError);
    }

    Info << "End" << nl << endl;

    return 0;
}


// ************************************************************************* //
