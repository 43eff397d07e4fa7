"""Exceptions of the package, with a common base class; each has the key at fault and its value.

Hard questions are no errors: what cannot be proved is said by the outcome of the answer, ``undecided`` with its reason.
"""

from __future__ import annotations

import re
from decimal import Decimal
from typing import Any

#: Decimals that are longer than any double is typed.
LONG = re.compile(r"-?\d+\.\d{16,}(?:[eE][+-]?\d+)?")


def as_typed(said: str) -> str:
    """Return words in which the exact decimals of doubles are the short ones that they are typed as: -0.63."""

    def short(found: re.Match[str]) -> str:
        double = float(found[0])
        return repr(double) if Decimal(double) == Decimal(found[0]) else found[0]

    return LONG.sub(short, said)


class Error(Exception):
    """Base class of all errors of this package.

    ``key`` is the key of the scene, or the keyword, that is at fault, such as ``"pair.gap"``, and ``value`` its value as it was
    written; ``None`` where no single one is.
    """

    def __init__(self, message: str, key: str | None = None, value: str | None = None) -> None:
        super().__init__(as_typed(message))
        self.key = key
        self.value = None if value is None else as_typed(value)

    def __reduce__(self) -> tuple[type[Error], tuple[str, str | None, str | None]]:
        return type(self), (str(self), self.key, self.value)


class SceneError(Error, ValueError):
    """A malformed scene: a key unknown or missing, a value of the wrong kind, not TOML."""


class RangeError(Error, ValueError):
    """A value out of range."""


class WordError(Error, ValueError):
    """A word of mappings that is malformed."""


class CertificateError(Error, ValueError):
    """A malformed document."""


class ListError(Error, ValueError):
    """A malformed list of impacts."""


class MissingPackageError(Error, ImportError):
    """An optional package that is not installed; ``key`` is its name."""


class Interrupted(Error):
    """A sweep whose workers or scheduler were lost, or the whole grid of one that Ctrl-C ended; ``resume=`` keeps finished chunks."""


class Stopped(KeyboardInterrupt):
    """Ctrl-C during work: ``partial`` is its answer with the part certified until then; ``keep_partial=True`` returns that."""

    def __init__(self, partial: Any) -> None:
        super().__init__("stopped by Ctrl-C: the part that is certified is the partial of this exception")
        self.partial = partial

    def __reduce__(self) -> tuple[Any, ...]:
        return Stopped, (self.partial,)
