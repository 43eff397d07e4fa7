"""An orbit that goes through rests: legs from one release to the next, proved one by one.

A release forgets everything but its wall and its phase. With one harmonic the wall gives the phase, so there are three
legs at most, however long the orbit: from the start, from the left wall and from the right wall; a second release from
the same wall makes the orbit exactly periodic. With several harmonics every release begins a leg of its own, and the
orbit is periodic if two from one wall are whole periods of the excitation apart.
"""
from math import ceil

from flint import ctx

from orbit import FIRST_BITS, prove
from release import Released, ReleasedAt, pressure_slope, release_time
from rest import settle_within
from scene import LEFT

# Bits that are tried for a leg: enough for 200 impacts of anything that is not an exact graze.
MOST_BITS = 1 << 13
# Digits more, where bounds end very near to a rest.
CLOSER = 8


class Timeline:
    """The legs of a scene, for comparisons with listings to N digits; computed on request.

    `width`: number of digits proved at least. `is_patient`: a chatter may be listed on when it is too short for `digits`.
    """

    def __init__(self, scene, digits, width=30, is_patient=False):
        self.scene, self.digits, self.width, self.is_patient = scene, digits, width, is_patient
        self.proved = {}
        chatter = scene.motion().restitution
        # Impacts from the last one that a listing needs to the rest that `settle_within` sees, and some to spare.
        self.spare = 20 + int(ceil(8 / (1 - float(chatter.mid())))) if chatter < 1 else 20

    def leg(self, key, scene, impacts):
        """`Proved` with `impacts` impacts of a scene that begins a leg, or with the impacts up to its rest."""
        known = self.proved.get(key)
        if known is None or known[0] < impacts and known[1].rest is None:
            settle = settle_within(self.digits)
            known = impacts, prove(scene, impacts, max(self.width, self.digits + 20), settle, MOST_BITS)
            self.proved[key] = known
        return known[1]

    def begin(self):
        """The origin of the first leg."""
        return Origin(self, None, self.scene)


class Origin:
    """The beginning of a leg: here, the start of the scene. `scene` begins there; `key` tells the legs apart."""

    number = 0

    def __init__(self, timeline, key, scene):
        self.timeline, self.key, self.scene = timeline, key, scene

    def prove(self, impacts, resting):
        """`Proved` with at least `impacts` impacts, and the rest, if there is one and `resting`."""
        return self.timeline.leg(self.key, self.scene, impacts + (self.timeline.spare if resting else 0))

    def prove_on(self, impacts, proved):
        """The same rest with `impacts` impacts before it, however little time is left."""
        on = prove(self.scene, impacts, self.timeline.width, None, MOST_BITS)
        return on._replace(rest=proved.rest, bits=max(on.bits, proved.bits))

    def prove_closer(self, impacts):
        """`Proved` with its rest known to more digits than any listing of the timeline's shows; it takes more impacts."""
        digits = self.timeline.digits + CLOSER
        width, more = max(self.timeline.width, digits + 20), CLOSER * self.timeline.spare
        return prove(self.scene, impacts + more, width, settle_within(digits), MOST_BITS)

    def began(self, bits):
        """The time at which it begins in the leg's own time, as a ball."""
        with ctx.workprec(bits):
            return self.scene.start()[1]

    def time(self, bits):
        """The time at which it begins, as a ball."""
        return self.began(bits)

    def shifted(self, time, bits):
        """A time of the leg as a time of the orbit."""
        return time

    def next(self, rest):
        """The beginning of the next leg, after a rest on this one."""
        if isinstance(rest.release, int):
            return AtPhase(self.timeline, rest.wall, rest.release + self.half_turns_before())
        return AtRoot(self.timeline, rest.release, self.number + 1)

    def half_turns_before(self):
        """The half periods that a count on this leg leaves out."""
        return 0


class AtPhase(Origin):
    """The release from a wall at th = half_turns * pi of one harmonic; it is time 0 of its leg."""

    def __init__(self, timeline, wall, half_turns):
        super().__init__(timeline, wall, Released(timeline.scene, wall))
        self.wall, self.half_turns = wall, half_turns

    def time(self, bits):
        with ctx.workprec(bits):
            return release_time(self.timeline.scene, self.half_turns)

    def shifted(self, time, bits):
        with ctx.workprec(bits):
            return self.time(bits) + time

    def half_turns_before(self):
        # At the beginning of this leg th is 0 on the left and pi on the right, in the leg's own count.
        return self.half_turns - (0 if self.wall == LEFT else 1)

    def cycles_since(self, earlier):
        """The whole cycles since an earlier release from the same wall."""
        return (self.half_turns - earlier.half_turns) // 2


class AtRoot(Origin):
    """The release at a root of the pressure; its leg keeps the time of the orbit."""

    def __init__(self, timeline, root, number):
        super().__init__(timeline, number, ReleasedAt(timeline.scene, root))
        self.wall, self.number = root.wall, number

    def cycles_since(self, earlier):
        """The cycles of the fastest harmonic since an earlier release from this wall at the same phases, or None.

        Moved by that many periods of the excitation, the earlier one is a root, too. If a' has one sign on both balls
        and between, there is only one root.
        """
        with ctx.workprec(FIRST_BITS):
            common = self.timeline.scene.common_period()
            if common is None:
                return None
            period, cycles = common
            later, first = self.time(FIRST_BITS), earlier.time(FIRST_BITS)
            count = ((later - first) / period).unique_fmpz()
            if count is None:
                return None
            both = later.union(first + int(count) * period)
            is_same = pressure_slope(self.timeline.scene.motion(), self.wall, both) < 0
            return int(count) * cycles if is_same else None
