"""``check`` and ``prove``: the claims of a document, proved again, or as a theorem of Coq."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _core
from ._document import Document
from ._exact import Number, optional_whole, text
from ._file import ending, read, write
from ._progress import Progress, kept, reporting
from .errors import CertificateError

if TYPE_CHECKING:
    from typing import TypeAlias

    #: An answer, the path of a file, or a document as text or as a dict.
    Source: TypeAlias = "Document | os.PathLike[str] | str | Mapping[str, Any]"


@dataclass(frozen=True)
class Claim:
    """A claim of a document and its verdict."""

    #: Path of the claim, such as ``events[0].time``.
    path: str
    #: confirmed, refuted or undecided, as are those after the first one that is not confirmed.
    verdict: str
    #: The reason why it is not confirmed, at the deciding claim.
    reason: str | None


@dataclass(frozen=True)
class Check:
    """The result of a check; true if every claim is proved again."""

    #: confirmed, refuted, undecided or interrupted.
    verdict: str
    #: The claims checked, and the fault, if any.
    message: str
    #: The theorem in words, if the document is confirmed; the claims of ``unchecked_claims`` are no part of it.
    theorem: str | None
    #: Paths of the values that are not checked: they claim nothing, or no lemma of ``check`` covers them.
    unjudged: list[str]
    #: The keys among these that claim something.
    unchecked_claims: list[str]
    #: All claims checked, in the order of the document.
    claims: list[Claim]

    @property
    def interrupted(self) -> bool:
        """True if Ctrl-C ended the check: the claims until then are confirmed."""
        return self.verdict == "interrupted"

    def __bool__(self) -> bool:
        return self.verdict == "confirmed"


@dataclass(frozen=True)
class Theorem:
    """A file for Coq."""

    text: str
    #: Number of impacts that it proves.
    impacts: int
    #: The reason why not all requested impacts are proved, if so.
    stop: str | None
    #: True if Ctrl-C ended it.
    interrupted: bool
    #: What the document claims besides, in words, if it does: events from the first other one on, an outcome of another kind.
    left_out: str | None

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the file, whose name ends in ``.v``."""
        path = Path(path)
        ending(path, (".v",))
        write(path, [self.text.encode()])


def text_of(source: Source) -> str:
    """Return the text of a document."""
    if isinstance(source, Document):
        return source.json()
    if isinstance(source, Mapping):
        return json.dumps(source, ensure_ascii=False)
    if isinstance(source, str) and source.lstrip()[:1] in ("{", "["):
        return source
    return read(source, CertificateError)


def check(source: Source, *, effort: Number = 1, progress: Progress = None, keep_partial: bool = False) -> Check:
    """Prove every claim of a document again, by an independent method, from its own numbers.

    ``effort`` multiplies the work allowed for each claim before it is left undecided.
    """
    with reporting(progress, "claims") as report:
        verdict, message, theorem, unjudged, unchecked_claims, claims = _core.check(text_of(source), text("effort", effort), report)
    found = Check(verdict, message, theorem, unjudged, unchecked_claims, [Claim(*claim) for claim in claims])
    return kept(found, keep_partial)


def prove(source: Source, impacts: int | None = None, *, progress: Progress = None, keep_partial: bool = False) -> Theorem:
    """Return a Coq file whose theorem states the claims of an orbit, for its first ``impacts`` or all."""
    impacts = optional_whole("impacts", impacts)
    with reporting(progress, "impacts", impacts) as report:
        return kept(Theorem(*_core.prove(text_of(source), impacts, report)), keep_partial)
