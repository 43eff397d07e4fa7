"""The map of the impact pair in Arb balls, (A.1)-(A.7), for one harmonic.

Units: lengths in A, times in 1/W. So phases are th = W t + tau in radians, velocities y'/(A W), and the only
parameters are gap = d/A and the restitution e. A velocity is the one just before the impact, with its sign. 0 is this
impact, 1 the next one.
"""
from flint import arb, arb_mat

LEFT, RIGHT = "left", "right"
MAPPING = {(RIGHT, LEFT): "P1", (LEFT, RIGHT): "P2", (RIGHT, RIGHT): "P3", (LEFT, LEFT): "P4"}


def ball(value):
    """The exact value of a decimal string, an integer or a fraction "p/q", as a ball; balls stay as they are."""
    if isinstance(value, str) and "/" in value:
        over, under = value.split("/")
        return arb(over) / arb(under)
    return arb(value)


class Pair:
    """An impact pair with gap d/A and restitution e."""

    def __init__(self, gap, restitution):
        self.gap, self.e = ball(gap), ball(restitution)

    def level(self, wall):
        """The height of a wall above the left one."""
        return self.gap if wall == RIGHT else arb(0)

    def drift(self, th0, v0):
        """c = v+ + A W cos th0 of (11), with v+ = -e v of (15)."""
        return -self.e * v0 + th0.cos()

    def misses(self, this, following):
        """Residuals of (A.1)/(A.3)/(A.5) and (A.2)/(A.4)/(A.6) for states (wall, th, v): 0 on orbits."""
        (wall0, th0, v0), (wall1, th1, v1) = this, following
        c = self.drift(th0, v0)
        velocity = v1 + th1.cos() - c
        displacement = self.level(wall1) - self.level(wall0) + th1.sin() - c * (th1 - th0) - th0.sin()
        return velocity, displacement

    def slopes(self, th0, v0, th1):
        """The derivatives of `misses` by (th0, v0) and by (th1, v1), two 2 x 2 lists."""
        h = th1 - th0
        by_this = [[th0.sin(), self.e], [th0.sin() * h - self.e * v0, self.e * h]]
        by_next = [[-th1.sin(), arb(1)], [th1.cos() - self.drift(th0, v0), arb(0)]]
        return by_this, by_next

    def jacobian(self, th0, v0, th1, v1):
        """d(th1, v1)/d(th0, v0), eq. (A.7)."""
        h = th1 - th0
        dt_dt, dt_dv = (th0.sin() * h - self.e * v0) / v1, self.e * h / v1
        return arb_mat([[dt_dt, dt_dv], [th1.sin() * dt_dt - th0.sin(), th1.sin() * dt_dv - self.e]])


def name(walls):
    """The word of a closed sequence of walls in time order, the right-most mapping first, as the paper writes it."""
    steps = zip(walls, walls[1:] + walls[:1])
    return " ".join(reversed([MAPPING[step] for step in steps]))
