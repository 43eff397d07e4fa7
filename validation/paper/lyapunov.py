"""The growth of a tangent vector along certified impacts, enclosed: the finite-time Lyapunov exponent per impact.

The vector's direction phi is a ball: with u its middle and J from (A.7), the mean value theorem gives the next one as
arg(J u) + det J/|J u(phi)|^2 (phi - mid phi), since that quotient is the derivative of arg(J u(phi)). Where the vector
grows the ball shrinks, so thousands of impacts keep their digits. Units of pair.py; the vector is (d th, d v).
"""
from flint import arb


def direction(phi):
    """(cos phi, sin phi)."""
    return phi.cos(), phi.sin()


def applied(jacobian, u):
    """J u."""
    return jacobian[0, 0] * u[0] + jacobian[0, 1] * u[1], jacobian[1, 0] * u[0] + jacobian[1, 1] * u[1]


def exponent(run):
    """(1/n) log |DP_n ... DP_1 (1, 0)| over the n listed impacts, a ball that holds the true value."""
    phi, growth, this = arb(0), arb(0), run.start
    for following in run.impacts:
        jacobian = run.pair.jacobian(*this[1:], *following[1:])
        x, y = applied(jacobian, direction(phi))
        square = x * x + y * y
        p, q = applied(jacobian, direction(phi.mid()))
        phi = arb.atan2(q, p) + jacobian.det() / square * (phi - phi.mid())
        phi, growth, this = arb(phi.mid(), phi.rad()), growth + square.log() / 2, following
    return growth / len(run.impacts)
