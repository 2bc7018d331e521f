# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Pictures of what function objects write against time."""

from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt

from bolus_results.results import energy_shares
from bolus_results.tables import optional_table

# Panels: function object, column, factor, label
_CURVES = (
    (
        "contactForce",
        "total_perMass",
        1,
        "force on the wall / bolus mass [N/g]",
    ),
    (
        "externalWork",
        "work_perMass",
        1,
        "work of the wall / bolus mass [mJ/g]",
    ),
    ("retainedMass", "retained", 100, "bolus retained [% of the start]"),
)


def curves(paths, target: Path, labels=None) -> bool:
    """Force, work and retained mass of one or more cases.

    labels: what the legend calls each of them, else the names of their folders.
    """
    if labels is None:
        labels = [Path(path).resolve().name for path in paths]
    figure, panels = plt.subplots(1, 3, figsize=(12, 3.8), layout="constrained")
    drawn = 0
    for path, label in zip(paths, labels, strict=True):
        for axes, (name, column, factor, quantity) in zip(
            panels, _CURVES, strict=True
        ):
            axes.set_xlabel("t [s]")
            axes.set_ylabel(quantity)
            table = optional_table(path, name)
            if table:
                axes.plot(
                    table.time,
                    factor * table[column],
                    linewidth=1.2,
                    label=label,
                )
                drawn += 1
    for axes, tag in zip(panels, "abc", strict=True):
        axes.grid(alpha=0.3)
        axes.set_xlim(left=0)
        axes.set_title(f"({tag})", loc="left", fontsize=10)
    panels[2].set_ylim(bottom=0)
    if len(paths) > 1 and drawn:
        panels[0].legend()
    if drawn:
        figure.savefig(target, dpi=150)
    plt.close(figure)
    return drawn > 0


# Layers of the energy picture, from below: label, columns, colour
_LAYERS = (
    ("elastic, kinetic", ("elastic", "slip", "kinetic"), "#4c72b0"),
    ("plastic", ("plastic",), "#c8b08a"),
    ("friction", ("friction",), "#55a868"),
    ("fracture", ("fracture",), "#c44e52"),
    ("broken bolus's viscosity", ("damagedViscosity",), "#dd8452"),
    ("gas", ("gas",), "#b9b4ab"),
    (
        "time step, transport, outflow",
        ("relaxation", "inertiaLoss", "transport", "outflow"),
        "#8172b3",
    ),
    (
        "stabilisation",
        ("hourglass", "overshoot"),
        "#937860",
    ),
)


def energy(path, target: Path) -> bool:
    """Where the work of the walls went; False without energyBalance."""
    table = optional_table(path, "energyBalance")
    if not table:
        return False
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(10, 4), layout="constrained"
    )
    below = np.zeros_like(table.time)
    for label, columns, colour in _LAYERS:
        above = below + 1e3 * sum(table[column] for column in columns)
        left.fill_between(
            table.time, below, above, color=colour, linewidth=0, label=label
        )
        below = above
    left.plot(
        table.time,
        1e3 * (table["work"] + table["closure"]),
        "k",
        linewidth=1,
        label="work of the walls",
    )
    left.set_ylabel("energy [mJ]")
    left.legend(fontsize=7)

    for name, share in energy_shares(table).items():
        right.plot(table.time, 100 * share, linewidth=1.2, label=name)
    work = np.abs(table["work"] + table["closure"]).max()
    right.plot(
        table.time,
        100 * np.abs(table["residual"]) / (work if work > 0 else 1.0),
        "k:",
        label="residual",
    )
    right.set_ylabel("artificial, of the largest work [%]")
    right.legend(fontsize=7)
    for axes in (left, right):
        axes.set_xlabel("t [s]")
        axes.set_xlim(left=0)
        axes.grid(alpha=0.3)
    figure.suptitle(Path(path).resolve().name, fontsize=11)
    figure.savefig(target, dpi=150)
    plt.close(figure)
    return True


def pieces(path, target: Path) -> bool:
    """Pieces of sound bolus, and the jets, against time."""
    fragments = optional_table(path, "fragments")
    jets = optional_table(path, "jets")
    if not fragments or not jets:
        return False

    figure, (left, right) = plt.subplots(
        1, 2, figsize=(11, 3.6), layout="constrained"
    )
    left.step(fragments.time, fragments["pieces"], "k", label="pieces")
    left.set(xlabel="t [s]", ylabel="pieces of sound bolus [-]")
    masses = left.twinx()
    for i in range(1, 5):
        masses.plot(
            fragments.time, 1e3 * fragments[f"mass{i}"], lw=1, label=f"no. {i}"
        )
    masses.set(ylabel="mass of the largest [g]")
    masses.legend(fontsize=8)
    for column, label in (
        ("back99", "back"),
        ("out99", "out through the pylorus"),
    ):
        right.plot(jets.time, 1e3 * jets[column], lw=0.8, label=label)
    right.set(xlabel="t [s]", ylabel="speed of the fastest hundredth [mm/s]")
    right.legend(fontsize=8)
    figure.savefig(target, dpi=120)
    plt.close(figure)
    return True
