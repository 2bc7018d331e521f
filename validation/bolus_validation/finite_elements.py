# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""The first part of the cylinder test by CalculiX, a finite-element program.

A Lagrangian calculation that shares nothing with ours but the question: plane
strain, eight-node elements with reduced integration, finite strains, J2
plasticity with one flow stress at all rates, face-to-face contact with Coulomb
friction on a rigid cylinder; the block sticks to the platen. Its mesh goes with
the bolus, so that it ends where that gets too distorted.

Needs the program ccx (Debian: calculix-ccx). Lengths in mm, stresses in MPa,
forces in N per mm of thickness.
"""

import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class Block:
    """A block below a cylinder [mm, MPa]."""

    width: float
    height: float
    diameter: float
    E: float
    nu: float
    flow_stress: float
    mu: float
    travel: float
    size: float  # of the elements at the tool
    # Of the contact [E / size]. With 30 it gives way: the force is 1 % less
    # at 0.1 to 0.3 mm, and CalculiX stops at 0.6 mm
    stiffness: float = 300.0


def program() -> str | None:
    """Where CalculiX is."""
    return shutil.which("ccx") or shutil.which("ccx_2.20")


def graded(length: float, first: float, growth: float = 1.06) -> np.ndarray:
    """Places (n + 1,) from 0 to length in steps that grow."""
    steps = [first]
    while sum(steps) < length:
        steps.append(steps[-1] * growth)
    places = np.cumsum([0.0, *steps])
    return places * (length / places[-1])


class _Grid:
    """Nodes and eight-node elements of a mapped grid of n by m cells."""

    def __init__(self, x: np.ndarray, first_node: int, first_element: int):
        """x: places (2n + 1, 2m + 1, 2) of corners and middles."""
        n, m = x.shape[0] // 2, x.shape[1] // 2
        i, j = np.indices(x.shape[:2])
        there = (i % 2 == 0) | (j % 2 == 0)
        self.number = np.full(x.shape[:2], -1)
        self.number[there] = first_node + np.arange(there.sum())
        self.x = x
        self.there = there
        corners = [(0, 0), (2, 0), (2, 2), (0, 2)]
        middles = [(1, 0), (2, 1), (1, 2), (0, 1)]
        self.elements = np.array(
            [
                [
                    self.number[2 * a + k, 2 * b + h]
                    for k, h in corners + middles
                ]
                for a in range(n)
                for b in range(m)
            ]
        )
        self.element = first_element + np.arange(n * m).reshape(n, m)

    def nodes(self) -> str:
        """Lines of *NODE."""
        return "".join(
            f"{k}, {x[0]:.10g}, {x[1]:.10g}, 0.\n"
            for k, x in zip(
                self.number[self.there], self.x[self.there], strict=True
            )
        )

    def lines(self) -> str:
        """Lines of *ELEMENT."""
        return "".join(
            f"{k}, {', '.join(map(str, row))}\n"
            for k, row in zip(self.element.ravel(), self.elements, strict=True)
        )


def _between(places: np.ndarray) -> np.ndarray:
    """With the middles."""
    all_places = np.empty(2 * len(places) - 1)
    all_places[::2] = places
    all_places[1::2] = 0.5 * (places[1:] + places[:-1])
    return all_places


def _set(name: str, numbers) -> str:
    return f"*NSET, NSET={name}\n" + "".join(
        f"{n},\n" for n in np.asarray(numbers).ravel() if n > 0
    )


def deck(b: Block) -> str:
    """The input of CalculiX."""
    x = _between(graded(0.5 * b.width, b.size))
    y = _between(b.height - graded(b.height, b.size)[::-1])
    block = _Grid(np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1), 1, 1)

    # A quarter of a ring: its nodes are all prescribed
    radius = 0.5 * b.diameter
    angle = np.linspace(
        -0.5 * np.pi, 0, 2 * int(np.ceil(0.5 * np.pi * radius / b.size)) + 1
    )
    depth = radius - np.array([0, 0.5, 1]) * 0.1 * radius
    ring = (
        depth[None, :, None]
        * np.stack([np.cos(angle), np.sin(angle)], axis=-1)[:, None, :]
    )
    ring[..., 1] += b.height + radius
    tool = _Grid(ring, block.number.max() + 1, block.element.max() + 1)

    # The part of the block's top that the tool may reach
    near = block.element[x[::2][:-1] < 1.5 * b.diameter, -1]
    stiffness = b.stiffness * b.E / b.size
    return (
        "*NODE, NSET=ALL\n"
        + block.nodes()
        + tool.nodes()
        + "*ELEMENT, TYPE=CPE8R, ELSET=BLOCK\n"
        + block.lines()
        + "*ELEMENT, TYPE=CPE8R, ELSET=TOOL\n"
        + tool.lines()
        + _set("MIDDLE", block.number[0])
        + _set("PLATEN", block.number[:, 0])
        + _set("TOOL", tool.number)
        + "*SURFACE, NAME=TOP\n"
        + "".join(f"{e}, S3\n" for e in near)
        + "*SURFACE, NAME=ROUND\n"
        + "".join(f"{e}, S1\n" for e in tool.element[:, 0])
        + "*MATERIAL, NAME=BOLUS\n*ELASTIC\n"
        f"{b.E:.10g}, {b.nu:.10g}\n*PLASTIC\n{b.flow_stress:.10g}, 0.\n"
        "*MATERIAL, NAME=STEEL\n*ELASTIC\n"
        f"{100 * b.E:.10g}, 0.3\n"
        "*SOLID SECTION, ELSET=BLOCK, MATERIAL=BOLUS\n1.\n"
        "*SOLID SECTION, ELSET=TOOL, MATERIAL=STEEL\n1.\n"
        "*SURFACE INTERACTION, NAME=RUB\n"
        "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n"
        f"{stiffness:.10g}\n*FRICTION\n{b.mu:.10g}, {0.2 * stiffness:.10g}\n"
        "*CONTACT PAIR, INTERACTION=RUB, TYPE=SURFACE TO SURFACE\n"
        "TOP, ROUND\n"
        "*BOUNDARY\nMIDDLE, 1, 1\nPLATEN, 1, 2\nTOOL, 1, 1\n"
        "*STEP, NLGEOM, INC=100000\n*STATIC\n"
        f"{0.02 / b.travel:.10g}, 1., 1e-7, {0.05 / b.travel:.10g}\n"
        f"*BOUNDARY\nTOOL, 2, 2, {-b.travel:.10g}\n"
        "*NODE PRINT, NSET=TOOL, TOTALS=ONLY\nRF\n"
        "*NODE FILE, OUTPUT=2D\nU\n"
        "*END STEP\n"
    )


def solve(folder: Path, b: Block) -> tuple[np.ndarray, np.ndarray]:
    """Way of the tool [mm] and its force on both halves [N/mm], both (n,).

    As far as it came: check the last way. Raises FileNotFoundError without
    CalculiX, RuntimeError where it gives no force at all.
    """
    ccx = program()
    if ccx is None:
        raise FileNotFoundError(
            "CalculiX (ccx) is not there; Debian: apt install calculix-ccx"
        )
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "cylinder.inp").write_text(deck(b))
    done = subprocess.run(
        [ccx, "-i", "cylinder"],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    (folder / "log.ccx").write_text(done.stdout + done.stderr)
    data = folder / "cylinder.dat"
    text = data.read_text() if data.exists() else ""
    found = re.findall(
        r"total force.*?for set TOOL and time\s+(\S+)\s+(\S+)\s+(\S+)", text
    )
    if not found:
        raise RuntimeError(f"CalculiX: no force; see {folder / 'log.ccx'}")
    table = np.array(found, dtype=float)
    return b.travel * table[:, 0], -2 * table[:, 2]
