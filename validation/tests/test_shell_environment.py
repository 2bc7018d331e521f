# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Allrun and scripts/ do the same whatever the user's shell, locale, folders.

The solver of these cases only makes folders of times.
"""

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import pytest
import shell_case
from shell_case import ROOT, run, run_case

# It is what caseFunctions calls bolusFoam, so that its times are judged
JUDGED = shell_case.ALLRUN.replace(
    "solve ./solver", "bolusFoam() { ./solver; }\nsolve bolusFoam"
)


@pytest.fixture(scope="module")
def german(tmp_path_factory):
    """An environment with decimal commas."""
    folder = tmp_path_factory.mktemp("locale")
    made = folder / "de_DE.UTF-8"
    try:
        subprocess.run(
            ["localedef", "-i", "de_DE", "-f", "UTF-8", made],
            capture_output=True,
        )
    except FileNotFoundError:
        pass
    found = {"LOCPATH": str(folder), "LC_ALL": "de_DE.UTF-8"}
    said = run("bash", "-c", "printf %.1f 0", env=found, ok=None)
    if said != "0,0":
        pytest.skip("NO LOCALE de_DE.UTF-8: localedef could not make it")
    return found


# --- locales and times -------------------------------------


@pytest.mark.parametrize(
    "times",
    [
        "0 5e-05 0.1",
        "-1 -0.5 -0.25",
        "-1 -5e-05 -1e-05",
        "-1 -0.5 0",
        "5 9.5 10",
    ],
)
@pytest.mark.parametrize("by_itself", [False, True])
def test_a_run_goes_on_from_its_last_complete_time(
    tmp_path, german, times, by_itself
):
    *complete, last = times.split()
    case = shell_case.make(tmp_path / "case", times=("20",), allrun=JUDGED)
    folder = tmp_path / "run"
    run_case(case, "-out", folder)
    for name in ("0", "20"):
        shutil.rmtree(folder / name)
    for name in (*complete, last):
        (folder / name / "uniform").mkdir(parents=True)
        if name != last:
            (folder / name / "uniform" / "complete").touch()
    # The start has no mark: it is nobody's to judge
    (folder / complete[0] / "uniform" / "complete").unlink()

    if by_itself:
        line = f"source {ROOT}/scripts/environment && {folder}/Allrun"
        run("bash", "-c", line, env=german | {"BOLUSFOAM_CONTINUE": "yes"})
    else:
        run_case(case, "-out", folder, "-continue", env=german)
    assert [p.name for p in (folder / "incomplete").rglob("*[0-9]")] == [last]
    for name in complete:
        assert (folder / name).is_dir()


@pytest.mark.parametrize("start", ["0", "-1", "5"])
def test_the_start_of_a_run_is_not_set_aside(tmp_path, start):
    case = shell_case.make(tmp_path / "case", times=("20",), allrun=JUDGED)
    folder = tmp_path / "run"
    run_case(case, "-out", folder)
    shutil.rmtree(folder / "20")
    os.rename(folder / "0", folder / start)
    run_case(case, "-out", folder, "-continue")
    assert (folder / start).is_dir()
    assert not (folder / "incomplete").exists()


def test_a_run_may_start_before_zero(tmp_path, german):
    case = shell_case.make(tmp_path / "case", times=("-0.25", "0"))
    control = "system/controlDict"
    options = ("-set", f"{control}:startTime=-0.5", "-set", "endTime=0")
    folder = tmp_path / "run"
    run_case(case, "-out", folder, *options, env=german)
    assert (folder / "-0.5" / "U").is_file()
    said = run_case(case, "-out", folder, "-continue", env=german)
    assert "nothing left to do: the run is at its endTime, 0 s" in said


def test_a_copy_has_the_case_and_not_its_results(tmp_path):
    case = shell_case.make(tmp_path / "case", allrun="#!/bin/sh\n")
    shutil.rmtree(case / "0.orig")
    results = ("-0.5", "0", "0.5", "1e-05", "-1e-05", "10", "processor0")
    mine = ("-1", "3rdLaw", "2.stl", "0.orig.bak")
    for name in (*results, *mine):
        (case / name).mkdir()
    (case / "1.5").touch()  # a file is no time
    run_case(case, "-out", tmp_path / "run")
    copied = {path.name for path in (tmp_path / "run").iterdir()}
    assert copied >= {*mine, "1.5"}
    assert not copied & set(results)


# --- the user's shell --------------------------------------


ODD = {
    "CDPATH": "/tmp:/",
    "BASH_FUNC_cd%%": '() { builtin cd "$@" && ls; }',
    "BASH_FUNC_sed%%": "() { echo sed; }",
    "BASH_FUNC_grep%%": '() { command grep -n --color=always "$@"; }',
    "BASH_FUNC_make%%": "() { false; }",
    "SHELLOPTS": "noclobber:noglob:keyword",
    "BASHOPTS": "nullglob:failglob:nocasematch:dotglob:lastpipe",
    "POSIXLY_CORRECT": "1",
    "GLOBIGNORE": "*",
    "IFS": "/",
    "TAPE": "/nowhere",
    "TAR_OPTIONS": "--exclude=system",
    "GREP_OPTIONS": "-v",
    "MAKEFLAGS": "-n",
    "MAKEFILES": "/nowhere",
    "PYTHONHOME": "/nowhere",
    "PYTHONWARNINGS": "error",
    "PYTHONINSPECT": "1",
    "PYTHONSAFEPATH": "1",
    "PYTHONOPTIMIZE": "2",
    "LANGUAGE": "de",
}


@pytest.mark.parametrize("how", ["./Allrun", "bash Allrun"])
def test_what_the_user_exports_changes_nothing(tmp_path, german, how):
    shadow = tmp_path / "shadow" / "numpy.py"
    shadow.parent.mkdir()
    shadow.write_text("raise SystemExit('not mine')")
    # A folder of scripts that CDPATH would find first
    (tmp_path / "scripts").mkdir()
    spaced = tmp_path / "a b"
    spaced.mkdir()
    case = shell_case.make(
        tmp_path / "case",
        allrun=shell_case.ALLRUN + "python -c 'import numpy'\n",
    )
    environment = german | {
        **ODD,
        "CDPATH": str(tmp_path),
        "PYTHONPATH": str(shadow.parent),
        "TMPDIR": str(spaced),
    }
    words = ("run", case, "-out", tmp_path / "run", "-set", "endTime=2")
    said = run(*how.split(), *words, env=environment)
    assert "run: done" in said
    assert (tmp_path / "run" / "1").is_dir()
    # Nothing to compile: make -n would have left that undone in silence
    assert "solver, output in log.solver" in said
    run(*how.split(), "validate", env=environment)


def test_the_environment_is_read_whatever_the_users_shell_has(tmp_path):
    (tmp_path / "scripts").mkdir()
    script = f"""
        shopt -s expand_aliases
        alias grep='grep -n' sed='sed s/a/b/' tr='tr a b'
        cd() {{ builtin cd "$@" && ls; }}
        export CDPATH={tmp_path}
        source scripts/environment
        echo "$BOLUSFOAM_DIR|$CDPATH|$BOLUSFOAM_PETSC_LIBS"
    """
    plain = run(
        "bash", "-c", "source scripts/environment; echo $BOLUSFOAM_PETSC_LIBS"
    )
    said = run("bash", "-c", script).strip().split("|")
    assert said[:2] == [str(ROOT), str(tmp_path)]
    assert said[2].split() == plain.split()
    assert "-lpetsc" in plain


# --- paths -------------------------------------------------


SMALL = (
    *("-set", "nAxial=4", "-set", "nRadial=8", "-set", "strain=0.02"),
    *("-set", "unloadStrain=0", "-set", "strainStep=0.01"),
)
BAD = {
    "a b": "a space",
    "a'b": "an apostrophe",
    'a"b': "a quotation mark",
    "a\tb": "white space",
    "a\nb": "white space",
    "a\\b": "a backslash",
}


@pytest.mark.parametrize("name", BAD)
def test_a_path_that_openfoam_cannot_read_is_refused_first(tmp_path, name):
    case = shell_case.make(tmp_path / "case")
    out = tmp_path / "x" / name
    said = run_case(case, "-out", out, ok=False)
    assert BAD[name] in said and "-out" in said
    assert [path.name for path in tmp_path.iterdir()] == ["case"]
    # By default the copy has the name of its case
    odd = shell_case.make(tmp_path / name)
    said = run_case(odd, ok=False)
    assert BAD[name] in said and "-out" in said
    # And with a name it runs: nothing is computed in the case's own folder
    run_case(odd, "-out", tmp_path / "run")
    assert (tmp_path / "run" / "1").is_dir()


@pytest.mark.parametrize("name", BAD)
def test_calibrate_refuses_such_a_path_first(tmp_path, name):
    data = tmp_path / "x.csv"
    data.write_text("# rate: 0.1 1/s\nstrain [-], stress [kPa]\n")
    out = tmp_path / name
    said = run(ROOT / "scripts" / "calibrate", data, "-out", out, ok=False)
    assert repr(name.strip("ab")) in said and "-out" in said
    assert not out.exists()


def test_a_report_is_written_to_any_path(tmp_path):
    run_case("rheology/compression", *SMALL, "-out", tmp_path / "run")
    spoilt = tmp_path / "a b's"
    os.rename(tmp_path / "run", spoilt)
    run(ROOT / "scripts" / "report", spoilt, "-out", tmp_path / "p 'q")
    text = (tmp_path / "p 'q" / "page.html").read_text()
    assert "(not readable)" not in text and "elasticity.E" in text


def test_any_other_path_runs_as_it_is(tmp_path):
    case = shell_case.make(tmp_path / "case")
    for name in ("é€", "a&b|c", "$HOME`x`", "(a){b}[c]*?", "#;<>!~%^", "-n"):
        out = tmp_path / name
        said = run_case(case, "-out", out)
        assert f"the results are in {out}\n" in said
        assert (out / "1").is_dir()


@pytest.mark.parametrize("name", ["a b", "a'b", "a$b", "a:b", "a#b", "a(b"])
def test_a_clone_in_a_path_that_wmake_cannot_do_is_refused(tmp_path, name):
    ours = shell_case.clone(tmp_path / name)
    for command in ("build", "run gastric/caseA", "test"):
        said = run(ours / "Allrun", *command.split(), ok=False)
        assert "the path of this clone" in said
        assert len(said.strip().split("\n")) == 2
    assert not (ours / "run").exists()


# --- an installation of somebody else ----------------------


READ_ONLY = """
mount --bind "$0" "$0" && mount -o remount,ro,bind "$0" "$0" && exec "$@"
"""


@pytest.fixture(params=["another user", "a read-only disk"])
def stranger(request):
    """(words before a command of who may not write here, a folder of theirs)"""
    folder = Path(tempfile.mkdtemp())
    if os.getuid() == 0:
        os.chown(folder, 65534, 65534)
    if request.param == "another user":
        who = ("setpriv", "--reuid=65534", "--regid=65534", "--clear-groups")
    else:
        who = ("unshare", "-m", "bash", "-c", READ_ONLY, str(ROOT))
    may = f"test -x {ROOT}/Allrun -a -w {folder} -a ! -w {ROOT} && echo yes"
    tried = run("sh", "-c", '"$@" || :', "sh", *who, "sh", "-c", may)
    if tried != "yes\n":
        shutil.rmtree(folder)
        pytest.skip(f"NOT TRIED as {request.param}: that takes root's rights")
    yield who, folder
    shutil.rmtree(folder)


def test_an_installation_of_root_runs_for_others(stranger, tmp_path):
    user, theirs = stranger
    case = shell_case.make(theirs / "case")
    for path in theirs.rglob("*"):
        os.chown(path, 65534, 65534)
    home = {"HOME": str(theirs)}
    said = run(*user, ROOT / "Allrun", "run", "case", cwd=theirs, env=home)
    assert "the results are in" in said
    assert "ermission" not in said
    assert (theirs / "bolusFoamRun" / "case" / "1").is_dir()
    said = run(
        *user, ROOT / "Allrun", "run", case, "-continue", cwd=theirs, env=home
    )
    assert "nothing left to do" in said


def test_what_others_would_have_to_build_is_told_with_its_owner(tmp_path):
    if os.getuid() != 0 or shutil.which("setpriv") is None:
        pytest.skip("NOT TRIED as another user: that takes root's rights")
    folder = Path(tempfile.mkdtemp())
    folder.chmod(0o755)
    ours = shell_case.clone(folder / "clone")
    user = ("setpriv", "--reuid=65534", "--regid=65534", "--clear-groups")
    for script in ("setup", "build"):
        said = run(*user, ours / "scripts" / script, ok=False)
        assert "belongs to root" in said and "nobody" in said
        assert "./Allrun build" in said
        assert "Permission denied" not in said
    shutil.rmtree(folder)


# --- which OpenFOAM ----------------------------------------


@pytest.mark.parametrize(
    "version,api,refused",
    [
        ("com", "api=2412\npatch=0\n", None),
        ("v2312", None, None),
        ("my-own", "api=1912\n", None),
        ("com", "api=1906\n", "too old"),
        ("11", None, "not an ESI version"),
        ("dev", None, "not an ESI version"),
    ],
)
def test_an_openfoam_is_known_by_its_interface_not_its_name(
    tmp_path, version, api, refused
):
    (tmp_path / "wmake").mkdir()
    wmake = tmp_path / "wmake" / "wmake"
    wmake.write_text("#!/bin/sh\n")
    wmake.chmod(0o755)
    if api:
        (tmp_path / "META-INFO").mkdir()
        (tmp_path / "META-INFO" / "api-info").write_text(api)
    said = subprocess.run(
        ["bash", "-c", ". scripts/environment && echo $BOLUSFOAM_OPENFOAM"],
        cwd=ROOT,
        env=os.environ
        | {
            "WM_PROJECT_DIR": str(tmp_path),
            "WM_PROJECT_VERSION": version,
            # Of one that was sourced before
            "FOAM_API": "1912",
            "PATH": f"{tmp_path / 'wmake'}:{os.environ['PATH']}",
        },
        capture_output=True,
        text=True,
    )
    if refused:
        assert refused in said.stderr
        assert said.returncode != 0
    else:
        assert said.stdout.split() == ["sourced"], said.stderr
