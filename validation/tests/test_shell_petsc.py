# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""A PETSc that cannot be used is refused before anything is compiled.

The PETScs are made up: a pkg-config file and the headers that say how one was
configured.
"""

import pytest
import shell_case
from shell_case import ROOT, run

OPEN_MPI = "PETSC_HAVE_OMPI_MAJOR_VERSION"


def made_up(folder, version="3.18.5", pc=True, **changes):
    """PETSC_DIR of one like that of Debian, but for changes of petscconf.h:
    macro to value, None where it is not set."""
    macros = {OPEN_MPI: 4, "PETSC_HAVE_MUMPS": 1, "PETSC_USE_REAL_DOUBLE": 1}
    macros |= changes
    include = folder / "include"
    include.mkdir(parents=True)
    (include / "petscconf.h").write_text(
        "".join(f"#define {m} {v}\n" for m, v in macros.items() if v)
    )
    parts = ("MAJOR", "MINOR", "SUBMINOR")
    numbers = zip(parts, version.split("."), strict=True)
    (include / "petscversion.h").write_text(
        "#include <petscconf.h>\n"
        + "".join(f"#define PETSC_VERSION_{n} {v}\n" for n, v in numbers)
    )
    if pc:
        (folder / "lib" / "pkgconfig").mkdir(parents=True)
        (folder / "lib" / "pkgconfig" / "PETSc.pc").write_text(
            "Name: PETSc\nDescription: made up\n"
            f"Version: {version}\nCflags: -I{include}\nLibs: -lpetsc\n"
        )
    return {"PETSC_DIR": str(folder), "PETSC_ARCH": ""}


def usable(environment, ok):
    return run(ROOT / "scripts" / "petscIsUsable", env=environment, ok=ok)


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"version": "3.26.1", OPEN_MPI: None, "PETSC_HAVE_OPENMPI": 1},
        {"version": "4.0.0"},
        # One that does not name its MPI: the trial solve will tell
        {OPEN_MPI: None},
        {"PETSC_USE_COMPLEX": None, "PETSC_HAVE_CXX_COMPLEX": 1},
    ],
)
def test_a_petsc_from_3_18_on_that_fits_is_let_pass(tmp_path, changes):
    assert usable(made_up(tmp_path, **changes), ok=True) == ""


def test_the_petsc_of_this_machine_is_let_pass():
    assert run(ROOT / "scripts" / "petscIsUsable") == ""


REFUSED = {
    "is version 3.17.5": ({"version": "3.17.5"}, "3.18 or newer"),
    "is version 2.99.1": ({"version": "2.99.1"}, "3.18 or newer"),
    "complex numbers": ({"PETSC_USE_COMPLEX": 1}, "--with-scalar-type=real"),
    "precision single": (
        {"PETSC_USE_REAL_DOUBLE": None, "PETSC_USE_REAL_SINGLE": 1},
        "--with-precision=double",
    ),
    "precision __float128": (
        {"PETSC_USE_REAL_DOUBLE": None, "PETSC_USE_REAL___FLOAT128": 1},
        "--with-precision=double",
    ),
    "indices of 64 bits": (
        {"PETSC_USE_64BIT_INDICES": 1},
        "--with-64-bit-indices=0",
    ),
    "no MUMPS": ({"PETSC_HAVE_MUMPS": None}, "--download-mumps"),
    "another MPI: MPICH": (
        {OPEN_MPI: None, "PETSC_HAVE_MPICH_NUMVERSION": 40000300},
        "That of OpenFOAM is Open MPI",
    ),
    "another MPI: none": (
        {OPEN_MPI: None, "PETSC_HAVE_MPIUNI": 1},
        "That of OpenFOAM is Open MPI",
    ),
    "not there: no lib/pkgconfig/PETSc.pc": ({"pc": False}, "PETSC_ARCH"),
}


@pytest.mark.parametrize("found", REFUSED)
def test_one_that_does_not_fit_is_refused_in_one_message(tmp_path, found):
    changes, valid = REFUSED[found]
    said = usable(made_up(tmp_path, **changes), ok=False)
    # What was found, where, what would be valid, what to do
    assert said.startswith(f"petsc: the PETSc in {tmp_path} ")
    assert found in said and valid in said and "unset PETSC_DIR" in said
    assert said.count("petsc: ") == 1


def test_indices_of_64_bits_fit_labels_of_64(tmp_path):
    environment = made_up(tmp_path / "petsc", PETSC_USE_64BIT_INDICES=1)
    assert "64 bits" in usable(environment, ok=False)
    # An OpenFOAM of one's own, whose labels are
    wmake = tmp_path / "wmake"
    wmake.mkdir()
    (wmake / "wmake").write_text("#!/bin/sh\n")
    (wmake / "wmake").chmod(0o755)
    own = {
        "WM_PROJECT_DIR": str(tmp_path),
        "WM_PROJECT_VERSION": "v2312",
        "WM_LABEL_SIZE": "64",
        "WM_MPLIB": "SYSTEMOPENMPI",
        "FOAM_MPI": "sys-openmpi",
    }
    own["PATH"] = f"{wmake}:/usr/bin:/bin"
    assert usable(environment | own, ok=True) == ""
    # And one of another MPI than PETSc and mpicc
    mpich = {"WM_MPLIB": "MPICH", "FOAM_MPI": "mpich-3.3"}
    assert "another MPI" in usable(environment | own | mpich, ok=False)


@pytest.mark.parametrize("script", ["setup", "build"])
def test_setup_and_build_refuse_it_before_they_compile(tmp_path, script):
    ours = shell_case.clone(tmp_path / "clone")
    environment = made_up(tmp_path / "petsc", PETSC_USE_COMPLEX=1)
    run("ln", "-s", ROOT / "src" / "rooms", ours / "src" / "rooms")
    said = run(ours / "scripts" / script, env=environment, ok=False)
    assert "complex numbers" in said
    assert not (ours / ".local" / "log.build").exists()
    assert not (ours / ".local" / "mumpsSolve").exists()
