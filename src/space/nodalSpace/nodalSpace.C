// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "nodalSpace.H"
#include "closedPoints.H"
#include "surfaceFields.H"
#include "syncTools.H"
#include "processorPolyPatch.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::boolList Foam::nodalSpace::walls(const List<patchKind>& kinds)
{
    boolList result(kinds.size());
    forAll(kinds, i) result[i] = kinds[i] == NORMAL || kinds[i] == FULL;
    return result;
}


void Foam::nodalSpace::setConstraints(const scalar deltaT)
{
    const label nNodes = nodes_.nNodes();
    const label nd = nodes_.nd();
    const vector& e1 = nodes_.axial();
    const vector& e2 = nodes_.radial();
    const vector& e3 = nodes_.normal();
    const polyBoundaryMesh& bm = mesh_.boundaryMesh();

    nodeMeshVelocity_.setSize(nNodes);
    nodeMeshVelocity_ = Zero;
    if (mesh_.moving())
    {
        forAll(nodeMeshVelocity_, n)
        {
            const label p = nodePoint()[n];
            nodeMeshVelocity_[n] = nodes_.toNode(
                p, (mesh_.points()[p] - mesh_.oldPoints()[p]) / deltaT
            );
        }
    }

    frozen_.setSize(nNodes);
    frozen_ = false;
    nFixed_.setSize(nNodes);
    nFixed_ = 0;
    basis_.setSize(nNodes);

    auto constrain = [&](const label n, vector dir)
    {
        if (nd == 2) dir -= (dir & e3) * e3;
        const scalar magDir = mag(dir);
        if (magDir < VSMALL) return;
        dir /= magDir;

        for (label k = 0; k < nFixed_[n]; ++k)
        {
            dir -= (dir & basis_[n][k]) * basis_[n][k];
        }

        // Almost the direction of an earlier one: one wall in two patches
        if (nFixed_[n] < nd && mag(dir) > 0.3)
        {
            basis_[n][nFixed_[n]++] = dir / mag(dir);
        }
    };

    boolList full(nNodes, false);

    // Points on the axis of a wedge stay there
    forAll(nodes_.onAxis(), n)
    {
        if (nodes_.onAxis()[n]) constrain(n, e2);
    }

    forAll(bm, patchi)
    {
        if (!cells_.wall(patchi)) continue;

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
            nodeNormal[pointNode()[p]] += nodes_.toNode(p, normal[p]);
        }
        forAll(nodeNormal, n)
        {
            if (magSqr(nodeNormal[n]) > 0)
            {
                constrain(n, nodeNormal[n]);
                if (kinds_[patchi] == FULL) full[n] = true;
            }
        }
    }
    nNormals_ = nFixed_;

    // Where the lumen is closed nothing passes
    for (const label p : closedPoints::of(mesh_)) full[pointNode()[p]] = true;

    forAll(full, n)
    {
        if (!full[n]) continue;
        constrain(n, e1);
        constrain(n, e2);
        if (nd == 3) constrain(n, e3);
        // The remainder of a direction may have been too short to count
        if (nFixed_[n] < nd) constrain(n, e1 + e2 + e3);
    }

    // Complete the bases
    const vector axes[3] = {e1, e2, e3};
    forAll(basis_, n)
    {
        label filled = nFixed_[n];
        while (filled < nd)
        {
            vector best = Zero;
            for (label d = 0; d < nd; ++d)
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


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::nodalSpace::nodalSpace(const fvMesh& mesh, const List<patchKind>& kinds) :
    mesh_(mesh),
    kinds_(kinds),
    nodes_(mesh),
    cells_(mesh, nodes_, walls(kinds))
{
    update(1);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::nodalSpace::update(const scalar deltaT)
{
    cells_.followMesh();
    setConstraints(deltaT);
    cells_.assemble(basis_);
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
        if (points[p]) frozen_[pointNode()[p]] = false;
    }
    forAll(frozen_, n)
    {
        if (frozen_[n]) nFixed_[n] = nd();
    }
}


void Foam::nodalSpace::toPoints(const scalarField& q, vectorField& v) const
{
    const label nd = nodes_.nd();
    v.setSize(mesh_.nPoints());
    forAll(v, p)
    {
        const label n = pointNode()[p];
        v[p] = Zero;
        for (label k = 0; k < nd; ++k) v[p] += q[nd * n + k] * basis_[n][k];
        v[p] = nodes_.toPoint(p, v[p]);
    }
}


void Foam::nodalSpace::fromPoints(const vectorField& v, scalarField& q) const
{
    const label nd = nodes_.nd();
    q.setSize(nd * nNodes());
    forAll(nodePoint(), n)
    {
        const label p = nodePoint()[n];
        const vector u = nodes_.toNode(p, v[p]);
        for (label k = 0; k < nd; ++k) q[nd * n + k] = u & basis_[n][k];
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
