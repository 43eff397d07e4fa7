"""Answers of the other verbs, as objects above their documents."""

from .audits import Audit, decimal, heading, listing
from .descriptions import Description, Picture, Trade
from .manifolds import Beside, Curve, Manifold, Tangencies, Tangency
from .orbits import Bifurcation, Bifurcations, Cycles, Periodic, PeriodicOrbit, TwoImpact, Window, Windows
from .regions import Basin, Chaos, ChaosCells, Component, GlobalAnalysis, Trap, percent

__all__ = [
    "Audit",
    "Basin",
    "Beside",
    "Bifurcation",
    "Bifurcations",
    "Chaos",
    "ChaosCells",
    "Component",
    "Curve",
    "Cycles",
    "Description",
    "GlobalAnalysis",
    "Manifold",
    "Periodic",
    "PeriodicOrbit",
    "Picture",
    "Tangencies",
    "Tangency",
    "Trade",
    "Trap",
    "TwoImpact",
    "Window",
    "Windows",
    "decimal",
    "heading",
    "listing",
    "percent",
]
