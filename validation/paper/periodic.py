"""Periodic orbits proved: Krawczyk's operator on all impacts at once, then the first contact of each flight.

The unknowns are (th, v) of the k impacts of a word, the equations (A.1)-(A.6) of its k flights; the last one ends at
the first state, N cycles later (29). A seed only proposes.
"""
from dataclasses import dataclass

from flint import arb, arb_mat

from contact import first_contact
from pair import name


class Refused(Exception):
    """A proof did not succeed."""


@dataclass
class Orbit:
    """A proved orbit: states (wall, th, v) in time order, each in a box that holds exactly one such orbit."""

    pair: object
    cycles: int
    states: list

    def flights(self):
        """Pairs of consecutive states, the last one shifted by the period."""
        return zip(self.states, self.states[1:] + [later(self.states[0], self.cycles)])

    def jacobian(self):
        """DP over the period, eq. (53), at the orbit."""
        product = arb_mat([[1, 0], [0, 1]])
        for (_, th0, v0), (_, th1, v1) in self.flights():
            product = self.pair.jacobian(th0, v0, th1, v1) * product
        return product

    def misses(self):
        """Residuals of (A.1)-(A.6): balls that hold 0 if the states are the orbit's."""
        return [miss for this, following in self.flights() for miss in self.pair.misses(this, following)]

    def require_first_contacts(self):
        """Refused unless the end of each flight is proved to be its first contact."""
        for (wall0, th0, v0), (wall1, th1, _) in self.flights():
            contact = first_contact(self.pair, wall0, th0, v0)
            if contact.wall != wall1 or not contact.isolating.contains(th1):
                raise Refused(f"the flight from th = {th0.str(8)} touches the {contact.wall} wall earlier")

    def word(self):
        """The paper's word."""
        return name([wall for wall, _, _ in self.states])

    def eigenvalues(self):
        """(38): two real balls, or (re, im) of the pair as ("complex", re, im)."""
        trace, det = self.jacobian().trace(), self.jacobian().det()
        under = trace * trace - 4 * det
        if under > 0:
            return [(trace - under.sqrt()) / 2, (trace + under.sqrt()) / 2]
        if under < 0:
            return ["complex", trace / 2, (-under).sqrt() / 2]
        raise Refused("the discriminant of (38) may be 0")

    def stable(self):
        """True: both eigenvalues are inside the unit circle, proved; False: one is outside; else Refused."""
        trace, det = self.jacobian().trace(), self.jacobian().det()
        if det < 1 and abs(trace) < 1 + det:
            return True
        if det > 1 or abs(trace) > 1 + det:
            return False
        raise Refused("on the unit circle, as far as the balls tell")

    def shown(self):
        """The eigenvalues as text."""
        values = self.eigenvalues()
        if values[0] == "complex":
            return f"{values[1].str(6)} +- {values[2].str(6)} i"
        return " and ".join(value.str(8) for value in values)


def later(state, cycles):
    """The same state, `cycles` cycles later."""
    wall, th, v = state
    return wall, th + 2 * cycles * arb.pi(), v


def follow(pair, wall, th, v, impacts):
    """The states of the middle of a flight after flight, as a seed: nothing is kept of the error."""
    states = [(wall, arb(th), arb(v))]
    for _ in range(impacts):
        wall, th, v = states[-1]
        contact = first_contact(pair, wall, th, v)
        arrival = contact.th.mid()
        states.append((contact.wall, arrival, (pair.drift(th, v) - arrival.cos()).mid()))
    return states


def equations(pair, states, cycles):
    """(F, F') of the closed orbit as columns and matrix of balls."""
    size = len(states)
    values, slopes = [], [[arb(0)] * (2 * size) for _ in range(2 * size)]
    for i, this in enumerate(states):
        j = (i + 1) % size
        following = later(states[j], cycles) if j == 0 else states[j]
        values += pair.misses(this, following)
        for k, by in zip((i, j), pair.slopes(this[1], this[2], following[1])):
            for row in (0, 1):
                for column in (0, 1):
                    slopes[2 * i + row][2 * k + column] += by[row][column]
    return arb_mat([[x] for x in values]), arb_mat(slopes)


def krawczyk(problem, middle, radius):
    """The box around `middle` in which exactly one zero of `problem` lies, narrowed, or Refused.

    K = m - Y F(m) + (1 - Y F'(X))(X - m) in the interior of X proves it; `problem(x)` gives F and F' as matrices.
    """
    size = len(middle)
    for _ in range(6):
        values, slopes = problem(middle)
        step = slopes.mid().inv() * values
        middle = [(middle[i] - step[i, 0]).mid() for i in range(size)]
    box = [arb(x, radius) for x in middle]
    for turn in range(3):
        values, slopes = problem(middle)
        around, y = problem(box)[1], slopes.mid().inv().mid()
        unit = arb_mat(size, size, [int(i == j) for i in range(size) for j in range(size)])
        offset = arb_mat([[box[i] - middle[i]] for i in range(size)])
        change = (unit - y * around) * offset - y * values
        image = [middle[i] + change[i, 0] for i in range(size)]
        if turn == 0 and not all(x.contains_interior(k) for x, k in zip(box, image)):
            raise Refused("Krawczyk's image is not in the interior")
        box = [x.intersection(k) for x, k in zip(box, image)]
        middle = [x.mid() for x in box]
    return box


def prove(pair, seed, cycles, radius=arb(2) ** -50):
    """The one orbit of the seed's word near it, with no earlier contact on any flight, or Refused."""
    walls = [wall for wall, _, _ in seed]

    def states(x):
        return [(wall, x[2 * i], x[2 * i + 1]) for i, wall in enumerate(walls)]

    box = krawczyk(lambda x: equations(pair, states(x), cycles), [x.mid() for _, *pairs in seed for x in pairs], radius)
    orbit = Orbit(pair, cycles, states(box))
    orbit.require_first_contacts()
    return orbit


def find(pair, wall, th, v, impacts, cycles):
    """`prove` with the states that follow from one rounded state as the seed."""
    return prove(pair, follow(pair, wall, th, v, impacts - 1), cycles)
