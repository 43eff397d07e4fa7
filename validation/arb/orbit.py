"""An orbit: impact after impact, each time and velocity in a proved ball.

The set of states is c + Q r: c exact, in full precision; Q a rotation, exact, and r two balls around 0, in coarse
precision. One step, by the mean value theorem over the box that holds the set: F(c + Q r) is inside F(c) + J Q r with
J from (A.7) over the box. F(c) = c' + delta, c' exact; then r' = (Q'^-1 J Q) r + Q'^-1 delta for any rotation Q'. Q'
follows the longer column of J Q r, so that r grows by what the motion stretches and by no more.
"""
from collections import namedtuple

from flint import arb, ctx

from flight import Flight, TooLong, Undecided
from scene import LEFT, RIGHT

MAPPING = {(LEFT, RIGHT): "P2", (RIGHT, LEFT): "P1", (RIGHT, RIGHT): "P3", (LEFT, LEFT): "P4"}
FIRST_BITS, FIRST_COARSE_BITS, MOST_BITS, MOST_COARSE_BITS = 192, 128, 1 << 17, 1 << 11

Impact = namedtuple("Impact", "index mapping wall time velocity")
Proved = namedtuple("Proved", "impacts rest bits reason")


def rotate(rotation, x, y):
    """Q (x, y)."""
    a, b = rotation
    return a * x - b * y, b * x + a * y


def rotate_back(rotation, x, y):
    """Q^-1 (x, y); Q is a rotation times the length of (a, b), which is about 1."""
    a, b = rotation
    square = a * a + b * b
    return (a * x + b * y) / square, (a * y - b * x) / square


def ball_around(middle, error):
    """middle + error, keeping every bit of the middle; the error is a ball around 0."""
    return arb(middle, error.abs_upper())


def along_longer(columns, r):
    """The rotation onto the longer of the two columns, weighted by r; exact."""
    def length(k):
        return ((columns[k][0].mid() ** 2 + columns[k][1].mid() ** 2).sqrt() * r[k].abs_upper()).mid()

    x, y = (entry.mid() for entry in columns[0 if length(0) >= length(1) else 1])
    norm = (x * x + y * y).sqrt()
    return ((x / norm).mid(), (y / norm).mid()) if norm > 0 else (arb(1), arb(0))


class States:
    """The set c + Q r of states (time, velocity before the impact) on a wall; `bits` is the coarse precision.

    `released`: the one state that is meant is a release.
    """

    def __init__(self, wall, centre, rotation, r, bits, released=False):
        self.wall, self.centre, self.rotation, self.r, self.bits = wall, centre, rotation, r, bits
        self.released = released

    @classmethod
    def of_balls(cls, wall, time, velocity, bits, released=False):
        """The smallest such set around two balls."""
        r = [arb(0, time.rad()), arb(0, velocity.rad())]
        return cls(wall, (time.mid(), velocity.mid()), (arb(1), arb(0)), r, bits, released)

    def balls(self):
        """Time and velocity of all states of the set, around the centre in full precision."""
        with ctx.workprec(self.bits):
            error = rotate(self.rotation, *self.r)
        return tuple(ball_around(middle, part) for middle, part in zip(self.centre, error))

    def coarse(self):
        """Two balls of the current precision that hold all states of the set."""
        return tuple(+x for x in self.balls())

    def image(self, jacobian, wall, landing):
        """The set after one step: `landing` holds F(c) on a wall, `jacobian` holds (A.7) over the set."""
        with ctx.workprec(self.bits):
            (p, q), (s, t) = jacobian
            a, b = self.rotation
            columns = [(p * a + q * b, s * a + t * b), (q * a - p * b, t * a - s * b)]
            rotation = along_longer(columns, self.r)
            first, second = (rotate_back(rotation, *column) for column in columns)
            delta = rotate_back(rotation, *(arb(0, x.rad()) for x in landing))
            r = [first[k] * self.r[0] + second[k] * self.r[1] + delta[k] for k in (0, 1)]
        return States(wall, tuple(x.mid() for x in landing), rotation, r, self.bits)


class Walk:
    """The steps of one orbit in two precisions: the current one for the centre, a coarse one for proofs about sets."""

    def __init__(self, scene, coarse_bits):
        self.coarse_bits = coarse_bits
        self.fine = scene.motion()
        with ctx.workprec(coarse_bits):
            self.rough = scene.motion()

    def begin(self, scene):
        """The states at the start and None, or, from inside the gap, at the first contact and that impact."""
        wall, time, height, velocity = scene.start()
        if wall is not None:
            return States.of_balls(wall, time, velocity, self.coarse_bits, scene.at_release), None
        flight = Flight(self.fine, None, time, height, velocity)
        wall, bracket = flight.first_contact()
        time, velocity = flight.land(wall, bracket)
        return States.of_balls(wall, time, velocity, self.coarse_bits), Impact(1, None, wall, time, velocity)

    def step(self, states):
        """The states at the next impact.

        Wall and bracket are proved for all of the set in coarse precision; the centre lands in full precision.
        """
        with ctx.workprec(self.coarse_bits):
            flights = leave(self.rough, states.wall, *states.coarse(), states.released)
            wall, bracket = flights.first_contact()
            jacobian = flights.jacobian(bracket)
        landing = leave(self.fine, states.wall, *states.centre).land(wall, bracket)
        return states.image(jacobian, wall, landing)


def leave(motion, wall, time, velocity, released=False):
    """The flights after an impact; (15) turns the velocity before it into the one after it."""
    return Flight(motion, wall, time, arb(0) if wall == LEFT else motion.gap, -motion.restitution * velocity, released)


def check_width(impact, widest, digits):
    """Raises Undecided unless the balls of time and velocity are narrow enough."""
    if not (2 * impact.time.rad() < widest[0] and 2 * impact.velocity.rad() < widest[1]):
        raise Undecided(f"wider than {digits} digits")


def orbit_at(scene, impacts, digits, bits, coarse_bits, settle=None):
    """(impacts, rest, reason): the impacts as far as these precisions prove them, and why they end there, or None.

    `settle(walk, states)` tells the rest that these states come to without any further impact that matters, or None.
    """
    found = []
    with ctx.workprec(bits):
        walk = Walk(scene, coarse_bits)
        widest = [arb(10) ** -digits * unit for unit in (walk.fine.period(), walk.fine.speed())]
        try:
            states, first = walk.begin(scene)
            if first is not None:
                check_width(first, widest, digits)
                found.append(first)
            while len(found) < impacts:
                rest = settle(walk, states) if settle else None
                if rest is not None:
                    return found, rest, None
                after = walk.step(states)
                impact = Impact(len(found) + 1, MAPPING[states.wall, after.wall], after.wall, *after.balls())
                check_width(impact, widest, digits)
                found.append(impact)
                states = after
        except Undecided as reason:
            return found, None, type(reason)(f"impact {len(found) + 1}: {reason}")
    return found[:impacts], None, None


def prove(scene, impacts, digits=30, settle=None, most_bits=MOST_BITS):
    """So many impacts, or those up to a rest, each narrower than the digits ask for relative to 2 pi/W and A W.

    Starts again with more bits whenever something is undecided; where no precision is enough, `reason`, an Undecided,
    says why.
    """
    bits, coarse_bits, best = max(FIRST_BITS, 4 * digits + 64), FIRST_COARSE_BITS, Proved([], None, 0, None)
    while True:
        found, rest, reason = orbit_at(scene, impacts, digits, bits, coarse_bits, settle)
        helped = best.bits == 0 or len(found) > len(best.impacts)
        if helped or reason is None:
            best = Proved(found, rest, bits, reason)
        if reason is None or isinstance(reason, TooLong):
            return best
        if helped and bits < most_bits:
            bits = min(more_bits(bits, len(best.impacts), impacts), most_bits)
        else:
            # More bits did not help: the proofs need them, not the centre.
            coarse_bits, bits = 2 * coarse_bits, min(3 * bits // 2, most_bits)
        if coarse_bits > MOST_COARSE_BITS:
            return best


def orbit(scene, impacts, digits=30):
    """(impacts, bits): as many impacts as requested; raises Undecided when no precision is enough."""
    proved = prove(scene, impacts, digits)
    if proved.reason is not None:
        raise proved.reason
    return proved.impacts, proved.bits


def more_bits(bits, reach, impacts):
    """The next precision to try when `bits` reached an impact: half as much again, or what the rest seems to need."""
    seems = FIRST_COARSE_BITS + bits * impacts * 11 // (10 * (reach + 1))
    return max(3 * bits // 2, min(seems, 8 * bits))
