"""Verified numerics for the horizontal impact pair: a ball between the two walls of an excited box, every impact proved.

>>> import impact_pair
>>> sol = impact_pair.solve(A=8, W="pi", d="9.42497", e="0.5", v0="-12.56636", impacts=200)
>>> sol.certified, sol.outcome.kind, sol.t_bounds.shape
(True, 'impacts-reached', (200, 2))
>>> sol[2].time
Bounds('2.487100613920(68,71)')
>>> float(sol(1.0).y[0])  # where the ball is at t = 1
2.84459...

A bracket holds the last digits of the lower and the upper bound, rounded outward. Certified bounds contain the true value of the
exact problem: ``"9.42497"`` is 942497/100000 and ``"pi"`` is pi. Units are those of the scene: length, time, radians.
"""

from __future__ import annotations

from collections.abc import Sequence

from ._core import __version__
from ._exact import Value
from ._progress import Progress
from .bounds import Bounds
from .boxes import BoxImages
from .errors import CertificateError, Error, Interrupted, ListError, MissingPackageError, RangeError, SceneError, Stopped, WordError
from .orbit import Event, Flights, Graze, Impact, Orbit, Outcome, Release, Rest, States
from .orbit import read as read_orbit
from .questions import ask
from .scene import MAX_BITS, Scene
from .sweep import SweepResult
from .verdicts import Check, Claim, Theorem, check, prove
from .verified import Verified, verify

__all__ = [
    "Bounds",
    "BoxImages",
    "CertificateError",
    "Check",
    "Claim",
    "Error",
    "Event",
    "Flights",
    "Graze",
    "Impact",
    "Interrupted",
    "ListError",
    "MissingPackageError",
    "Orbit",
    "Outcome",
    "RangeError",
    "Release",
    "Rest",
    "Scene",
    "SceneError",
    "States",
    "Stopped",
    "SweepResult",
    "Theorem",
    "Verified",
    "WordError",
    "__version__",
    "ask",
    "check",
    "prove",
    "read_orbit",
    "solve",
    "verify",
]


def solve(
    *,
    A: Value | Sequence[Value],
    W: Value | Sequence[Value],
    d: Value,
    e: Value,
    v0: Value,
    tau: Value | Sequence[Value] = 0,
    t0: Value = 0,
    wall: str | None = None,
    y0: Value | None = None,
    impacts: int | None = None,
    until: Value | None = None,
    digits: int = 9,
    arithmetic: str | int = "auto",
    max_bits: int = MAX_BITS,
    progress: Progress = None,
    keep_partial: bool = False,
) -> Orbit:
    """Return the certified impacts under the excitation A sin(W t + tau), with gap d and restitution e, in the paper's notation.

    Numbers are exact, see :class:`Scene`: ``"0.63"`` is 63/100, but the float ``0.63`` is its binary value, which is not 63/100. A tuple
    ``(low, high)`` stands for all values between.

    Parameters
    ----------
    A : number, tuple, or list of them for several harmonics
        Amplitude of the excitation [length].
    W : number, tuple, or list of them
        Angular frequency [rad/time].
    d : number or tuple
        Gap: the distance that the ball travels from wall to wall [length].
    e : number or tuple
        Restitution coefficient, from 0 to 1.
    v0 : number or tuple
        Relative velocity at the start [length/time]; on a wall just before the impact: at most 0 on the left one, at least 0 on the right.
    tau : number, tuple, or list of them, default 0
        Phase of the excitation [rad].
    t0 : number or tuple, default 0
        Time of the start [time].
    wall : {"left", "right"}, default "left"
        The wall of the start; not with ``y0``.
    y0 : number or tuple, optional
        Relative displacement at a start inside the gap, from its middle [length].
    impacts, until, digits, arithmetic, max_bits, progress, keep_partial
        How far the orbit is followed, and how, as in :meth:`Scene.run`.

    Returns
    -------
    Orbit
        With the arrays ``t``, ``v`` (n,), ``t_bounds``, ``v_bounds`` (n, 2) and ``wall`` (n,) of the impacts; called with times it
        returns bounds of the motion then. What is undecided is said by its ``outcome``.

    Raises
    ------
    SceneError
        When a number does not read as one, or a value has the wrong kind.
    RangeError
        When a value is out of range; ``key`` and ``value`` of the error name it.
    Stopped
        On Ctrl-C, as a ``KeyboardInterrupt``, with the orbit that is certified until then as ``partial``.

    Examples
    --------
    >>> sol = solve(A=8, W="pi", d="9.42497", e="0.5", v0="-12.56636", impacts=3)
    >>> [str(impact.time) for impact in sol]
    ['0.55134802021852(08,17)', '1.6659842879656(05,12)', '2.487100613920(68,71)']
    >>> sol.outcome.message
    '3 impacts'

    """
    scene = Scene(amplitude=A, frequency=W, phase=tau, gap=d, restitution=e, time=t0, wall=wall, position=y0, velocity=v0)
    how = {"progress": progress, "keep_partial": keep_partial}
    return scene.run(impacts=impacts, until=until, digits=digits, arithmetic=arithmetic, max_bits=max_bits, **how)  # type: ignore[arg-type]
