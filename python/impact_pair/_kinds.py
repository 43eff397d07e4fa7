"""Colours of pictures, and classes of the outcomes of a sweep."""

from __future__ import annotations

#: Distinguishable with colour-vision deficiency.
BLUE, ORANGE, GREEN, PURPLE, SKY = "#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9"
VERMILION, YELLOW, GREY, BLACK = "#d55e00", "#f0e442", "#999999", "#000000"
#: Colours of points in a diagram, by what is known of them; later ones are drawn on top.
CLASSES = {
    "undecided convergence": BLACK,
    "proved to converge to a periodic orbit": BLUE,
    "periodic through rest, or at an end": GREEN,
    "undecided, impacts before": VERMILION,
}


def class_of(outcome: str) -> str:
    """Return the class of an outcome."""
    unproved, attracted, settled, undecided = CLASSES
    return {"attracted": attracted, "undecided-limit": unproved, "undecided": undecided}.get(outcome, settled)
