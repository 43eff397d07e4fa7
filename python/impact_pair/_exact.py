"""Exact numbers as the texts that the library reads."""

from __future__ import annotations

import json
import math
import operator
from collections.abc import Iterable, Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any, SupportsIndex, TypeAlias, cast

import numpy as np

from .errors import RangeError

if TYPE_CHECKING:
    import numpy.typing as npt

#: An exact number: an integer, a fraction, a decimal, an expression such as ``"3*pi"``, or a double, which is its exact binary
#: value (``0.1`` is not 1/10, ``"0.1"`` is).
Number: TypeAlias = "str | SupportsIndex | Fraction | Decimal | float"
#: A number, or a tuple of two for all values between them.
Value: TypeAlias = "Number | tuple[Number, Number]"


#: The keys that are lists with several harmonics.
HARMONICS = tuple(f"excitation.{name}" for name in ("amplitude", "A", "frequency", "angular-frequency", "W", "phase", "tau"))
#: The greatest whole numbers that the library takes: of impacts and points, and of all else.
IMPACTS = 2**63 - 1
MOST = 2**32 - 1


def plain(value: Any) -> Any:
    """Return a numpy scalar of any width, or an array of none, as the number of Python that it is; anything else as it is."""
    is_single = getattr(value, "ndim", None) == 0 and hasattr(value, "item")
    # A value that is missing has a number behind its mask.
    found: Any = np.ma.masked if np.ma.is_masked(value) else value.item() if is_single else value
    # A long double is more than a float: its item is itself.
    is_long = isinstance(found, np.longdouble) and bool(np.isfinite(found))
    return Fraction(*found.as_integer_ratio()) if is_long else found


def whole(key: str, value: Any, most: int = MOST) -> int:
    """Return a whole number, also one that is written as a float; ``key`` names it in errors.

    Raises
    ------
    RangeError
        When it is none, below 0, or above ``most``.

    """
    value = plain(value)
    found: int | None = None
    if not isinstance(value, (bool, str)):
        try:
            found = int(value) if isinstance(value, (float, Decimal, Fraction)) and value == int(value) else operator.index(value)
        except (TypeError, ValueError, OverflowError):
            found = None
    if found is None:
        raise RangeError(f"{key} is {value!r}, but must be a whole number", key, str(value))
    if found < 0:
        raise RangeError(f"{key} is {value!r}, but must not be negative", key, str(value))
    if found > most:
        raise RangeError(f"{key} is {value!r}, but must be at most {most}", key, str(value))
    return found


def optional_whole(key: str, value: Any, most: int = MOST) -> int | None:
    """Return a whole number, if there is one."""
    return None if value is None else whole(key, value, most)


def string(key: str, value: Any) -> str:
    """Return a text; ``key`` names it in errors.

    Raises
    ------
    RangeError
        When it is none.

    """
    if not isinstance(value, str):
        raise RangeError(f"{key} is {value!r}, but must be a str", key, repr(value))
    return value


def doubles_near(key: str, values: Any, dtype: Any = np.float64) -> npt.NDArray[Any]:
    """Return an array of the doubles next to numbers; ``key`` names it in errors.

    Raises
    ------
    RangeError
        When these are none, or some are masked.

    """
    if np.ma.is_masked(values):
        raise RangeError(f"{key} is {values!r}, but must be numbers: some are masked", key, repr(values))
    try:
        given = np.asarray(values)
        # Among numbers in a list a truth value has become one.
        each: Iterable[Any] = [] if hasattr(values, "dtype") else np.asarray(values, dtype=object).flat
        if given.dtype.kind in "bc" or any(isinstance(one, (bool, np.bool_)) for one in each):
            raise RangeError(f"{key} is {values!r}, but must be real numbers", key, repr(values))
        return np.asarray(given, dtype=dtype)
    except (TypeError, ValueError, OverflowError) as error:
        raise RangeError(f"{key} is {values!r}, but must be numbers: {error}", key, repr(values)) from None


def doubles_of(key: str, values: Any, dtype: Any = np.float64) -> npt.NDArray[Any]:
    """Return an array of the numbers given, or of integers with ``dtype``; ``key`` names it in errors.

    Raises
    ------
    RangeError
        When these are none, some are masked, or one is no double (an integer that fits): it would become another number.

    """
    found = doubles_near(key, values, dtype)
    given = np.asarray(values)
    if given.dtype == found.dtype:
        return found
    # As numbers of Python, which are compared exactly.
    same = [own == one or math.isnan(one) for own, one in zip(given.ravel().tolist(), found.ravel().tolist(), strict=True)]
    if not all(same):
        said = f"{key} holds {given.ravel()[same.index(False)]!r}, which is not exactly a number of {np.dtype(dtype)}"
        raise RangeError(said, key, repr(values))
    return found


def single(over: Any, example: str) -> tuple[str, Any]:
    """Return the only key of what a range is given by, and its values.

    Raises
    ------
    RangeError
        When there is not one key.

    """
    if not isinstance(over, Mapping) or len(over) != 1:
        raise RangeError(f"over is {over!r}, but must be a dict with one key, such as {example}", "over", repr(over))
    [(key, values)] = over.items()
    return string("over", key), values


def text(key: str, value: Value) -> str:
    """Return a number as exact text, an interval as ``[low, high]``; ``key`` names it in errors."""
    value = plain(value)
    if isinstance(value, tuple):
        if len(value) != 2:
            raise RangeError(f"{key} is {value!r}, but an interval is a tuple of two numbers", key, repr(value))
        low, high = (plain(end) for end in value)
        is_known = not isinstance(low, (str, tuple)) and not isinstance(high, (str, tuple))
        if is_known and text(key, low) and text(key, high) and low > high:
            raise RangeError(f"{key} is {value!r}, but an interval is (low, high) with low <= high", key, repr(value))
        return f"[{text(key, low)}, {text(key, high)}]"
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        raise RangeError(f"{key} is {value}, but must be a number", key, str(value))
    if isinstance(value, Fraction):
        return f"{value.numerator}/{value.denominator}"
    if isinstance(value, (float, Decimal)):
        if not (value.is_finite() if isinstance(value, Decimal) else math.isfinite(value)):
            raise RangeError(f"{key} is {value}, but must be finite", key, str(value))
        # Exact: each double is a decimal.
        return str(Decimal(value))
    try:
        return str(operator.index(value))
    except TypeError:
        message = f"{key} is {value!r}, but must be an int, a Fraction, a Decimal, a float or an expression in a str"
        raise RangeError(message, key, repr(value)) from None


def texts(key: str, value: Value | Sequence[Value]) -> str | list[str]:
    """Return a number, or a list of them for several harmonics, as exact texts."""
    if isinstance(value, np.ndarray) and value.ndim == 1:
        value = value.tolist()
    if not isinstance(value, Sequence) or isinstance(value, (str, tuple, bytes)):
        return text(key, cast("Value", value))
    if key not in HARMONICS:
        raise RangeError(f"{key} is {value!r}, but must be a single number; (low, high) stands for all between", key, repr(value))
    return [text(f"{key}.{i + 1}", one) for i, one in enumerate(value)]


def options_of(options: Mapping[str, Any]) -> str:
    """Return options as JSON, named as on the command line: switches, texts and lists as they are, numbers as exact texts."""

    def said(key: str, value: Any) -> Any:
        value = plain(value)
        return value if value is None or isinstance(value, (bool, list)) else text(key, value)

    return json.dumps({key.replace("_", "-"): said(key, value) for key, value in options.items()})
