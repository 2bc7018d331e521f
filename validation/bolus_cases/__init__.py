# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Writes and runs cases.

synthetic   files, fields and blockMesh meshes of small cases; the runner
specimens   the compression tutorial, and blocks of bolus in a box
mapped      blocks whose points are moved to where a function says
cutting     mesh and initial field of the cutting tutorials; tool_surface: of
            a tool that is given as a surface
"""
