"""Finished chunks of a sweep, in memory or in a folder."""

from __future__ import annotations

import hashlib
import os
import re
from abc import ABC, abstractmethod
from pathlib import Path
from typing import TYPE_CHECKING

from .errors import Error

if TYPE_CHECKING:
    from collections.abc import Iterator

NAME = re.compile(r"(\d{12})-(\d{12})-([0-9a-f]{16})\.jsonl")


class Chunks(ABC):
    """Lines of points, a chunk at a time."""

    @abstractmethod
    def ranges(self) -> list[tuple[int, int]]:
        """Return the ranges of stored points, first (included) and last (excluded)."""

    @abstractmethod
    def add(self, first: int, last: int, lines: bytes) -> None:
        """Keep the lines of the points from first up to last."""

    @abstractmethod
    def read(self) -> Iterator[bytes]:
        """Yield the chunks in the order of their points."""

    def missing(self, points: int) -> list[tuple[int, int]]:
        """Return the ranges of missing points."""
        gaps, at = [], 0
        for first, last in [*sorted(self.ranges()), (points, points)]:
            if at < first:
                gaps.append((at, first))
            at = max(at, last)
        return gaps


class Memory(Chunks):
    """Chunks in memory."""

    def __init__(self) -> None:
        self._lines: dict[tuple[int, int], bytes] = {}

    def ranges(self) -> list[tuple[int, int]]:
        """Return the ranges of stored points."""
        return list(self._lines)

    def add(self, first: int, last: int, lines: bytes) -> None:
        """Keep the lines."""
        self._lines[first, last] = whole(first, last, lines)

    def read(self) -> Iterator[bytes]:
        """Yield them in order."""
        return (self._lines[key] for key in sorted(self._lines))


class Files(Chunks):
    """Chunks in a folder: one file each, written atomically; its name has the range of points and a hash of its bytes."""

    def __init__(self, folder: Path, head: str) -> None:
        self.folder = folder
        folder.mkdir(parents=True, exist_ok=True)
        # For who looks into the folder; its name is the hash of it.
        (folder / "head.json").write_text(head + "\n", encoding="utf-8")
        self._files: dict[tuple[int, int], Path] = {}
        at = 0
        for path in sorted(folder.iterdir()):
            name = NAME.fullmatch(path.name)
            if name is None:
                continue
            first, last = int(name[1]), int(name[2])
            # One that overlaps what is there says the same; a damaged one is computed again.
            if first >= at and digest(path.read_bytes()) == name[3]:
                self._files[first, last] = path
                at = last

    def ranges(self) -> list[tuple[int, int]]:
        """Return the ranges of stored points."""
        return list(self._files)

    def add(self, first: int, last: int, lines: bytes) -> None:
        """Keep the lines; from now on a crash does not lose them."""
        path = self.folder / f"{first:012}-{last:012}-{digest(whole(first, last, lines))}.jsonl"
        draft = path.with_name(f".{path.name}.{os.getpid()}")
        with draft.open("wb") as out:
            out.write(lines)
            out.flush()
            os.fsync(out.fileno())
        try:
            draft.replace(path)
        finally:
            # Ctrl-C may come once it is there.
            if path.exists():
                self._files[first, last] = path

    def read(self) -> Iterator[bytes]:
        """Yield them in order."""
        return (self._files[key].read_bytes() for key in sorted(self._files))


def digest(lines: bytes) -> str:
    """Return the hash that detects a corrupted chunk."""
    return hashlib.sha256(lines).hexdigest()[:16]


def whole(first: int, last: int, lines: bytes) -> bytes:
    """Return the lines, which must be one per point."""
    if lines.count(b"\n") != last - first:
        raise Error(f"a worker answered with {lines.count(10)} lines for the points from {first} up to {last}")
    return lines
