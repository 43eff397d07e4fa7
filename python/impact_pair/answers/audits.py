"""Lists of impacts of other programs, compared with the certified orbit."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np

from .._document import Document
from .._exact import plain
from .._file import read
from ..errors import ListError


class Audit(Document):
    """An audit: another simulator's list, compared with the certified orbit."""

    @property
    def certified(self) -> bool:
        """Always true: the list is compared with a certified orbit."""
        return True

    @property
    def agreed(self) -> bool:
        """True if all rows are inside or in a chatter, and no impact is missed."""
        return bool(self.document["agreed"])

    @property
    def message(self) -> str:
        """The result in words."""
        return str(self.document["message"])

    @property
    def unused_columns(self) -> list[str]:
        """The columns of the list that were not read."""
        return list(self.document["unused_columns"])

    @property
    def counts(self) -> dict[str, int]:
        """Number of rows or certified impacts with each verdict."""
        return dict(self.document["counts"])

    @property
    def first_disagreement(self) -> dict[str, Any] | None:
        """Impact, verdict and row of the first one, if any."""
        found: dict[str, Any] | None = self.document.get("first_disagreement")
        return found

    @property
    def events(self) -> list[dict[str, Any]]:
        """Verdict, row, listed values, certified values and errors, for each row and each missed impact."""
        return list(self.document["events"])

    def to_pandas(self) -> Any:
        """Return a DataFrame with one row per event."""
        import pandas as pd

        return pd.json_normalize(self.events)

    def __repr__(self) -> str:
        return self.message


def listing(events: str | os.PathLike[str] | Mapping[str, Any] | Any) -> str:
    """Return another simulator's impacts as text: a file's, or arrays by name as CSV, each number as its exact decimal.

    Raises
    ------
    ListError
        When it is none of these, some values are masked, or the columns are of several lengths.

    """
    if isinstance(events, (str, os.PathLike)):
        return read(events, ListError)
    if not isinstance(events, Mapping) and not hasattr(events, "columns"):
        raise ListError(f"events is {events!r}, but must be a path, arrays by name or a DataFrame", "events", repr(events))
    named = dict(events) if isinstance(events, Mapping) else {name: events[name] for name in events.columns}
    masked = [name for name, column in named.items() if np.ma.is_masked(column)]
    if masked:
        raise ListError(f"{masked[0]} has masked values, but must be numbers or names of walls", "events", str(masked[0]))
    columns = [np.asarray(column) for column in named.values()]
    lengths = [len(column) for column in columns]
    if len(set(lengths)) > 1:
        said = f"the columns have {', '.join(map(str, lengths))} values, but must have one number of them"
        raise ListError(said, "events", repr(lengths))
    out = io.StringIO()
    rows = csv.writer(out)
    rows.writerow([heading(name, place + 1) for place, name in enumerate(named)])
    rows.writerows([[decimal(cell) for cell in row] for row in zip(*columns, strict=True)])
    return out.getvalue()


def heading(name: Any, place: int) -> str:
    """Return the name of a column: where it is a number, as a DataFrame without names has, one that cannot be taken for a value."""
    try:
        float(name)
    except (TypeError, ValueError):
        return str(name)
    return f"column {place}"


def decimal(cell: Any) -> str:
    """Return a value of a list as text: of a double or a long double its exact decimal."""
    if isinstance(cell, (float, np.floating)):
        value = plain(cell)
        if not isinstance(value, Fraction):
            return str(Decimal(float(value)))
        # A long double: over a power of two, so that it is a whole number over that power of ten.
        power = value.denominator.bit_length() - 1
        return f"{value.numerator * 5**power}e-{power}"
    return str(cell)
