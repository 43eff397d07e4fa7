"""``verify``: a document checked by a program that is extracted from its proof in Coq."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .errors import Error
from .verdicts import text_of

if TYPE_CHECKING:
    from .verdicts import Source

PROGRAM = "impact-pair-verified"
#: Verdicts, by the exit codes that go with them.
VERDICTS = {0: "verified", 1: "not verified", 2: "unreadable"}


@dataclass(frozen=True)
class Verified:
    """The answer of the verified checker; true if the document is verified."""

    #: ``verified``, ``not verified`` or ``unreadable``.
    verdict: str
    #: The claim of the document, in the words of the theorem; ``None`` where the theorem does not cover it.
    claim: str | None
    #: The reason why it is not verified.
    reason: str | None

    def __bool__(self) -> bool:
        return self.verdict == "verified"


def program() -> Path:
    """Return the path of the program: in this package, beside the interpreter, or on PATH."""
    name = PROGRAM + (".exe" if os.name == "nt" else "")
    for folder in (Path(__file__).parent, Path(sys.executable).parent):
        if (folder / name).is_file():
            return folder / name
    found = shutil.which(PROGRAM)
    if found is None:
        message = f"{PROGRAM} is neither in the package nor beside {sys.executable} nor on PATH: validation/coq/verified/build builds it"
        raise Error(message)
    return Path(found)


def verify(document: Source | Mapping[str, Any]) -> Verified:
    """Verify a document with a checker that is proved in Coq: an answer, a dict, the path of a file, or its text.

    Verified are orbits of ``run``, the orbits of ``periodic``, the region of ``trap`` and the horseshoe of ``chaos``, as far as
    ``docs/verified.md`` says.
    A document that claims more is not verified: of ``chaos`` leave out ``scene_orbit``, by ``no_orbit=True``. An :class:`Error` says
    so where the program ``impact-pair-verified`` is not found, or stops without a verdict.
    """
    text = json.dumps(dict(document)) if isinstance(document, Mapping) else text_of(document)
    done = subprocess.run([program(), "-"], input=text.encode(), capture_output=True, check=False)
    lines = done.stdout.decode(errors="replace").splitlines() or [""]
    verdict, _, reason = lines[-1].partition(": ")
    if verdict != VERDICTS.get(done.returncode):
        message = f"{PROGRAM} stopped without a verdict: {done.stderr.decode(errors='replace').strip()}"
        raise Error(message)
    claims = [line.removeprefix("claim: ") for line in lines[:-1] if line.startswith("claim: ")]
    return Verified(verdict, claims[0] if claims else None, reason or None)
