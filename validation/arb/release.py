"""The release from a rest: by its phase with one harmonic, as a root of the pressure with several. Proved.

Lemma R3 (release). A ball at rest stays as long as the pressure a >= 0 and leaves where a turns negative. With one
harmonic, th = W t + tau, a is A W^2 times -sin th on the left and sin th on the right, so that happens where th/pi
passes an even integer (left) or an odd one (right). With several it is the first root of a at which a' < 0, if a > 0
was proved up to it; where a touches 0, or nearly so, nothing is proved. Then u = 0, z'' = 0 and z''' is inward: the
flight begins as in `Flight.departure`.
"""
from flint import arb, ctx

from flight import MOST_PARTS, Undecided, between, narrow, shortest
from scene import LEFT, Motion


def pressure(motion, wall, time):
    """a, the acceleration towards the wall, at a time, or over a ball of times."""
    e2 = motion.excitation(time)[2]
    return e2 if wall == LEFT else -e2


def pressure_slope(motion, wall, time):
    """a' at a time, or over a ball of times."""
    third = motion.third(time)
    return third if wall == LEFT else -third


def release_after(motion, wall, time):
    """The release of a ball that rests at a time: the half periods of one harmonic, or a `Root`."""
    return half_turns_after(motion, wall, time) if len(motion.terms) == 1 else root_after(motion, wall, time)


def half_turns_at(motion, time):
    """th/pi at a time, for the one harmonic there is; a negative amplitude is half a forcing period."""
    ((amplitude, frequency, phase),) = motion.terms
    turned = 1 if amplitude < 0 else 0
    return (frequency * time + phase) / arb.pi() + turned


def half_turns_after(motion, wall, time):
    """th/pi at the release of a ball that rests at a time."""
    parity = 0 if wall == LEFT else 1
    turns = (half_turns_at(motion, time) - parity) / 2
    whole = turns.floor().unique_fmpz()
    if whole is None or not turns - int(whole) >= arb("0.5"):
        raise Undecided("the ball may not be pressed where it comes to rest")
    return 2 * (int(whole) + 1) + parity


def release_time(scene, half_turns):
    """The time at which the one harmonic has turned this number of half periods."""
    motion = scene.motion()
    ((_, frequency, _),) = motion.terms
    return (half_turns - half_turns_at(motion, arb(0))) * arb.pi() / frequency


class Root:
    """The only root of the contact force in a bracket, on which a' < 0; to any requested number of bits."""

    def __init__(self, wall, bracket):
        self.wall, self.bracket = wall, bracket
        self.known = {}

    def time(self, motion):
        """A ball around it, for the motion in the current precision."""
        if ctx.prec not in self.known:
            a, slope = (lambda t, of=of: of(motion, self.wall, t) for of in (pressure, pressure_slope))
            # A root at 0 could be enclosed without end.
            enough = motion.period().mid() * arb(2) ** -ctx.prec
            self.known[ctx.prec] = narrow(a, slope, self.bracket, enough)
        return self.known[ctx.prec]


def root_after(motion, wall, time):
    """The `Root` at which a ball leaves that rests on a wall since a time in a ball.

    The time after it is cut into parts from left to right: a > 0 on a part, or a' < 0 on it and a < 0 at its end.
    """
    period = motion.period()
    a, width = time.upper(), period.mid() / 8
    if not pressure(motion, wall, time) > 0:
        a, width = beginning_press(motion, wall, time, width)
    for _ in range(MOST_PARTS):
        b = (a + width).mid()
        part = between(a, b)
        slope = pressure_slope(motion, wall, part)
        if is_pressed(motion, wall, part, slope) or slope < 0 and pressure(motion, wall, b) > 0:
            a, width = b, 2 * width
        elif slope < 0 and pressure(motion, wall, b) < 0:
            return Root(wall, part)
        elif width < shortest(period):
            raise Undecided(f"near t = {a.str(10)}: the pressure may end, touch 0, or nearly so")
        else:
            width = width / 2
    raise Undecided(f"no release in {MOST_PARTS} parts")


def is_pressed(motion, wall, part, slope):
    """a > 0 on a part, as it stands or by the mean value form."""
    if pressure(motion, wall, part) > 0:
        return True
    middle = part.mid()
    return pressure(motion, wall, middle) + slope * (part - middle) > 0


def beginning_press(motion, wall, time, width):
    """(b, w): a > 0 on (t, b], since a(t) = 0, exactly, and a' > 0 on [t, b]."""
    while pressure(motion, wall, time) == 0 and width > shortest(motion.period()):
        if pressure_slope(motion, wall, between(time, time + width)) > 0:
            return (time + width).lower(), width
        width = width / 2
    raise Undecided("the ball may not be pressed where it comes to rest")


class Released:
    """The scene after a release from a wall: it leaves at time 0, exactly, at the phase 0 (left) or pi (right)."""

    at_release = False

    def __init__(self, scene, wall):
        self.scene, self.wall = scene, wall

    def motion(self):
        motion = self.scene.motion()
        ((amplitude, frequency, _),) = motion.terms
        sign = 1 if self.wall == LEFT else -1
        return Motion([(sign * abs(amplitude), frequency, arb(0))], motion.gap, motion.restitution)

    def start(self):
        return self.wall, arb(0), arb(0) if self.wall == LEFT else self.scene.motion().gap, arb(0)


class ReleasedAt:
    """The scene after a release at a `Root`, which is enclosed the better the higher the precision is."""

    at_release = True

    def __init__(self, scene, root):
        self.scene, self.root = scene, root

    def motion(self):
        return self.scene.motion()

    def start(self):
        motion = self.motion()
        return self.root.wall, self.root.time(motion), arb(0) if self.root.wall == LEFT else motion.gap, arb(0)
