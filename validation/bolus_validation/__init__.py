# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Theory, the studies, and the paper that they are held against.

studies     runs and collects studies
paper       what the paper reports, and a run against it
rheology    the laws, integrated without the solver; motility: the wall
"""
