// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "nodeNumbering.H"
#include "globalMeshData.H"
#include "globalIndex.H"
#include "syncTools.H"
#include "wedgePolyPatch.H"
#include "emptyPolyPatch.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::nodeNumbering::findSlice()
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


Foam::labelList Foam::nodeNumbering::partners() const
{
    const label nPoints = mesh_.nPoints();

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
    return partner;
}


void Foam::nodeNumbering::pairPoints()
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

    const labelList partner(partners());
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
    if (frame_.valid()) turn(partner);
}


void Foam::nodeNumbering::turn(const labelList& partner)
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


void Foam::nodeNumbering::number()
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


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::nodeNumbering::nodeNumbering(const fvMesh& mesh) :
    mesh_(mesh),
    frame_(mesh)
{
    findSlice();
    pairPoints();
    number();
}

// ************************************************************************* //
