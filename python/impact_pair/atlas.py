"""Atlases: where every motion goes over the plane of two parameters, at the points of a grid or for all parameters of cells."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path
from typing import Any

from ._file import ending, parquet, write
from ._grid import GridResult, arrays, arrow, flat

#: The endings of files that an atlas is written into.
ENDINGS = (".csv", ".jsonl", ".parquet", ".svg", ".html")


class AtlasResult(GridResult):
    """An atlas: what is proved of every motion at each point or cell, in the order of the grid; after Ctrl-C of those that are finished."""

    name = "atlas"

    @property
    def classes(self) -> dict[str, int]:
        """Number of points or cells of each class."""
        return dict(sorted(Counter(self.table["class"]).items()))

    @cached_property
    def table(self) -> dict[str, Any]:
        """The columns of CSV as arrays, a row a point or cell: exact values as doubles (n, 2), rounded outward, ends of cells inward."""
        return arrays(self._core.table("points"))

    def to_dict(self) -> dict[str, Any]:
        """Return columns by name, exact values as two, ``amplitude_lower`` and ``amplitude_upper``; the ends of cells rounded inward."""
        return flat(self.table)

    def to_pandas(self) -> Any:
        """Return a DataFrame with the columns of ``to_dict``."""
        import pandas as pd

        return pd.DataFrame(self.to_dict()).infer_objects()

    def to_arrow(self) -> Any:
        """Return a pyarrow Table with the columns of ``to_dict``, the head as metadata."""
        return arrow(self.to_dict(), self.name, self._core.head())

    def svg(self) -> str:
        """Return the plane in the colours of the classes, with the paper's curves over it, as SVG."""
        return self._core.picture("svg")

    def html(self) -> str:
        """Return the page: one file without anything from elsewhere, in which each point or cell says what is proved of it."""
        return self._core.picture("html")

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write .csv, .jsonl, .svg or .html, with the bytes of ``impact-pair atlas``, or .parquet by pyarrow. It is written atomically.

        Raises
        ------
        RangeError
            When a name has another ending.
        Interrupted
            When points are missing, and the file is one of the whole grid: .jsonl.

        """
        path = Path(path)
        if ending(path, ENDINGS) == ".jsonl":
            self.require_whole()
        write(path, self._parts(path.suffix.lower()))

    def _parts(self, kind: str) -> Iterator[bytes]:
        """Yield the bytes of a file with this ending."""
        match kind:
            case ".svg":
                yield self.svg().encode()
            case ".html":
                yield self.html().encode()
            case ".csv":
                yield from self._written("points")
            case ".parquet":
                yield parquet(self.to_arrow())
            case _:
                yield from self._written()

    def __repr__(self) -> str:
        return self._summary(self.classes)

    def _repr_svg_(self) -> str:
        return self.svg()
