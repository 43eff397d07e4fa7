"""A start proved to be attracted to a stable orbit: a box around the orbit that the map of one period contracts.

With coordinates x = x* + T s around the proved state x*, the mean value theorem gives P(x) - x* = T G s with G =
T^-1 DP T over the box |s| <= r. If the greatest row sum of |G| is q < 1, every state in the box tends to x*, and if
det G is never 0 none but x* itself ever is x*.
"""
from flint import arb, arb_mat

from contact import first_contact
from periodic import Refused

UNIT = arb(0, 1)


def axes(jacobian):
    """T: the eigenvectors of a matrix, or the real and imaginary part of one, as columns; rounded and exact."""
    a, b, c, d = (x.mid() for x in jacobian.entries())
    half, under = (a + d) / 2, (a + d) ** 2 / 4 - (a * d - b * c)
    root = abs(under).sqrt()
    first, second = ((b, half - root - a), (b, half + root - a)) if under > 0 else ((b, half - a), (arb(0), root))
    columns = [[(x / (p * p + q * q).sqrt()).mid() for x in (p, q)] for p, q in (first, second)]
    return arb_mat(columns).transpose()


def contraction(orbit, radius):
    """(q, T): the factor of contraction over the box |s| <= radius, or Refused."""
    coordinates = axes(orbit.jacobian())
    product = coordinates
    for (wall0, th0, v0), (wall1, th1, _) in orbit.flights():
        spread = [abs(product[i, 0]) + abs(product[i, 1]) for i in (0, 1)]
        th, v = (x + UNIT * y * radius for x, y in zip((th0, v0), spread))
        contact = first_contact(orbit.pair, wall0, th, v)
        if contact.wall != wall1 or not contact.isolating.contains(th1):
            raise Refused("the box does not follow the orbit")
        landing = orbit.pair.drift(th, v) - contact.th.cos()
        product = orbit.pair.jacobian(th, v, contact.th, landing) * product
    g = coordinates.inv() * product
    rows = [abs(g[i, 0]) + abs(g[i, 1]) for i in (0, 1)]
    q = rows[0].max(rows[1])
    if not q < 1 or g.det().contains(0):
        raise Refused(f"no contraction over a box of {radius.str(3)}: {q.str(6)}")
    return q.upper(), coordinates


def offset(orbit, coordinates, th, v):
    """s of a state near the orbit's first one, modulo the excitation's period."""
    _, th0, v0 = orbit.states[0]
    turn = 2 * arb.pi()
    th = th - turn * ((th - th0) / turn + arb("0.5")).mid().floor()
    s = coordinates.inv() * arb_mat([[th - th0], [v - v0]])
    return s[0, 0], s[1, 0]


def enters(orbit, states, radius):
    """(n, q): the first of the states (wall, th, v), one period apart, inside a box that the orbit attracts, but not on
    the orbit itself; and the contraction there."""
    q, coordinates = contraction(orbit, radius)
    for n, (wall, th, v) in states:
        s = offset(orbit, coordinates, th, v)
        if wall == orbit.states[0][0] and all(abs(x) < radius for x in s):
            if all(x.contains(0) for x in s):
                raise Refused("the state may be the orbit's own")
            return n, q
    raise Refused("no state of the run is in the box")
