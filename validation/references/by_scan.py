"""The closed form (12), scanned in steps of T/100 for a change of sign, which SciPy's `brentq` then closes in on."""
from scipy.optimize import brentq

from flight import fly
from scene import LEFT, RIGHT, Motion, Start
from simulator import Contact, Listing, bounce

STEPS = 100      # a period
NUDGE = 1e-3     # the first look at the ball, in steps after its departure from the wall


class ByScan:
    """The usual way without an ODE solver."""

    name = "scan T/100 + brentq"
    tolerance = 2e-12  # brentq's own

    def contacts(self, motion: Motion[float], start: Start[float], until: float, limit: int) -> Listing:
        found: list[Contact] = []
        while len(found) < limit:
            try:
                contact = self.first(motion, start, until)
            except ValueError as error:
                return Listing(found, f"ValueError: {error}")
            if contact is None:
                return Listing(found, "time")
            found.append(contact)
            start = bounce(motion, contact)
        return Listing(found, "impacts")

    @staticmethod
    def first(motion: Motion[float], start: Start[float], until: float) -> Contact | None:
        """The first contact that the scan sees."""
        height, velocity, _ = fly(motion, start)
        half, step = motion.gap / 2, motion.period / STEPS
        before, count = start.time + NUDGE * step, 0
        while before < until:
            count += 1
            time = min(start.time + count * step, until)
            y = height(time)
            if abs(y) > half:
                sign, wall = (1, RIGHT) if y > 0 else (-1, LEFT)
                root = brentq(lambda t: sign * height(t) - half, before, time)
                return Contact(root, wall, velocity(root))
            before = time
        return None
