// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "schwarzSlabs.H"

#include <algorithm>
#include <vector>

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::boolList Foam::schwarzSlabs::solved(
    const nodalSpace& space,
    const boolList& room
)
{
    const label nd = space.nd();
    boolList result(space.nNodes(), false);
    forAll(room, c)
    {
        if (!room[c]) continue;
        for (label i = space.cellStart()[c]; i < space.cellStart()[c + 1]; ++i)
        {
            result[space.cellDofs()[i] / nd] = true;
        }
    }
    return result;
}


Foam::List<Foam::DynamicList<PetscInt>> Foam::schwarzSlabs::blocks(
    const nodalSpace& space,
    const boolList& room
) const
{
    const boolList solved(schwarzSlabs::solved(space, room));
    labelList nodes(space.ownedNodes());
    label nSolved = 0;
    for (const label node : nodes) nSolved += solved[node];

    const pointField& points = space.mesh().points();
    auto position = [&](const label node)
    { return points[space.nodePoint()[node]][axis_]; };
    std::sort(
        nodes.begin(),
        nodes.end(),
        [&](const label a, const label b) { return position(a) < position(b); }
    );

    // Nodes at one position, to a millionth of the mesh, stay together
    const scalar level = 1e-6 * space.mesh().bounds().mag();
    List<DynamicList<PetscInt>> result(number_);
    scalar last = -GREAT;
    label below = 0;
    label counted = 0;
    for (const label node : nodes)
    {
        if (position(node) > last + level) below = counted;
        last = position(node);
        const label slab = number_ * (scalar(below) / max(nSolved, 1));
        result[min(slab, number_ - 1)].append(
            space.nodeRow()[node] / space.nd()
        );
        counted += solved[node];
    }
    return result;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::schwarzSlabs::give(
    KSP solver,
    const nodalSpace& space,
    const boolList& room
) const
{
    if (number_ <= 0) return;

    List<DynamicList<PetscInt>> nodes(blocks(space, room));
    std::vector<IS> slabs;
    for (DynamicList<PetscInt>& rows : nodes)
    {
        if (rows.empty()) continue;
        std::sort(rows.begin(), rows.end());
        slabs.push_back(nullptr);
        PETSC_CHECK(ISCreateBlock(
            PETSC_COMM_SELF,
            space.nd(),
            rows.size(),
            rows.cdata(),
            PETSC_COPY_VALUES,
            &slabs.back()
        ));
    }
    PC pc;
    PETSC_CHECK(KSPGetPC(solver, &pc));
    petscCheck(
        PCASMSetLocalSubdomains(pc, slabs.size(), slabs.data(), slabs.data()),
        "PCASMSetLocalSubdomains"
    );
    for (IS& slab : slabs) ISDestroy(&slab);

    // PETSc takes a caller's subdomains as they are until it is told again
    PetscInt overlap = 1;
    PETSC_CHECK(PetscOptionsGetInt(
        nullptr, "bolus_velocity_", "-pc_asm_overlap", &overlap, nullptr
    ));
    PETSC_CHECK(PCASMSetOverlap(pc, overlap));
}

// ************************************************************************* //
