# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Which stomach the paper had: a search over what its text leaves open.

Runs case A on 1 mm with one set of assumptions after the other, two at a time,
then the best on 0.5 mm, and the best few of these as cases B and C. What was
run is kept in run/validate/paper: a search that was stopped goes on.
"""

import argparse
import shutil
import sys

from bolus_results.locking import FolderBusy, alone_in
from bolus_validation import paper_page, paper_search


def main(given) -> None:
    """Search, judge, write."""
    base = paper_search.BASE
    if given.quick:
        base = base / "quick"
        shutil.rmtree(base / "runs", ignore_errors=True)
        (base / "records.jsonl").unlink(missing_ok=True)
    base.mkdir(parents=True, exist_ok=True)
    with alone_in(base):
        if given.quick:
            records = paper_search.search(
                base, 3, evaluate=paper_search.quick_run
            )
        elif given.page:
            records = paper_search.Records(base, paper_search.sources())
        else:
            records = paper_search.search(
                base, given.sets, minutes=given.minutes
            )
            paper_search.refine(base, records, given.fine)
            paper_search.judge(base, records, given.best)
        if not records.searched():
            sys.exit("paper: nothing has been run yet: ./Allrun validate paper")
        for path in paper_page.write(records, base, into_doc=given.page):
            print(path)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--sets", type=int, default=150, help="to try, those kept included"
    )
    parser.add_argument(
        "--minutes", type=float, help="start no run of the search after these"
    )
    parser.add_argument(
        "--fine", type=int, default=8, help="best sets to run on 0.5 mm"
    )
    parser.add_argument(
        "--best", type=int, default=3, help="sets to judge by more runs"
    )
    parser.add_argument(
        "--page",
        action="store_true",
        help="write doc/paper.md and its picture from what is kept",
    )
    parser.add_argument(
        "--quick", action="store_true", help="3 sets on 2 mm, 9 s: for tests"
    )
    try:
        main(parser.parse_args())
    except FolderBusy as error:
        sys.exit(f"paper: {error}")
