// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "cellExchange.H"
#include "Pstream.H"
#include "PstreamReduceOps.H"
#include "processorPolyPatch.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::cellExchange::swap(const label width, scalarField& beyond) const
{
    beyond.setSize(sent_.size());
    const label before = Pstream::nRequests();
    for (const polyPatch& patch : mesh_.boundaryMesh())
    {
        if (!isA<processorPolyPatch>(patch) || patch.empty()) continue;
        const auto& to = refCast<const processorPolyPatch>(patch);
        const label first = at(patch.start(), width);
        const std::streamsize size = width * patch.size() * sizeof(scalar);
        UIPstream::read(
            Pstream::commsTypes::nonBlocking,
            to.neighbProcNo(),
            reinterpret_cast<char*>(&beyond[first]),
            size,
            to.tag(),
            to.comm()
        );
        UOPstream::write(
            Pstream::commsTypes::nonBlocking,
            to.neighbProcNo(),
            reinterpret_cast<const char*>(&sent_[first]),
            size,
            to.tag(),
            to.comm()
        );
    }
    Pstream::waitRequests(before);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cellExchange::cellExchange(const fvMesh& mesh) :
    mesh_(mesh),
    nInternal_(mesh.nInternalFaces()),
    coupled_(mesh.nFaces(), false),
    place_(mesh.nFaces() - mesh.nInternalFaces(), -1)
{
    for (const fvPatch& patch : mesh_.boundary())
    {
        if (!patch.coupled()) continue;
        forAll(patch, i) coupled_[patch.start() + i] = true;
    }
    DynamicList<label> faces, cells;
    for (label f = nInternal_; f < mesh_.nFaces(); ++f)
    {
        if (!coupled_[f]) continue;
        place_[f - nInternal_] = faces.size();
        faces.append(f);
        cells.append(mesh_.faceOwner()[f]);
    }
    faces_ = faces;
    cells_ = cells;
    parts_ = returnReduce(coupled_.found(true), orOp<bool>());
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::cellExchange::cells(
    const scalarField& values,
    const label width,
    scalarField& beyond
) const
{
    if (!parts_) return;
    sent_.setSize(cells_.size() * width);
    forAll(cells_, i)
    {
        for (label k = 0; k < width; ++k)
        {
            sent_[i * width + k] = values[cells_[i] * width + k];
        }
    }
    swap(width, beyond);
}


void Foam::cellExchange::faces(
    const scalarField& values,
    scalarField& beyond
) const
{
    if (!parts_) return;
    sent_.setSize(faces_.size());
    forAll(faces_, i) sent_[i] = values[faces_[i]];
    swap(1, beyond);
}

// ************************************************************************* //
