"""Scenes: one impact pair, one start, and the computations on them."""

from __future__ import annotations

import difflib
import json
import os
import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from . import _core, answers
from ._document import Document
from ._exact import IMPACTS, Number, Value, doubles_of, optional_whole, options_of, single, string, text, texts, whole
from ._file import read
from ._grid import Over, question, spaced
from ._progress import Progress, kept, reporting
from .atlas import AtlasResult
from .bounds import doubles
from .boxes import BoxImages, box_map
from .errors import Error, ListError, RangeError, SceneError
from .orbit import Flights, Orbit
from .sweep import SweepResult

if TYPE_CHECKING:
    from concurrent.futures import Executor

    import numpy.typing as npt

Answer = TypeVar("Answer", bound=Document)

#: Default maximum precision of an orbit, in bits.
MAX_BITS = 1_000_000
TABLES = {
    "excitation": ("amplitude", "frequency", "phase"),
    "pair": ("gap", "restitution"),
    "start": ("time", "wall", "position", "velocity"),
    "run": ("impacts", "until", "digits"),
}
WORDS = {"start.wall", "run.impacts", "run.digits"}


class Scene:
    """An impact pair and a start, exact: nothing is rounded to a double, nothing is clamped.

    Numbers are ``int``, ``Fraction``, ``Decimal``, expressions such as ``"3*pi"``, tuples ``(low, high)`` for all values between
    them, or floats, which are their exact binary values. Several harmonics are lists of amplitudes, frequencies and phases.

    >>> scene = Scene(amplitude=8, frequency="pi", gap="9.42497", restitution="0.5", velocity="-12.56636")
    >>> scene.run(impacts=1)[0].time
    Bounds('0.55134802021852(08,17)')
    """

    def __init__(
        self,
        *,
        velocity: Value,
        amplitude: Value | Sequence[Value] | None = None,
        A: Value | Sequence[Value] | None = None,
        frequency: Value | Sequence[Value] | None = None,
        W: Value | Sequence[Value] | None = None,
        phase: Value | Sequence[Value] | None = None,
        tau: Value | Sequence[Value] | None = None,
        gap: Value | None = None,
        d: Value | None = None,
        restitution: Value | None = None,
        e: Value | None = None,
        time: Value = 0,
        wall: str | None = None,
        position: Value | None = None,
        title: str | None = None,
        impacts: int | None = None,
        until: Value | None = None,
        digits: int | None = None,
    ) -> None:
        """Make a scene.

        The excitation is A sin(W t + tau): ``amplitude`` or ``A`` [length], ``frequency`` or ``W`` [rad/time], ``phase`` or ``tau`` [rad],
        0 by default. ``gap`` or ``d`` [length] is between the walls, ``restitution`` or ``e`` is from 0 to 1.
        The start is at ``time`` [time] on a ``wall`` (``"left"``, the default, or ``"right"``) with relative ``velocity``
        [length/time] just before the impact, or inside the gap at ``position`` y [length].
        ``impacts``, ``until`` [time] and ``digits`` are the defaults of ``run``.
        """
        given = {
            "title": title,
            "excitation": {
                "amplitude": amplitude,
                "A": A,
                "frequency": frequency,
                "W": W,
                "phase": 0 if phase is None and tau is None else phase,
                "tau": tau,
            },
            "pair": {"gap": gap, "d": d, "restitution": restitution, "e": e},
            "start": {
                "time": time,
                "wall": "left" if wall is None and position is None else wall,
                "position": position,
                "velocity": velocity,
            },
            "run": {"impacts": impacts, "until": until, "digits": digits},
        }
        self._read(toml(given), has_lines=False)

    #: The path of its file, by which commands name it; one that is in no file is named as if it were saved here.
    _path = "scene.toml"

    def _read(self, source: str, *, has_lines: bool) -> None:
        self._text = source
        try:
            self._core = _core.Scene(source)
        except Error as error:
            if has_lines:
                raise
            # Nobody wrote these lines.
            raise type(error)(re.sub(r"^line \d+: |, on line \d+,?", "", str(error)), error.key, error.value) from None

    @classmethod
    def from_text(cls, source: str) -> Scene:
        """Read a scene from the text of a scene file (TOML)."""
        scene = cls.__new__(cls)
        scene._read(source, has_lines=True)
        return scene

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Scene:
        """Read a scene file (TOML)."""
        scene = cls.from_text(read(path, SceneError))
        scene._path = os.fspath(path)
        return scene

    @classmethod
    def from_dict(cls, tables: Mapping[str, Any]) -> Scene:
        """Make a scene of tables as a scene file has them: excitation, pair, start, and optionally title and run."""
        scene = cls.__new__(cls)
        scene._read(toml(tables), has_lines=False)
        return scene

    @classmethod
    def named(cls, name: str) -> Scene:
        """Return a scene of the repository, such as ``"figure-14"`` of the paper, ``"chatter"`` or ``"square-wave"``."""
        source = _core.paper(string("name", name))
        if source is None:
            near = difflib.get_close_matches(name, _core.SCENES, 1)
            meant = f"; did you mean {near[0]!r}?" if near else ""
            raise RangeError(f"the scene is {name!r}, but known are {', '.join(_core.SCENES)}{meant}", "name", name)
        scene = cls.from_text(source)
        scene._path = f"scenes/{name}.toml"
        return scene

    @property
    def text(self) -> str:
        """The scene file."""
        return self._text

    @property
    def title(self) -> str | None:
        """The title, if there is one."""
        return self._core.title

    @property
    def document(self) -> dict[str, Any]:
        """Parameters and start as exact texts, as in the orbit JSON."""
        found: dict[str, Any] = json.loads(self._core.document())
        return found

    def varied(self, values: Mapping[str, Value]) -> Scene:
        """Return the scene with other values of some keys: amplitude or A, gap or d, start.velocity, amplitude.2 and so on.

        The defaults of ``run`` are kept.
        """
        found = json.loads(self._core.varied([(key, text(key, value)) for key, value in values.items()]))
        run = dict(zip(TABLES["run"], self._core.run(), strict=True))
        return Scene.from_dict({"title": self.title, **tables_of(found), "run": run})

    def _answer(
        self, kind: type[Answer], verb: str, counted: tuple[str, int | None], how: tuple[bool, Progress, bool], **options: Any
    ) -> Answer:
        """Return the answer of a verb: what progress counts, up to how many; whether with a picture, its progress, and what Ctrl-C cuts.

        Options are those of the command line, which says what is accepted; None is their default.
        """
        return self._ask(kind, (verb, options_of(options)), counted, how)

    def _ask(
        self, kind: type[Answer], question: tuple[str, str], counted: tuple[str, int | None], how: tuple[bool, Progress, bool]
    ) -> Answer:
        """Return the answer to a verb with options as JSON."""
        picture, progress, keep_partial = how
        with reporting(progress, *counted) as report:
            return kept(kind(*_core.answer(self._core, self._path, question, picture, report)), keep_partial)

    def run(
        self,
        *,
        impacts: int | None = None,
        until: Value | None = None,
        digits: int | None = None,
        arithmetic: str | int = "auto",
        splice: int = 0,
        max_bits: int = MAX_BITS,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> Orbit:
        """Return the certified events of the scene.

        Parameters
        ----------
        impacts : int, optional
            Number of impacts to stop after; by default that of the scene, or 100 where there is no ``until`` either.
        until : number, optional
            Time to stop at [time]; by default that of the scene.
        digits : int, optional
            Requested width of enclosures, at most 10^-digits: of times relative to 2 pi/W, of velocities relative to A W; by default
            that of the scene, or 9.
        arithmetic : {"auto", "float", "interval", "inari", "shadow"} or int, default "auto"
            The arithmetic, or a number of bits; ``"float"`` certifies nothing.
        splice : int, default 0
            With ``"shadow"``: the first impacts that are proved in higher precision.
        max_bits : int, default 1000000
            Maximum precision of ``"auto"``, in bits.
        progress : bool or callable, optional
            A bar of tqdm, or a function that receives the number of impacts.
        keep_partial : bool, default False
            Whether Ctrl-C returns the part that is certified until then, instead of raising :class:`impact_pair.Stopped` with it.

        Returns
        -------
        Orbit
            The events, with their bounds and the outcome.

        Raises
        ------
        RangeError
            When an argument is out of range, or a value of the scene is beyond the range of flights.

        Examples
        --------
        >>> Scene.named("figure-14").run(impacts=2).walls
        array(['right', 'left'], dtype='<U5')

        """
        impacts = optional_whole("impacts", impacts, IMPACTS)
        options = {"impacts": impacts, "until": until, "digits": digits, "arithmetic": arithmetic, "splice": splice}
        return self._run(options_of(options | {"max_bits": max_bits}), impacts, (progress, keep_partial))

    def _run(self, requested: str, impacts: int | None, how: tuple[Progress, bool]) -> Orbit:
        """Return the orbit with options as JSON, as many impacts as progress counts up to."""
        progress, keep_partial = how
        with reporting(progress, "impacts", impacts) as report:
            return kept(Orbit(_core.run(self._core, requested, report), (self._text, requested)), keep_partial)

    def describe(
        self,
        *,
        impacts: int = 2000,
        depth: int = 6,
        max_bits: int = MAX_BITS,
        picture: bool = False,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> answers.Description:
        """Describe the motion: what becomes of it, its exponent, a trapping region and a horseshoe, and what is undecided.

        The questions are examined in the order of their cost, and only as far as the fate requires: no region and no horseshoe are
        looked for where the motion is attracted, periodic or at rest. Region and horseshoe need one harmonic.

        Parameters
        ----------
        impacts : int, default 2000
            Maximum number of impacts that are certified to decide the fate; in double precision ten times as many.
        depth : int, default 6
            Maximum number of impacts of a word of the horseshoe.
        max_bits : int, default 1000000
            Maximum precision of the orbit, in bits.
        picture : bool, default False
            Whether to draw time series, phase plane, impacts with region and h-sets, and itinerary.
        progress : bool or callable, optional
            A bar of tqdm, or a function that receives the amount done.
        keep_partial : bool, default False
            Whether Ctrl-C returns the part that is certified until then, instead of raising :class:`impact_pair.Stopped` with it.

        Returns
        -------
        Description
            The answer, with ``fate``, ``exponent_limit``, ``region``, ``entropy`` and ``undecided``.

        Raises
        ------
        RangeError
            When ``impacts`` or ``depth`` is out of range, or a value of the scene is beyond the range of flights.

        Examples
        --------
        >>> found = Scene.named("figure-13").describe()
        >>> found.fate, found.period
        ('attracted', (2, 1))
        >>> found.exponent_limit  # ln 0.5: both eigenvalues have the modulus e^2
        Bounds('-0.693147180559(95,89)')

        """
        options = {"impacts": impacts, "depth": depth, "max_bits": max_bits}
        return self._answer(answers.Description, "describe", ("impacts and boxes", None), (picture, progress, keep_partial), **options)

    def flights(
        self, t: npt.ArrayLike, v: npt.ArrayLike, wall: npt.ArrayLike, *, progress: Progress = None, keep_partial: bool = False
    ) -> Flights:
        """Return the next certified impacts of n states of this pair, each by itself, in doubles.

        Times ``t`` (n,) [time] and velocities ``v`` (n,) [length/time] just before the impact are exact doubles, ``wall`` (n,) is
        -1 for left and 1 for right; one of them may be a single number for all.
        """
        given = (doubles_of("t", t), doubles_of("v", v), doubles_of("wall", wall, np.int8))
        try:
            times, velocities, walls = np.broadcast_arrays(*given)
        except ValueError:
            shapes = ", ".join(str(one.shape) for one in given)
            raise RangeError(f"t, v and wall have the shapes {shapes}, but must have one", "t", shapes) from None
        if np.any(np.abs(walls) != 1):
            raise RangeError("wall holds other numbers, but accepted are -1 for left and 1 for right", "wall")
        states = (times.tobytes(), velocities.tobytes(), walls.tobytes())
        with reporting(progress, "flights", walls.size) as report:
            (sides, mappings, found_t, found_v), interrupted = _core.flights(self._core, states, report)
        sides_array, mappings_array = np.frombuffer(sides, dtype=np.int8), np.frombuffer(mappings, dtype=np.uint8)
        found = Flights(sides_array, doubles(found_t, -1, 2), doubles(found_v, -1, 2), mappings_array, interrupted)
        return kept(found, keep_partial)

    def box_map(self, rects: npt.ArrayLike, *, columns: int = 4096, progress: Progress = None, keep_partial: bool = False) -> BoxImages:
        """Return certified enclosures of the images of boxes under the impact map, in reduced coordinates.

        Every impact is mirrored to the left wall. Its phase is (W t + tau)/(2 pi) modulo 1 on the left wall, and half a period later
        on the right one; its speed is that before the impact over A W. The next impact of every motion with an impact in a box is in
        its image; at a graze both continuations are. For one harmonic.

        Parameters
        ----------
        rects : array (n, 4)
            Least phase, least speed, greatest phase, greatest speed of each box; speeds from 0, nothing beyond 1024.
        columns : int, default 4096
            Columns of a forcing period in which landings are found, a power of two: phases of images are multiples of its inverse.
        progress : bool or callable, optional
            A bar of tqdm, or a function that receives the number of boxes.
        keep_partial : bool, default False
            Whether Ctrl-C returns the part that is certified until then, instead of raising :class:`impact_pair.Stopped` with it.

        Returns
        -------
        BoxImages
            The rectangles, as ``rects`` of all landings, and as ``near`` and ``far`` of those on either wall; NaN where undecided.

        Raises
        ------
        RangeError
            When a box or ``columns`` is not as above, or the scene has several harmonics.

        Examples
        --------
        >>> found = Scene.named("figure-12").box_map([[0.0, 3.99, 0.01, 4.0], [0.6, 0.0, 0.7, 0.1]])
        >>> found.decided
        array([ True, False])
        >>> found.reasons[1]
        np.str_('rest')

        """
        return kept(box_map(self._core, rects, columns, progress), keep_partial)

    def sweep(
        self,
        over: Over,
        *,
        transient: int = 500,
        impacts: int = 300,
        digits: int = 6,
        arithmetic: str | int = "auto",
        max_bits: int = 100_000,
        summary: bool = False,
        executor: Executor | None = None,
        workers: int | None = None,
        resume: str | os.PathLike[str] | None = None,
        seconds: float = 10.0,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> SweepResult:
        """Certify an orbit at each point of a grid: bifurcation diagrams, exponents, basins.

        ``over`` has the keys that vary, one or two: ``{"amplitude": ("1", "10", 1000)}`` are 1000 exact values, evenly spaced,
        endpoints included; an array or a list such as ``np.linspace(1, 10, 1000)`` stands for its first and last value and their number,
        and the values between are spaced exactly. Of two keys the second one varies faster. Keys are those of the command line: amplitude,
        frequency, phase, gap, restitution, start.time, start.phase, start.position, start.velocity; with several harmonics amplitude.2
        and so on. Of each orbit ``transient`` impacts are skipped and ``impacts`` listed, or with ``summary`` none.

        ``executor`` computes: any ``concurrent.futures.Executor``, such as a ``ProcessPoolExecutor`` or Dask's ``client.get_executor()``;
        without one all processors of this process. It is sent chunks that take about ``seconds``, sized from the first ones, for as many
        ``workers`` as it has. With ``resume`` finished points are kept in that folder, in a file named by a hash of scene, grid and
        version: called again after a crash of a worker, the scheduler or this process, the sweep continues from there. Ctrl-C ends it with
        :class:`impact_pair.Stopped`, whose ``partial`` has the finished points and is ``interrupted``.
        """
        options = {"transient": transient, "impacts": impacts, "digits": digits, "arithmetic": arithmetic}
        options |= {"max_bits": max_bits, "summary": summary}
        how = {"executor": executor, "workers": workers, "resume": resume, "seconds": seconds, "progress": progress}
        return kept(SweepResult.of(question(self._text, "sweep", over, options), **how), keep_partial)

    def atlas(
        self,
        over: Over,
        *,
        cells: bool = False,
        effort: Number = 1,
        horseshoes: int | None = None,
        digits: int = 9,
        executor: Executor | None = None,
        workers: int | None = None,
        resume: str | os.PathLike[str] | None = None,
        seconds: float = 10.0,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> AtlasResult:
        """Prove where every motion goes at each point of a grid of two parameters, or for all parameters of cells.

        ``over`` has the two keys that vary, as for :meth:`sweep`; with ``cells`` the counts are those of the smallest cells along each
        axis. The start of the scene is not used. ``executor``, ``workers``, ``resume`` and ``seconds`` are those of :meth:`sweep`.
        ``effort`` multiplies the work for each point or cell: about 300,000 boxes in all for a point, 20,000 for a cell. With
        ``horseshoes`` undecided components of a point, and of a smallest cell, are searched for horseshoes of words of at most that many
        impacts.
        """
        options = {"cells": cells, "effort": effort, "horseshoes": horseshoes, "digits": digits}
        how = {"executor": executor, "workers": workers, "resume": resume, "seconds": seconds, "progress": progress}
        return kept(AtlasResult.of(question(self._text, "atlas", over, options), **how), keep_partial)

    def periodic(
        self,
        word: str,
        cycles: int,
        *,
        all: bool = False,
        digits: int | None = None,
        max_bits: int = MAX_BITS,
        no_witness: bool = False,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> answers.Periodic:
        """Prove the periodic orbits of a word (``"P2 P1"`` or ``"RL"``) in ``cycles`` forcing periods; ``all``: search everywhere.

        The document of a search has a witness, with which ``check`` proves that there are no others; ``no_witness`` leaves it out.
        """
        options = {"word": word, "cycles": cycles, "all": all, "digits": digits, "max_bits": max_bits, "no_witness": no_witness}
        return self._answer(answers.Periodic, "periodic", ("cells", None), (False, progress, keep_partial), **options)

    def two_impact(
        self,
        cycles: int | tuple[int, int] = 1,
        *,
        wall: str = "left",
        solve_for: str = "velocity",
        digits: int | None = None,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> answers.Periodic | list[answers.Periodic]:
        """Find all motions with two impacts in N cycles, (56)-(73); for a range of N one answer each, in a list.

        ``solve_for`` is ``"velocity"``, ``"amplitude"`` or ``"gap"``: which of the three the other two give.
        """
        options = {"cycles": both_ends("cycles", cycles), "wall": wall, "solve_for": solve_for, "digits": digits}
        found = self._answer(answers.TwoImpact, "two-impact", ("cycles", None), (False, progress, True), **options)
        return kept(found.each if isinstance(cycles, tuple) else found.each[0], keep_partial)

    def manifold(
        self,
        over: Mapping[str, tuple[Value, Value, int]],
        cycles: int | tuple[int, int] = 1,
        *,
        wall: str = "left",
        digits: int | None = None,
        picture: bool = False,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> answers.Manifold:
        """Return A_N (68) over ``{"frequency": (low, high, count)}`` or ``"velocity"``: figures 10 and 11."""
        options = {"manifold": grid(over, '{"frequency": (1, 60, 200)}'), "cycles": both_ends("cycles", cycles)}
        return self._answer(
            answers.Manifold, "two-impact", ("points", None), (picture, progress, keep_partial), **options, wall=wall, digits=digits
        )

    def bifurcations(
        self,
        word: str,
        cycles: int,
        over: Mapping[str, tuple[Value, Value]],
        *,
        doublings: int = 4,
        digits: int | None = None,
        max_bits: int = MAX_BITS,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> answers.Bifurcations:
        """Prove folds, pitchforks, period doublings and grazes of a word's orbits over ``{"amplitude": (low, high)}``."""
        options = {"word": word, "cycles": cycles, "over": ranged(over), "doublings": doublings, "digits": digits, "max_bits": max_bits}
        return self._answer(answers.Bifurcations, "bifurcations", ("steps", None), (False, progress, keep_partial), **options)

    def trap(
        self,
        *,
        effort: Number = 1,
        words: int | None = None,
        picture: bool = False,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> answers.Trap:
        """Prove a trapping region, and bound the number of words of ``words`` walls in it.

        ``effort`` multiplies the work, for narrower bounds: 2, 4, .., 64 bisect the boxes once, twice, .., 6 times.
        """
        return self._answer(answers.Trap, "trap", ("boxes", None), (picture, progress, keep_partial), effort=effort, words=words)

    def cycles(
        self,
        impacts: int | tuple[int, int],
        *,
        effort: Number = 1,
        digits: int | None = None,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> answers.Cycles:
        """Prove all periodic orbits in the region of ``trap`` with this ``effort``, of a number of impacts or a range of numbers."""
        options = {"impacts": both_ends("impacts", impacts), "effort": effort, "digits": digits}
        most = impacts[1] if isinstance(impacts, tuple) else impacts
        return self._answer(answers.Cycles, "cycles", ("impacts", most), (False, progress, keep_partial), **options)

    def windows(
        self,
        over: Mapping[str, tuple[Value, Value]],
        *,
        impacts: int = 40_000_000,
        effort: Number = 1,
        longest: int = 44,
        most: int = 10,
        digits: int | None = None,
        max_bits: int = MAX_BITS,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> answers.Windows:
        """Search stable periodic orbits over ``{"gap": (low, high)}`` and prove each with the window in which it is stable.

        ``impacts`` of floating-point orbits, times ``effort``, are searched for orbits of at most ``longest`` impacts of the reduced map;
        the ``most`` windows that are nearest to the scene's own value are proved.
        """
        counted = ("impacts", impacts if effort == 1 else None)
        options = {"over": ranged(over), "impacts": impacts, "effort": effort, "longest": longest, "most": most}
        return self._answer(
            answers.Windows, "windows", counted, (False, progress, keep_partial), **options, digits=digits, max_bits=max_bits
        )

    def global_analysis(
        self,
        *,
        effort: Number = 1,
        basins: bool = False,
        horseshoes: int | None = None,
        digits: int | None = None,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> answers.GlobalAnalysis:
        """Prove where every motion goes, whatever its start.

        ``effort`` multiplies the work: about 300,000 boxes in all, and 65,536 for ``basins``, which are those of attraction. With
        ``horseshoes`` undecided components, the four largest ones, are searched for horseshoes of words of at most that many impacts.
        """
        options = {"effort": effort, "basins": basins, "horseshoes": horseshoes, "digits": digits}
        return self._answer(answers.GlobalAnalysis, "global", ("boxes", None), (False, progress, keep_partial), **options)

    def tangency(
        self,
        over: Mapping[str, tuple[Value, Value]],
        *,
        word: str | None = None,
        longest: int = 18,
        most: int = 10,
        effort: Number = 1,
        digits: int | None = None,
        max_bits: int = MAX_BITS,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> answers.Tangencies:
        """Prove homoclinic tangencies of the equispaced motion over ``{"gap": (low, high)}``, or over ``amplitude`` or ``restitution``.

        They are searched along the flights of ``word`` (``F`` to the far wall, ``N`` back to the near one, from the unstable manifold
        to the stable one), or along all words of at most ``longest`` flights; the ``most`` that are nearest to the scene's own value are
        proved. ``effort`` multiplies the work without ``word``: about 30 million flights in floating point for each saddle, and as much
        again to follow folds, 10,000 flights each.
        """
        options = {"over": ranged(over), "word": word, "longest": longest, "most": most, "effort": effort}
        counted = ("impacts", None)
        return self._answer(
            answers.Tangencies, "tangency", counted, (False, progress, keep_partial), **options, digits=digits, max_bits=max_bits
        )

    def chaos(
        self,
        *,
        depth: int | None = None,
        effort: Number = 1,
        over: Mapping[str, tuple[Value, Value]] | None = None,
        bases: list[dict[str, Any]] | None = None,
        hyperbolic: bool = False,
        no_orbit: bool = False,
        no_witness: bool = False,
        picture: bool = False,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> answers.Chaos:
        """Prove a horseshoe and a lower bound of the topological entropy, for all values of ``over``, if given.

        Words have ``depth`` impacts at most, or as many as about a million boxes times ``effort`` lead to.
        With ``hyperbolic`` also exponents and dimension of the motions of its words: ``document["hyperbolic"]``. With ``no_orbit`` the
        document says nothing of the orbit of the scene's own start, as :func:`impact_pair.verify` requires it. The document
        has a witness, a strip for each word, with which ``check`` proves it; ``no_witness`` leaves it out.
        """
        options = {"depth": depth, "effort": effort, "over": None if over is None else ranged(over), "hyperbolic": hyperbolic}
        options |= {"bases": None if bases is None else json.dumps({"bases": bases}), "no_orbit": no_orbit}
        options |= {"no_witness": no_witness}
        return self._answer(answers.Chaos, "chaos", ("boxes", None), (picture, progress, keep_partial), **options)

    def chaos_cells(
        self,
        over: Mapping[str, tuple[Value, Value, int]],
        *,
        depth: int = 12,
        effort: Number = 1,
        picture: bool = False,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> answers.ChaosCells:
        """Prove, cell by cell over ``{"amplitude": (low, high, count)}``, that there is a horseshoe or an attractor.

        The cells are ``count`` equal parts of the range. An undecided cell is bisected at most 8 times, and once more where ``effort``
        doubles.
        """
        cells = grid(over, '{"amplitude": (1, 10, 40)}')
        counted = ("cells", int(cells.rpartition(":")[2]))
        return self._answer(answers.ChaosCells, "chaos", counted, (picture, progress, keep_partial), over=cells, effort=effort, depth=depth)

    def trade(
        self,
        *,
        impacts: int | None = None,
        max_bits: int = MAX_BITS,
        picture: bool = False,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> answers.Trade:
        """Measure the cost of accuracy: speed, reach and widths of each arithmetic, and the true errors of floating point."""
        return self._answer(
            answers.Trade, "trade", ("impacts", impacts), (picture, progress, keep_partial), impacts=impacts, max_bits=max_bits
        )

    def audit(
        self,
        events: str | os.PathLike[str] | Mapping[str, npt.ArrayLike] | Any,
        *,
        tolerance: Value = "1e-9",
        until: Value | None = None,
        columns: Sequence[str | int | None] = (None, None, None),
        velocities: bool = True,
        digits: int | None = None,
        max_bits: int = MAX_BITS,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> answers.Audit:
        """Compare another simulator's impacts with the certified orbit: inside, outside, missed, false; and where it diverges.

        ``events`` is the path of a list (CSV, other text, JSON), arrays by name (``time``, ``wall``, ``velocity``) or a DataFrame
        with such columns; doubles are compared with their exact values. ``columns`` names time, wall and velocity, or numbers them from 1.
        """
        if not isinstance(columns, (tuple, list)) or len(columns) != 3:
            raise RangeError(f"columns is {columns!r}, but must be three: of time, wall and velocity", "columns", repr(columns))
        options = dict(zip(("time_column", "wall_column", "velocity_column"), columns, strict=True))
        options |= {"events": answers.listing(events), "tolerance": tolerance, "until": until, "digits": digits, "max_bits": max_bits}
        if not velocities:
            options |= {"no_velocity": True, "velocity_column": None}
        try:
            return self._answer(answers.Audit, "audit", ("impacts", None), (False, progress, keep_partial), **options)
        except ListError as error:
            # Not the options of the command line, but the keyword.
            said = re.sub(r"by --\w+-column NAME or --\w+-column NUMBER", "in columns=", str(error))
            raise ListError(said, error.key, error.value) from None

    def plot(
        self,
        panels: str = "abcdefgh",
        *,
        cycles: int = 8,
        orbit_cycles: int = 40,
        impacts: int | None = None,
        until: Value | None = None,
        digits: int | None = None,
        arithmetic: str | int = "auto",
        splice: int = 0,
        max_bits: int = MAX_BITS,
        progress: Progress = None,
        keep_partial: bool = False,
    ) -> answers.Picture:
        """Draw panels of the paper's figures 12-17, by their letters, as SVG; for matplotlib see :mod:`impact_pair.plots`."""
        impacts = optional_whole("impacts", impacts, IMPACTS)
        options = {"impacts": impacts, "until": until, "digits": digits, "arithmetic": arithmetic, "splice": splice}
        requested = options_of(options | {"max_bits": max_bits})
        shown = (whole("cycles", cycles), whole("orbit_cycles", orbit_cycles))
        with reporting(progress, "impacts", impacts) as report:
            return kept(answers.Picture(*_core.plot(self._core, string("panels", panels), shown, requested, report)), keep_partial)

    def __repr__(self) -> str:
        words = ", ".join(f"{key}={value!r}" for key, value in self._keywords().items() if value is not None)
        return f"Scene({words})"

    def _keywords(self) -> dict[str, Any]:
        found = self.document
        shaken = {key: value[0] if len(value) == 1 else value for key, value in found["excitation"].items()}
        start = {key: value for key, value in found["start"].items() if key != "wall" or value != "left"}
        return shaken | {"gap": found["gap"], "restitution": found["restitution"]} | start | {"title": self.title}

    def _repr_html_(self) -> str:
        title = f"<b>{self.title}</b><br>" if self.title else ""
        return title + "<br>".join(self._core.words())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scene) and self._text == other._text

    def __hash__(self) -> int:
        return hash(self._text)

    def __reduce__(self) -> tuple[Any, ...]:
        return Scene.from_text, (self._text,)


def tables_of(document: Mapping[str, Any]) -> dict[str, Any]:
    """Return the tables of the scene of a document."""
    pair = {"gap": document["gap"], "restitution": document["restitution"]}
    return {"excitation": document["excitation"], "pair": pair, "start": document["start"]}


def both_ends(key: str, counts: int | tuple[int, int]) -> str:
    """Return a number, or the first and the last of a range, as on the command line."""
    if isinstance(counts, tuple) and len(counts) != 2:
        raise RangeError(f"{key} is {counts!r}, but must be a number, or a tuple of the first and the last", key, repr(counts))
    return "..".join(text(key, count) for count in (counts if isinstance(counts, tuple) else (counts,)))


def ranged(over: Mapping[str, tuple[Value, Value]]) -> str:
    """Return a key and its range in the syntax of the command line."""
    key, ends = single(over, '{"amplitude": (1, 2)}')
    if not isinstance(ends, (tuple, list)) or len(ends) != 2:
        raise RangeError(f"over of {key} is {ends!r}, but must be (low, high)", key, repr(ends))
    return f"{key}={text(key, ends[0])}..{text(key, ends[1])}"


def grid(over: Mapping[str, Any], example: str) -> str:
    """Return a key, the exact first and last of its values, and their number, as on the command line."""
    key, values = single(over, example)
    low, high, count = spaced(key, values)
    return f"{key}={text(key, low)}..{text(key, high)}:{count}"


def toml(tables: Mapping[str, Any]) -> str:
    """Return tables as a scene file, all numbers as exact texts."""
    if not isinstance(tables, Mapping):
        raise SceneError(f"the tables are {tables!r}, but must be a dict with {', '.join(TABLES)}", "tables", repr(tables))
    lines = []
    title = tables.get("title")
    if title is not None:
        lines.append(f"title = {json.dumps(title, ensure_ascii=False)}")
    unknown = [name for name in tables if name != "title" and name not in TABLES]
    if unknown:
        raise SceneError(f"{unknown[0]} is not a table of a scene: accepted are title, {', '.join(TABLES)}", unknown[0])
    for name, keys in TABLES.items():
        table = tables.get(name)
        if table is None:
            continue
        lines.append(f"[{name}]")
        if not isinstance(table, Mapping):
            raise SceneError(f"{name} is {table!r}, but must be a dict with {', '.join(keys)}", name, repr(table))
        for key, value in table.items():
            if f"{name}.{key}" == "start.wall" and not isinstance(value, (str, type(None))):
                raise SceneError(f'start.wall is {value!r}, but must be "left" or "right"', "start.wall", repr(value))
            if value is not None:
                is_word = f"{name}.{key}" in WORDS
                is_number = is_word and not isinstance(value, str)
                value = whole(f"{name}.{key}", value, IMPACTS) if is_number else value
                named = key if re.fullmatch(r"[\w-]+", str(key), re.ASCII) else json.dumps(str(key))
                lines.append(f"{named} = {json.dumps(value if is_word else texts(f'{name}.{key}', value))}")
    return "\n".join(lines) + "\n"
