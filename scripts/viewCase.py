# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""A case in ParaView: surface of the bolus, wall and four fields, in 3D.

    [xvfb-run -a] pvpython scripts/viewCase.py CASE [--time T] [--png FILE] [--state FILE]

Half of the wedge's surface of revolution is shown, so that the fields of the
section are seen inside: sigmaEq, triaxiality, epsilonPEq, D. Each has a view
of its own, with the surface alpha = 0.5 and the wall. Without --time the last
written time; --png saves a picture, --state a .pvsm for ParaView's own window
(File, Load State). Default: CASE/paraview.png and CASE/paraview.pvsm.

Works on wedge meshes about x through the origin, and says so where another one
is given; plane and 3D meshes are shown as they are.
"""

import argparse
import sys
from pathlib import Path

from paraview import simple as pv

# ParaView's Python knows nothing of scripts/environment
sys.path.append(str(Path(__file__).resolve().parents[1] / "validation"))
from bolus_results.locking import FolderBusy, alone_in  # noqa: E402

FIELDS = {
    "sigmaEq": ("Viridis (matplotlib)", (0, 16e3)),
    "triaxiality": ("Cool to Warm", (-3, 3)),
    "epsilonPEq": ("Plasma (matplotlib)", (0, 2)),
    "D": ("Reds", (0, 1)),
}


def arguments():
    """Command line."""
    parser = argparse.ArgumentParser(prog="viewCase.py")
    parser.add_argument("case", type=Path)
    parser.add_argument("--time", type=float)
    parser.add_argument("--png", type=Path)
    parser.add_argument("--state", type=Path)
    options = parser.parse_args()
    if not (options.case / "system" / "controlDict").is_file():
        parser.error(f"{options.case}: not a case (no system/controlDict)")
    options.png = options.png or options.case / "paraview.png"
    options.state = options.state or options.case / "paraview.pvsm"
    return options


def reader(case, regions):
    """An OpenFOAM reader of these mesh regions."""
    source = pv.OpenFOAMReader(FileName=str(case / "case.foam"))
    source.MeshRegions = regions
    source.UpdatePipelineInformation()
    return source


def section(source):
    """The cut of a mesh with the plane z = 0."""
    cut = pv.Slice(Input=pv.CellDatatoPointData(Input=source))
    cut.SliceType = "Plane"
    cut.SliceType.Origin = [0, 0, 0]
    cut.SliceType.Normal = [0, 0, 1]
    return cut


def about_x(bounds):
    """Is a wedge with these bounds (x, x, y, y, z, z) about x, its radius y?"""
    low, high = bounds[2:4]
    slack = 1e-6 * (high - low)
    thin = bounds[5] - bounds[4] < 0.3 * (high - low)
    return thin and low > -slack and abs(bounds[4] + bounds[5]) < slack


def revolved(source):
    """A line in the plane z = 0 turned half about the x axis."""
    # The filter turns about z
    turned = pv.Transform(Input=source)
    turned.Transform.Rotate = [0, -90, 0]
    swept = pv.RotationalExtrusion(Input=pv.ExtractSurface(Input=turned))
    swept.Angle, swept.Resolution, swept.Capping = 180, 60, 0
    back = pv.Transform(Input=swept)
    back.Transform.Rotate = [0, 90, 0]
    return back


def show(options):
    """Build the four views, save picture and state."""
    (options.case / "case.foam").touch()
    inside = reader(options.case, ["internalMesh"])
    times = list(inside.TimestepValues)
    if not times:
        sys.exit(f"viewCase.py: {options.case}: no written times")
    time = times[-1] if options.time is None else options.time
    if not any(abs(t - time) < 1e-6 for t in times):
        sys.exit(
            f"viewCase.py: time {time:g} is not written; there are "
            + " ".join(f"{t:g}" for t in times)
        )
    pv.GetAnimationScene().AnimationTime = time
    inside.UpdatePipeline(time)
    names = set(inside.CellData.keys())
    if "alpha" not in names:
        sys.exit(f"viewCase.py: no field alpha at time {time:g}")
    wedge = any("wedge" in region for region in inside.MeshRegions.Available)

    if wedge:
        bounds = inside.GetDataInformation().GetBounds()
        about_x(bounds) or sys.exit(
            f"viewCase.py: {options.case}: the wedge is not about x through "
            "the origin, in the middle of z; turn or move a copy of the case "
            "there (transformPoints) to see it"
        )

    flat = section(inside)
    bolus = pv.Clip(Input=flat)
    bolus.ClipType = "Scalar"
    bolus.Scalars, bolus.Value, bolus.Invert = ["POINTS", "alpha"], 0.5, 0
    edge = pv.Contour(Input=flat)
    edge.ContourBy, edge.Isosurfaces = ["POINTS", "alpha"], [0.5]
    walls = section(reader(options.case, ["group/wall"]))
    if wedge:
        edge, walls = revolved(edge), revolved(walls)

    layout = pv.CreateLayout("bolusFoam")
    views = []
    for name, (colours, limits) in FIELDS.items():
        view = pv.CreateRenderView()
        view.ViewSize, view.ViewTime = [800, 500], time
        view.Background = [1, 1, 1]
        view.UseColorPaletteForBackground = 0
        view.OrientationAxesVisibility = 0
        pv.AssignViewToLayout(view, layout, len(views))
        views.append(view)
        for source, colour, opacity in (
            (edge, [0.75, 0.6, 0.4], 0.35),
            (walls, [0.42, 0.24, 0.18], 0.15),
        ):
            shown = pv.Show(source, view)
            pv.ColorBy(shown, None)
            shown.DiffuseColor, shown.Opacity = colour, opacity
        if name in names:
            shown = pv.Show(bolus, view)
            pv.ColorBy(shown, ("POINTS", name))
            table = pv.GetColorTransferFunction(name)
            table.ApplyPreset(colours, True)
            table.RescaleTransferFunction(*limits)
            if name == "D":
                table.InvertTransferFunction()
            shown.SetScalarBarVisibility(view, True)
            bar = pv.GetScalarBar(table, view)
            bar.TitleColor = bar.LabelColor = [0, 0, 0]
        pv.ResetCamera(view)
        view.CameraPosition = [view.CameraFocalPoint[0], 0.05, 0.12]
        view.CameraViewUp = [0, 1, 0]
        pv.ResetCamera(view)
    pv.SaveState(str(options.state))
    pv.SaveScreenshot(
        str(options.png), layout, ImageResolution=[1600, 1000]
    )
    print(options.png)
    print(options.state)


def main():
    """Alone in the case's folder, where case.foam is made too."""
    options = arguments()
    try:
        with alone_in(options.case):
            show(options)
    except FolderBusy as error:
        sys.exit(f"viewCase.py: {error}")


if __name__ == "__main__":
    main()
