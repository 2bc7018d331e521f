# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Bad input, killed runs, full disks: what the programs do about them.

fuzz() spoils each entry of each dictionary of a case, one at a time, runs it,
and judges how it ended.
"""

import copy
import os
import re
import shutil
import signal
import subprocess
from dataclasses import dataclass
from pathlib import Path

from PyFoam.RunDictionary.ParsedParameterFile import ParsedParameterFile

# What an entry is made: kind, its new text (None: taken away)
SPOILS = {
    "missing": None,
    "negative": "-1",
    "zero": "0",
    "huge": "1e30",
    "wrong type": "banana",
    "wrong dimension": "(1 2 3)",
}
TIMEOUT = 60  # [s] after which a run counts as hung


@dataclass
class Outcome:
    """How a spoilt run ended.

    verdict   error (one that names entry or file), ran, gaveUp (a step, told),
              or a fault: unclear, crashed, hung, swallowed
    """

    file: str
    entry: str
    spoil: str
    verdict: str
    message: str

    @property
    def fault(self) -> bool:
        """Whether nobody should see this."""
        return self.verdict in ("unclear", "crashed", "hung", "swallowed")


def leaves(dictionary, path=()):
    """Yield (path, value) of the entries that are no sub-dictionaries."""
    for key in list(dictionary.keys()):
        value = dictionary[key]
        if hasattr(value, "keys"):
            yield from leaves(value, (*path, key))
        else:
            yield (*path, key), value


def expand(case: Path, file: str) -> None:
    """Write a dictionary of a case anew without #include and macros."""
    done = subprocess.run(
        ["foamDictionary", file, "-expand"],
        cwd=case,
        env=os.environ | {"PWD": str(case)},
        capture_output=True,
        text=True,
        check=True,
    )
    text = done.stdout[done.stdout.index("FoamFile") :]
    (case / file).write_text(text)


def spoil(case: Path, file: str, path, text: str | None) -> None:
    """Set an entry of a file of a case, or take it away."""
    parsed = ParsedParameterFile(str(case / file))
    where = parsed.content
    for key in path[:-1]:
        where = where[key]
    if text is None:
        del where[path[-1]]
    else:
        where[path[-1]] = text
    parsed.writeFile()


def judge(status: int | None, output: str, path, value, text) -> tuple:
    """(verdict, message) of a run that ended with this status (None: hung)."""
    if status is None:
        return "hung", ""
    fatal = output.find("FOAM FATAL")
    message = output[fatal : fatal + 600] if fatal >= 0 else output[-300:]
    if status == 0:
        nan = re.search(r"\bnan\b", output)
        if nan:
            return "swallowed", "nan in the output"
        number = isinstance(value, int | float) and not isinstance(value, bool)
        if number and text in ("banana", "(1 2 3)"):
            return "swallowed", f"{text} for the number {value}"
        return "ran", ""
    if fatal < 0:
        return "crashed", message
    if "no convergence" in message:
        return "gaveUp", message
    # As a word of its own, after the headline and before the source's line: "E"
    # is in every error. Or another entry, with which this one does not agree;
    # or, where a stock OpenFOAM selects, the word that it does not know
    body = message.partition("\n")[2].partition("From function")[0]
    named = any(words in body for words in ("Entry '", "banana")) or any(
        re.search(rf"(?<!\w){re.escape(str(name))}(?!\w)", body)
        for name in (key.strip('"') for key in path[-2:])
    )
    return ("error" if named else "unclear"), message


def run_limited(case: Path, command, timeout: float = TIMEOUT):
    """(status or None where it hung, output) of a command in a case."""
    process = subprocess.Popen(
        command,
        cwd=case,
        env=os.environ | {"PWD": str(case)},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )
    try:
        output, _ = process.communicate(timeout=timeout)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return None, ""
    return process.returncode, output


def fuzz(case: Path, file: str, command, only=None, work: Path | None = None):
    """Yield an Outcome for each spoilt entry of a dictionary of a case.

    case      a case that runs; stays as it is
    file      path of the dictionary in it
    command   what is run
    only      (path) -> bool: which entries
    """
    work = work or case.with_name(case.name + "-spoilt")
    sound = ParsedParameterFile(str(case / file))
    for path, value in leaves(copy.deepcopy(sound.content)):
        if path[0] == "FoamFile" or (only and not only(path)):
            continue
        for kind, text in SPOILS.items():
            shutil.rmtree(work, ignore_errors=True)
            shutil.copytree(case, work, symlinks=True)
            spoil(work, file, path, text)
            status, output = run_limited(work, command)
            verdict, message = judge(status, output, path, value, text)
            yield Outcome(file, "/".join(path), kind, verdict, message)
    shutil.rmtree(work, ignore_errors=True)
