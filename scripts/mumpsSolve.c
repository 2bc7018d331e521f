/* SPDX-License-Identifier: GPL-3.0-or-later
 * Copyright (C) 2026 the bolusFoam developers
 *
 * A linear system like those of bolusFoam in two dimensions - a grid of n x n
 * nodes, three unknowns a node, each coupled with all of the eight neighbours,
 * not symmetric - solved by PETSc with the LU factorisation of MUMPS.
 *
 * scripts/setup runs it to see that PETSc, MUMPS and MPI fit together;
 * scripts/blasBenchmark takes the time.
 *
 *     mpirun -np 2 mumpsSolve -n 100
 *
 * It prints the number of unknowns, the seconds for the factorisation (the
 * smallest of three) and the relative residual; the exit code is 0 if that is
 * below 1e-10.
 */

#include <petscksp.h>

#if defined(PETSC_USE_COMPLEX)
#error "PETSc is built for complex numbers: bolusFoam needs the real one"
#endif

/* Any smooth number between -1 and 1 will do, the same on all machines */
static PetscReal coefficient(PetscInt row, PetscInt column)
{
    return PetscSinReal(1.3*(PetscReal)(row % 1013) + 0.7*(column % 1019));
}


static PetscErrorCode assemble(MPI_Comm comm, PetscInt n, Mat* A)
{
    PetscInt first, last;

    PetscFunctionBeginUser;
    PetscCall
    (
        MatCreateAIJ
        (
            comm, PETSC_DECIDE, PETSC_DECIDE, 3*n*n, 3*n*n,
            27, NULL, 27, NULL, A
        )
    );
    PetscCall(MatGetOwnershipRange(*A, &first, &last));

    for (PetscInt row = first; row < last; ++row)
    {
        const PetscInt i = row/3 % n, j = row/3/n;

        for (PetscInt jj = j - 1; jj <= j + 1; ++jj)
        {
            for (PetscInt ii = i - 1; ii <= i + 1; ++ii)
            {
                if (ii < 0 || jj < 0 || ii >= n || jj >= n) continue;

                for (PetscInt k = 0; k < 3; ++k)
                {
                    const PetscInt column = 3*(n*jj + ii) + k;
                    const PetscReal a =
                        row == column ? 20 : coefficient(row, column);
                    PetscCall(MatSetValue(*A, row, column, a, INSERT_VALUES));
                }
            }
        }
    }

    PetscCall(MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
    PetscFunctionReturn(0);
}


int main(int argc, char** argv)
{
    PetscInt n = 30;
    PetscReal bNorm, rNorm;
    double best = 1e30;
    Mat A;
    Vec x, b, r;

    PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
    PetscCall(PetscOptionsGetInt(NULL, NULL, "-n", &n, NULL));

    PetscCall(assemble(PETSC_COMM_WORLD, n, &A));
    PetscCall(MatCreateVecs(A, &x, &b));
    PetscCall(VecDuplicate(b, &r));
    PetscCall(VecSet(b, 1));

    for (int repeat = 0; repeat < 3; ++repeat)
    {
        KSP ksp;
        PC pc;

        PetscCall(KSPCreate(PETSC_COMM_WORLD, &ksp));
        PetscCall(KSPSetOperators(ksp, A, A));
        PetscCall(KSPSetType(ksp, KSPPREONLY));
        PetscCall(KSPGetPC(ksp, &pc));
        PetscCall(PCSetType(pc, PCLU));
        PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));

        const double start = MPI_Wtime();
        PetscCall(KSPSetUp(ksp));
        const double time = MPI_Wtime() - start;
        best = time < best ? time : best;

        PetscCall(KSPSolve(ksp, b, x));
        PetscCall(KSPDestroy(&ksp));
    }

    PetscCall(MatMult(A, x, r));
    PetscCall(VecAXPY(r, -1, b));
    PetscCall(VecNorm(r, NORM_2, &rNorm));
    PetscCall(VecNorm(b, NORM_2, &bNorm));
    PetscCall
    (
        PetscPrintf
        (
            PETSC_COMM_WORLD, "%d unknowns %.4f s residual %.1e\n",
            (int)(3*n*n), best, (double)(rNorm/bNorm)
        )
    );

    PetscCall(MatDestroy(&A));
    PetscCall(VecDestroy(&x));
    PetscCall(VecDestroy(&b));
    PetscCall(VecDestroy(&r));
    PetscCall(PetscFinalize());
    return rNorm < 1e-10*bNorm ? 0 : 1;
}
