// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "linearOptions.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::linearOptions::linearOptions(const dictionary& dict, entryReader& read) :
    slabs_(0, 0)
{
    const label subdomains = read.wholeNumber(
        "subdomains", "of schwarz, on each processor", {1, true, 1e4, true}, 6
    );
    const wordList axes({"x", "y", "z", "none"});
    const label axis = axes.find(read.choice(
        "subdomainAxis",
        "along which the subdomains of schwarz lie",
        axes,
        "none"
    ));
    if (axis < 3) slabs_ = schwarzSlabs(subdomains, axis);
    tolerance_ = read.number(
        "linearTolerance",
        "largest relative residual of the linear solver [-]",
        {0, false, 0.1, true},
        1e-3
    );
    read.has("linearSolver");
    read.has("petscOptions");

    string options("-bolus_snes_type newtonls -bolus_snes_linesearch_type bt ");
    const word solver(dict.lookupOrDefault<word>("linearSolver", "direct"));
    if (solver == "direct")
    {
        // Approximate minimum fill: with METIS the fastest of MUMPS's
        // orderings for 55,000 unknowns in the plane on two ranks (a fifth
        // less than quasi-dense minimum degree); on one rank 9 % less for
        // 14,000, the same for 4,000
        options += "-bolus_velocity_ksp_type preonly -bolus_velocity_pc_type lu"
                   " -bolus_velocity_pc_factor_mat_solver_type mumps"
                   " -bolus_velocity_mat_mumps_icntl_14 80"
                   " -bolus_velocity_mat_mumps_icntl_7 2"
                   // The rows are scaled: MUMPS need not look for scales
                   " -bolus_velocity_mat_mumps_icntl_8 0 ";
    }
    else if (solver == "schwarz")
    {
        // Preconditioned from the right: judged by the residual itself. The
        // subdomains are partitioned by PTScotch, where PETSc has it; what is
        // of low rank to 1e-3 in their factors is taken so.
        options += "-bolus_velocity_ksp_type gmres"
                   " -bolus_velocity_ksp_pc_side right"
                   " -bolus_velocity_ksp_gmres_restart 100"
                   " -bolus_velocity_ksp_gmres_cgs_refinement_type"
                   " refine_ifneeded"
                   " -bolus_velocity_ksp_max_it 500"
                   " -bolus_velocity_pc_type asm"
                   " -bolus_velocity_pc_asm_overlap 1"
                   " -bolus_velocity_pc_asm_blocks "
            + Foam::name(subdomains * Pstream::nProcs())
            + " -bolus_velocity_sub_pc_type lu"
              " -bolus_velocity_sub_pc_factor_mat_solver_type mumps"
              " -bolus_velocity_sub_mat_mumps_icntl_14 80"
              // PORD: in 3D with 200,000 rows a third of the time of QAMD, with
              // 390,000 as fast
              " -bolus_velocity_sub_mat_mumps_icntl_7 4"
              " -bolus_velocity_sub_mat_mumps_icntl_8 0"
              " -bolus_velocity_sub_mat_mumps_icntl_35 2"
              " -bolus_velocity_sub_mat_mumps_cntl_7 1e-3 ";
    }
    else
    {
        FatalIOErrorInFunction(dict)
            << "entry linearSolver: " << solver
            << "; valid are direct (small and plane meshes) and schwarz"
            << " (large three-dimensional ones)" << exit(FatalIOError);
    }
    options += dict.lookupOrDefault<string>("petscOptions", "");
    petscCheck(
        PetscOptionsInsertString(nullptr, options.c_str()), "petscOptions"
    );
}

// ************************************************************************* //
