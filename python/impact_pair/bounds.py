"""Bounds of numbers: as exact decimals, as doubles rounded outward, as balls of other packages."""

from __future__ import annotations

import math
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from . import _core
from ._exact import plain

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    import numpy.typing as npt

    Doubles = npt.NDArray[np.float64]

Array = TypeVar("Array", bound="npt.NDArray[Any]")


def doubles(data: bytes, *shape: int) -> Doubles:
    """Return bytes of doubles as an array of this shape, read-only."""
    return np.frombuffer(data, dtype=np.float64).reshape(shape)


def fixed(values: Array) -> Array:
    """Return an array, read-only."""
    values.flags.writeable = False
    return values


def outward(bounds: Iterable[Sequence[str]]) -> Doubles:
    """Return pairs of decimals as an array (n, 2) of doubles: lower ends rounded down, upper ones up."""
    return doubles(_core.outward([(lower, upper) for lower, upper in bounds]), -1, 2)


def middles(bounds: Doubles) -> Doubles:
    """Return the doubles (n,) near the middles of bounds (n, 2): infinite where both are the same infinity, NaN where one is infinite."""
    low, high = bounds[:, 0], bounds[:, 1]
    with np.errstate(invalid="ignore", over="ignore"):
        width = high - low
        # Of bounds near the greatest doubles the width is none.
        middle = np.where(np.isinf(width), 0.5 * low + 0.5 * high, low + 0.5 * width)
        return np.where(low == high, low, np.where(np.isinf(low) | np.isinf(high), np.nan, middle))


def radii(bounds: Doubles) -> Doubles:
    """Return the distances (n,) from the middles to the ends of bounds (n, 2), rounded up; infinite where one of these is."""
    low, high, middle = bounds[:, 0], bounds[:, 1], middles(bounds)
    with np.errstate(invalid="ignore"):
        radius = np.maximum(high - middle, middle - low)
        radius = np.where(radius > 0, np.nextafter(radius, np.inf), radius)
    return np.where(low == high, 0.0, np.where(np.isinf(low) | np.isinf(high), np.inf, radius))


@dataclass(frozen=True)
class Bounds:
    """A number that is proved to lie between two decimals, rounded outward.

    >>> Bounds("2.48710061392068445", "2.48710061392070662")
    Bounds('2.487100613920(68,71)')
    """

    #: The decimals, exact texts.
    lower: str
    upper: str

    @property
    def decimals(self) -> tuple[str, str]:
        """Both bounds as decimals."""
        return self.lower, self.upper

    @property
    def float64(self) -> tuple[float, float]:
        """Both bounds as doubles, the lower one rounded down, the upper one up."""
        low, high = outward([self.decimals])[0]
        return float(low), float(high)

    @property
    def mid(self) -> float:
        """A double near the middle; NaN where one bound is infinite."""
        return float(middles(outward([self.decimals]))[0])

    @property
    def rad(self) -> float:
        """The distance from ``mid`` to the bounds, rounded up."""
        return float(radii(outward([self.decimals]))[0])

    @property
    def fractions(self) -> tuple[Fraction, Fraction]:
        """Both bounds as exact fractions."""
        return Fraction(Decimal(self.lower)), Fraction(Decimal(self.upper))

    def __contains__(self, number: float | Fraction | Decimal) -> bool:
        low, high = (Decimal(end) for end in self.decimals)
        number = plain(number)
        if isinstance(number, (float, Decimal)):
            # Compared exactly; what is no number is in no bounds.
            return not math.isnan(number) and bool(low <= number <= high)
        return bool(low <= Fraction(number) <= high)

    def arb(self) -> Any:
        """Return a ball of python-flint that holds the number; in the precision that is set there."""
        from flint import arb

        low, high = (arb(end) for end in self.decimals)
        return low.union(high)

    def iv(self) -> Any:
        """Return an interval of mpmath that holds the number; in the precision that is set there."""
        from mpmath import iv

        return iv.mpf([iv.mpf(self.lower).a, iv.mpf(self.upper).b])

    def __str__(self) -> str:
        return _core.bracket(self.lower, self.upper)

    def __repr__(self) -> str:
        return f"Bounds({str(self)!r})"

    def __float__(self) -> float:
        return self.mid


def pair(bounds: Sequence[str] | None) -> Bounds | None:
    """Return the bounds of a document, if there are any."""
    return None if bounds is None else Bounds(bounds[0], bounds[1])
