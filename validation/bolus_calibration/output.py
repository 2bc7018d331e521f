# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""What a calibration leaves: dictionary, table, pictures.

bolusProperties.NAME   for any case
calibration.json       numbers, intervals, misfit of each law
calibration.png        data, law, and the solver's material on one cell
"""

import json
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from bolus_results.material_point import read_segments, run_material_point

from bolus_calibration.data import SEGMENTS, Curve
from bolus_calibration.fit import CONFIDENCE, Fit

DICTIONARY = """\
/*--------------------------------*- C++ -*----------------------------------*\\
{head}
\\*---------------------------------------------------------------------------*/
FoamFile
{{
    version     2.0;
    format      ascii;
    class       dictionary;
    object      bolusProperties;
}}
// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

rho             {rho:g};       // [kg/m3]

elasticity
{{
    E               {e:.6g};  // [Pa]
    nu              {nu:g};
}}

flowStress
{{
    type            {type};
{entries}
}}

damage
{{
    type            none;
}}

// ************************************************************************* //
"""


def number_lines(fit: Fit) -> list[str]:
    """Each number with its interval."""
    return [
        f"{name:<16}{value:>12.5g}  [{low:.4g}, {high:.4g}]"
        for name, value, low, high in zip(
            fit.names, fit.values, fit.low, fit.high, strict=True
        )
    ]


def dictionary(fit: Fit, name: str, sources, rho: float, nu: float) -> str:
    """Text of bolusProperties."""
    head = [
        f"{name}: fitted by ./Allrun calibrate to {', '.join(sources)};",
        f"rms misfit {100 * fit.misfit:.1f} %; "
        f"{100 * CONFIDENCE:.0f} % intervals, SI units:",
        *("    " + line for line in number_lines(fit)),
    ]
    entries = "\n".join(
        f"    {line}" if line else ""
        for line in fit.law.entries(fit.parameters[1:])
    )
    return DICTIONARY.format(
        head="\n".join(head),
        rho=rho,
        nu=nu,
        e=fit.values[0],
        type=fit.law.type,
        entries=entries,
    )


def _programme(curve: Curve) -> str:
    """Segments of materialPoint that follow a curve."""
    peak = curve.strain[curve.segment < 2].max()
    if curve.kind == "shear":
        mode, sign, share = "simpleShear", 1, np.sqrt(3)
    else:
        mode, sign, share = "uniaxial", -1, 1.0
    rate = share * curve.rate
    text = (
        f"loading {{ mode {mode}; rate {rate:.9g}; "
        f"strain {sign * share * peak:.9g}; }}\n"
    )
    if curve.has("relaxation"):
        held = curve.time[curve.segment == 1]
        text += f"relaxation {{ mode {mode}; duration {np.ptp(held):.9g}; }}\n"
    if curve.has("unloading"):
        text += f"unloading {{ mode {mode}; rate {rate:.9g}; unload yes; }}\n"
    return text


def rheometer(curves: list[Curve], text: str, folder: Path) -> list:
    """The curves as materialPoint has them: [(strain, stress [Pa]), ...].

    One of each kind and rate, as the same programme gives the same curve;
    None for the others.
    """
    (folder / "rheometer").mkdir(exist_ok=True)
    properties = text[text.index("rho ") :]
    seen, result = set(), []
    for i, curve in enumerate(curves):
        key = (curve.kind, round(4 * np.log(curve.rate)))
        if key in seen:
            result.append(None)
            continue
        seen.add(key)
        done = run_material_point(
            f"bolusProperties\n{{\n{properties}}}\n"
            f"segments\n{{\n{_programme(curve)}}}\n",
            folder / "rheometer",
            f"curve{i}",
        )
        if done.returncode:
            raise RuntimeError(
                "materialPoint refused the fitted material:\n"
                + (done.stderr or done.stdout)
            )
        table = read_segments(folder / "rheometer" / f"curve{i}.dat")
        parts = [table[s] for s in SEGMENTS if s in table]
        if curve.kind == "shear":
            pairs = [
                (p["shearStrain"] / np.sqrt(3), p["shearStress"] * np.sqrt(3))
                for p in parts
            ]
        else:
            pairs = [(-p["axialStrain"], -p["axialStress"]) for p in parts]
        result.append(
            tuple(np.concatenate(x) for x in zip(*pairs, strict=True))
        )
    return result


def rheometer_difference(curves, fit: Fit, tables) -> dict[str, float]:
    """Largest difference of materialPoint to the law while loading, of the
    largest stress [-], by kind of test."""
    result: dict[str, float] = {}
    for curve, law, table in zip(curves, fit.stresses, tables, strict=True):
        if table is None:
            continue
        loading = curve.segment == 0
        peak = int(np.argmax(table[0]))
        other = np.interp(
            curve.strain[loading],
            np.concatenate(([0.0], table[0][: peak + 1])),
            np.concatenate(([0.0], table[1][: peak + 1])),
        )
        error = np.max(np.abs(other - law[loading])) / np.max(law)
        result[curve.kind] = max(result.get(curve.kind, 0.0), float(error))
    return result


def picture(curves: list[Curve], fit: Fit, tables, target: Path) -> None:
    """Stress against strain by kind of test, and relaxation against time."""
    kinds = sorted({c.kind for c in curves})
    held = [i for i, c in enumerate(curves) if c.has("relaxation")]
    count = len(kinds) + bool(held)
    figure, axes = plt.subplots(
        1,
        count,
        figsize=(5.5 * count, 4.5),
        layout="constrained",
        squeeze=False,
    )
    rates = sorted({round(c.rate, 12) for c in curves})
    colour = {
        rate: plt.cm.viridis(0.9 * i / max(1, len(rates) - 1))
        for i, rate in enumerate(rates)
    }
    for axis, kind in zip(axes[0], kinds, strict=False):
        labels = set()
        for curve, law, table in zip(curves, fit.stresses, tables, strict=True):
            if curve.kind != kind:
                continue
            shade = colour[round(curve.rate, 12)]
            label = f"{curve.rate:.3g}/s"
            axis.plot(
                curve.strain,
                curve.stress / 1e3,
                ".",
                markersize=3,
                color=shade,
                label=None if label in labels else label,
            )
            labels.add(label)
            axis.plot(curve.strain, law / 1e3, color=shade)
            if table is not None:
                axis.plot(table[0], table[1] / 1e3, "k:", linewidth=1)
        axis.set(
            title=f"{kind}: data, law (lines), materialPoint (dotted)",
            xlabel="equivalent strain [-]",
            ylabel="equivalent stress [kPa]",
        )
        axis.legend(fontsize=8)
    if held:
        axis = axes[0][-1]
        for i in held:
            curve = curves[i]
            inside = curve.segment == 1
            since = curve.time[inside] - curve.time[inside][0]
            shade = colour[round(curve.rate, 12)]
            axis.plot(
                since,
                curve.stress[inside] / 1e3,
                ".",
                markersize=3,
                color=shade,
            )
            axis.plot(since, fit.stresses[i][inside] / 1e3, color=shade)
        axis.set(
            title="relaxation",
            xlabel="time held [s]",
            ylabel="equivalent stress [kPa]",
            xscale="symlog",
        )
    figure.suptitle(f"{fit.law.type}, rms misfit {100 * fit.misfit:.1f} %")
    figure.savefig(target, dpi=120)
    plt.close(figure)


def write_json(fits: list[Fit], difference, remarks, target: Path) -> None:
    """All laws, the chosen one first."""
    target.write_text(
        json.dumps(
            {
                "confidence": CONFIDENCE,
                "laws": [
                    {
                        "type": fit.law.type,
                        "misfit": fit.misfit,
                        "rowScatter": fit.row_scatter,
                        "specimenScatter": fit.specimen_scatter,
                        "specimenScatterAssumed": fit.scatter_assumed,
                        "numbers": {
                            name: {"value": v, "low": low, "high": high}
                            for name, v, low, high in zip(
                                fit.names,
                                map(float, fit.values),
                                map(float, fit.low),
                                map(float, fit.high),
                                strict=True,
                            )
                        },
                    }
                    for fit in fits
                ],
                "materialPointDifference": difference,
                "remarks": remarks,
            },
            indent=1,
        )
        + "\n"
    )
