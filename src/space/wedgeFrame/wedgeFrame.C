// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "wedgeFrame.H"
#include "mathematicalConstants.H"
#include "polyMesh.H"
#include "Pstream.H"
#include "PstreamReduceOps.H"
#include "SubField.H"
#include "wedgePolyPatch.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::wedgeFrame::wedgeFrame(const polyMesh& mesh) :
    valid_(false),
    origin_(Zero),
    axis_(1, 0, 0),
    radial_(0, 1, 0),
    normal_(0, 0, 1),
    angle_(constant::mathematical::twoPi),
    onAxis_(mesh.nPoints(), false)
{
    const polyBoundaryMesh& patches = mesh.boundaryMesh();

    // How many wedge patches a point belongs to
    labelList sides(mesh.nPoints(), Zero);
    vector plane[2] = {Zero, Zero};
    point centre[2] = {Zero, Zero};
    label n = 0;
    for (const polyPatch& pp : patches)
    {
        if (!isA<wedgePolyPatch>(pp)) continue;
        const wedgePolyPatch& wedge = refCast<const wedgePolyPatch>(pp);

        for (const label p : pp.meshPoints()) ++sides[p];

        label faces = pp.size();
        point sum = Zero;
        vector area = Zero;
        forAll(pp, i)
        {
            sum += pp.faceCentres()[i];
            area += pp.faceAreas()[i];
        }
        reduce(faces, sumOp<label>());
        reduce(sum, sumOp<point>());
        reduce(area, sumOp<vector>());
        if (faces == 0) continue;

        if (n < 2)
        {
            plane[n] = area / mag(area);
            centre[n] = sum / faces;
        }
        if (n == 0)
        {
            axis_ = wedge.axis() / mag(wedge.axis());
            normal_ = wedge.centreNormal() / mag(wedge.centreNormal());
            angle_ = 2 * std::acos(min(wedge.cosAngle(), scalar(1)));
        }
        ++n;
    }
    if (n == 0) return;

    if (n != 2)
    {
        FatalErrorInFunction
            << "the mesh has " << n << " wedge patches with faces; valid are"
            << " two, the sides of one wedge" << exit(FatalError);
    }
    valid_ = true;

    // The two patches give opposite axes; take the positive one
    const scalar most = cmptMax(cmptMag(axis_));
    for (direction d = 0; d < vector::nComponents; ++d)
    {
        if (mag(axis_[d]) > 0.5 * most)
        {
            if (axis_[d] < 0) axis_ *= -1;
            break;
        }
    }

    point sum = Zero;
    label found = 0;
    forAll(sides, p)
    {
        onAxis_[p] = sides[p] == 2;
        if (!onAxis_[p]) continue;
        sum += mesh.points()[p];
        ++found;
    }
    reduce(found, sumOp<label>());
    reduce(sum, sumOp<point>());

    const point middle(0.5 * (centre[0] + centre[1]));
    radial_ = normal_ ^ axis_;
    if (found > 0)
    {
        origin_ = sum / found;
    }
    else
    {
        // x = middle + a radial + b normal in both planes
        const scalar r[2] = {plane[0] & radial_, plane[1] & radial_};
        const scalar z[2] = {plane[0] & normal_, plane[1] & normal_};
        const scalar d[2] = {
            plane[0] & (centre[0] - middle), plane[1] & (centre[1] - middle)
        };
        const scalar det = r[0] * z[1] - r[1] * z[0];
        origin_ = middle + ((d[0] * z[1] - d[1] * z[0]) / det) * radial_
            + ((r[0] * d[1] - r[1] * d[0]) / det) * normal_;
    }

    if (((middle - origin_) & radial_) < 0) radial_ *= -1;
    normal_ = axis_ ^ radial_;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::wedgeFrame::apart(
    const polyMesh& mesh,
    const wedgeFrame& frame,
    const point& origin,
    const vector& axis
)
{
    // A line is farthest at one of the ends
    scalar low = GREAT;
    scalar high = -GREAT;
    for (const point& p : mesh.points())
    {
        const scalar x = (p - frame.origin()) & frame.axis();
        low = min(low, x);
        high = max(high, x);
    }
    reduce(low, minOp<scalar>());
    reduce(high, maxOp<scalar>());

    scalar most = 0;
    for (const scalar x : {low, high})
    {
        const vector d(frame.origin() + x * frame.axis() - origin);
        most = max(most, mag(d - (d & axis) * axis));
    }
    return most;
}

// ************************************************************************* //
