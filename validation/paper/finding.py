"""The result of checking a claim of the paper, and its failure."""
from dataclasses import dataclass

PROVED, SEEN, FALSE, MISPRINT = "proved", "seen", "false", "misprint"


class Failed(Exception):
    """An expectation of a claim does not hold."""


@dataclass
class Finding:
    """One row of the report: a statement, its verdict, the numbers that decide it."""

    statement: str
    verdict: str
    numbers: str


def expect(condition, what):
    """Fails the claim unless the condition is proved true; a comparison of balls is true only if all members say so."""
    if not condition:
        raise Failed(what)


def excludes(ball, what):
    """Fails unless a ball excludes 0."""
    expect(not ball.contains(0), f"{what}: {ball.str(6)} may be 0")


def tiny(ball, what):
    """Fails unless a ball holds 0 and is narrower than 1e-20: an equation, as far as the balls tell."""
    expect(ball.contains(0) and ball.rad() < 1e-20, f"{what}: {ball.str(6)} should be 0")
