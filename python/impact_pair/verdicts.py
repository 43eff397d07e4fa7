"""``check`` and ``prove``: what a document claims, proved again, and as a theorem for Coq."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from . import _core
from ._document import Document
from ._file import ending, write
from ._progress import Progress, reporting

if TYPE_CHECKING:
    from typing import TypeAlias

    #: An answer, the path of a file, or the text of a document.
    Source: TypeAlias = "Document | os.PathLike[str] | str"


@dataclass(frozen=True)
class Claim:
    """A claim of a document and what a check found of it."""

    #: Where it stands: ``events[0].time``.
    path: str
    #: confirmed, refuted or undecided, as are those after the first one that is not confirmed.
    verdict: str
    #: Why it is not confirmed: of the claim that decides.
    reason: str | None


@dataclass(frozen=True)
class Check:
    """What a check found; true where every claim is proved again."""

    #: confirmed, refuted, undecided or interrupted.
    verdict: str
    #: Which claims, and what is wrong with one.
    message: str
    #: Where the document has what claims nothing, or what no lemma of ``check`` is about.
    unjudged: list[str]
    #: All that is judged, in the order of the document.
    claims: list[Claim]

    def __bool__(self) -> bool:
        return self.verdict == "confirmed"


@dataclass(frozen=True)
class Theorem:
    """A file for Coq."""

    text: str
    #: How many impacts it proves.
    impacts: int
    #: Why not all that were asked for, if so.
    stop: str | None

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the file, whose name ends in ``.v``."""
        path = Path(path)
        ending(path, (".v",))
        write(path, [self.text.encode()])


def text_of(source: Source) -> str:
    """Return the text of a document."""
    if isinstance(source, Document):
        return source.json()
    if isinstance(source, str) and source.lstrip()[:1] in ("{", "["):
        return source
    return Path(source).read_text(encoding="utf-8")


def check(source: Source, *, effort: int = 1, progress: Progress = None) -> Check:
    """Prove every claim of a document again, by another route, from its own numbers.

    ``effort`` allows so many times the work for each claim before it is left undecided.
    """
    with reporting(progress, "claims") as tell:
        verdict, message, unjudged, claims = _core.check(text_of(source), effort, tell)
    return Check(verdict, message, unjudged, [Claim(*claim) for claim in claims])


def prove(source: Source, impacts: int | None = None, *, progress: Progress = None) -> Theorem:
    """Return a Coq file whose theorem says what an orbit says, of its first ``impacts`` or of all."""
    with reporting(progress, "impacts", impacts) as tell:
        return Theorem(*_core.prove(text_of(source), impacts, tell))
