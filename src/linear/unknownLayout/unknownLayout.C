// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "unknownLayout.H"
#include "globalIndex.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::unknownLayout::unknownLayout(const nodalSpace& space, petscVec& x) :
    space_(space)
{
    const label nVelocities = space.nRowsOwned();
    const label nCells = space.mesh().nCells();
    petscCheck(
        VecCreateMPI(
            PETSC_COMM_WORLD, nVelocities + nCells, PETSC_DETERMINE, x.set()
        ),
        "VecCreateMPI"
    );
    PETSC_CHECK(VecSetOption(x, VEC_IGNORE_NEGATIVE_INDICES, PETSC_TRUE));

    // The pressures of each processor follow its velocities
    const globalIndex velocities(nVelocities);
    const globalIndex cells(nCells);
    firstCellRow_ = velocities.toGlobal(0) + nVelocities + cells.toGlobal(0);
    nodeRow_ = space.nodeRow();
    for (label& row : nodeRow_)
    {
        row += cells.toGlobal(velocities.whichProcID(row), 0);
    }

    DynamicList<PetscInt> rows;
    for (const label row : nodeRow_)
    {
        for (label k = 0; k < space.nd(); ++k) rows.append(row + k);
    }
    for (label c = 0; c < nCells; ++c) rows.append(firstCellRow_ + c);

    petscIS from;
    PETSC_CHECK(ISCreateGeneral(
        PETSC_COMM_SELF,
        rows.size(),
        rows.cdata(),
        PETSC_COPY_VALUES,
        from.set()
    ));
    PETSC_CHECK(VecCreateSeq(PETSC_COMM_SELF, rows.size(), local_.set()));
    petscCheck(
        VecScatterCreate(x, from, local_, nullptr, scatter_.set()),
        "VecScatterCreate"
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::unknownLayout::gather(
    Vec x,
    const scalar velocity,
    const scalar pressure,
    scalarField& q,
    scalarField& p
) const
{
    PETSC_CHECK(
        VecScatterBegin(scatter_, x, local_, INSERT_VALUES, SCATTER_FORWARD)
    );
    PETSC_CHECK(
        VecScatterEnd(scatter_, x, local_, INSERT_VALUES, SCATTER_FORWARD)
    );

    const PetscScalar* v;
    PETSC_CHECK(VecGetArrayRead(local_, &v));
    label i = 0;
    for (scalar& value : q) value = velocity * v[i++];
    for (scalar& value : p) value = pressure * v[i++];
    PETSC_CHECK(VecRestoreArrayRead(local_, &v));
}

// ************************************************************************* //
