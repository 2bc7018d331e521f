// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "cutSurface.H"
#include "syncTools.H"
#include "volFields.H"

namespace Foam
{

//- Area vector of the part of a face where alpha exceeds isoValue
static vector cutArea(
    const pointField& points,
    const face& f,
    const scalarField& pointAlpha,
    const scalar isoValue
)
{
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
        const scalar da = pointAlpha[a] - isoValue;
        const scalar db = pointAlpha[b] - isoValue;

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


//- Values of the points: of the cells around them, in proportion to 1/distance.
//  Stock volPointInterpolation keeps its weights and makes them anew whenever
//  the mesh moves, which took a twentieth of a run of the stomach: all points of
//  a wedge are on its boundary, where it is slow
static scalarField atPoints(const volScalarField& alpha)
{
    const fvMesh& mesh = alpha.mesh();
    const pointField& points = mesh.points();
    const vectorField& centres = mesh.cellCentres();
    const labelListList& cellPoints = mesh.cellPoints();

    scalarField sum(points.size(), Zero);
    scalarField weights(points.size(), Zero);
    forAll(cellPoints, c)
    {
        for (const label p : cellPoints[c])
        {
            const scalar weight = 1 / mag(points[p] - centres[c]);
            sum[p] += weight * alpha[c];
            weights[p] += weight;
        }
    }
    syncTools::syncPointList(mesh, sum, plusEqOp<scalar>(), scalar(0));
    syncTools::syncPointList(mesh, weights, plusEqOp<scalar>(), scalar(0));
    return sum / weights;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cutSurface::cutSurface(
    const volScalarField& alpha,
    const scalar isoValue,
    const labelHashSet& patches
) :
    free_(alpha.size(), Zero),
    contact_(alpha.size(), Zero)
{
    const fvMesh& mesh = alpha.mesh();
    const scalarField pointAlpha(atPoints(alpha));
    const labelList& owner = mesh.faceOwner();
    const labelList& neighbour = mesh.faceNeighbour();

    vectorField interface(alpha.size(), Zero);
    forAll(mesh.faces(), facei)
    {
        const vector A(
            cutArea(mesh.points(), mesh.faces()[facei], pointAlpha, isoValue)
        );

        interface[owner[facei]] += A;
        if (mesh.isInternalFace(facei))
        {
            interface[neighbour[facei]] -= A;
        }
        else if (patches.found(mesh.boundaryMesh().whichPatch(facei)))
        {
            contact_[owner[facei]] += mag(A);
        }
    }
    free_ = mag(interface);
}

// ************************************************************************* //
