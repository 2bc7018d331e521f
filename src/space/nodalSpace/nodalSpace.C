// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "nodalSpace.H"
#include "closedPoints.H"
#include "surfaceFields.H"
#include "globalMeshData.H"
#include "globalIndex.H"
#include "syncTools.H"
#include "wallPolyPatch.H"
#include "wedgePolyPatch.H"
#include "emptyPolyPatch.H"
#include "processorPolyPatch.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::nodalSpace::findSlice()
{
    nd_ = 3;
    e1_ = vector(1, 0, 0);
    e2_ = vector(0, 1, 0);
    e3_ = vector(0, 0, 1);

    if (frame_.valid())
    {
        nd_ = 2;
        e1_ = frame_.axis();
        e2_ = frame_.radial();
        e3_ = frame_.normal();
        return;
    }

    // Directions without geometry: the number of solution directions counts
    // only non-empty ones
    if (mesh_.nSolutionD() == 2)
    {
        nd_ = 2;
        vector axes[3] = {e1_, e2_, e3_};
        label n = 0;
        vector plane[2];
        for (direction d = 0; d < 3; ++d)
        {
            if (mesh_.solutionD()[d] > 0) plane[n++] = axes[d];
        }
        e1_ = plane[0];
        e2_ = plane[1];
        e3_ = e1_ ^ e2_;
    }
    else if (mesh_.nSolutionD() != 3)
    {
        FatalErrorInFunction
            << "a mesh with " << mesh_.nSolutionD() << " solution directions;"
            << " valid are wedge, planar (2) and 3" << exit(FatalError);
    }
}


void Foam::nodalSpace::pairPoints()
{
    const label nPoints = mesh_.nPoints();

    pointNode_.setSize(nPoints);
    Q_.setSize(nPoints);
    Q_ = tensor::I;

    if (nd_ == 3)
    {
        nodePoint_ = identity(nPoints);
        pointNode_ = identity(nPoints);
        return;
    }

    // Two points are a pair where an edge joins them across the slice: an
    // edge of no face of the slice's sides.
    boolList side(nPoints, false);
    boolList inSide(mesh_.nEdges(), false);
    for (const polyPatch& pp : mesh_.boundaryMesh())
    {
        if (isA<wedgePolyPatch>(pp) || isA<emptyPolyPatch>(pp))
        {
            forAll(pp, i)
            {
                for (const label p : pp[i]) side[p] = true;
                for (const label e : mesh_.faceEdges()[pp.start() + i])
                {
                    inSide[e] = true;
                }
            }
        }
    }

    labelList partner(nPoints, -1);
    forAll(mesh_.edges(), e)
    {
        const edge& ed = mesh_.edges()[e];
        if (!inSide[e] && side[ed.start()] && side[ed.end()])
        {
            partner[ed.start()] = ed.end();
            partner[ed.end()] = ed.start();
        }
    }

    pointNode_ = -1;
    DynamicList<label> nodePoint(nPoints);
    for (label p = 0; p < nPoints; ++p)
    {
        if (pointNode_[p] < 0)
        {
            pointNode_[p] = nodePoint.size();
            if (partner[p] >= 0) pointNode_[partner[p]] = nodePoint.size();
            nodePoint.append(p);
        }
    }
    nodePoint_.transfer(nodePoint);

    onAxis_.setSize(nodePoint_.size(), false);
    if (frame_.valid())
    {
        scalar largest = 0;
        for (const point& x : mesh_.points())
        {
            largest = max(largest, mag(frame_.fromAxis(x)));
        }
        reduce(largest, maxOp<scalar>());

        forAll(Q_, p)
        {
            const vector x(frame_.fromAxis(mesh_.points()[p]));
            const scalar y = x & e2_;
            const scalar z = x & e3_;
            const scalar r = std::sqrt(y * y + z * z);

            // By topology; or a pair that some mesher did not merge there
            if (frame_.onAxis()[p] || r < 1e-9 * largest)
            {
                onAxis_[pointNode_[p]] = true;
            }
            else if (partner[p] >= 0)
            {
                const scalar c = y / r;
                const scalar s = z / r;
                Q_[p] = e1_ * e1_ + c * (e2_ * e2_ + e3_ * e3_)
                    + s * (e3_ * e2_ - e2_ * e3_);
            }
        }
    }
}


void Foam::nodalSpace::number()
{
    const label nPoints = mesh_.nPoints();
    const label nNodes = nodePoint_.size();

    // One owner for a node that several processors hold: the one that owns
    // the lowest global number among its points
    labelList global(identity(nPoints));
    boolList mine(nNodes, true);

    if (Pstream::parRun())
    {
        labelList unique;
        autoPtr<globalIndex> points =
            mesh_.globalData().mergePoints(global, unique);

        labelList lowest(nNodes, labelMax);
        forAll(global, p)
        {
            label& l = lowest[pointNode_[p]];
            l = min(l, global[p]);
        }
        forAll(mine, n) mine[n] = points().isLocal(lowest[n]);
    }

    DynamicList<label> owned(nNodes);
    forAll(mine, n)
    {
        if (mine[n]) owned.append(n);
    }
    ownedNodes_.transfer(owned);

    nRowsOwned_ = nd_ * ownedNodes_.size();
    const label firstRow = globalIndex(nRowsOwned_).toGlobal(0);

    labelList pointRow(nPoints, -1);
    nodeRow_.setSize(nNodes, -1);
    forAll(ownedNodes_, i) nodeRow_[ownedNodes_[i]] = firstRow + nd_ * i;
    forAll(pointRow, p) pointRow[p] = nodeRow_[pointNode_[p]];
    syncTools::syncPointList(mesh_, pointRow, maxEqOp<label>(), label(-1));
    forAll(pointRow, p)
    {
        nodeRow_[pointNode_[p]] = max(nodeRow_[pointNode_[p]], pointRow[p]);
    }
}


void Foam::nodalSpace::setFaceWeights()
{
    const faceList& faces = mesh_.faces();

    if (faceStart_.empty())
    {
        faceStart_.setSize(faces.size() + 1);
        label n = 0;
        forAll(faces, f)
        {
            faceStart_[f] = n;
            n += faces[f].size();
        }
        faceStart_[faces.size()] = n;
        faceWeights_.setSize(n);
    }

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


void Foam::nodalSpace::setConstraints(const scalar deltaT)
{
    const label nNodes = nodePoint_.size();
    const polyBoundaryMesh& bm = mesh_.boundaryMesh();

    nodeMeshVelocity_.setSize(nNodes);
    nodeMeshVelocity_ = Zero;
    if (mesh_.moving())
    {
        forAll(nodePoint_, n)
        {
            const label p = nodePoint_[n];
            nodeMeshVelocity_[n] =
                (Q_[p].T()
                    & ((mesh_.points()[p] - mesh_.oldPoints()[p]) / deltaT));
        }
    }

    frozen_.setSize(nNodes);
    frozen_ = false;
    nFixed_.setSize(nNodes);
    nFixed_ = 0;
    basis_.setSize(nNodes);

    auto constrain = [&](const label n, vector dir)
    {
        if (nd_ == 2) dir -= (dir & e3_) * e3_;
        const scalar magDir = mag(dir);
        if (magDir < VSMALL) return;
        dir /= magDir;

        for (label k = 0; k < nFixed_[n]; ++k)
        {
            dir -= (dir & basis_[n][k]) * basis_[n][k];
        }

        // Almost the direction of an earlier one: one wall in two patches
        if (nFixed_[n] < nd_ && mag(dir) > 0.3)
        {
            basis_[n][nFixed_[n]++] = dir / mag(dir);
        }
    };

    boolList full(nNodes, false);

    // Points on the axis of a wedge stay there
    forAll(onAxis_, n)
    {
        if (onAxis_[n]) constrain(n, e2_);
    }

    forAll(bm, patchi)
    {
        const patchKind kind = kinds_[patchi];
        if (kind != NORMAL && kind != FULL) continue;

        vectorField normal(mesh_.nPoints(), Zero);
        const polyPatch& pp = bm[patchi];
        forAll(pp, i)
        {
            forAll(pp[i], fp)
            {
                normal[pp[i][fp]] += faceWeight(pp.start() + i, fp);
            }
        }
        syncTools::syncPointList(
            mesh_, normal, plusEqOp<vector>(), vector(Zero)
        );

        vectorField nodeNormal(nNodes, Zero);
        forAll(normal, p)
        {
            nodeNormal[pointNode_[p]] += Q_[p].T() & normal[p];
        }
        forAll(nodeNormal, n)
        {
            if (magSqr(nodeNormal[n]) > 0)
            {
                constrain(n, nodeNormal[n]);
                if (kind == FULL) full[n] = true;
            }
        }
    }
    nNormals_ = nFixed_;

    // Where the lumen is closed nothing passes
    for (const label p : closedPoints::of(mesh_)) full[pointNode_[p]] = true;

    forAll(full, n)
    {
        if (!full[n]) continue;
        constrain(n, e1_);
        constrain(n, e2_);
        if (nd_ == 3) constrain(n, e3_);
        // The remainder of a direction may have been too short to count
        if (nFixed_[n] < nd_) constrain(n, e1_ + e2_ + e3_);
    }

    // Complete the bases
    const vector axes[3] = {e1_, e2_, e3_};
    forAll(basis_, n)
    {
        label filled = nFixed_[n];
        while (filled < nd_)
        {
            vector best = Zero;
            for (label d = 0; d < nd_; ++d)
            {
                vector dir = axes[d];
                for (label k = 0; k < filled; ++k)
                {
                    dir -= (dir & basis_[n][k]) * basis_[n][k];
                }
                if (mag(dir) > mag(best) + 1e-6) best = dir;
            }
            basis_[n][filled++] = best / mag(best);
        }
    }
}


void Foam::nodalSpace::setCells()
{
    const label nCells = mesh_.nCells();
    const faceList& faces = mesh_.faces();
    const labelList& own = mesh_.faceOwner();
    const polyBoundaryMesh& bm = mesh_.boundaryMesh();

    // Kind of each boundary face
    boolList wall(mesh_.nFaces(), false);
    boolList counted(mesh_.nFaces(), true);
    forAll(bm, patchi)
    {
        const bool isWall = kinds_[patchi] == NORMAL || kinds_[patchi] == FULL;
        const bool isSide =
            isA<wedgePolyPatch>(bm[patchi]) || isA<emptyPolyPatch>(bm[patchi]);
        forAll(bm[patchi], i)
        {
            wall[bm[patchi].start() + i] = isWall;
            counted[bm[patchi].start() + i] = !isWall && !isSide;
        }
    }

    wallFlux_.setSize(nCells);
    wallFlux_ = 0;
    cellWallNormal_.setSize(nCells);
    cellWallNormal_ = Zero;
    forAll(bm, patchi)
    {
        if (kinds_[patchi] != NORMAL && kinds_[patchi] != FULL) continue;
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
    forAll(cellWallNormal_, c)
    {
        vector& n = cellWallNormal_[c];
        if (nd_ == 2) n -= (n & e3_) * e3_;
        if (magSqr(n) > 0) n /= mag(n);
    }

    if (cellStart_.empty())
    {
        cellStart_.setSize(nCells + 1);
        hourglassStart_.setSize(nCells + 1);
        DynamicList<label> dofs(nCells * 8 * nd_);
        label nHour = 0;
        forAll(mesh_.cells(), c)
        {
            cellStart_[c] = dofs.size();
            hourglassStart_[c] = nHour;
            DynamicList<label> nodes(8);
            for (const label p : mesh_.cellPoints()[c])
            {
                if (!nodes.found(pointNode_[p])) nodes.append(pointNode_[p]);
            }
            for (const label n : nodes)
            {
                for (label k = 0; k < nd_; ++k) dofs.append(nd_ * n + k);
            }
            const label n = nd_ * nodes.size();
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
    }

    cellG_ = Zero;
    cellH_ = 0;
    scalarField area(mesh_.nPoints(), 0.0);

    forAll(mesh_.cells(), c)
    {
        const labelList& pts = mesh_.cellPoints()[c];
        const label start = cellStart_[c];
        const label n = cellStart_[c + 1] - start;
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
            while (dof[s] != nd_ * pointNode_[p]) s += nd_;
            slot[i] = s;
            for (label k = 0; k < nd_; ++k)
            {
                const vector v = shape(p, k);
                cellG_[start + s + k] += (A[i] * v) / V;
                cellH_[start + s + k] += (B[i] & v);
            }
            centre += midPoints_[p];
            scalar a2 = 0;
            for (label k = 0; k < nd_; ++k) a2 += sqr(A[i] & shape(p, k));
            scale += a2 / V;
            area[p] += std::sqrt(a2);
        }
        centre /= pts.size();
        hourglassScale_[c] = scale;

        // Hourglass: what is left of the points' velocity when the linear
        // part is taken away
        List<vector> delta(pts.size() * n, Zero);
        for (label d = 0; d < n; ++d)
        {
            vector mean = Zero;
            forAll(pts, i)
            {
                if (d >= slot[i] && d < slot[i] + nd_)
                {
                    delta[i * n + d] = shape(pts[i], d - slot[i]);
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
        scalar* H = &hourglass_[hourglassStart_[c]];
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

    syncTools::syncPointList(mesh_, area, plusEqOp<scalar>(), scalar(0));
    nodeArea_.setSize(nNodes());
    nodeArea_ = 0;
    forAll(area, p) nodeArea_[pointNode_[p]] += 0.5 * area[p];
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::nodalSpace::nodalSpace(const fvMesh& mesh, const List<patchKind>& kinds) :
    mesh_(mesh),
    kinds_(kinds),
    frame_(mesh)
{
    findSlice();
    pairPoints();
    number();
    update(1);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::nodalSpace::update(const scalar deltaT)
{
    midPoints_ = mesh_.points();
    if (mesh_.moving())
    {
        midPoints_ = 0.5 * (mesh_.points() + mesh_.oldPoints());
    }
    setFaceWeights();
    setConstraints(deltaT);
    setCells();
}


Foam::boolList Foam::nodalSpace::pointsOf(const boolList& cells) const
{
    boolList points(mesh_.nPoints(), false);
    forAll(cells, c)
    {
        if (!cells[c]) continue;
        for (const label p : mesh_.cellPoints()[c]) points[p] = true;
    }
    syncTools::syncPointList(mesh_, points, orEqOp<bool>(), false);
    return points;
}


void Foam::nodalSpace::grow(boolList& cells) const
{
    const boolList points(pointsOf(cells));
    forAll(points, p)
    {
        if (!points[p]) continue;
        for (const label c : mesh_.pointCells()[p]) cells[c] = true;
    }
}


void Foam::nodalSpace::solveOnly(const boolList& cells)
{
    const boolList points(pointsOf(cells));

    frozen_ = true;
    forAll(points, p)
    {
        if (points[p]) frozen_[pointNode_[p]] = false;
    }
    forAll(frozen_, n)
    {
        if (frozen_[n]) nFixed_[n] = nd_;
    }
}


Foam::scalar Foam::nodalSpace::extent(
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


void Foam::nodalSpace::toPoints(const scalarField& q, vectorField& v) const
{
    v.setSize(mesh_.nPoints());
    forAll(v, p)
    {
        const label n = pointNode_[p];
        v[p] = Zero;
        for (label k = 0; k < nd_; ++k) v[p] += q[nd_ * n + k] * basis_[n][k];
        v[p] = Q_[p] & v[p];
    }
}


void Foam::nodalSpace::fromPoints(const vectorField& v, scalarField& q) const
{
    q.setSize(nd_ * nNodes());
    forAll(nodePoint_, n)
    {
        const label p = nodePoint_[n];
        const vector u = Q_[p].T() & v[p];
        for (label k = 0; k < nd_; ++k) q[nd_ * n + k] = u & basis_[n][k];
    }
}


void Foam::nodalSpace::flux(const vectorField& v, surfaceScalarField& phi) const
{
    auto faceFlux = [&](const label facei)
    {
        const face& f = mesh_.faces()[facei];
        scalar sum = 0;
        forAll(f, fp) sum += faceWeight(facei, fp) & v[f[fp]];
        return sum;
    };

    scalarField& internal = phi.primitiveFieldRef();
    forAll(internal, facei) internal[facei] = faceFlux(facei);

    forAll(mesh_.boundaryMesh(), patchi)
    {
        const polyPatch& pp = mesh_.boundaryMesh()[patchi];
        scalarField& b = phi.boundaryFieldRef()[patchi];
        forAll(b, i)
        {
            switch (kinds_[patchi])
            {
                case NORMAL:
                case FULL:
                    b[i] = mesh_.moving()
                        ? mesh_.phi().boundaryField()[patchi][i]
                        : 0;
                    break;
                case SLICE:
                    b[i] = isA<processorPolyPatch>(pp)
                        ? faceFlux(pp.start() + i)
                        : 0;
                    break;
                default:
                    b[i] = faceFlux(pp.start() + i);
            }
        }
    }
}

// ************************************************************************* //
