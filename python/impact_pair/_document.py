"""Base class of all answers: their document, and its export."""

from __future__ import annotations

import html
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ._file import ending, write

if TYPE_CHECKING:
    import os

    from ._exact import Number
    from .verdicts import Check


def counted(count: int, what: str, plural: str | None = None) -> str:
    """Return how many there are: ``1 orbit``, ``2 orbits``."""
    return f"{count} {what if count == 1 else plural or what + 's'}"


class Document:
    """An answer: the document that the command line writes with ``--format json``, and whether it is complete."""

    def __init__(
        self, text: str | None, complete: bool | None = None, interrupted: bool = False, svg: str | None = None, status: str | None = None
    ) -> None:
        # Without a document nothing is proved.
        self._text = json.dumps({"certified": False, "message": status}) if text is None else text
        self._status = status
        self._complete = complete
        self._interrupted = interrupted
        self._svg = svg
        self._document: dict[str, Any] | None = None

    @property
    def document(self) -> dict[str, Any]:
        """The document as a dict; bounds are pairs of decimals in strings, rounded outward."""
        if self._document is None:
            self._document = json.loads(self.json())
        return self._document

    @property
    def certified(self) -> bool:
        """True if the claims of the document are proved."""
        return bool(self.document["certified"])

    @property
    def complete(self) -> bool | None:
        """True if everything requested is certified: the command line's exit code 0. ``None`` for a document that was read."""
        return self._complete

    @property
    def interrupted(self) -> bool:
        """True if Ctrl-C ended the computation: the document has what was proved until then."""
        return self._interrupted

    @property
    def status(self) -> str | None:
        """How much of what was requested is certified, and which keyword is known to help; ``None`` for a document that was read."""
        return self._status

    @property
    def svg(self) -> str | None:
        """The picture, if requested."""
        return self._svg

    def json(self) -> str:
        """Return the document as text."""
        return self._text

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write ``.json``, the document, or ``.svg``, the picture that was requested; the file is written atomically.

        Raises
        ------
        RangeError
            When the name has another ending, or there is no picture.

        """
        path = Path(path)
        accepted = (".json",) if self.svg is None else (".json", ".svg")
        said = self.svg if ending(path, accepted) == ".svg" else self.json().rstrip("\n") + "\n"
        write(path, [(said or "").encode()])

    def check(self, effort: Number = 1) -> Check:
        """Prove every claim again, by another route; see :func:`impact_pair.check`."""
        from .verdicts import check

        return check(self.json(), effort=effort)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.json(), self._complete, self._interrupted, self._svg, self._status)

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(repr(self))}</pre>"
