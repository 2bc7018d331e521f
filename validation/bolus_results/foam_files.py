# SPDX-License-Identifier: GPL-3.0-or-later
# Copyright (C) 2026 the bolusFoam developers
"""Files of OpenFOAM as numbers and text.

Lists and fields: ASCII or binary as their header says (arch: size of labels
and scalars; little endian), plain or gzipped. PyFoam's parser would take
minutes for the meshes of a run; this one hands the numbers to numpy in one
piece. foamlib guesses what the header says: sizes of labels and scalars from
where a bracket closes, and the order of bytes not at all.
"""

import gzip
import os
import re
import subprocess
import zlib
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

# Brackets to blanks: what is left is a plain sequence of numbers
_FLATTEN = bytes.maketrans(b"()", b"  ")
_COMMENT = rb"/\*.*?\*/|//[^\n]*"
_SKIP = re.compile(rb"(?:\s|" + _COMMENT + rb")*", re.DOTALL)

# Numbers of one value
COMPONENTS = {
    b"scalar": 1,
    b"label": 1,
    b"vector": 3,
    b"symmTensor": 6,
    b"tensor": 9,
    b"sphericalTensor": 1,
}


class FoamFileError(ValueError):
    """A file that cannot be read, and what would be valid."""


@dataclass
class Content:
    """A file behind its header; in binary the sizes of its numbers."""

    path: Path
    cls: str  # of the header
    data: bytes
    label: np.dtype | None = None
    scalar: np.dtype | None = None

    @property
    def binary(self) -> bool:
        """Are its lists binary?"""
        return self.label is not None

    def error(self, text: str) -> FoamFileError:
        """An error of this file."""
        return FoamFileError(f"{self.path}: {text}")

    def numbers(self, text: bytes, dtype: type) -> np.ndarray:
        """All the numbers of an ASCII list with brackets, flat."""
        try:
            return np.array(text.translate(_FLATTEN).split(), dtype=dtype)
        except ValueError as error:
            raise self.error(str(error)) from None

    def sequence(
        self, start: int, dtype: type, width: int | None
    ) -> tuple[int, np.ndarray, int]:
        """The list N ( ... ) from a place on: N, its numbers, flat, its end.

        dtype   int or float
        width   numbers of a value; None: that of an ASCII list may be any
        """
        head = re.compile(rb"(\d+)\s*([({]?)").match(
            self.data, _SKIP.match(self.data, start).end()
        )
        if not head:
            raise self.error("not a list 'N ( ... )'")
        count, begin = int(head.group(1)), head.end()
        if not head.group(2):
            if count:
                raise self.error("not a list 'N ( ... )'")
            return 0, np.empty(0, dtype), begin
        if self.binary:
            if head.group(2) == b"{":
                raise self.error("a list N{...} in a binary file is not known")
            kind = self.label if dtype is int else self.scalar
            end = begin + count * width * kind.itemsize
            if self.data[end : end + 1] != b")":
                raise self.error(
                    f"no list of {count} x {width} numbers of {kind.itemsize} "
                    "bytes, as the header's arch says: cut short?"
                )
            flat = np.frombuffer(self.data[begin:end], kind).astype(dtype)
            return count, flat, end + 1
        if head.group(2) == b"{":  # N{value}: all the same
            end = self.data.find(b"}", begin)
            flat = np.tile(self.numbers(self.data[begin:end], dtype), count)
        else:
            # The list ends where no other bracket opens before the next one
            end = self._closing(begin)
            flat = self.numbers(self.data[begin:end], dtype)
        if end < 0 or (width and flat.size != count * width):
            raise self.error(
                f"{flat.size} numbers in a list of {count}: cut short?"
            )
        return count, flat, end + 1

    def _closing(self, begin: int) -> int:
        """Where the bracket closes that was opened before; -1: nowhere."""
        semicolon = self.data.find(b";", begin)
        if semicolon >= 0:
            return self.data.rfind(b")", begin, semicolon)
        if self.cls == "faceCompactList":  # of the two lists the next
            return self.data.find(b")", begin)
        return self.data.rfind(b")", begin)


def stored(path: Path) -> Path | None:
    """A file, or its .gz; None if there is neither."""
    for found in (path, path.with_name(path.name + ".gz")):
        if found.is_file():
            return found
    return None


def read_bytes(path: Path) -> bytes:
    """A file or its .gz, unpacked."""
    found = stored(path)
    if found is None:
        raise FoamFileError(f"{path}: no such file, nor one with .gz")
    if found == path:
        return path.read_bytes()
    try:
        return gzip.decompress(found.read_bytes())
    except (EOFError, gzip.BadGzipFile, zlib.error) as error:
        raise FoamFileError(f"{found}: {error}") from None


def read_text(path: Path) -> str:
    """The text of a file or of its .gz behind its header, without comments.

    Dictionaries are text in binary runs as well.
    """
    data = re.sub(_COMMENT, b"", read_bytes(path), flags=re.DOTALL)
    header = re.search(rb"FoamFile\s*\{[^}]*\}", data)
    return (data[header.end() :] if header else data).decode(errors="replace")


def read_content(path: Path) -> Content:
    """A file of lists or a field: what its header says of it."""
    data = read_bytes(path)
    header = re.search(rb"FoamFile\s*\{([^}]*)\}", data[:5000])
    entries = header.group(1).decode(errors="replace") if header else ""
    body = data[header.end() :] if header else data

    def entry(name):
        found = re.search(rf'\b{name}\s+(?:"([^"]*)"|([^;"\s]+))\s*;', entries)
        return (found.group(1) or found.group(2) or "") if found else ""

    form, cls = entry("format"), entry("class")
    if form in ("", "ascii"):
        body = re.sub(_COMMENT, b"", body, flags=re.DOTALL)
        return Content(path, cls, body)
    if form != "binary":
        raise FoamFileError(
            f"{path}: format is {form}; valid are ascii and binary"
        )
    arch = re.fullmatch(r"(\w+);label=(32|64);scalar=(32|64)", entry("arch"))
    if not arch or arch.group(1) != "LSB":
        raise FoamFileError(
            f"{path}: binary with arch '{entry('arch')}'; valid are "
            '"LSB;label=32;scalar=64" and other sizes, 32 or 64 (elsewhere '
            "foamFormatConvert makes it ascii)"
        )
    label, scalar = (int(size) // 8 for size in arch.groups()[1:])
    return Content(
        path, cls, body, np.dtype(f"<i{label}"), np.dtype(f"<f{scalar}")
    )


def read_list(path: Path, dtype: type, width: int = 1) -> np.ndarray:
    """A file that is one list; (n,), or (n, width) of values of width."""
    flat = read_content(path).sequence(0, dtype, width)[1]
    return flat if width == 1 else flat.reshape(-1, width)


def read_faces(path: Path) -> list[np.ndarray]:
    """The points of each face."""
    content = read_content(path)
    if content.cls == "faceCompactList":
        _, starts, end = content.sequence(0, int, 1)
        _, labels, _ = content.sequence(end, int, 1)
        if not starts.size or starts[-1] != labels.size:
            raise content.error("the two lists of faces do not fit: cut short?")
        return np.split(labels, starts[1:-1]) if starts.size > 1 else []
    if content.binary:
        raise content.error(
            f"binary, class {content.cls}; valid is faceCompactList"
        )
    count, flat, _ = content.sequence(0, int, None)
    faces, i = [], 0
    while i < flat.size:
        faces.append(flat[i + 1 : i + 1 + flat[i]])
        i += 1 + flat[i]
    if len(faces) != count or i != flat.size:
        raise content.error(f"{len(faces)} faces, {count} announced")
    return faces


def read_field(path: Path, size: int) -> np.ndarray:
    """The internal field of a file.

    Returns (size,) for a scalar, (size, 3) for a vector, (size, 6) for a
    symmetric tensor (xx xy xz yy yz zz), in the unit of the field.
    """
    content = read_content(path)
    start = re.search(rb"\binternalField\s+", content.data)
    if not start:
        raise content.error("has no internalField")

    uniform = re.compile(rb"uniform\s+([^;]*);").match(
        content.data, start.end()
    )
    if uniform:
        value = content.numbers(uniform.group(1), float)
        value = value[0] if value.size == 1 else value
        values = np.broadcast_to(value, (size, *np.shape(value))).copy()
        return _finite(content, values)

    head = re.compile(rb"nonuniform\s+List<(\w+)>").match(
        content.data, start.end()
    )
    if not head or head.group(1) not in COMPONENTS:
        raise content.error("internalField is no list of numbers")
    width = COMPONENTS[head.group(1)]
    dtype = int if head.group(1) == b"label" else float
    count, flat, _ = content.sequence(head.end(), dtype, width)
    if count != size:
        raise content.error(f"{count} values, but the mesh has {size} cells")
    return _finite(content, flat if width == 1 else flat.reshape(-1, width))


def _finite(content: Content, values: np.ndarray) -> np.ndarray:
    """Values, if all of them are numbers."""
    bad = np.flatnonzero(~np.isfinite(values).reshape(len(values), -1).all(1))
    if bad.size:
        raise content.error(
            f"{bad.size} values are no finite numbers, the first in cell "
            f"{bad[0]}"
        )
    return values


# --- dictionaries -----------------------------


def entries(text: str) -> dict[str, str]:
    """Entries of a dictionary as foamDictionary prints it, by their path."""
    found, path, held = {}, [], ""
    text = re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.DOTALL)
    for token in re.findall(r'"[^"]*"|[{};]|[^{};"]+', text):
        if token == "{":
            path.append(" ".join(held.split()))
            held = ""
        elif token == "}":
            if path:
                path.pop()
            held = ""
        elif token == ";":
            words = held.split(None, 1)
            if words:
                value = " ".join(words[1].split()) if len(words) > 1 else ""
                found[".".join([*path, words[0]])] = value
            held = ""
        else:
            held += token
    return {
        name: value
        for name, value in found.items()
        if not name.startswith("FoamFile")
    }


def messages(text: str) -> list[tuple[str, str]]:
    """Warnings and errors of OpenFOAM in what it printed: (kind, text)."""
    found = []
    for kind, rest in re.findall(
        r"--> FOAM (FATAL|Warning)[^\n]*\n(.*?)(?=\n *\n|--> FOAM|\Z)",
        re.sub(r"^\[\d+\] ?", "", text, flags=re.MULTILINE),
        re.DOTALL,
    ):
        said = re.sub(r"^ *(From function|in file) .*\n?", "", rest, flags=re.M)
        found.append((kind, " ".join(said.split())))
    return found


def foam_dictionary(case: Path, name: str) -> tuple[str, str]:
    """A dictionary of a case, includes and macros expanded, and what was said
    beside it.

    Raises FoamFileError with what foamDictionary says of one it cannot read.
    """
    with TemporaryDirectory() as folder:
        # By another name: OpenFOAM cannot read all that a path may hold
        link = Path(folder) / "case"
        link.symlink_to(Path(case).resolve())
        try:
            done = subprocess.run(
                ["foamDictionary", "-expand", name],
                cwd=link,
                # OpenFOAM warns where it is not that of the folder
                env=os.environ | {"PWD": str(link)},
                capture_output=True,
                text=True,
                check=False,
            )
        except FileNotFoundError:
            raise FoamFileError(
                f"{case / name}: no foamDictionary to read it with; source "
                "scripts/environment"
            ) from None
    if done.returncode:
        raise FoamFileError(f"{case / name}: {done.stderr.strip()[-300:]}")
    # What comes before the banner is not of the dictionary
    start = max(done.stdout.find("/*-------"), 0)
    return done.stdout[start:], done.stdout[:start] + done.stderr


def expanded(case: Path, name: str) -> dict[str, str]:
    """The entries of a dictionary of a case, includes and macros expanded.

    Raises FoamFileError with what foamDictionary says of one it cannot read.
    """
    return entries(foam_dictionary(case, name)[0])
