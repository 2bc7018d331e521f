// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "condensedTangent.H"
#include "profiling.H"

namespace Foam
{

//- Read access to the values of a vector on this processor
class vecValues
{
    Vec v_;
    const PetscScalar* a_;

public:

    explicit vecValues(Vec v) :
        v_(v)
    {
        PETSC_CHECK(VecGetArrayRead(v_, &a_));
    }
    ~vecValues()
    {
        PETSC_CHECK(VecRestoreArrayRead(v_, &a_));
    }
    PetscScalar operator[](const label i) const
    {
        return a_[i];
    }
};

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::condensedTangent::preallocate()
{
    const label n = space_.nRowsOwned();
    const label nd = space_.nd();

    petscMat pattern;
    PETSC_CHECK(MatCreate(PETSC_COMM_WORLD, pattern.set()));
    PETSC_CHECK(MatSetType(pattern, MATPREALLOCATOR));
    PETSC_CHECK(MatSetSizes(pattern, n, n, PETSC_DETERMINE, PETSC_DETERMINE));
    PETSC_CHECK(MatSetUp(pattern));

    DynamicList<PetscInt> rows;
    for (const label node : space_.ownedNodes())
    {
        for (label k = 0; k < nd; ++k)
        {
            const PetscInt row = space_.nodeRow()[node] + k;
            const scalar zero = 0;
            PETSC_CHECK(
                MatSetValues(pattern, 1, &row, 1, &row, &zero, ADD_VALUES)
            );
        }
    }
    forAll(room_, c)
    {
        if (!room_[c]) continue;
        rows.clear();
        for (
            label i = space_.cellStart()[c]; i < space_.cellStart()[c + 1]; ++i
        )
        {
            const label dof = space_.cellDofs()[i];
            rows.append(space_.nodeRow()[dof / nd] + dof % nd);
        }
        const scalarField zeros(rows.size() * rows.size(), 0.0);
        PETSC_CHECK(MatSetValues(
            pattern,
            rows.size(),
            rows.cdata(),
            rows.size(),
            rows.cdata(),
            zeros.cdata(),
            ADD_VALUES
        ));
    }
    PETSC_CHECK(MatAssemblyBegin(pattern, MAT_FINAL_ASSEMBLY));
    PETSC_CHECK(MatAssemblyEnd(pattern, MAT_FINAL_ASSEMBLY));

    PETSC_CHECK(MatCreate(PETSC_COMM_WORLD, A_.set()));
    PETSC_CHECK(MatSetType(A_, MATAIJ));
    PETSC_CHECK(MatSetSizes(A_, n, n, PETSC_DETERMINE, PETSC_DETERMINE));
    PETSC_CHECK(MatPreallocatorPreallocate(pattern, PETSC_TRUE, A_));
    // Preallocation makes it 1; subdomains are to have whole nodes
    PETSC_CHECK(MatSetBlockSize(A_, nd));
    PETSC_CHECK(MatSetOption(A_, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_TRUE));
}


void Foam::condensedTangent::createSolver()
{
    PETSC_CHECK(KSPCreate(PETSC_COMM_WORLD, solver_.set()));
    PETSC_CHECK(KSPSetOptionsPrefix(solver_, "bolus_velocity_"));
    PETSC_CHECK(KSPSetOperators(solver_, A_, A_));
    petscCheck(KSPSetFromOptions(solver_), "petscOptions of fvSolution");
    slabs_.give(solver_, space_, room_);
}


void Foam::condensedTangent::addB(const scalarField& perCell, Vec v) const
{
    const label nd = space_.nd();
    DynamicList<PetscInt> rows;
    DynamicList<scalar> values;
    forAll(perCell, c)
    {
        rows.clear();
        values.clear();
        for (
            label i = space_.cellStart()[c]; i < space_.cellStart()[c + 1]; ++i
        )
        {
            const label dof = space_.cellDofs()[i];
            rows.append(space_.nodeRow()[dof / nd] + dof % nd);
            values.append(B_[i] * perCell[c]);
        }
        PETSC_CHECK(VecSetValues(
            v, rows.size(), rows.cdata(), values.cdata(), ADD_VALUES
        ));
    }
    PETSC_CHECK(VecAssemblyBegin(v));
    PETSC_CHECK(VecAssemblyEnd(v));
}


void Foam::condensedTangent::multC(scalarField& perCell) const
{
    const vecValues u(local_);
    forAll(perCell, c)
    {
        scalar sum = 0;
        for (
            label i = space_.cellStart()[c]; i < space_.cellStart()[c + 1]; ++i
        )
        {
            sum += C_[i] * u[space_.cellDofs()[i]];
        }
        perCell[c] = sum;
    }
}


PetscErrorCode Foam::condensedTangent::multiply(Vec x, Vec y) const
{
    const label n = space_.nRowsOwned();

    PETSC_CHECK(
        VecScatterBegin(scatter_, x, local_, INSERT_VALUES, SCATTER_FORWARD)
    );
    PETSC_CHECK(
        VecScatterEnd(scatter_, x, local_, INSERT_VALUES, SCATTER_FORWARD)
    );

    scalarField Cu(D_.size());
    multC(Cu);

    scalarField perCell(D_.size());
    {
        const vecValues values(x);
        PetscScalar* u;
        PETSC_CHECK(VecGetArray(solution_, &u));
        for (label i = 0; i < n; ++i) u[i] = values[i];
        PETSC_CHECK(VecRestoreArray(solution_, &u));
        forAll(perCell, c) perCell[c] = values[n + c] + Cu[c] / D_[c];
    }
    PETSC_CHECK(MatMult(A_, solution_, right_));
    addB(perCell, right_);

    const vecValues Au(right_);
    const vecValues values(x);
    PetscScalar* result;
    PETSC_CHECK(VecGetArray(y, &result));
    for (label i = 0; i < n; ++i) result[i] = Au[i];
    forAll(D_, c) result[n + c] = Cu[c] + D_[c] * values[n + c];
    PETSC_CHECK(VecRestoreArray(y, &result));
    return 0;
}


PetscErrorCode Foam::condensedTangent::solve(Vec f, Vec x, bool& solved) const
{
    const label n = space_.nRowsOwned();

    scalarField g(D_.size());
    {
        const vecValues values(f);
        forAll(g, c) g[c] = values[n + c] + excess_[c];
    }
    PETSC_CHECK(VecSet(right_, 0));
    addB(-g / D_, right_);
    {
        const vecValues values(f);
        PetscScalar* r;
        PETSC_CHECK(VecGetArray(right_, &r));
        for (label i = 0; i < n; ++i) r[i] += values[i];
        PETSC_CHECK(VecRestoreArray(right_, &r));
    }

    // Apart, for the profile: the first things that KSPSolve would do
    PetscErrorCode code;
    {
        addProfiling(factorisation, "factorisation");
        code = KSPSetUp(solver_);
        if (code == 0) code = KSPSetUpOnBlocks(solver_);
    }
    KSPConvergedReason reason = KSP_DIVERGED_PC_FAILED;
    if (code == 0)
    {
        addProfiling(substitution, "linear solve");
        code = KSPSolve(solver_, right_, solution_);
        PETSC_CHECK(KSPGetConvergedReason(solver_, &reason));
        PetscInt iterations;
        PETSC_CHECK(KSPGetIterationNumber(solver_, &iterations));
        iterations_ += iterations;
    }
    solved = code == 0 && reason > 0;

    PetscScalar* result;
    {
        const vecValues u(solution_);
        PETSC_CHECK(VecGetArray(x, &result));
        for (label i = 0; i < n; ++i) result[i] = u[i];
        PETSC_CHECK(VecRestoreArray(x, &result));
    }
    PETSC_CHECK(
        VecScatterBegin(scatter_, x, local_, INSERT_VALUES, SCATTER_FORWARD)
    );
    PETSC_CHECK(
        VecScatterEnd(scatter_, x, local_, INSERT_VALUES, SCATTER_FORWARD)
    );
    scalarField Cu(D_.size());
    multC(Cu);
    PETSC_CHECK(VecGetArray(x, &result));
    forAll(D_, c) result[n + c] = (g[c] - Cu[c]) / D_[c];
    PETSC_CHECK(VecRestoreArray(x, &result));
    return code;
}


PetscErrorCode Foam::condensedTangent::shellMult(Mat J, Vec x, Vec y)
{
    void* self;
    PETSC_CHECK(MatShellGetContext(J, &self));
    return static_cast<const condensedTangent*>(self)->multiply(x, y);
}


PetscErrorCode Foam::condensedTangent::shellSolve(PC pc, Vec f, Vec x)
{
    void* self;
    PETSC_CHECK(PCShellGetContext(pc, &self));
    bool solved;
    const PetscErrorCode code =
        static_cast<const condensedTangent*>(self)->solve(f, x, solved);
    // Not left to the next solution: nothing else takes a failure back
    PETSC_CHECK(PCSetFailedReason(pc, solved ? PC_NOERROR : PC_SUBPC_ERROR));
    return code;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::condensedTangent::condensedTangent(
    const nodalSpace& space,
    VecScatter scatter,
    Vec local,
    const schwarzSlabs& slabs
) :
    space_(space),
    slabs_(slabs),
    room_(space.mesh().nCells(), false),
    B_(space.cellDofs().size(), Zero),
    C_(space.cellDofs().size(), Zero),
    D_(space.mesh().nCells(), 1.0),
    excess_(space.mesh().nCells(), Zero),
    scatter_(scatter),
    local_(local),
    iterations_(0)
{
    preallocate();
    PETSC_CHECK(MatCreateVecs(A_, solution_.set(), right_.set()));

    const label n = space_.nRowsOwned() + space_.mesh().nCells();
    petscCheck(
        MatCreateShell(
            PETSC_COMM_WORLD,
            n,
            n,
            PETSC_DETERMINE,
            PETSC_DETERMINE,
            this,
            shell_.set()
        ),
        "MatCreateShell"
    );
    PETSC_CHECK(MatShellSetOperation(
        shell_, MATOP_MULT, reinterpret_cast<void (*)()>(shellMult)
    ));

    createSolver();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::condensedTangent::attach(SNES snes)
{
    KSP ksp;
    PC pc;
    PETSC_CHECK(SNESGetKSP(snes, &ksp));
    PETSC_CHECK(KSPSetType(ksp, KSPPREONLY));
    PETSC_CHECK(KSPGetPC(ksp, &pc));
    PETSC_CHECK(PCSetType(pc, PCSHELL));
    PETSC_CHECK(PCShellSetContext(pc, this));
    PETSC_CHECK(PCShellSetApply(pc, shellSolve));
}


void Foam::condensedTangent::setAccuracy(const scalar tolerance)
{
    PETSC_CHECK(KSPSetTolerances(
        solver_, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT
    ));
}


void Foam::condensedTangent::clear(const boolList& cells)
{
    bool fits = true;
    forAll(cells, c)
    {
        if (cells[c] && !room_[c]) fits = false;
    }
    reduce(fits, andOp<bool>());
    if (!fits)
    {
        // A layer more than needed: the next steps will fit as well
        room_ = cells;
        space_.grow(room_);
        preallocate();
        createSolver();
    }
    PETSC_CHECK(MatZeroEntries(A_));
    B_ = 0;
    C_ = 0;
    D_ = 1;
    excess_ = 0;
}


void Foam::condensedTangent::add(
    const label c,
    const scalarField& J,
    const UList<PetscInt>& rows,
    const UList<PetscInt>& cols
)
{
    const label n = cols.size();
    const label start = space_.cellStart()[c];
    const scalar D = J[n * (n + 1) + n];

    D_[c] = D;
    for (label i = 0; i < n; ++i)
    {
        B_[start + i] = rows[i] < 0 ? 0 : J[i * (n + 1) + n];
        C_[start + i] = J[n * (n + 1) + i];
    }

    scalarField A(n * n);
    for (label i = 0; i < n; ++i)
    {
        const scalar b = B_[start + i] / D;
        for (label j = 0; j < n; ++j)
        {
            A[i * n + j] = J[i * (n + 1) + j] - b * C_[start + j];
        }
    }
    PETSC_CHECK(MatSetValues(
        A_, n, rows.cdata(), n, cols.cdata(), A.cdata(), ADD_VALUES
    ));
}


void Foam::condensedTangent::fix(const PetscInt row)
{
    const scalar one = 1;
    PETSC_CHECK(MatSetValues(A_, 1, &row, 1, &row, &one, ADD_VALUES));
}


void Foam::condensedTangent::finish()
{
    PETSC_CHECK(MatAssemblyBegin(A_, MAT_FINAL_ASSEMBLY));
    PETSC_CHECK(MatAssemblyEnd(A_, MAT_FINAL_ASSEMBLY));
    PETSC_CHECK(MatAssemblyBegin(shell_, MAT_FINAL_ASSEMBLY));
    PETSC_CHECK(MatAssemblyEnd(shell_, MAT_FINAL_ASSEMBLY));
    PETSC_CHECK(KSPSetOperators(solver_, A_, A_));
}

// ************************************************************************* //
