"""Questions as JSON: a verb, a scene as in documents, and options as on the command line."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from . import _core, answers
from ._document import Document
from ._grid import GridResult, Question
from ._progress import Progress, kept
from .atlas import AtlasResult
from .errors import RangeError
from .scene import Scene, tables_of
from .sweep import SweepResult

#: The answer of each verb but ``run``.
ANSWERS: dict[str, type[Document]] = {
    "audit": answers.Audit,
    "bifurcations": answers.Bifurcations,
    "chaos": answers.Chaos,
    "cycles": answers.Cycles,
    "describe": answers.Description,
    "global": answers.GlobalAnalysis,
    "periodic": answers.Periodic,
    "tangency": answers.Tangencies,
    "trade": answers.Trade,
    "trap": answers.Trap,
    "two-impact": answers.TwoImpact,
    "windows": answers.Windows,
}


#: The answer of each verb over a grid.
GRIDS: dict[str, type[GridResult]] = {"atlas": AtlasResult, "sweep": SweepResult}


def ask(
    question: str | Mapping[str, Any], *, picture: bool = False, progress: Progress = None, keep_partial: bool = False
) -> Document | GridResult:
    """Answer a question that is written as JSON: a verb, a scene and options.

    Every answer is that of the method of :class:`Scene` with the name of the verb: ``run`` returns an :class:`Orbit`, ``trap`` a
    ``Trap``. For ``two-impact`` the answer of each number of cycles is in its ``each``.

    Parameters
    ----------
    question : dict or str
        ``{"verb": .., "scene": {..}, "options": {..}}``, or this as text. The scene is as in documents, such as ``orbit.scene`` or
        ``Scene.document``. Options are named as on the command line, ``"max-bits"``; switches are true or false, a number is the decimal
        that JSON writes. For files there are their contents: ``"events"`` of ``audit``, ``"bases"`` of ``chaos``.
    picture : bool, default False
        Whether to draw the answer: ``svg`` is the picture, None where the verb has none.
    progress : bool or callable, optional
        A bar of tqdm, or a function that receives the amount done.
    keep_partial : bool, default False
        Whether Ctrl-C returns the part that is certified until then, instead of raising :class:`impact_pair.Stopped` with it.

    Returns
    -------
    Document
        The answer; ``document`` is the JSON of the command line. A ``SweepResult`` or ``AtlasResult`` for ``sweep`` and ``atlas``, whose
        option ``over`` is a list such as ``["amplitude=1..10:40"]``.

    Raises
    ------
    SceneError
        When the scene is malformed: a key is unknown or missing, or a value has the wrong kind.
    RangeError
        When a value is out of range, there is no such verb or option, or the question is not JSON.

    Examples
    --------
    >>> scene = Scene.named("figure-14").document
    >>> ask({"verb": "run", "scene": scene, "options": {"impacts": 200, "arithmetic": "shadow"}}).claim
    'shadowed'

    """
    try:
        written = question if isinstance(question, str) else json.dumps(question)
    except (TypeError, ValueError) as error:
        raise RangeError(f"the question is {question!r}, but must be JSON: {error}", "question", repr(question)) from None
    verb, document, options = _core.question(written)
    scene = Scene.from_dict(tables_of(json.loads(document)))
    if verb == "run":
        return scene._run(options, None, (progress, keep_partial))
    if verb in GRIDS:
        return kept(GRIDS[verb].of(Question(scene.text, verb, options), progress=progress), keep_partial)
    return scene._ask(kind_of(verb, json.loads(options)), (verb, options), ("steps", None), (picture, progress, keep_partial))


def kind_of(verb: str, options: Mapping[str, Any]) -> type[Document]:
    """Return the class of an answer, which may depend on the options. An unknown verb is refused later, by the compiled module."""
    if verb == "chaos" and ":" in str(options.get("over")):
        return answers.ChaosCells
    if verb == "two-impact" and options.get("manifold") is not None:
        return answers.Manifold
    return ANSWERS.get(verb, Document)
