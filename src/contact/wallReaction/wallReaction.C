// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "wallReaction.H"
#include "contactPatches.H"
#include "surfaceFields.H"
#include "syncTools.H"
#include "volFields.H"

#include <functional>

// * * * * * * * * * * * * * * * * Functions * * * * * * * * * * * * * * * * //

void Foam::wallReaction::distribute(
    const nodalSpace& space,
    const volVectorField& U,
    const scalarField& force,
    const scalarField& rowForce,
    volVectorField& wallForce,
    volScalarField& wallPower
)
{
    const fvMesh& mesh = space.mesh();
    const label nd = space.nd();
    const label nPoints = mesh.nPoints();

    // By components of the node, at the points: force, power, and weight of
    // the faces. A fixed component goes to the faces that look that way (where
    // walls or a symmetry plane meet, each then gets its own normal force), a
    // free one to all walls by their area.
    vectorField F(nPoints, Zero);
    vectorField W(nPoints, Zero);
    vectorField weight(nPoints, Zero);
    forAll(F, p)
    {
        const label node = space.pointNode()[p];
        for (label k = 0; k < nd; ++k)
        {
            F[p][k] = force[nd * node + k];
            W[p][k] = rowForce[nd * node + k] * space.fixedValue(node, k);
        }
    }

    auto faceWeight = [&](const label facei, const label fp, const label k)
    {
        const label p = mesh.faces()[facei][fp];
        const vector& a = space.faceWeight(facei, fp);
        return k < space.nNormals()[space.pointNode()[p]]
            ? mag(a & space.shape(p, k))
            : mag(a);
    };

    auto isWall = [&](const label patchi)
    { return contactPatches::isWall(U, patchi); };

    auto forPoints = [&](std::function<void(label, label, label)> f)
    {
        forAll(mesh.boundary(), patchi)
        {
            if (!isWall(patchi)
                && !contactPatches::isSymmetry(mesh.boundaryMesh()[patchi]))
            {
                continue;
            }

            const polyPatch& pp = mesh.boundaryMesh()[patchi];
            forAll(pp, i)
            {
                forAll(pp[i], fp) f(patchi, i, fp);
            }
        }
    };

    vectorField nodeWeight(space.nNodes(), Zero);
    forPoints(
        [&](label patchi, label i, label fp)
        {
            const label facei = mesh.boundaryMesh()[patchi].start() + i;
            const label p = mesh.faces()[facei][fp];
            const label node = space.pointNode()[p];
            for (label k = 0; k < nd; ++k)
            {
                // A symmetry plane takes nothing along itself
                if (isWall(patchi) || k < space.nNormals()[node])
                {
                    nodeWeight[node][k] += faceWeight(facei, fp, k);
                }
            }
        }
    );
    forAll(weight, p) weight[p] = nodeWeight[space.pointNode()[p]];

    syncTools::syncPointList(mesh, F, plusEqOp<vector>(), vector(Zero));
    syncTools::syncPointList(mesh, W, plusEqOp<vector>(), vector(Zero));
    syncTools::syncPointList(mesh, weight, plusEqOp<vector>(), vector(Zero));

    forPoints(
        [&](label patchi, label i, label fp)
        {
            if (!isWall(patchi)) return;
            const label facei = mesh.boundaryMesh()[patchi].start() + i;
            const label p = mesh.faces()[facei][fp];
            for (label k = 0; k < nd; ++k)
            {
                if (weight[p][k] < VSMALL) continue;
                const scalar part = faceWeight(facei, fp, k) / weight[p][k];
                wallForce.boundaryFieldRef()[patchi][i] -=
                    (part * F[p][k]) * space.basis()[space.pointNode()[p]][k];
                wallPower.boundaryFieldRef()[patchi][i] += part * W[p][k];
            }
        }
    );
}


void Foam::wallReaction::start(
    const volVectorField& U,
    const scalarField& pressure,
    volVectorField& wallForce,
    volScalarField& wallPower
)
{
    const fvMesh& mesh = U.mesh();
    wallForce.primitiveFieldRef() = Zero;
    wallPower.primitiveFieldRef() = 0;
    forAll(mesh.boundary(), patchi)
    {
        const labelList& cells = mesh.boundary()[patchi].faceCells();
        fvPatchVectorField& F = wallForce.boundaryFieldRef()[patchi];
        fvPatchScalarField& P = wallPower.boundaryFieldRef()[patchi];
        F == vectorField(F.size(), Zero);
        P == scalarField(P.size(), Zero);

        if (!contactPatches::isWall(U, patchi) || !mesh.moving()) continue;
        scalarField power(P.size());
        forAll(power, i)
        {
            power[i] =
                pressure[cells[i]] * mesh.phi().boundaryField()[patchi][i];
        }
        P == power;
    }
}


void Foam::wallReaction::book(
    const scalarField& pressure,
    const volScalarField& wallPower,
    powerLedger& ledger
)
{
    const fvMesh& mesh = wallPower.mesh();
    forAll(mesh.boundary(), patchi)
    {
        const polyPatch& pp = mesh.boundaryMesh()[patchi];
        ledger["walls"] += sum(wallPower.boundaryField()[patchi]);

        if (!mesh.moving() || !contactPatches::isSymmetry(pp)) continue;
        const scalarField& swept = mesh.phi().boundaryField()[patchi];
        forAll(swept, i)
        {
            ledger["closure"] += pressure[pp.faceCells()[i]] * swept[i];
        }
    }
}

// ************************************************************************* //
