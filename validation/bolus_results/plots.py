# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Pictures of a run.

    python -m bolus_results.plots CASE [CASE ...] [--times T ...] [--out DIR]

writes into CASE/pictures (or DIR), for the first case

    sigmaEq.png triaxiality.png epsilonPEq.png D.png   the bolus, where
                  alpha > 0.5, at the times of results.json, or
                  at ten over the run
    overview.png  alpha and pressure at times spread over the run

and for all the cases together

    curves.png    force and work per bolus mass, mass retained

and, if the first case has the table energyBalance,

    energy.png    where the work of the walls went, and what of it the
                  discretisation took

The pylorus is on the right. Only wedge and plane meshes have pictures of
fields.
"""

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import Normalize

from bolus_results import curves
from bolus_results.fields import Case, NoSection, Section
from bolus_results.foam_files import FoamFileError, stored
from bolus_results.locking import alone_in
from bolus_results.measure import TIME_TOLERANCE, measure_of, spread

MM = 1e3
VOID = "#f4f1ec"
WALL = "#6b3d2e"


@dataclass
class Quantity:
    """How a field is shown."""

    field: str
    label: str
    unit: str
    scale: float
    colours: str
    limits: tuple[float, float] | None  # in the shown unit; None: of the data
    extend: str = "neither"


BOLUS_FIELDS = (
    # The flow stress tops out at 15.2 kPa
    Quantity("sigmaEq", r"$\sigma_{eq}$", "kPa", 1e-3, "viridis", (0, 16)),
    # Red is tension; the confined bolus goes far below the lower end
    Quantity(
        "triaxiality",
        r"triaxiality $\eta = -p/\sigma_{eq}$",
        "-",
        1,
        "RdBu_r",
        (-3, 3),
        "both",
    ),
    Quantity(
        "epsilonPEq",
        r"$\epsilon_{p,eq}$",
        "-",
        1,
        "magma",
        None,
        "max",
    ),
    Quantity("D", "damage D", "-", 1, "Reds", (0, 1)),
)


def _mirrored(section: Section, chosen: np.ndarray):
    """The chosen polygons [mm], and in a wedge mirrored about the axis."""
    upper = [MM * section.polygons[i] for i in np.flatnonzero(chosen)]
    every = upper
    if section.axisymmetric:
        every = upper + [polygon * (1, -1) for polygon in upper]
    # matplotlib is ten times faster with one array than with a list
    if len({len(polygon) for polygon in every}) == 1:
        return np.array(every)
    return every


def paint(axes, section: Section, chosen, values, norm, colours) -> None:
    """Colour cells by values, given per polygon of the section."""
    polygons = _mirrored(section, chosen)
    values = values[chosen]
    values = np.tile(values, len(polygons) // max(values.size, 1))
    axes.add_collection(
        PolyCollection(
            polygons,
            array=values,
            norm=norm,
            cmap=colours,
            # Edges in the cell's own colour close the hairlines between them
            edgecolors="face",
            linewidths=0.2,
        )
    )


def frame(axes, case: Case, time: float) -> None:
    """Lumen, wall, axes in mm, and the time."""
    mesh = case.mesh(time)
    section = mesh.section
    lines = [MM * line for line in mesh.wall_lines()]
    if section.axisymmetric:
        lines += [line * (1, -1) for line in lines]
    every = np.ones(len(section.polygons), dtype=bool)
    axes.add_collection(
        PolyCollection(
            _mirrored(section, every),
            facecolors=VOID,
            edgecolors="none",
            # No hairlines between the cells
            antialiased=False,
        )
    )
    axes.add_collection(LineCollection(lines, colors=WALL, linewidths=1.2))
    axes.set_aspect("equal")
    axes.autoscale()
    axes.set_title(f"t = {time:g} s", fontsize=9)
    axes.tick_params(labelsize=7)


def sheet(case: Case, time: float, rows: int, columns: int):
    """A figure of panels that have the shape of the mesh, and its axes."""
    corners = MM * np.vstack(case.mesh(time).section.polygons)
    wide, high = np.ptp(corners, axis=0)
    if case.mesh(time).axisymmetric:
        high = 2 * corners[:, 1].max()
    width = 3.0
    height = min(max(width * high / wide, 0.8), 2 * width)
    return plt.subplots(
        rows,
        columns,
        figsize=(0.5 + (width + 0.1) * columns, 1.6 + (height + 0.3) * rows),
        sharex=True,
        sharey=True,
        squeeze=False,
        layout="constrained",
    )


def written(case: Case, times, fields) -> list[float]:
    """The written times that stand for those asked for and hold the fields."""
    found = (case.nearest(time, TIME_TOLERANCE) for time in times)
    return [
        time
        for time in dict.fromkeys(found)
        if time is not None and all(case.has(time, name) for name in fields)
    ]


def contour_page(case: Case, quantity: Quantity, target: Path, times) -> bool:
    """One field of the bolus at several times; False if none was written."""
    shown = written(case, times, ("alpha", quantity.field))
    if not shown:
        return False

    # First all the values, for the common colour bar
    cells = {}
    for time in shown:
        section = case.mesh(time).section
        bolus = case.field(time, "alpha")[section.cells] > 0.5
        values = quantity.scale * case.field(time, quantity.field)
        cells[time] = (bolus, values[section.cells])
    limits = quantity.limits
    if limits is None:
        every = np.concatenate(
            [values[bolus] for bolus, values in cells.values()]
        )
        # A few cells in the throat would take all the colours
        top = np.percentile(every, 99) if every.size else 1
        limits = (0, max(float(top), 1e-3))
    norm = Normalize(*limits)

    columns = min(len(shown), 5)
    rows = -(-len(shown) // columns)
    figure, grid = sheet(case, shown[-1], rows, columns)
    for axes in grid.flat[len(shown) :]:
        axes.set_axis_off()
    for axes, time in zip(grid.flat, shown, strict=False):
        frame(axes, case, time)
        bolus, values = cells[time]
        paint(
            axes,
            case.mesh(time).section,
            bolus,
            values,
            norm,
            quantity.colours,
        )
    for axes in grid[-1]:
        axes.set_xlabel("x [mm]", fontsize=8)
    for axes in grid[:, 0]:
        axes.set_ylabel("r [mm]", fontsize=8)
    figure.colorbar(
        ScalarMappable(norm, quantity.colours),
        ax=grid,
        location="bottom",
        fraction=0.03,
        aspect=60,
        extend=quantity.extend,
        label=f"{quantity.label} [{quantity.unit}]",
    )
    figure.suptitle(
        f"{case.path.resolve().name}: {quantity.label} of the bolus",
        fontsize=11,
    )
    figure.savefig(target, dpi=150)
    plt.close(figure)
    return True


def overview(case: Case, target: Path, number: int = 8) -> bool:
    """alpha and pressure at times spread over the run."""
    times = [
        t for t in case.times if all(case.has(t, f) for f in ("alpha", "p"))
    ]
    if not times:
        return False
    times = spread(times, number)

    # kPa; symmetric, so that no pressure is white
    highest = 1e-9
    for time in times:
        bolus = case.field(time, "alpha") > 0.5
        if bolus.any():
            pressure = 1e-3 * np.abs(case.field(time, "p")[bolus])
            highest = max(highest, float(np.percentile(pressure, 98)))
    shown = (
        ("alpha", 1.0, Normalize(0, 1), "Blues", r"$\alpha$ [-]", "neither"),
        (
            "p",
            1e-3,
            Normalize(-highest, highest),
            "PuOr_r",
            "p of the bolus [kPa]",
            "both",
        ),
    )

    # A row of alpha above a row of p, four times to a row
    columns = min(len(times), 4)
    bands = -(-len(times) // columns)
    figure, grid = sheet(case, times[-1], 2 * bands, columns)
    for axes in grid.flat:
        axes.set_axis_off()
    for i, time in enumerate(times):
        section = case.mesh(time).section
        alpha = case.field(time, "alpha")[section.cells]
        for j, (name, scale, norm, colours, *_) in enumerate(shown):
            axes = grid[2 * (i // columns) + j, i % columns]
            axes.set_axis_on()
            frame(axes, case, time)
            # alpha of every cell that holds any; p where there is bolus
            chosen = alpha > (0.01 if name == "alpha" else 0.5)
            values = scale * case.field(time, name)[section.cells]
            paint(axes, section, chosen, values, norm, colours)
    for axes in grid[-1]:
        axes.set_xlabel("x [mm]", fontsize=8)
    for axes in grid[:, 0]:
        axes.set_ylabel("r [mm]", fontsize=8)
    for _, _, norm, colours, label, extend in shown:
        figure.colorbar(
            ScalarMappable(norm, colours),
            ax=grid,
            location="bottom",
            fraction=0.02,
            aspect=60,
            extend=extend,
            label=label,
        )
    figure.suptitle(case.path.resolve().name, fontsize=11)
    figure.savefig(target, dpi=120)
    plt.close(figure)
    return True


def draw(paths, times=(), folder: Path | None = None) -> list[Path]:
    """Draw all pictures; returns those that there was something to draw for.

    times   of the fields [s]; (): see Measure
    """
    first = Case(paths[0])
    times = times or measure_of(first.path).times_of(first)
    folder = Path(folder) if folder else first.path / "pictures"
    folder.mkdir(parents=True, exist_ok=True)

    made = []
    flat = stored(first.path / "constant" / "polyMesh" / "owner") is not None
    try:
        if flat:
            first.mesh(min(first.times, default=0.0)).section  # noqa: B018
    except NoSection:
        flat = False
    if flat:
        for quantity in BOLUS_FIELDS:
            target = folder / f"{quantity.field}.png"
            if contour_page(first, quantity, target, times):
                made.append(target)
        if overview(first, folder / "overview.png"):
            made.append(folder / "overview.png")
    if curves.curves(paths, folder / "curves.png"):
        made.append(folder / "curves.png")
    if curves.energy(paths[0], folder / "energy.png"):
        made.append(folder / "energy.png")
    return made


def main(arguments=None) -> int:
    """Command line."""
    parser = argparse.ArgumentParser(
        prog="plots", description="Draw the pictures of a run."
    )
    parser.add_argument("cases", type=Path, nargs="+", metavar="case")
    parser.add_argument(
        "--times",
        type=float,
        nargs="+",
        default=(),
        metavar="T",
        help="times of the contours [s] (those of results.json)",
    )
    parser.add_argument("--out", type=Path, help="folder (CASE/pictures)")
    options = parser.parse_args(arguments)
    try:
        Case(options.cases[0])
        if options.out:
            options.out.mkdir(parents=True, exist_ok=True)
        with alone_in(options.out or options.cases[0]):
            for path in draw(options.cases, options.times, options.out):
                print(path)
    except (FoamFileError, OSError) as error:
        print(f"plots: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
