// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "meshCheck.H"

#include "HashSet.H"
#include "labelIOList.H"
#include "OSspecific.H"
#include "primitiveMeshTools.H"
#include "Tuple2.H"
#include "volFields.H"

#include <cmath>

// * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * * //

void Foam::meshCheck::requireMesh(const Time& time)
{
    const fileName points(
        time.path() / time.constant() / "polyMesh" / "points"
    );
    bool found = isFile(points) || isFile(points + ".gz");
    reduce(found, andOp<bool>());
    if (!found)
    {
        FatalErrorInFunction
            << "the case has no mesh: there is no constant/polyMesh/points;"
            << " make it by blockMesh (in parallel: and decomposePar)"
            << exit(FatalError);
    }

    const labelIOList owner(IOobject(
        "owner",
        time.constant(),
        "polyMesh",
        time,
        IOobject::MUST_READ,
        IOobject::NO_WRITE,
        false
    ));
    const label empty =
        returnReduce(label(owner.empty() ? 1 : 0), sumOp<label>());
    if (empty > 0)
    {
        FatalErrorInFunction
            << empty << " of " << Pstream::nProcs() << " ranks have no cells;"
            << " valid is a number of ranks that gives every one a part of the"
            << " mesh: take fewer (-np), or cut it otherwise"
            << " (system/decomposeParDict)" << exit(FatalError);
    }
}


void Foam::meshCheck::requireSoundCells(const fvMesh& mesh)
{
    // Not by <, which traps where there is no number
    auto sound = [](const scalar v) { return std::isfinite(v) && v > 0; };

    // Number of cells that are not, and the smallest volume and its place
    Tuple2<scalar, point> worst(GREAT, Zero);
    labelHashSet bad;
    auto look = [&](const label c, const scalar volume)
    {
        if (sound(volume)) return;
        bad.insert(c);
        const scalar v = std::isfinite(volume) ? volume : -GREAT;
        if (v < worst.first())
        {
            worst = Tuple2<scalar, point>(v, mesh.cellCentres()[c]);
        }
    };

    scalarField own;
    scalarField nei;
    primitiveMeshTools::facePyramidVolume(
        mesh, mesh.points(), mesh.cellCentres(), own, nei
    );
    const labelList& owner = mesh.faceOwner();
    const labelList& neighbour = mesh.faceNeighbour();
    forAll(own, f) look(owner[f], own[f]);
    forAll(nei, f) look(neighbour[f], nei[f]);
    forAll(mesh.V(), c) look(c, mesh.V()[c]);

    const label n = returnReduce(bad.size(), sumOp<label>());
    if (n == 0) return;

    reduce(worst, minFirstOp<scalar>());
    FatalErrorInFunction
        << n << " cells are turned inside out after the mesh has moved to t = "
        << mesh.time().value() << " s, the worst at " << worst.second()
        << " m (" << worst.first() << " m3). Nothing written is lost: the last"
        << " written time is " << mesh.time().times().last().name()
        << " s. Valid is a motion (constant/dynamicMeshDict, its boundary"
        << " conditions) or a mesh that leaves every cell a volume > 0"
        << exit(FatalError);
}

// ************************************************************************* //
