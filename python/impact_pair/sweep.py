"""Sweeps: one certified orbit at each point of a grid, in this process or on any ``concurrent.futures.Executor``.

A point is a pure function of the exact scene and its number, so neither the worker nor the order matters: the answer
has the same bytes as ``impact-pair sweep`` writes in one process.
"""

from __future__ import annotations

import contextlib
import hashlib
import itertools
import json
import os
import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _cf, _core
from ._exact import Value, doubles_near, text, whole
from ._file import ending, parquet, write
from ._progress import Progress, reporting
from ._store import Chunks, Files, Memory
from .bounds import doubles
from .errors import Error, Interrupted, RangeError

if TYPE_CHECKING:
    from .bounds import Doubles

#: The rows of a table: impacts and points, distinguished by the column ``record``, or only one of these.
Rows = Literal["mixed", "points", "states"]

#: The endings of tables.
TABLES = (".csv", ".parquet")

#: How many times larger than the last ones a chunk may be: the first ones tell the rate.
GROWTH = 8
#: Chunks that wait for each worker, so that none is idle.
AHEAD = 2
#: The last chunks are smaller, so that workers end together: this number for each.
TAIL = 4


@dataclass(frozen=True)
class Question:
    """The specification of a sweep: everything that its points depend on, as sent to workers."""

    scene: str
    over: tuple[str, ...]
    transient: int
    impacts: int
    digits: int
    arithmetic: str
    max_bits: int
    summary: bool

    def core(self) -> _core.Sweep:
        """Return the sweep for the computation."""
        asked = (self.digits, self.arithmetic, self.max_bits)
        scene = _core.Scene(self.scene)
        return _core.Sweep(scene, list(self.over), (self.transient, self.impacts), asked, self.summary)

    def key(self) -> str:
        """Return a hash of scene, grid, settings and version: sweeps with equal keys have the same bytes."""
        return hashlib.sha256(self.core().head().encode()).hexdigest()[:32]


def compute(question: Question, first: int, last: int, key: str) -> tuple[bytes, float]:
    """Return the lines of the points from first up to last, and the seconds taken: the work of a worker, on one thread.

    ``key`` is that of the question where it is asked; a worker with another version has another one, and raises an ``Error``.
    """
    began = time.perf_counter()
    core = question.core()
    if question.key() != key:
        raise Error(f"a worker has another version, {json.loads(core.head())['program']}: all must have one")
    lines = core.compute((first, last), 1, None)
    if lines.count(b"\n") < last - first:
        # Ctrl-C in a terminal is sent to the workers as well.
        raise KeyboardInterrupt
    return lines, time.perf_counter() - began


class Rate:
    """The size of the next chunk, such that it takes some seconds."""

    def __init__(self, seconds: float, workers: int) -> None:
        self.seconds, self.workers = seconds, workers
        self.spent, self.done, self.largest = 0.0, 0, 0

    def tell(self, points: int, seconds: float) -> None:
        """Take in what a chunk took."""
        # What was measured last counts most: points differ.
        self.spent, self.done = 0.5 * self.spent + seconds, self.done // 2 + points
        self.largest = max(self.largest, points)

    def size(self, left: int) -> int:
        """Return how many points to compute next, of those that are left."""
        if not self.done:
            return 1
        wanted = int(self.seconds * self.done / max(self.spent, 1e-9))
        return max(1, min(wanted, GROWTH * self.largest, -(-left // (TAIL * self.workers))))


def sweep(
    scene: str,
    over: Mapping[str, tuple[Value, Value, int] | Sequence[float] | Doubles],
    asked: dict[str, Any],
    *,
    executor: Executor | None = None,
    workers: int | None = None,
    resume: str | os.PathLike[str] | None = None,
    seconds: float = 10.0,
    progress: Progress = None,
) -> SweepResult:
    """Certify an orbit at each point of a grid: bifurcation diagrams, exponents, basins.

    ``over`` has the keys that vary, one or two: ``{"amplitude": ("1", "10", 1000)}`` are 1000 exact values, evenly spaced,
    endpoints included; an array or a list such as ``np.linspace(1, 10, 1000)`` stands for its first and last value and their number,
    and the values between are spaced exactly. Of two keys the second one varies faster. Keys are those of the command line: amplitude,
    frequency, phase, gap, restitution, start.time, start.phase, start.position, start.velocity; with several harmonics amplitude.2
    and so on. Of each orbit ``transient`` impacts are skipped and ``impacts`` listed, or with ``summary`` none.

    ``executor`` computes: any ``concurrent.futures.Executor``, such as a ``ProcessPoolExecutor`` or Dask's ``client.get_executor()``;
    without one all processors of this process. It is sent chunks that take about ``seconds``, sized from the first ones, for as many
    ``workers`` as it has. With ``resume`` finished chunks are kept in that folder under a hash of scene, grid and version: called again
    after a crash of a worker, the scheduler or this process, the sweep continues from there. Ctrl-C ends it: the answer has the
    finished points, and is ``interrupted``.
    """
    if not isinstance(over, Mapping):
        raise RangeError(f'over is {over!r}, but must be a dict, such as {{"amplitude": (1, 10, 1000)}}', "over", repr(over))
    axes = tuple(axis(key, values) for key, values in over.items())
    question = Question(scene, axes, **asked)
    core = question.core()
    core.check()
    chunks: Chunks = Memory() if resume is None else Files(Path(resume) / question.key(), core.head())
    count = workers or workers_of(executor)
    with reporting(progress, "points", core.points) as tell:
        run = Run(question, chunks, core.points, Rate(seconds, count), tell)
        # What is finished is kept.
        with contextlib.suppress(KeyboardInterrupt):
            run.here(core) if executor is None else run.on(executor)
    return SweepResult(question, chunks)


def spread(key: str, given: Any) -> tuple[Value, Value, int]:
    """Return first value, last value and number of evenly spaced values, such as those of ``np.linspace``."""
    values = doubles_near(f"over of {key}", given)
    evenly = np.linspace(values[0], values[-1], len(values)) if values.ndim == 1 and len(values) > 1 else None
    if evenly is None or not np.allclose(values, evenly, rtol=1e-6 if given_in_singles(given) else 1e-12, atol=0):
        message = f"over of {key} is {given!r}, but must be two or more evenly spaced values, or (low, high, count)"
        raise RangeError(message, key, repr(given))
    # The ends as they are given: a fraction is no double.
    return given[0], given[-1], len(values)


def given_in_singles(values: Any) -> bool:
    """Return whether an array has less than double precision, in which steps are rounded more."""
    return getattr(values, "dtype", np.dtype(float)).itemsize < np.dtype(float).itemsize


def spaced(key: str, values: Any) -> tuple[Value, Value, int]:
    """Return first value, last value and number of what varies: of ``(low, high, count)``, or of an array or a list of values."""
    if isinstance(values, (np.ndarray, list)):
        values = spread(key, values)
    if not isinstance(values, tuple) or len(values) != 3:
        raise RangeError(f"over of {key} is {values!r}, but must be (low, high, count)", key, repr(values))
    low, high, count = values
    return low, high, whole(f"{key} count", count)


def axis(key: str, values: Any) -> str:
    """Return what varies in the words of the command line: exact values from one to another, evenly spread."""
    low, high, count = spaced(key, values)
    return f"{key}={text(key, low)}..{text(key, high)}:{count}"


def workers_of(executor: Executor | None) -> int:
    """Return how many chunks an executor computes at a time."""
    if executor is None:
        return 1
    client = getattr(executor, "_client", None)
    if client is not None and hasattr(client, "ncores"):
        return max(1, sum(map(int, client.ncores().values())))
    return int(getattr(executor, "_max_workers", None) or os.cpu_count() or 1)


def stretches(lines: bytes) -> Iterator[tuple[int, int, bytes]]:
    """Yield the lines of points that follow one another: the first point, the one after the last, and the lines."""
    found: list[tuple[int, bytes]] = [(json.loads(line)["point"], line) for line in lines.splitlines(keepends=True)]
    for _, part in itertools.groupby(enumerate(found), lambda numbered: numbered[1][0] - numbered[0]):
        points = [line for _, line in part]
        yield points[0][0], points[-1][0] + 1, b"".join(line for _, line in points)


class Run:
    """A sweep at work."""

    def __init__(self, question: Question, chunks: Chunks, points: int, rate: Rate, tell: Any) -> None:
        self.question, self.chunks, self.rate = question, chunks, rate
        self.gaps = chunks.missing(points)
        self.left = sum(last - first for first, last in self.gaps)
        self.done, self._tell = points - self.left, tell

    def next(self) -> tuple[int, int]:
        """Take the next points that are left."""
        first, last = self.gaps[0]
        last = min(last, first + self.rate.size(self.left))
        self.gaps[0] = (last, self.gaps[0][1])
        if last == self.gaps[0][1]:
            del self.gaps[0]
        self.left -= last - first
        return first, last

    def keep(self, first: int, last: int, lines: bytes, took: float) -> None:
        """Keep a finished chunk."""
        self.chunks.add(first, last, lines)
        self.rate.tell(last - first, took)
        self.done += last - first
        if self._tell:
            self._tell(self.done)

    def here(self, core: _core.Sweep) -> None:
        """Compute by all processors of this process."""
        while self.gaps:
            began, before = time.perf_counter(), self.done
            first, last = self.next()
            tell = None if self._tell is None else lambda points, before=before: self._tell(before + points)
            lines = core.compute((first, last), 0, tell)
            for start, end, part in stretches(lines):
                self.keep(start, end, part, time.perf_counter() - began)
            if lines.count(b"\n") < last - first:
                return

    def on(self, executor: Executor) -> None:
        """Have it computed by the workers of an executor."""
        running: dict[Future[tuple[bytes, float]], tuple[int, int]] = {}
        key = self.question.key()
        try:
            while self.gaps or running:
                while self.gaps and len(running) < AHEAD * self.rate.workers:
                    first, last = self.next()
                    running[executor.submit(compute, self.question, first, last, key)] = (first, last)
                for future in wait(running, return_when=FIRST_COMPLETED).done:
                    first, last = running.pop(future)
                    self.keep(first, last, *future.result())
        except Error:
            raise
        except Exception as lost:
            # Each library has its own name for it: BrokenProcessPool, KilledWorker, CommClosedError.
            raise Interrupted(f"the executor failed after {self.done} points: {lost!r}") from lost
        finally:
            for future in running:
                future.cancel()


class SweepResult:
    """A sweep: the certified result of each point, in the order of the grid; after Ctrl-C of those that are finished."""

    def __init__(self, question: Question, chunks: Chunks) -> None:
        self._question, self._chunks = question, chunks

    @cached_property
    def _core(self) -> _core.Sweep:
        return self._question.core()

    @cached_property
    def head(self) -> dict[str, Any]:
        """The head of the sweep: the first line of its JSON Lines."""
        found: dict[str, Any] = json.loads(self._core.head())
        return found

    @property
    def certified(self) -> bool:
        """Whether the bounds are proved: false for ``arithmetic="float"``."""
        return bool(self.head["certified"])

    @property
    def complete(self) -> bool:
        """Whether everything requested is certified at every point: the command line's exit code 0."""
        return not self.interrupted and all(record["complete"] for record in self)

    @property
    def interrupted(self) -> bool:
        """Whether Ctrl-C ended the sweep: some points of the grid are missing."""
        return self._missing() > 0

    def _missing(self) -> int:
        return sum(last - first for first, last in self._chunks.missing(self.points))

    def require_whole(self) -> None:
        """Raise :class:`Interrupted` where points are missing.

        Raises
        ------
        Interrupted
            When Ctrl-C ended the sweep.

        """
        if self.interrupted:
            said = f"the sweep was interrupted, {self._missing()} of {self.points} points are missing"
            raise Interrupted(f"{said}: to_pandas() has the finished ones, and a sweep with resume= goes on")

    @property
    def outcomes(self) -> dict[str, int]:
        """Number of points with each outcome."""
        return dict(sorted(Counter(record["outcome"] for record in self).items()))

    @property
    def points(self) -> int:
        """Number of points of the grid."""
        return self._core.points

    def __len__(self) -> int:
        return self.points

    def lines(self) -> Iterator[bytes]:
        """Yield the records as JSON Lines, chunk by chunk, in the order of the grid."""
        return self._chunks.read()

    def __iter__(self) -> Iterator[dict[str, Any]]:
        for lines in self.lines():
            for line in lines.splitlines():
                yield json.loads(line)

    def _table(self, rows: Rows) -> dict[str, Any]:
        columns: dict[str, Any] = {}
        for name, column in self._core.table(b"".join(self.lines()), rows).items():
            columns[name] = doubles(column, -1, 2) if isinstance(column, bytes) else np.array(column, dtype=object)
        return columns

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
        columns: dict[str, Any] = {}
        for name, column in table.items():
            if column.ndim == 2:
                columns |= {f"{name}_lower": column[:, 0], f"{name}_upper": column[:, 1]}
            else:
                columns[name] = column
        return columns

    def to_pandas(self, rows: Rows = "mixed") -> Any:
        """Return a DataFrame with the columns of ``to_dict``."""
        import pandas as pd

        return pd.DataFrame(self.to_dict(rows)).infer_objects()

    def to_arrow(self, rows: Rows = "mixed") -> Any:
        """Return a pyarrow Table with the columns of ``to_dict``, the head as metadata."""
        import pyarrow as pa

        table = pa.table({name: pa.array(list(column)) for name, column in self.to_dict(rows).items()})
        return table.replace_schema_metadata({"impact-pair/sweep": self._core.head()})

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

    def svg(self, show: str = "phase") -> str:
        """Return the bifurcation diagram over one key (``show`` is phase or velocity), or the map of outcomes over two, as SVG."""
        return self._core.svg(b"".join(self.lines()), show)

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
                yield self._core.csv_head(rows).encode()
                yield from (self._core.csv(lines, rows) for lines in self.lines())
            case ".parquet":
                yield parquet(self.to_arrow(rows))
            case _:
                yield self._core.head().encode() + b"\n"
                yield from self.lines()

    def __repr__(self) -> str:
        said = ", ".join(f"{count} {outcome}" for outcome, count in self.outcomes.items())
        missing = f"; interrupted, {self._missing()} of {self.points} points are missing" if self.interrupted else ""
        return f"<sweep over {' and '.join(self._question.over)}: {said}{missing}>"

    def _repr_svg_(self) -> str:
        return self.svg()

    def __reduce__(self) -> tuple[Any, ...]:
        kept = Memory()
        for (first, last), lines in zip(sorted(self._chunks.ranges()), self.lines(), strict=True):
            kept.add(first, last, lines)
        return SweepResult, (replace(self._question), kept)
