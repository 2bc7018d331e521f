# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""./Allrun calibrate: see bolus_calibration.data for what a file may hold."""

import argparse
import os
import re
import sys
from pathlib import Path

from bolus_results.locking import alone_in

from bolus_calibration import output
from bolus_calibration.data import DataError, read
from bolus_calibration.fit import CONFIDENCE, LAWS, fit_all

ROOT = Path(__file__).parents[2]
COMMON = ROOT / "tutorials" / "common"
# Of the user's own: no part of the repository
INSTALLED = ROOT / "laws"


def arguments(given=None) -> argparse.Namespace:
    """Command line."""
    parser = argparse.ArgumentParser(
        prog="./Allrun calibrate",
        description="Fit the laws of bolusProperties to measured curves of "
        "compression and shear. Columns and units: doc/calibration.md.",
    )
    parser.add_argument("data", nargs="+", type=Path, metavar="DATA.csv")
    parser.add_argument(
        "-law", help=f"{', '.join(LAWS)}; default: that of least misfit"
    )
    parser.add_argument(
        "-name", help="of the material; default: the first file's name"
    )
    parser.add_argument(
        "-out", type=Path, help="folder; default run/calibrate/NAME"
    )
    parser.add_argument(
        "-install",
        action="store_true",
        help="put the law into the folder laws, for -set law=NAME",
    )
    parser.add_argument("-rho", type=float, default=1100, help="[kg/m3]")
    parser.add_argument("-nu", type=float, default=0.49, help="[-]")
    parser.add_argument(
        "-scatter",
        type=float,
        help="of whole specimens [-], if the data do not tell, e.g. 0.07",
    )
    options = parser.parse_args(given)
    options.name = options.name or options.data[0].stem
    if not re.fullmatch(r"[\w-]+", options.name):
        parser.error(
            f"-name {options.name}: letters, digits, _ and - make a name"
        )
    runs = Path(os.environ.get("BOLUSFOAM_RUNS", ROOT / "run"))
    options.out = options.out or runs / "calibrate" / options.name
    unread = re.search(r"[\s'\"\\]", str(options.out.resolve()))
    if unread:
        parser.error(
            f"-out {options.out}: its path has {unread.group()!r} in it, which "
            "OpenFOAM cannot read; name another folder"
        )
    if not options.rho > 0:
        parser.error(f"-rho {options.rho}: it must be positive")
    if not 0 <= options.nu < 0.5:
        parser.error(f"-nu {options.nu}: it must be at least 0, below 0.5")
    if options.scatter is not None and not 0 <= options.scatter < 1:
        parser.error(f"-scatter {options.scatter}: it is a part, 0 to 1")
    return options


def calibrate(options: argparse.Namespace) -> None:
    """Read, fit, write."""
    name = f"bolusProperties.{options.name}"
    for folder in (INSTALLED, COMMON) if options.install else ():
        if (folder / name).exists():
            raise DataError(
                f"-install: there is a {folder / name}; take another -name"
                + (", or remove it" if folder == INSTALLED else "")
            )
    curves = [curve for path in options.data for curve in read(path)]
    remarks = [remark for curve in curves for remark in curve.remarks]
    fits = fit_all(curves, options.law, options.scatter)
    remarks += fit_remarks(curves, fits)
    options.out.mkdir(parents=True, exist_ok=True)
    with alone_in(options.out):
        write(options, curves, fits, remarks)


def fit_remarks(curves: list, fits: list) -> list[str]:
    """What to know of the fits."""
    best = fits[0]
    remarks = []
    if len(fits) == 1:
        remarks.append(
            "one rate and no relaxation: how the stress depends on the rate "
            "is not known; the law written has no rate"
        )
    if best.undetermined:
        remarks.append(
            f"{', '.join(best.undetermined)}: hardly determined by these data; "
            "a relaxation or more rates would tell"
        )
    if best.scatter_assumed:
        remarks.append(
            f"{len(curves)} specimens for {len(best.names)} numbers: the "
            f"scatter of specimens is taken as {best.specimen_scatter:.0%}; "
            "more specimens, or -scatter, would tell"
        )

    return remarks


def write(options, curves: list, fits: list, remarks: list[str]) -> None:
    """Write the law and what is told of it; print it."""
    best = fits[0]
    text = output.dictionary(
        best,
        options.name,
        [p.name for p in options.data],
        options.rho,
        options.nu,
    )
    target = options.out / f"bolusProperties.{options.name}"
    target.write_text(text)
    tables = output.rheometer(curves, text, options.out)
    difference = output.rheometer_difference(curves, best, tables)
    output.picture(curves, best, tables, options.out / "calibration.png")
    output.write_json(
        fits, difference, remarks, options.out / "calibration.json"
    )

    kinds = [f"{sum(c.kind == k for c in curves)} {k}" for k in difference]
    print(f"calibrate: {', '.join(kinds)}; {best.law.type}")
    print(f"  {CONFIDENCE:.0%} intervals, SI units")
    for line in output.number_lines(best):
        print(f"    {line}")
    for fit in fits:
        print(f"  misfit of {fit.law.type}: {100 * fit.misfit:.1f} %")
    for kind, error in difference.items():
        print(f"  materialPoint in {kind}: {100 * error:.2f} % off the law")
    for remark in remarks:
        print(f"  note: {remark}")
    for name in (target.name, "calibration.png", "calibration.json"):
        print(f"    {options.out / name}")
    if options.install:
        INSTALLED.mkdir(exist_ok=True)
        (INSTALLED / target.name).write_text(
            text + '\n// See tutorials/common/law\nlawFolder       "laws";\n'
        )
        print(f"  installed: ./Allrun run CASE -set law={options.name}")
    else:
        print(
            "  constant/bolusProperties of a case includes it by\n"
            f'    #include "{target.resolve()}"\n'
            "  or -install puts it where -set law=NAME finds it"
        )


def main(given=None) -> int:
    """Command line."""
    options = arguments(given)
    try:
        calibrate(options)
    except (DataError, RuntimeError, OSError) as error:
        print(f"calibrate: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
