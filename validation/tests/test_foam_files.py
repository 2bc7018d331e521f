# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Binary, ASCII and compressed runs are read alike; others are refused."""

import gzip
import shutil

import numpy as np
import pytest
from bolus_cases.synthetic import run, write_control, write_file
from bolus_results import results
from bolus_results.foam_files import (
    FoamFileError,
    read_faces,
    read_field,
    read_list,
)
from bolus_results.measure import Measure
from test_results import broken_bolus


@pytest.fixture(scope="module")
def ascii_run(tmp_path_factory):
    """A run with fields, and books of its last time."""
    case = tmp_path_factory.mktemp("formats") / "ascii"
    broken_bolus(case)
    write_file(
        case / "1" / "uniform" / "bolusBooks",
        "initial 2;\noverfull 3;\nspilled 0.5;\n",
    )
    return case


def collected(case):
    found = results.collect(case, Measure((1.0,)))
    del found["case"]
    return found


def test_a_binary_run_gives_the_same_results(ascii_run, tmp_path):
    binary = tmp_path / "binary"
    shutil.copytree(ascii_run, binary)
    for name in ("fvSchemes", "fvSolution"):
        write_file(binary / "system" / name, "")
    # The digits of the ASCII files: all that a double has
    write_control(binary, writeFormat="binary", writePrecision=17)
    run(binary, "foamFormatConvert", "-constant")
    for name in ("constant/polyMesh/faces", "constant/polyMesh/points", "1/U"):
        data = (binary / name).read_bytes()
        assert b"format      binary" in data, name
    found, expected = collected(binary), collected(ascii_run)
    assert found["times"]["1"]["jetForward"]["value"] == pytest.approx(0.01)
    # foamFormatConvert reads the same digits
    assert found == expected


def test_a_compressed_run_gives_the_same_results(ascii_run, tmp_path):
    packed = tmp_path / "packed"
    shutil.copytree(ascii_run, packed)
    for folder in ("constant/polyMesh", "1", "1/uniform"):
        for path in (packed / folder).iterdir():
            if path.is_file():
                target = path.with_name(path.name + ".gz")
                target.write_bytes(gzip.compress(path.read_bytes()))
                path.unlink()
    found = collected(packed)
    assert found["run"]["overfullSteps"]["value"] == 3
    assert found == collected(ascii_run)


HEAD = (
    b'FoamFile { version 2.0; format binary; class %s; arch "%s"; }\n'
    b"// * * * * * //\n\n"
)


def write_binary(path, cls, body, arch="LSB;label=32;scalar=64"):
    path.write_bytes(HEAD % (cls.encode(), arch.encode()) + body)


@pytest.mark.parametrize("label", [32, 64])
@pytest.mark.parametrize("scalar", [32, 64])
def test_numbers_have_the_size_that_the_header_says(tmp_path, label, scalar):
    arch = f"LSB;label={label};scalar={scalar}"
    path = tmp_path / "f"
    # Of 41 = ")" and 59 = ";" bytes: a bracket ends nothing
    labels = np.array([0x29292929, 7, 0x3B29, 0], f"<i{label // 8}")
    write_binary(path, "labelList", b"4\n(" + labels.tobytes() + b")", arch)
    assert read_list(path, int).tolist() == labels.tolist()
    numbers = np.array([[1.5, -2, 3e-5], [4, 5, 6.25]], f"<f{scalar // 8}")
    body = b"dimensions [0 1 -1 0 0 0 0];\n\ninternalField   nonuniform "
    body += b"List<vector> \n2\n(" + numbers.tobytes() + b")\n;\n"
    body += b"boundaryField { a { type b; value uniform (0 0 0); } }\n"
    write_binary(path, "volVectorField", body, arch)
    assert (read_field(path, 2) == numbers).all()
    starts = np.array([0, 3, 7], f"<i{label // 8}")
    points = np.array([0, 1, 2, 41, 40, 4, 5], f"<i{label // 8}")
    write_binary(
        path,
        "faceCompactList",
        b"3\n(" + starts.tobytes() + b")\n\n7\n(" + points.tobytes() + b")\n",
        arch,
    )
    faces = read_faces(path)
    assert [f.tolist() for f in faces] == [[0, 1, 2], [41, 40, 4, 5]]


def test_uniform_and_empty_binary_lists_are_read(tmp_path):
    path = tmp_path / "f"
    write_binary(path, "volScalarField", b"internalField uniform 2.5;\n")
    assert (read_field(path, 3) == 2.5).all()
    write_binary(path, "labelList", b"\n0\n\n// * * //\n")
    assert read_list(path, int).size == 0


def test_compact_faces_may_be_ascii(tmp_path):
    path = tmp_path / "faces"
    write_file(path, "3(0 3 7)\n7(0 1 2 3 4 5 6)\n", "faceCompactList")
    assert [f.tolist() for f in read_faces(path)] == [[0, 1, 2], [3, 4, 5, 6]]


ONE = np.array([1.0]).tobytes()
SCALARS = b"internalField nonuniform List<scalar> "


@pytest.mark.parametrize(
    ("arch", "body", "says"),
    [
        ("MSB;label=32;scalar=64", b"", "arch 'MSB.*valid are"),
        ("", b"", "arch ''"),
        ("LSB;label=32;scalar=80", b"", "valid are"),
        (None, SCALARS + b"2\n(" + ONE + b");", "cut short"),
        (None, SCALARS + b"1\n(" + ONE[:4] + b");", "cut short"),
        (None, SCALARS + b"1", "not a list"),
        (None, SCALARS + b"1{" + ONE + b"};", "not known"),
        (None, SCALARS + b"2(" + 2 * ONE + b");", "mesh has 1 cells"),
        (None, SCALARS.replace(b"scalar", b"word") + b"1(a);", "no list of"),
        (
            None,
            SCALARS + b"1(" + np.array([np.nan]).tobytes() + b");",
            "1 values are no finite numbers, the first in cell 0",
        ),
    ],
)
def test_a_binary_file_that_cannot_be_read_says_why(tmp_path, arch, body, says):
    path = tmp_path / "f"
    given = {} if arch is None else {"arch": arch}
    write_binary(path, "volScalarField", body, **given)
    with pytest.raises(FoamFileError, match=says) as error:
        read_field(path, 1)
    assert str(path) in str(error.value)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("internalField nonuniform List<scalar> 3(1 2", "cut short"),
        ("internalField nonuniform List<vector> 3((1 2 3) (4 5", "cut short"),
        ("internalField nonuniform List<scalar> 3(1 2 x);", "convert"),
        ("internalField nonuniform List<scalar> 3(1 nan 2);", "in cell 1"),
        ("internalField uniform", "no list of numbers"),
        ("internalField uniform inf;", "3 values are no finite numbers"),
    ],
)
def test_an_ascii_field_that_is_cut_or_spoilt_says_why(tmp_path, text, says):
    write_file(tmp_path / "f", text)
    with pytest.raises(FoamFileError, match=says):
        read_field(tmp_path / "f", 3)


def test_a_compressed_file_that_is_cut_says_so(tmp_path):
    data = gzip.compress(b"3(1 2 3)")
    (tmp_path / "owner.gz").write_bytes(data[:-6])
    with pytest.raises(FoamFileError, match="owner.gz"):
        read_list(tmp_path / "owner", int)
