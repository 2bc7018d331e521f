# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Damage by a plastic strain that is averaged over a length."""

import numpy as np
import pytest
from bolus_cases.specimens import SLIDING, box, solve
from bolus_cases.synthetic import run, run_parallel, write_field
from bolus_results.fields import Case
from bolus_results.foam_files import FoamFileError

CELL = 1e-4
CELLS = 200
LENGTH = 1e-3  # of the average [m]


def column(case, strain, broken=None, length=LENGTH, np_=1):
    """One step of a column at rest with this plastic strain (n,); returns
    centres [m] and the average [-] (n,)."""
    mesh = box(
        case,
        size=(CELLS * CELL, CELL),
        counts=(CELLS, 1),
        patches={
            "x0": SLIDING,
            "x1": SLIDING,
            "y0": "symmetryPlane",
            "y1": "symmetryPlane",
        },
        end=0.01,
        step=0.01,
        material="viscoplasticDamage",
    )
    with open(case / "constant" / "bolusProperties", "a") as file:
        file.write(f"damage {{ nonlocalLength {length}; }}\n")
    write_field(case, mesh, 0, "epsilonPEq", strain)
    if broken is not None:
        write_field(case, mesh, 0, "D", 1.0 * broken)
    if np_ == 1:
        solve(case)
    else:
        run_parallel(case, "bolusFoam", ranks=np_)
        run(case, "reconstructPar")
    results = Case(case)
    return (
        mesh.cell_centres[:, 0],
        results.field(max(results.times), "nonlocalStrain"),
    )


def peak():
    """Unit strain in the cell after the middle of the column."""
    return np.where(np.arange(CELLS) == CELLS // 2, 1.0, 0.0)


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_peak_spreads_as_the_exact_answer(tmp_path, ranks):
    # exp(-|x|/l)/(2 l), of a source CELL wide; found: 0.0012 of its largest.
    # Three times that catches a length that is off by half a percent
    x, average = column(tmp_path, peak(), np_=ranks)
    exact = CELL / (2 * LENGTH) * np.exp(-abs(x - x[CELLS // 2]) / LENGTH)
    # The ends are ten lengths off
    assert np.max(abs(average - exact)) < 0.004 * exact.max()
    # Nothing is lost, but what the linear solver leaves (1.6e-6)
    assert average.sum() == pytest.approx(1, rel=1e-5)


def test_uniform_strain_stays_also_beside_broken_bolus(tmp_path):
    middle = abs(np.arange(CELLS) - CELLS / 2) < 5
    _, average = column(tmp_path, np.full(CELLS, 0.1), broken=middle)
    assert average[~middle] == pytest.approx(0.1, rel=1e-6)
    assert np.max(average[middle]) < 1e-6


def test_nothing_passes_through_broken_bolus(tmp_path):
    # Broken in the middle, the left half strained
    i = np.arange(CELLS)
    middle = abs(i - CELLS / 2) < 3
    _, average = column(tmp_path, np.where(i < 90, 0.1, 0.0), broken=middle)
    assert np.max(abs(average[i > CELLS / 2 + 3])) < 1e-6


def test_without_a_length_there_is_no_such_field(tmp_path):
    with pytest.raises(FoamFileError):
        column(tmp_path, peak(), length=0)


def test_a_negative_length_is_refused(tmp_path):
    with pytest.raises(AssertionError, match="nonlocalLength"):
        column(tmp_path, peak(), length=-1)
