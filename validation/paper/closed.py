"""The closed forms of equispaced orbits, N odd, cos th0 > 0 (64)-(69), in the units of pair.py, and what follows."""
from dataclasses import dataclass

from flint import arb

from pair import LEFT, RIGHT, Pair, ball


@dataclass
class Equispaced:
    """All equispaced orbits with one e < 1 and one odd N: th0 is the phase at the left wall."""

    e: object
    cycles: int = 1

    def __post_init__(self):
        self.e = ball(self.e)
        self.kappa = (1 + self.e) / (1 - self.e)
        self.turn = self.cycles * arb.pi()
        self.k = self.turn * self.kappa

    def gap(self, th0):
        """d/A = 2 sin th0 + K cos th0, from (66) and (67)."""
        return 2 * th0.sin() + self.k * th0.cos()

    def phase(self, gap):
        """th0 on the branch below the fold, th0 < atan(2/K)."""
        return self.fold_phase() - (ball(gap) / (4 + self.k * self.k).sqrt()).acos()

    def states(self, th0):
        """The two impacts of the orbit, (66)."""
        v = -2 * th0.cos() / (1 - self.e)
        return [(LEFT, th0, v), (RIGHT, th0 + self.turn, -v)]

    def pair(self, th0):
        """The impact pair that has this orbit."""
        return Pair(self.gap(th0), self.e)

    def half_trace(self, th0):
        """Trace of the half map, impact and mirror image; its determinant is e^2."""
        return 2 * self.e + (1 - self.e ** 2) * self.turn / 2 * th0.tan()

    def fold_phase(self):
        """The phase at which the half map has the eigenvalue 1: tan th0 = 2/K."""
        return (2 / self.k).atan()

    def pitchfork_phase(self):
        """The phase at which the half map has the eigenvalue -1: tan th0 = -2 kappa/(N pi)."""
        return -(2 * self.kappa / self.turn).atan()

    def fold(self):
        """A_sn/d."""
        return 1 / (4 + self.k * self.k).sqrt()

    def pitchfork(self):
        """A_pf/d."""
        return (1 + 4 * self.kappa ** 2 / self.turn ** 2).sqrt() / (self.k * (1 - 4 / self.turn ** 2))

    def seed(self, gap):
        """Its states at a gap, below the fold."""
        return self.states(self.phase(gap))
