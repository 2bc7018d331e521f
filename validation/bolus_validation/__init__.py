# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Readers, theory, comparisons and pictures for the cases of bolusFoam.

fields      meshes and cell fields of a case as numpy arrays
results     tables of the function objects; results.json of a run
plots       pictures of a run
report      a run against what the paper reports
"""
