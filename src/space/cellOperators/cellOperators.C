// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "cellOperators.H"
#include "surfaceFields.H"
#include "syncTools.H"
#include "wallPolyPatch.H"
#include "wedgePolyPatch.H"
#include "emptyPolyPatch.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::cellOperators::makeRoom()
{
    const label nCells = mesh_.nCells();
    const label nd = nodes_.nd();
    const labelList& pointNode = nodes_.pointNode();
    const faceList& faces = mesh_.faces();

    faceStart_.setSize(faces.size() + 1);
    label nWeights = 0;
    forAll(faces, f)
    {
        faceStart_[f] = nWeights;
        nWeights += faces[f].size();
    }
    faceStart_[faces.size()] = nWeights;
    faceWeights_.setSize(nWeights);

    cellStart_.setSize(nCells + 1);
    hourglassStart_.setSize(nCells + 1);
    DynamicList<label> dofs(nCells * 8 * nd);
    label nHour = 0;
    forAll(mesh_.cells(), c)
    {
        cellStart_[c] = dofs.size();
        hourglassStart_[c] = nHour;
        DynamicList<label> nodes(8);
        for (const label p : mesh_.cellPoints()[c])
        {
            if (!nodes.found(pointNode[p])) nodes.append(pointNode[p]);
        }
        for (const label n : nodes)
        {
            for (label k = 0; k < nd; ++k) dofs.append(nd * n + k);
        }
        const label n = nd * nodes.size();
        nHour += n * n;
    }
    cellStart_[nCells] = dofs.size();
    hourglassStart_[nCells] = nHour;
    cellDofs_.transfer(dofs);
    cellG_.setSize(cellDofs_.size());
    cellH_.setSize(cellDofs_.size());
    hourglass_.setSize(nHour);
    hourglassScale_.setSize(nCells);
    V_.setSize(nCells);
    wallFlux_.setSize(nCells);
    cellWallNormal_.setSize(nCells);
    nodeArea_.setSize(nodes_.nNodes());
}


void Foam::cellOperators::setWalls()
{
    const faceList& faces = mesh_.faces();
    const polyBoundaryMesh& bm = mesh_.boundaryMesh();

    wallFlux_ = 0;
    cellWallNormal_ = Zero;
    forAll(bm, patchi)
    {
        if (!walls_[patchi]) continue;
        const labelList& fc = bm[patchi].faceCells();
        forAll(fc, i)
        {
            const label facei = bm[patchi].start() + i;
            // Symmetry planes are no walls that bolus could part from
            if (isA<wallPolyPatch>(bm[patchi]))
            {
                forAll(faces[facei], fp)
                {
                    cellWallNormal_[fc[i]] += faceWeight(facei, fp);
                }
            }
            if (mesh_.moving())
            {
                wallFlux_[fc[i]] += mesh_.phi().boundaryField()[patchi][i];
            }
        }
    }
    const vector& across = nodes_.normal();
    forAll(cellWallNormal_, c)
    {
        vector& n = cellWallNormal_[c];
        if (nodes_.nd() == 2) n -= (n & across) * across;
        if (magSqr(n) > 0) n /= mag(n);
    }
}


Foam::boolList Foam::cellOperators::open() const
{
    const polyBoundaryMesh& bm = mesh_.boundaryMesh();
    boolList result(mesh_.nFaces(), true);
    forAll(bm, patchi)
    {
        const bool isSide =
            isA<wedgePolyPatch>(bm[patchi]) || isA<emptyPolyPatch>(bm[patchi]);
        forAll(bm[patchi], i)
        {
            result[bm[patchi].start() + i] = !walls_[patchi] && !isSide;
        }
    }
    return result;
}


void Foam::cellOperators::setHourglass(
    const label celli,
    const labelList& slot,
    const point& centre,
    const List<FixedList<vector, 3>>& basis
)
{
    const labelList& pts = mesh_.cellPoints()[celli];
    const label start = cellStart_[celli];
    const label n = cellStart_[celli + 1] - start;

    List<vector> delta(pts.size() * n, Zero);
    for (label d = 0; d < n; ++d)
    {
        vector mean = Zero;
        forAll(pts, i)
        {
            if (d >= slot[i] && d < slot[i] + nodes_.nd())
            {
                delta[i * n + d] = shape(basis, pts[i], d - slot[i]);
                mean += delta[i * n + d];
            }
        }
        mean /= pts.size();
        forAll(pts, i)
        {
            delta[i * n + d] -=
                mean + ((midPoints_[pts[i]] - centre) & cellG_[start + d]);
        }
    }
    scalar* H = &hourglass_[hourglassStart_[celli]];
    for (label d = 0; d < n; ++d)
    {
        for (label e = 0; e < n; ++e)
        {
            scalar sum = 0;
            forAll(pts, i) sum += (delta[i * n + d] & delta[i * n + e]);
            H[d * n + e] = sum;
        }
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cellOperators::cellOperators(
    const fvMesh& mesh,
    const nodeNumbering& nodes,
    const boolList& walls
) :
    mesh_(mesh),
    nodes_(nodes),
    walls_(walls)
{
    makeRoom();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::cellOperators::followMesh()
{
    midPoints_ = mesh_.points();
    if (mesh_.moving())
    {
        midPoints_ = 0.5 * (mesh_.points() + mesh_.oldPoints());
    }

    const faceList& faces = mesh_.faces();
    forAll(faces, facei)
    {
        const face& f = faces[facei];
        const label n = f.size();
        vector* w = &faceWeights_[faceStart_[facei]];

        point c = Zero;
        for (const label p : f) c += midPoints_[p];
        c /= n;

        vector S = Zero;
        for (label i = 0; i < n; ++i) w[i] = Zero;
        for (label i = 0; i < n; ++i)
        {
            const label j = (i + 1) % n;
            const point& a = midPoints_[f[i]];
            const point& b = midPoints_[f[j]];
            const vector Si = 0.5 * ((b - a) ^ (c - a));
            w[i] += Si / 3;
            w[j] += Si / 3;
            S += Si;
        }
        for (label i = 0; i < n; ++i) w[i] += S / (3 * n);
    }
}


void Foam::cellOperators::assemble(const List<FixedList<vector, 3>>& basis)
{
    const faceList& faces = mesh_.faces();
    const labelList& own = mesh_.faceOwner();
    const labelList& pointNode = nodes_.pointNode();
    const label nd = nodes_.nd();

    setWalls();
    const boolList counted(open());

    cellG_ = Zero;
    cellH_ = 0;
    scalarField area(mesh_.nPoints(), 0.0);

    forAll(mesh_.cells(), c)
    {
        const labelList& pts = mesh_.cellPoints()[c];
        const label start = cellStart_[c];
        const label* dof = &cellDofs_[start];

        // Area vectors of the cell's points: all faces, and without walls
        List<vector> A(pts.size(), Zero);
        List<vector> B(pts.size(), Zero);
        scalar V = 0;
        // A point nearby: wherever the mesh is, no digits are lost
        const point& near = midPoints_[pts[0]];
        for (const label facei : mesh_.cells()[c])
        {
            const scalar sign = (own[facei] == c ? 1 : -1);
            forAll(faces[facei], fp)
            {
                const label p = faces[facei][fp];
                const label i = pts.find(p);
                const vector w = sign * faceWeight(facei, fp);
                A[i] += w;
                if (counted[facei]) B[i] += w;
                V += w & (midPoints_[p] - near);
            }
        }
        V /= 3;
        V_[c] = V;

        labelList slot(pts.size());
        point centre = Zero;
        scalar scale = 0;
        forAll(pts, i)
        {
            const label p = pts[i];
            label s = 0;
            while (dof[s] != nd * pointNode[p]) s += nd;
            slot[i] = s;
            for (label k = 0; k < nd; ++k)
            {
                const vector v = shape(basis, p, k);
                cellG_[start + s + k] += (A[i] * v) / V;
                cellH_[start + s + k] += (B[i] & v);
            }
            centre += midPoints_[p];
            scalar a2 = 0;
            for (label k = 0; k < nd; ++k) a2 += sqr(A[i] & shape(basis, p, k));
            scale += a2 / V;
            area[p] += std::sqrt(a2);
        }
        centre /= pts.size();
        hourglassScale_[c] = scale;
        setHourglass(c, slot, centre, basis);
    }

    syncTools::syncPointList(mesh_, area, plusEqOp<scalar>(), scalar(0));
    nodeArea_ = 0;
    forAll(area, p) nodeArea_[pointNode[p]] += 0.5 * area[p];
}


Foam::scalar Foam::cellOperators::extent(
    const primitiveMesh& mesh,
    const pointField& points,
    const label celli,
    const vector& dir
)
{
    scalar low = GREAT;
    scalar high = -GREAT;
    for (const label p : mesh.cellPoints()[celli])
    {
        const scalar x = points[p] & dir;
        low = min(low, x);
        high = max(high, x);
    }
    return high - low;
}

// ************************************************************************* //
