"""Orbits: certified impacts, and bounds of the motion between them."""

from __future__ import annotations

import html
import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, SupportsIndex, TypeAlias, overload

import numpy as np

from . import _cf, _core
from ._document import Document
from ._exact import doubles_of
from ._file import ending, parquet, write
from ._progress import Progress, kept, reporting
from .bounds import Bounds, doubles, fixed, middles, radii

if TYPE_CHECKING:
    import os
    from collections.abc import Iterator

    import numpy.typing as npt

    from .bounds import Doubles
    from .verdicts import Theorem

NAMES = ("impact", "graze", "rest", "release")
MAPPINGS = (None, "P1", "P2", "P3", "P4")
SHOWN = 6
#: The scene file, and the options of its run.
Question: TypeAlias = "tuple[str, Any]"


@dataclass(frozen=True)
class Event:
    """An event at a wall. Times [time] are proved to lie in their bounds."""

    wall: str
    time: Bounds


@dataclass(frozen=True)
class Impact(Event):
    """The ball hits the wall; ``velocity`` is y' [length/time] just before, ``index`` counts from 1."""

    index: int
    mapping: str | None
    velocity: Bounds


@dataclass(frozen=True)
class Graze(Event):
    """The wall is touched with zero velocity, or not touched: undecided at any precision.

    ``distance`` bounds by how much the wall is missed at the extremum [length], negative where the extremum lies beyond the wall;
    ``speed`` bounds the speed of a touch [length/time]. Both are None in older documents.
    """

    distance: Bounds | None = None
    speed: Bounds | None = None


@dataclass(frozen=True)
class Rest(Event):
    """The ball comes to rest (sticking), after infinitely many unlisted impacts if ``accumulation`` is true."""

    accumulation: bool


@dataclass(frozen=True)
class Release(Event):
    """The ball leaves the wall on which it rested."""


@dataclass(frozen=True)
class Outcome:
    """Outcome of an orbit: ``kind`` and ``reason`` are those of the orbit JSON, ``message`` is one line of text."""

    kind: str
    message: str
    reason: str | None
    fields: dict[str, Any]


@dataclass(frozen=True)
class States:
    """Bounds (n, 2) of y [length] and y' [length/time] at times t; NaN where nothing is proved."""

    t: Doubles
    y_bounds: Doubles
    v_bounds: Doubles
    #: True where an impact may come before or after the time (n,): both velocities are in the bounds.
    at_impact: npt.NDArray[np.bool_]
    #: True if Ctrl-C ended the computation: the bounds of later times are NaN.
    interrupted: bool = False

    @property
    def y(self) -> Doubles:
        """The middles (n,) of the bounds of the displacement, relative to the box [length]."""
        return middles(self.y_bounds)

    @property
    def v(self) -> Doubles:
        """The middles (n,) of the bounds of the velocity, relative to the box [length/time]; NaN ``at_impact``, where it jumps.

        The velocities before impacts are the orbit's ``v``.
        """
        return np.where(self.at_impact, np.nan, middles(self.v_bounds))


class Orbit(Document):
    """An orbit with all its events. Arrays are of the impacts, n of them; bounds are doubles (n, 2), rounded outward.

    Called with times it says where the ball is then: ``orbit(0.5).y_bounds``.
    """

    def __init__(self, core: _core.Orbit, question: Question | None = None) -> None:
        super().__init__("", core.ending()[0])
        self._core = core
        self._question = question
        # What was pickled is computed again for the motion between impacts.
        self._mover = None if question is not None and core.ending()[0] is None else core
        names, walls, mappings, times, velocities = core.columns()
        self._names = np.frombuffer(names, dtype=np.uint8)
        self._at = self._names == 0
        #: The walls of all events as numbers (m,): -1 left, 1 right.
        self.event_sides: npt.NDArray[np.int8] = np.frombuffer(walls, dtype=np.int8)
        #: Bounds of the times of all events (m, 2) [time].
        self.event_bounds: Doubles = doubles(times, -1, 2)
        #: The walls of the impacts as numbers (n,): -1 left, 1 right.
        self.sides: npt.NDArray[np.int8] = fixed(self.event_sides[self._at])
        self._mappings = np.frombuffer(mappings, dtype=np.uint8)[self._at]
        #: Bounds of the times of the impacts (n, 2) [time].
        self.t_bounds: Doubles = fixed(self.event_bounds[self._at])
        #: Bounds of y' just before them (n, 2) [length/time].
        self.v_bounds: Doubles = fixed(doubles(velocities, -1, 2)[self._at])

    @property
    def t(self) -> Doubles:
        """The middles of the bounds of the times (n,) [time]."""
        return middles(self.t_bounds)

    @property
    def v(self) -> Doubles:
        """The middles of the bounds of the velocities before the impacts (n,) [length/time]."""
        return middles(self.v_bounds)

    @property
    def t_radii(self) -> Doubles:
        """Radii of the times about ``t`` (n,) [time], rounded up."""
        return radii(self.t_bounds)

    @property
    def v_radii(self) -> Doubles:
        """Radii of the velocities about ``v`` (n,) [length/time], rounded up."""
        return radii(self.v_bounds)

    @cached_property
    def walls(self) -> npt.NDArray[np.str_]:
        """The walls of the impacts (n,): ``"left"`` or ``"right"``."""
        return fixed(np.where(self.sides < 0, "left", "right"))

    @property
    def wall(self) -> npt.NDArray[np.str_]:
        """The walls of the impacts (n,): ``"left"`` or ``"right"``."""
        return self.walls

    @cached_property
    def event_kinds(self) -> npt.NDArray[np.str_]:
        """The kinds of all events (m,), in time order: ``"impact"``, ``"graze"``, ``"rest"`` or ``"release"``."""
        return fixed(np.asarray(np.array(NAMES)[self._names]))

    @cached_property
    def mappings(self) -> npt.NDArray[np.object_]:
        """The mappings that end at the impacts (n,): ``"P1"`` to ``"P4"``, or None if there is none or more than one."""
        return fixed(np.asarray(np.array(MAPPINGS, dtype=object)[self._mappings]))

    @cached_property
    def _about(self) -> tuple[dict[str, Any], dict[str, Any]]:
        head, outcome = self._core.about()
        return json.loads(head), json.loads(outcome)

    @property
    def certified(self) -> bool:
        """True if the bounds are proved: false for ``arithmetic="float"``."""
        return bool(self._about[0]["certified"])

    @property
    def interrupted(self) -> bool:
        """True if Ctrl-C ended the computation: the events are those certified until then."""
        return self._core.interrupted()

    @property
    def claim(self) -> str:
        """The start of the orbit: ``"exact start"``, or ``"shadowed"`` for one within the bounds of the outcome."""
        return str(self._about[0]["claim"])

    @property
    def arithmetic(self) -> dict[str, Any]:
        """The arithmetic: ``kind`` and ``bits``."""
        return dict(self._about[0]["arithmetic"])

    @property
    def scene(self) -> dict[str, Any]:
        """The exact parameters and the start, as the document has them."""
        return dict(self._about[0]["scene"])

    @property
    def outcome(self) -> Outcome:
        """Outcome of the orbit."""
        fields = self._about[1]
        return Outcome(fields["kind"], fields["message"], fields.get("reason"), fields)

    @property
    def bits(self) -> int | None:
        """Maximum precision of an impact in bits: 53 in doubles. None for an orbit that was read."""
        return self._core.ending()[2]

    @property
    def events(self) -> list[Event]:
        """All events in time order, with exact decimals."""
        return [self.event(i) for i in range(len(self._names))]

    def event(self, i: int) -> Event:
        """Return event number i, from 0, with exact decimals."""
        text = self._core.event(i if i >= 0 else i + len(self._names))
        if text is None:
            raise IndexError(i)
        said = json.loads(text)
        wall, time = said["wall"], Bounds(*said["time"])
        match said["event"]:
            case "impact":
                return Impact(wall, time, said["index"], said["mapping"], Bounds(*said["velocity"]))
            case "graze":
                if "distance" not in said:
                    return Graze(wall, time)
                return Graze(wall, time, Bounds(*said["distance"]), Bounds("0", said["speed"]))
            case "rest":
                return Rest(wall, time, "skipped" in said)
            case _:
                return Release(wall, time)

    @overload
    def __getitem__(self, i: SupportsIndex) -> Impact: ...

    @overload
    def __getitem__(self, i: slice) -> list[Impact]: ...

    def __getitem__(self, i: SupportsIndex | slice) -> Impact | list[Impact]:
        """Return impact number i, from 0, with exact decimals; of a slice the list of its impacts."""
        if isinstance(i, slice):
            return [self[k] for k in range(*i.indices(len(self)))]
        found = self.event(int(np.flatnonzero(self._at)[i]))
        assert isinstance(found, Impact)
        return found

    def __len__(self) -> int:
        return len(self.sides)

    def __iter__(self) -> Iterator[Impact]:
        return (self[i] for i in range(len(self)))

    def __call__(self, t: npt.ArrayLike, progress: Progress = False, *, keep_partial: bool = False) -> States:
        """Return bounds of the motion at times t (n,) [time], exact doubles in any order, by (11) and (12).

        At a time that may be before or after an impact both velocities are in the bounds. NaN before the start, after the last
        event, but where a time to stop at, ``until``, says that there is none before it, and while infinitely many impacts pass.
        """
        times = fixed(np.array(np.atleast_1d(doubles_of("t", t))))
        with reporting(progress, "times", times.size) as report:
            bounds, interrupted = self._moving().at(times.tobytes(), report)
        found = doubles(bounds, -1, 2, 2)
        low, high = self.t_bounds.T
        after = np.searchsorted(np.maximum.accumulate(high), times)
        at_impact = fixed(np.append(low, np.inf)[after] <= times)
        return kept(States(times, found[:, 0], found[:, 1], at_impact, interrupted), keep_partial)

    def _moving(self) -> _core.Orbit:
        if self._mover is None:
            assert self._question is not None
            scene, requested = self._question
            self._mover = _core.run(_core.Scene(scene), requested, None)
        return self._mover

    def json(self) -> str:
        """Return the orbit JSON, as ``impact-pair run --format json`` writes it."""
        return self._core.text("json")

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write .json, .jsonl or .csv as ``impact-pair run`` does; ``to_arrow`` as .parquet, ``savemat`` as .mat.

        The endings .nc and .zarr have ``to_xarray``. The file is written atomically.

        Raises
        ------
        RangeError
            When the name has another ending.

        """
        path = Path(path)
        match ending(path, (".json", ".jsonl", ".csv", ".parquet", ".mat", ".nc", ".zarr")):
            case ".json":
                super().save(path)
            case ".mat":
                self.savemat(str(path))
            case ".parquet":
                write(path, [parquet(self.to_arrow())])
            case ".nc" | ".zarr":
                _cf.save(self.to_xarray(), path)
            case suffix:
                write(path, [self._core.text(suffix[1:]).encode()])

    def prove(self, impacts: int | None = None) -> Theorem:
        """Return a Coq file whose theorem states the claims of this orbit; see :func:`impact_pair.prove`."""
        from .verdicts import prove

        return prove(self.json(), impacts)

    def to_dict(self) -> dict[str, Any]:
        """Return arrays by name: index, mapping, wall, t_lower, t_upper, v_lower, v_upper."""
        (t_lower, t_upper), (v_lower, v_upper) = self.t_bounds.T, self.v_bounds.T
        index = np.arange(1, len(self) + 1)
        named = {"index": index, "mapping": self.mappings, "wall": self.walls}
        return named | {"t_lower": t_lower, "t_upper": t_upper, "v_lower": v_lower, "v_upper": v_upper}

    def to_pandas(self) -> Any:
        """Return a DataFrame with one row per impact; columns as in ``to_dict``."""
        import pandas as pd

        return pd.DataFrame(self.to_dict()).set_index("index")

    def to_arrow(self) -> Any:
        """Return a pyarrow Table with one row per impact; columns as in ``to_dict``, the scene as metadata."""
        import pyarrow as pa

        table = pa.table(self.to_dict())
        return table.replace_schema_metadata({"impact-pair/orbit": self._core.about()[0]})

    def to_xarray(self) -> Any:
        """Return a Dataset of xarray along ``impact``, by the conventions of CF; the scene and the outcome are attributes, as JSON.

        The coordinate ``time`` has its bounds in ``time_bnds``, the data ``velocity`` in ``velocity_lower`` and ``velocity_upper``.
        ``wall`` and ``mapping`` are flags. Along ``event`` there are all events, grazes, rests and releases among them: ``event_time``
        with ``event_time_bnds``, and the flags ``event_kind`` and ``event_wall``. Units are those of the scene.

        Raises
        ------
        MissingPackageError
            When xarray is not installed.

        """
        return _cf.orbit(self, NAMES)

    def savemat(self, path: str) -> None:
        """Write a MATLAB file with ``to_dict``'s arrays (walls as -1 and 1, mappings as 1 to 4), the scene and the outcome in words."""
        from scipy.io import savemat

        columns = self.to_dict() | {"wall": self.sides, "mapping": self._mappings, "t": self.t, "v": self.v}
        head, outcome = self._core.about()
        savemat(path, columns | {"head": head, "outcome": outcome}, oned_as="column")

    def arb(self) -> list[tuple[Any, Any]]:
        """Return times and velocities of the impacts as balls of python-flint."""
        return [(impact.time.arb(), impact.velocity.arb()) for impact in self]

    def iv(self) -> list[tuple[Any, Any]]:
        """Return times and velocities of the impacts as intervals of mpmath."""
        return [(impact.time.iv(), impact.velocity.iv()) for impact in self]

    def _rows(self) -> Iterator[tuple[str, ...]]:
        count = len(self._names)
        for i in range(count):
            if i == SHOWN and count > 2 * SHOWN:
                yield ("...", "", "", "", "")
            if SHOWN <= i < count - SHOWN and count > 2 * SHOWN:
                continue
            match self.event(i):
                case Impact(wall, time, index, mapping, velocity):
                    yield (str(index), mapping or "-", wall, str(time), str(velocity))
                case other:
                    yield ("", type(other).__name__.lower(), other.wall, str(other.time), "")

    def __repr__(self) -> str:
        """Return the first and the last events; digits before a bracket are certain; the bracket holds the last digits of both bounds."""
        head = f"{'#':>7}  {'mapping':7}  {'wall':5}  {'time':31}  velocity before"
        lines = [f"{n:>7}  {mapping:7}  {wall:5}  {time:31}  {v}".rstrip() for n, mapping, wall, time, v in self._rows()]
        return "\n".join([head, *lines, self._core.ending()[1]])

    def _repr_html_(self) -> str:
        cell = "<td style='text-align:left'>{}</td>".format
        rows = ["".join(cell(html.escape(text)) for text in row) for row in self._rows()]
        names = "".join(f"<th>{name}</th>" for name in ("#", "mapping", "wall", "time", "velocity before"))
        body = "".join(f"<tr>{row}</tr>" for row in rows)
        return f"<table><tr>{names}</tr>{body}</table><p>{html.escape(self._core.ending()[1])}</p>"

    def __copy__(self) -> Orbit:
        return self

    def __deepcopy__(self, _: dict[int, Any]) -> Orbit:
        # It does not change.
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        # What Ctrl-C has cut would not be cut again.
        return read, (self.json(), None if self.interrupted else self._question)


def read(text: str, question: Question | None = None) -> Orbit:
    """Return the orbit of an orbit JSON; without what it is the answer to it has no bounds of the motion between its impacts."""
    return Orbit(_core.read_orbit(text), question)


@dataclass(frozen=True)
class Flights:
    """The next impacts of n states on walls, each by itself; where doubles do not decide it the wall is 0 and the bounds are NaN."""

    #: -1 left, 1 right, 0 undecided (n,).
    sides: npt.NDArray[np.int8]
    #: Bounds of the times (n, 2) [time].
    t_bounds: Doubles
    #: Bounds of y' just before the impacts (n, 2) [length/time].
    v_bounds: Doubles
    #: 1 to 4 for P1 to P4, 0 undecided (n,).
    mappings: npt.NDArray[np.uint8]
    #: True if Ctrl-C ended the computation: later states are undecided.
    interrupted: bool = False
