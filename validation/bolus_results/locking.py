# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""A folder for one process at a time.

What writes into a folder takes the lock of the file .bolusFoamLock in it
(flock, as scripts/runCase does for a run), which the kernel gives back when the
process ends, however it ends. The file names the process. BOLUSFOAM_LOCK names
the folder, absolute and physical, whose lock the caller has already.
"""

import fcntl
import os
import shlex
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

NAME = ".bolusFoamLock"


class FolderBusy(OSError):
    """Another process is at work in a folder."""


@contextmanager
def locked(path: Path, what: str, wait: bool = False) -> Iterator[None]:
    """Hold the lock of a file, which is made if need be.

    what   is protected, for the error
    wait   until it is free, else FolderBusy
    """
    # Without emptying it: it names the process that has it
    with open(path, "a+") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
        except BlockingIOError:
            lock.seek(0)
            holder = lock.read().strip() or "another one"
            raise FolderBusy(
                f"{what}: process {holder} is at work in it; start again when "
                "that has ended"
            ) from None
        command = shlex.join([Path(sys.argv[0]).name, *sys.argv[1:]])
        lock.truncate(0)
        lock.write(f"{os.getpid()} ({command})\n")
        lock.flush()
        try:
            yield
        finally:
            lock.truncate(0)


@contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """Be the only one that writes into a folder, which must be there.

    Raises FolderBusy, which names the process, where another one does.
    """
    folder = Path(folder).resolve()
    if os.environ.get("BOLUSFOAM_LOCK") == str(folder):
        yield
        return
    with locked(folder / NAME, str(folder)):
        yield
