// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "freeSurface.H"
#include "addToRunTimeSelectionTable.H"
#include "pointFields.H"
#include "volFields.H"
#include "volPointInterpolation.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(freeSurface, 0);
addToRunTimeSelectionTable(functionObject, freeSurface, dictionary);
}
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::vector Foam::functionObjects::freeSurface::cutArea(
    const face& f,
    const scalarField& pointAlpha
) const
{
    const pointField& points = mesh_.points();
    const point& origin = points[f[0]];

    // Twice the area vector by the polygon's corners, as they come
    vector twice(Zero);
    vector first(Zero);
    vector last(Zero);
    bool any = false;

    auto corner = [&](const vector& x)
    {
        if (any)
        {
            twice += last ^ x;
        }
        else
        {
            first = x;
            any = true;
        }
        last = x;
    };

    forAll(f, i)
    {
        const label a = f[i];
        const label b = f.nextLabel(i);
        const scalar da = pointAlpha[a] - isoValue_;
        const scalar db = pointAlpha[b] - isoValue_;

        if (da > 0)
        {
            corner(points[a] - origin);
        }
        if ((da > 0) != (db > 0))
        {
            const scalar s = da / (da - db);
            corner((1 - s) * points[a] + s * points[b] - origin);
        }
    }

    return 0.5 * (twice + (last ^ first));
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::string Foam::functionObjects::freeSurface::title() const
{
    return "External surface of the bolus, full geometry";
}


Foam::stringList Foam::functionObjects::freeSurface::heads() const
{
    return stringList(
        {"volume [m3]",
            "freeArea [m2]",
            "contactArea [m2]",
            "externalArea [m2]",
            "surfaceToVolume [1/m]"}
    );
}


Foam::scalarList Foam::functionObjects::freeSurface::values()
{
    const volScalarField& alpha = field("alpha");
    const scalarField pointAlpha(
        volPointInterpolation::New(mesh_).interpolate(alpha)
    );

    const faceList& faces = mesh_.faces();
    const labelList& owner = mesh_.faceOwner();
    const labelList& neighbour = mesh_.faceNeighbour();

    vectorField interface(mesh_.nCells(), Zero);
    scalar contactArea = 0;

    forAll(faces, facei)
    {
        const vector A(cutArea(faces[facei], pointAlpha));

        interface[owner[facei]] += A;
        if (mesh_.isInternalFace(facei))
        {
            interface[neighbour[facei]] -= A;
        }
        else if (patches_.found(mesh_.boundaryMesh().whichPatch(facei)))
        {
            contactArea += mag(A);
        }
    }

    const scalar freeArea = factor() * gSum(mag(interface)());
    contactArea = factor() * returnReduce(contactArea, sumOp<scalar>());

    const scalar volume = factor()
        * gSum(scalarField(alpha.primitiveField() * mesh_.V().field()));

    return scalarList(
        {volume,
            freeArea,
            contactArea,
            freeArea + contactArea,
            (freeArea + contactArea) / max(volume, VSMALL)}
    );
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::freeSurface::freeSurface(
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
        {"patches", "isoValue"}
    ),
    patches_(readPatches(dict, "patches", true)),
    isoValue_(dict.lookupOrDefault<scalar>("isoValue", 0.5))
{
    if (isoValue_ <= 0 || isoValue_ >= 1)
    {
        FatalIOErrorInFunction(dict)
            << "entry isoValue: " << isoValue_ << "; valid are volume"
            << " fractions > 0 and < 1" << exit(FatalIOError);
    }

    begin();
}


// ************************************************************************* //
