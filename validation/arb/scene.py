"""A scene file as balls of any precision: the excitation (1), the gap, the restitution and the start."""
import tomllib

from flint import arb

from commensurate import common_measure, half_turns
from expression import ball, evaluate

LEFT, RIGHT = "left", "right"


class SceneError(ValueError):
    """The scene asks for something that this simulator does not do, or that means nothing."""


class Scene:
    """The texts of a scene file, kept as written; `motion` and `start` turn them into balls."""

    # True if the start is a release known as a root of E'' only: no velocity and, though no ball shows it, no contact force.
    at_release = False

    def __init__(self, tables):
        self.tables = tables
        motion = self.motion()
        if not (motion.gap > 0 and 0 <= motion.restitution <= 1):
            raise SceneError("a scene needs gap > 0 and 0 <= restitution <= 1")
        amplitudes, frequencies = self.numbers("amplitude"), self.numbers("frequency")
        if not all(value >= 0 for value in amplitudes) or not all(w > 0 for w in frequencies):
            raise SceneError("a scene needs amplitudes >= 0 and frequencies > 0")

    @classmethod
    def read(cls, path):
        """The scene in a TOML file; bare decimals are kept as they are written."""
        with open(path, "rb") as file:
            return cls(tomllib.load(file, parse_float=str))

    def text(self, table, key):
        try:
            return self.tables[table][key]
        except KeyError:
            raise SceneError(f"{table}.{key} is missing") from None

    def number(self, table, key):
        return ball(evaluate(str(self.text(table, key))))

    def texts(self, key):
        """The texts of a key for the terms of the excitation, one or a list."""
        value = self.text("excitation", key)
        return [str(entry) for entry in (value if isinstance(value, list) else [value])]

    def numbers(self, key):
        return [ball(evaluate(text)) for text in self.texts(key)]

    def harmonics(self):
        """(A, W, tau) of each term as texts, without those of amplitude 0: they are no part of the excitation."""
        amplitudes, frequencies, phases = (self.texts(key) for key in ("amplitude", "frequency", "phase"))
        if len(phases) == 1:
            phases *= len(amplitudes)
        if not len(amplitudes) == len(frequencies) == len(phases):
            raise SceneError("amplitude, frequency and phase are lists of different lengths")
        terms = list(zip(amplitudes, frequencies, phases))
        return [term for term in terms if evaluate(term[0]) != 0] or terms[:1]

    def motion(self):
        """The parameters as balls of the current precision."""
        terms = []
        for amplitude, frequency, phase in self.harmonics():
            size, angle, turns = ball(evaluate(amplitude)), ball(evaluate(phase)), half_turns(phase)
            if turns is not None:
                # As exact as it can be said: at time 0 this phase is a release or the beginning of a press.
                size, angle = -size if turns % 2 else size, arb(0)
            terms.append((size, ball(evaluate(frequency)), angle))
        return Motion(terms, self.number("pair", "gap"), self.number("pair", "restitution"))

    def common_period(self):
        """(T, n): the period of the excitation as a ball, and how many cycles of the fastest harmonic it holds.

        None if the frequencies are not seen to be commensurate.
        """
        frequencies = [frequency for _, frequency, _ in self.harmonics()]
        measure = common_measure(frequencies)
        if measure is None:
            return None
        period = 2 * arb.pi() / (measure * ball(evaluate(frequencies[0])))
        fastest = max((ball(evaluate(frequency)) for frequency in frequencies), key=lambda w: w.mid())
        return period, int((period * fastest / (2 * arb.pi())).unique_fmpz())

    def has_roots(self):
        """True if there are several harmonics, and a root in one of their frequencies."""
        frequencies = [frequency for _, frequency, _ in self.harmonics()]
        return len(frequencies) > 1 and any("sqrt" in frequency for frequency in frequencies)

    def start(self):
        """(wall, time, height, velocity) of the start as balls; the wall is None inside the gap.

        `height` is the distance y + d/2 from the left wall; on a wall, the velocity is the one before the impact.
        """
        time, velocity = self.number("start", "time"), self.number("start", "velocity")
        gap = self.number("pair", "gap")
        wall = self.tables["start"].get("wall")
        if wall is None:
            height = self.number("start", "position") + gap / 2
            if not 0 < height < gap:
                raise SceneError("start.position is not inside the gap")
            return None, time, height, velocity
        if wall not in (LEFT, RIGHT):
            raise SceneError(f"start.wall is {wall!r}, expected 'left' or 'right'")
        if not (velocity <= 0 if wall == LEFT else velocity >= 0):
            raise SceneError("start.velocity does not lead into the wall it starts on")
        return wall, time, arb(0) if wall == LEFT else gap, velocity


class Motion:
    """The parameters: terms (A, W, tau) of the excitation (1), the gap d and the restitution e of (15).

    An amplitude may be negative here: -A sin(W t) is A sin(W t + pi), exactly.
    """

    def __init__(self, terms, gap, restitution):
        self.terms = terms
        self.gap = gap
        self.restitution = restitution

    def excitation(self, time):
        """(E, E', E'') at a time: eq. (1) and its derivatives."""
        e0 = e1 = e2 = arb(0)
        for amplitude, frequency, phase in self.terms:
            sine, cosine = (frequency * time + phase).sin_cos()
            speed = amplitude * frequency
            e0, e1, e2 = e0 + amplitude * sine, e1 + speed * cosine, e2 - speed * frequency * sine
        return e0, e1, e2

    def third(self, time):
        """E''' at a time."""
        return sum((-a * w**3 * (w * time + phase).cos() for a, w, phase in self.terms), arb(0))

    def period(self):
        """The shortest period 2 pi/W of the excitation, about."""
        return 2 * arb.pi() / max((frequency.mid() for _, frequency, _ in self.terms))

    def longest(self):
        """The longest period 2 pi/W, about."""
        return 2 * arb.pi() / min((frequency.mid() for _, frequency, _ in self.terms))

    def speed(self):
        """The largest of the speeds A W, about; 1 if nothing moves."""
        speed = max(abs(amplitude * frequency).mid() for amplitude, frequency, _ in self.terms)
        return speed if speed > 0 else arb(1)
