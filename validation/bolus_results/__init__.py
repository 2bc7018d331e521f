# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""What a user of any case needs: readers, numbers, pictures, a page of a run.

foam_files      files of OpenFOAM as numbers and text
fields, frame   meshes and cell fields of a case; where its axis is
tables          tables of the function objects
material_point  materialPoint and its tables
measure, state  at what a run is looked; the bolus at one time
results         results.json of a run; summary: a dozen lines of it
plots, curves   pictures of a run: its fields, its tables
page            one HTML page about runs, side by side
html, markdown  pages from templates; tables in pages
locking         a folder for one process at a time
"""
