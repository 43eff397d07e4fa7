"""An orbit that goes through rests: legs from one release to the next, proved one by one.

A release forgets everything but its wall, so there are three legs at most, however long the orbit: from the start,
from the left wall and from the right wall. A second release from the same wall makes the orbit exactly periodic.
"""
from math import ceil

from flint import arb, ctx

from orbit import prove
from rest import Released, half_turns_at, settle_within
from scene import LEFT

# Bits that are tried for a leg: enough for 200 impacts of anything that is not an exact graze.
MOST_BITS = 1 << 13


class Timeline:
    """The legs of a scene, for comparisons with listings to so many digits; computed when they are asked for."""

    def __init__(self, scene, digits):
        self.scene, self.digits = scene, digits
        self.proved = {}
        chatter = scene.motion().restitution
        # Impacts from the last one that a listing needs to the rest that `settle_within` sees, and some to spare.
        self.spare = 20 + int(ceil(8 / (1 - float(chatter.mid())))) if chatter < 1 else 20

    def leg(self, wall, impacts):
        """`Proved` with so many impacts, or those up to its rest; times count from the release from a wall, if any."""
        known = self.proved.get(wall)
        if known is None or known[0] < impacts and known[1].rest is None:
            scene = self.scene if wall is None else Released(self.scene, wall)
            settle = settle_within(self.digits)
            known = impacts, prove(scene, impacts, max(30, self.digits + 20), settle, MOST_BITS)
            self.proved[wall] = known
        return known[1]

    def begin(self):
        """Where the first leg begins."""
        return Origin(self, None, None)


class Origin:
    """The beginning of a leg: the start of the scene, or the release from a wall at th = half_turns * pi."""

    def __init__(self, timeline, wall, half_turns):
        self.timeline, self.wall, self.half_turns = timeline, wall, half_turns

    def prove(self, impacts, resting):
        """`Proved` with so many impacts at least, and the rest, if there is one and `resting`."""
        return self.timeline.leg(self.wall, impacts + (self.timeline.spare if resting else 0))

    def time(self, bits):
        """When it begins, as a ball."""
        with ctx.workprec(bits):
            if self.wall is None:
                return self.timeline.scene.start()[1]
            return release_time(self.timeline.scene, self.half_turns)

    def shifted(self, time, bits):
        """A time of the leg as a time of the orbit."""
        if self.wall is None:
            return time
        with ctx.workprec(bits):
            return self.time(bits) + time

    def next(self, rest):
        """The beginning of the next leg, after a rest on this one."""
        half_turns = rest.release
        if self.wall is not None:
            # At the beginning of this leg th is 0 on the left and pi on the right, in the leg's own count.
            half_turns += self.half_turns - (0 if self.wall == LEFT else 1)
        return Origin(self.timeline, rest.wall, half_turns)


def release_time(scene, half_turns):
    """When the excitation has come so far."""
    motion = scene.motion()
    ((_, frequency, _),) = motion.terms
    return (half_turns - half_turns_at(motion, arb(0))) * arb.pi() / frequency
