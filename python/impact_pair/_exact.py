"""Exact numbers as the texts that the library reads."""

from __future__ import annotations

import math
import operator
from collections.abc import Sequence
from decimal import Decimal
from fractions import Fraction
from typing import Any, SupportsIndex, TypeAlias

from .errors import RangeError

#: An exact number: an integer, a fraction, a decimal, an expression such as ``"3*pi"``, or a double, which is its exact binary
#: value (``0.1`` is not 1/10, ``"0.1"`` is).
Number: TypeAlias = "str | SupportsIndex | Fraction | Decimal | float"
#: A number, or a tuple of two for all values between them.
Value: TypeAlias = "Number | tuple[Number, Number]"


def plain(value: Any) -> Any:
    """Return a numpy scalar of any width, or an array of none, as the number of Python that it is; anything else as it is."""
    is_single = getattr(value, "ndim", None) == 0 and hasattr(value, "item")
    # A long double is more than a float: its item is itself.
    return value.item() if is_single else value


def whole(key: str, value: Any) -> int:
    """Return a whole number, also one that is written as a float; ``key`` names it in errors.

    Raises
    ------
    RangeError
        When it is none, or below 0.

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
    return found


def optional_whole(key: str, value: Any) -> int | None:
    """Return a whole number, if there is one."""
    return None if value is None else whole(key, value)


def text(key: str, value: Value) -> str:
    """Return a number as exact text, an interval as ``[low, high]``; ``key`` names it in errors."""
    value = plain(value)
    if isinstance(value, tuple):
        if len(value) != 2:
            raise RangeError(f"{key} is {value!r}, but an interval is a tuple of two numbers", key, repr(value))
        return f"[{text(key, value[0])}, {text(key, value[1])}]"
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        raise RangeError(f"{key} is {value}, but must be a number", key, str(value))
    if isinstance(value, Fraction):
        return f"{value.numerator}/{value.denominator}"
    if isinstance(value, (float, Decimal)):
        if not math.isfinite(value):
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
    if isinstance(value, (str, tuple)) or not isinstance(value, Sequence):
        return text(key, value)
    return [text(f"{key}.{i + 1}", one) for i, one in enumerate(value)]


def optional(key: str, value: Value | None) -> str | None:
    """Return a number as exact text, if there is one."""
    return None if value is None else text(key, value)
