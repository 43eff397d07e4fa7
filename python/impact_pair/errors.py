"""What cannot be asked: exceptions of one root, each with the key at fault and its value.

Hard questions are no errors: what cannot be proved is said by the outcome of the answer, ``undecided`` with its reason.
"""

from __future__ import annotations


class Error(Exception):
    """The root of all errors of this package.

    ``key`` is the key of the scene, or the keyword, that is at fault, such as ``"pair.gap"``, and ``value`` its value as it was
    written; ``None`` where no single one is.
    """

    def __init__(self, message: str, key: str | None = None, value: str | None = None) -> None:
        super().__init__(message)
        self.key = key
        self.value = value

    def __reduce__(self) -> tuple[type[Error], tuple[str, str | None, str | None]]:
        return type(self), (str(self), self.key, self.value)


class SceneError(Error, ValueError):
    """A scene that does not read as one: a key unknown or missing, a value of the wrong kind, no TOML."""


class RangeError(Error, ValueError):
    """A value outside what is accepted."""


class WordError(Error, ValueError):
    """A word of mappings that is malformed."""


class CertificateError(Error, ValueError):
    """A document that does not read as one of this program."""


class ListError(Error, ValueError):
    """A list of impacts that does not read as one."""


class Interrupted(Error):
    """A sweep whose workers or scheduler went away; with ``resume=`` all finished chunks are kept."""
