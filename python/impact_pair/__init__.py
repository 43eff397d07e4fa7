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
from .errors import CertificateError, Error, Interrupted, ListError, RangeError, SceneError, WordError
from .orbit import Event, Flights, Graze, Impact, Orbit, Outcome, Release, Rest, States
from .orbit import read as read_orbit
from .scene import MAX_BITS, Scene
from .sweep import SweepResult
from .verdicts import Check, Claim, Theorem, check, prove
from .verified import Verified, verify

__all__ = [
    "Bounds",
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
    "Orbit",
    "Outcome",
    "RangeError",
    "Release",
    "Rest",
    "Scene",
    "SceneError",
    "States",
    "SweepResult",
    "Theorem",
    "Verified",
    "WordError",
    "__version__",
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
) -> Orbit:
    """Return the certified impacts under the excitation A sin(W t + tau), with gap d and restitution e, in the paper's notation.

    A, d, y0 [length], W [rad/time], tau [rad], t0, until [time], v0 [length/time]: exact numbers, see :class:`Scene`. The ball starts
    at t0 on a ``wall`` (``"left"``, the default, or ``"right"``) with velocity v0 just before the impact, or inside the gap at y0. What
    comes back has the arrays ``t``, ``v`` (n,), ``t_bounds``, ``v_bounds`` (n, 2) and ``wall`` (n,) of the impacts and, called with
    times, says where the ball is then.
    """
    scene = Scene(amplitude=A, frequency=W, phase=tau, gap=d, restitution=e, time=t0, wall=wall, position=y0, velocity=v0)
    return scene.run(impacts=impacts, until=until, digits=digits, arithmetic=arithmetic, max_bits=max_bits, progress=progress)
