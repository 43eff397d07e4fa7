"""A motion as a whole, the trade of time for digits, and pictures."""

from __future__ import annotations

import html
import json
from typing import Any

from .. import _core
from .._document import Document
from ..bounds import Bounds, outward, pair
from .orbits import PeriodicOrbit
from .regions import Trap


class Description(Document):
    """Proved properties of a motion: its fate, exponent, region, horseshoe, and what is undecided."""

    @property
    def fate(self) -> str:
        """The kind: attracted, periodic, rests-forever, never-impacts, stays-in-region or undecided."""
        return str(self.document["fate"]["kind"])

    @property
    def message(self) -> str:
        """The fate in words."""
        return str(self.document["fate"]["message"])

    @property
    def since(self) -> int | None:
        """The impact from which on the motion is near the attracting orbit, or in the region; 0 is the start."""
        found: int | None = self.document["fate"].get("from")
        return found

    @property
    def period(self) -> tuple[int, int] | None:
        """Impacts and forcing periods of the attracting orbit, or of the periodic motion; of a complete chatter the listed impacts."""
        found = self.document["fate"].get("period")
        return None if found is None else (found["impacts"], found["cycles"])

    @property
    def word(self) -> str | None:
        """The word of the attracting orbit, the right-most mapping first in time."""
        found: str | None = self.document["fate"].get("word")
        return found

    @property
    def orbit(self) -> PeriodicOrbit | None:
        """The attracting orbit."""
        found = self.document["fate"].get("orbit")
        return None if found is None else PeriodicOrbit(found)

    @property
    def exponent_limit(self) -> Bounds | None:
        """Bounds of the Lyapunov exponent per impact in the limit; None where the motion is not attracted, and after a graze."""
        return pair(self.document["exponent"]["limit"])

    @property
    def exponent_finite_time(self) -> Bounds | None:
        """Bounds of the exponent per impact over the certified impacts; ``-inf`` where the ball comes to rest."""
        return pair(self.document["exponent"]["finite_time"])

    @property
    def region(self) -> Trap | None:
        """The trapping region, if one is proved."""
        found = self.document["region"]
        return None if found is None else Trap(json.dumps(found), found["entered_at_impact"] is not None)

    @property
    def entropy(self) -> float | None:
        """A lower bound of the topological entropy of the impact map [nats per impact]; None if no horseshoe is proved."""
        return self._down("per_impact")

    @property
    def entropy_per_cycle(self) -> float | None:
        """A lower bound of the topological entropy [nats per forcing period]; None if no horseshoe is proved."""
        return self._down("per_cycle")

    def _down(self, key: str) -> float | None:
        found = self.document["entropy"]
        return None if found is None else float(outward([(found[key], found[key])])[0, 0])

    @property
    def undecided(self) -> list[dict[str, str]]:
        """The questions that are undecided, each with a ``command`` that goes on."""
        return list(self.document["undecided"])

    @property
    def not_examined(self) -> list[dict[str, str]]:
        """The questions that were not examined, each with the ``reason``."""
        return list(self.document.get("not_examined", []))

    @property
    def lines(self) -> list[tuple[str, str]]:
        """The description in words: lines, each with its label."""
        return _core.description_lines(self.json())

    def _repr_html_(self) -> str:
        rows = "".join(
            f'<tr><th style="text-align: left">{html.escape(label)}</th><td style="text-align: left">{html.escape(text)}</td></tr>'
            for label, text in self.lines
        )
        return f"<table>{rows}</table>" + (self.svg or "")

    def __repr__(self) -> str:
        return "\n".join(f"{label:12}  {text}" for label, text in self.lines)


class Trade(Document):
    """The cost of accuracy, for each arithmetic."""

    @property
    def certified(self) -> bool:
        """Always false: it is a measurement."""
        return False

    @property
    def arithmetics(self) -> list[dict[str, Any]]:
        """The arithmetics, in the order of measurement."""
        return list(self.document["arithmetics"])

    def to_pandas(self) -> Any:
        """Return a DataFrame with one row per arithmetic."""
        import pandas as pd

        return pd.json_normalize(self.arithmetics)

    def _repr_svg_(self) -> str | None:
        return self.svg

    def __repr__(self) -> str:
        return f"<trade of {len(self.arithmetics)} arithmetics>"


class Picture(Document):
    """A picture as SVG, and whether it is certified."""

    def __init__(self, svg: str, complete: bool | None = None, interrupted: bool = False, verdict: str | None = None) -> None:
        super().__init__("", complete, interrupted, svg)
        self.verdict = verdict or ""

    @property
    def certified(self) -> bool:
        """True if the picture is proved."""
        return not self.verdict.startswith("computed")

    def json(self) -> str:
        """Return the verdict: a picture has no document."""
        return json.dumps({"verdict": self.verdict})

    def _repr_svg_(self) -> str | None:
        return self.svg

    def __repr__(self) -> str:
        return f"<picture: {self.verdict}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return Picture, (self.svg, self.complete, self.interrupted, self.verdict)
