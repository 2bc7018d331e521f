// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "contactPatches.H"
#include "contactWallFvPatchVectorField.H"
#include "emptyPolyPatch.H"
#include "processorPolyPatch.H"
#include "symmetryPlanePolyPatch.H"
#include "symmetryPolyPatch.H"
#include "syncTools.H"
#include "volFields.H"
#include "wallPolyPatch.H"
#include "wedgePolyPatch.H"

// * * * * * * * * * * * * * * * * Functions * * * * * * * * * * * * * * * * //

Foam::List<Foam::nodalSpace::patchKind> Foam::contactPatches::kinds(
    const volVectorField& U
)
{
    const polyBoundaryMesh& bm = U.mesh().boundaryMesh();
    List<nodalSpace::patchKind> result(bm.size());

    forAll(bm, patchi)
    {
        const polyPatch& pp = bm[patchi];
        const fvPatchVectorField& Up = U.boundaryField()[patchi];

        if (isA<wedgePolyPatch>(pp) || isA<emptyPolyPatch>(pp)
            || isA<processorPolyPatch>(pp))
        {
            result[patchi] = nodalSpace::SLICE;
        }
        else if (isSymmetry(pp))
        {
            result[patchi] = nodalSpace::NORMAL;
        }
        else if (pp.coupled())
        {
            FatalErrorInFunction
                << "patch " << pp.name() << " of type " << pp.type()
                << ": valid are wall, patch, symmetry, symmetryPlane, wedge,"
                << " empty and processor" << exit(FatalError);
        }
        else if (isA<contactWallFvPatchVectorField>(Up))
        {
            // Else it has no normal for the bolus to part along
            if (!isA<wallPolyPatch>(pp))
            {
                FatalErrorInFunction
                    << "field U, patch " << pp.name() << ": entry type:"
                    << " contactWall, and the patch is of type " << pp.type()
                    << "; valid is type wall in constant/polyMesh/boundary"
                    << exit(FatalError);
            }
            result[patchi] = refCast<const contactWallFvPatchVectorField>(Up)
                                 .friction()
                                 .sticks()
                ? nodalSpace::FULL
                : nodalSpace::NORMAL;
        }
        else if (Up.type() == "zeroGradient" && !isA<wallPolyPatch>(pp))
        {
            result[patchi] = nodalSpace::UNCONSTRAINED;
        }
        else
        {
            FatalErrorInFunction
                << "field U, patch " << pp.name() << " (" << pp.type()
                << "): entry type: " << Up.type() << "; valid are contactWall"
                << " (a wall with or without friction) and, where the patch is"
                << " no wall, zeroGradient (an open boundary)"
                << exit(FatalError);
        }
    }
    return result;
}


bool Foam::contactPatches::isWall(const volVectorField& U, const label patchi)
{
    return isA<contactWallFvPatchVectorField>(U.boundaryField()[patchi]);
}


bool Foam::contactPatches::isSymmetry(const polyPatch& patch)
{
    return isA<symmetryPlanePolyPatch>(patch) || isA<symmetryPolyPatch>(patch);
}


Foam::boolList Foam::contactPatches::separates(const volVectorField& U)
{
    boolList result(U.mesh().nCells(), false);
    forAll(U.boundaryField(), patchi)
    {
        if (!isWall(U, patchi)) continue;
        if (!refCast<const contactWallFvPatchVectorField>(
                U.boundaryField()[patchi]
            )
                .separation())
        {
            continue;
        }
        for (const label c : U.mesh().boundaryMesh()[patchi].faceCells())
        {
            result[c] = true;
        }
    }
    return result;
}


Foam::boolList Foam::contactPatches::heldNodes(
    const volVectorField& U,
    const nodalSpace& space
)
{
    const fvMesh& mesh = U.mesh();
    labelList wall(mesh.nPoints(), Zero);
    forAll(mesh.boundary(), patchi)
    {
        if (!isWall(U, patchi)) continue;
        for (const label p : mesh.boundaryMesh()[patchi].meshPoints())
        {
            wall[p] = 1;
        }
    }
    syncTools::syncPointList(mesh, wall, maxEqOp<label>(), label(0));

    boolList held(space.nNodes(), true);
    forAll(wall, p)
    {
        if (wall[p]) held[space.pointNode()[p]] = false;
    }
    return held;
}

// ************************************************************************* //
