"""Sweeps: one certified orbit at each point of a grid, in this process or on any ``concurrent.futures.Executor``.

A point is a pure function of the exact scene and its number, so neither the worker nor the order matters: the answer
has the same bytes as ``impact-pair sweep`` writes in one process.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path
from typing import Any, Literal, TypeAlias

from . import _cf
from ._file import ending, parquet, write
from ._grid import GridResult, arrays, arrow, flat
from .errors import RangeError

#: The rows of a table: impacts and points, distinguished by the column ``record``, or only one of these.
Rows = Literal["mixed", "points", "states"]

#: The number of each point's kind, the colours of kinds, the legend, and rings: phase, velocity, colour.
_MapOutcomes: TypeAlias = "tuple[list[int], list[str], list[tuple[str, str]], list[tuple[float, float, str]]]"

#: The endings of tables.
TABLES = (".csv", ".parquet")


class SweepResult(GridResult):
    """A sweep: the certified result of each point, in the order of the grid; after Ctrl-C of those that are finished."""

    name = "sweep"

    @property
    def certified(self) -> bool:
        """True if the bounds are proved: false for ``arithmetic="float"``."""
        return bool(self.head["certified"])

    @property
    def outcomes(self) -> dict[str, int]:
        """Number of points with each outcome."""
        return dict(sorted(Counter(record["outcome"] for record in self).items()))

    def _table(self, rows: Rows) -> dict[str, Any]:
        return arrays(self._core.table(rows))

    @cached_property
    def table(self) -> dict[str, Any]:
        """The columns of CSV as arrays: of bounds doubles (n, 2), rounded outward, NaN where there are none.

        Rows are the impacts after the transient (``record`` is ``"state"``) and the result of each point (``"point"``).
        """
        return self._table("mixed")

    @cached_property
    def states(self) -> dict[str, Any]:
        """The impacts after the transients: point, values of the keys, index, wall, phase [rad], velocity [length/time].

        Columns are as in ``table``; ``point`` is the row of its point in ``to_dict("points")``.
        """
        return self._table("states")

    def to_dict(self, rows: Rows = "mixed") -> dict[str, Any]:
        """Return columns by name, bounds as two, ``phase_lower`` and ``phase_upper``, of all rows or of points or states alone."""
        table = self.table if rows == "mixed" else self.states if rows == "states" else self._table(rows)
        return flat(table)

    def to_pandas(self, rows: Rows = "mixed") -> Any:
        """Return a DataFrame with the columns of ``to_dict``."""
        import pandas as pd

        return pd.DataFrame(self.to_dict(rows)).infer_objects()

    def to_arrow(self, rows: Rows = "mixed") -> Any:
        """Return a pyarrow Table with the columns of ``to_dict``, the head as metadata."""
        return arrow(self.to_dict(rows), self.name, self._core.head())

    def to_xarray(self) -> Any:
        """Return a Dataset of xarray on the grid, by the conventions of CF; the head is an attribute, as JSON.

        The values of the keys are coordinates with bounds (``amplitude``, ``amplitude_bnds``), results such as ``exponent`` have theirs in
        ``exponent_lower`` and ``exponent_upper``, ``outcome`` is a flag. Impacts after the transients are along ``state``, NaN where
        a point has fewer.

        Raises
        ------
        MissingPackageError
            When xarray is not installed.
        Interrupted
            When points are missing.

        """
        self.require_whole()
        return _cf.sweep(self)

    def on_map(self, *, by_word: bool = False) -> _MapOutcomes:
        """Return what a map over two keys shows: the number of each point's kind of outcome, and the colours of the kinds.

        Then the legend, colours with names, and where attractors hit the left wall first, phase and velocity with their colour. Attractors
        of one pair are told apart by their states, or with ``by_word`` only by their words.
        """
        return self._core.outcomes(by_word)

    def svg(self, show: str = "phase") -> str:
        """Return the bifurcation diagram over one key (``show`` is phase or velocity), or the map of outcomes over two, as SVG."""
        return self._core.picture(show)

    def save(self, path: str | os.PathLike[str], states: str | os.PathLike[str] | None = None) -> None:
        """Write .csv, .jsonl or .svg, with the bytes of ``impact-pair sweep``; .parquet by pyarrow, ``to_xarray`` as .nc or .zarr.

        It is written atomically. Of an interrupted sweep .csv, .parquet and .svg have the finished points.

        With ``states``, a .csv or .parquet beside another one, the impacts go into a separate table, and ``path`` holds only the
        result of each point; both have the column ``point``.

        Raises
        ------
        RangeError
            When a name has another ending, or there are no states.
        Interrupted
            When points are missing, and the file is one of the whole grid: .jsonl, .nc or .zarr.

        """
        path = Path(path)
        if ending(path, (".csv", ".jsonl", ".svg", ".parquet", ".nc", ".zarr")) in (".jsonl", ".nc", ".zarr"):
            self.require_whole()
        if states is not None:
            states = Path(states)
            self._keep(states, path)
            self._write(states, "states")
        if path.suffix.lower() in (".nc", ".zarr"):
            _cf.save(self.to_xarray(), path)
        else:
            self._write(path, "mixed" if states is None else "points")

    def _keep(self, states: Path, path: Path) -> None:
        """Refuse to write states where there are none, or no table of them."""
        for key, file in (("states", states), ("path", path)):
            if file.suffix.lower() not in TABLES:
                said = f"{key} is {file.name}, but points and states are two tables in {' or '.join(TABLES)}"
                raise RangeError(said, key, file.name)
        if states.resolve() == path.resolve():
            raise RangeError(f"path and states name the same file, {states.name}", "states", states.name)
        if self.head["summary"]:
            raise RangeError("states writes the impacts, but a sweep with summary has none", "states", states.name)

    def _write(self, path: Path, rows: Rows) -> None:
        write(path, self._parts(path.suffix.lower(), rows))

    def _parts(self, kind: str, rows: Rows) -> Iterator[bytes]:
        """Yield the bytes of a file with this ending."""
        match kind:
            case ".svg":
                yield self.svg().encode()
            case ".csv":
                yield from self._written(rows)
            case ".parquet":
                yield parquet(self.to_arrow(rows))
            case _:
                yield from self._written()

    def __repr__(self) -> str:
        return self._summary(self.outcomes)

    def _repr_svg_(self) -> str:
        return self.svg()
