"""The paper's misprints, each decided by numbers: the printed form fails, the right one holds."""
from flint import arb, arb_mat, arb_series

from contact import first_contact
from finding import MISPRINT, Finding, excludes, expect, tiny
from listed import listed
from pair import LEFT, RIGHT, Pair
from periodic import Orbit

# An impact of no special kind: A, W, tau, d, e; t0, v0 at the left wall. Fractions of 8 are exact at any precision.
A, W, TAU, GAP, E, T0, V0 = (arb(x) for x in (2, 3, 0.625, 5, 0.625, 0.25, -4))


def landed():
    """(t1, v1) of that impact, from the first contact in the units of pair.py."""
    pair = Pair(GAP / A, E)
    contact = first_contact(pair, LEFT, W * T0 + TAU, V0 / (A * W))
    expect(contact.wall == RIGHT, "the mapping is P2")
    return (contact.th - TAU) / W, (pair.drift(W * T0 + TAU, V0 / (A * W)) - contact.th.cos()) * A * W


def derivatives(by_time):
    """d(t1, v1)/dt0 or d(t1, v1)/dv0 from power series in the changed datum: nothing of (A.7) is used."""
    unit = arb_series([0, 1], 2)
    t0, v0 = T0 + unit if by_time else arb_series([T0], 2), V0 + unit if not by_time else arb_series([V0], 2)
    t1 = arb_series([landed()[0]], 2)
    theta0 = W * t0 + TAU
    c = -E * v0 + A * W * theta0.cos()
    miss = GAP + A * (W * t1 + TAU).sin() - c * (t1 - t0) - A * theta0.sin()
    slope = A * W * (W * t1 + TAU).cos() - c
    t1 = t1 - miss / slope
    v1 = c - A * W * (W * t1 + TAU).cos()
    return t1[1], v1[1]


def jacobian():
    """(A.7): sin(W t1 + tau) in the second row, h e/v1 in the velocity column."""
    t1, v1 = landed()
    h, a0, a1 = t1 - T0, A * W * W * (W * T0 + TAU).sin(), A * W * W * (W * t1 + TAU).sin()
    (tt, vt), (tv, vv) = derivatives(True), derivatives(False)
    tiny(tt - (a0 * h - E * V0) / v1, "dt1/dt0")
    tiny(vt - (a1 * (a0 * h - E * V0) / v1 - a0), "dv1/dt0")
    tiny(tv - E * h / v1, "dt1/dv0")
    tiny(vv - (E * h / v1 * a1 - E), "dv1/dv0")
    wrong = []
    for t in (T0, t1):
        printed = A * W * W * (W * t1 + t).sin() * (a0 * h - E * V0) / v1 - a0
        excludes(vt - printed, "sin(W t1 + t) as printed")
        wrong.append((vt - printed).str(4))
    excludes(tv - E * v1 * h, "e v1 h as a product")
    return Finding("(A.7): sin(W t1 + t) is sin(W t1 + tau)", MISPRINT, "dv1/dt0 misses the printed form by "
                   f"{wrong[0]} (t = t0), {wrong[1]} (t = t1), the right one by 0"), \
        Finding("(A.7): the velocity column has e h/v1, not the product e v1 h", MISPRINT,
                f"dt1/dv0 = {tv.str(8)}, the product is {(E * v1 * h).str(6)}")


def velocity():
    """(62): its left side is v_i; for i = 0 the printed index 1 gives the wrong sign."""
    (_, th0, v0), (_, th1, v1) = listed("N = 2").states
    right = (th1.cos() - th0.cos()) / arb("0.5")
    tiny(right - v0, "(62) with v_i")
    excludes(right - v1, "(62) with v_1")
    return Finding("(62): the left side is v_i, not v_1", MISPRINT,
                   f"N = 2 orbit, i = 0: right side - v_0 is 0, right side - v_1 = {(right - v1).str(8)}")


def count():
    """After (53): m + n + 2 impacts a period with the exponents m, n; m + n with m, n impacts on each side."""
    orbit = listed("model III, RRLL")
    words = orbit.word().split()
    exponents = words.count("P3"), words.count("P4")
    impacts = [wall for wall, _, _ in orbit.states]
    expect(exponents == (1, 1) and len(impacts) == sum(exponents) + 2, "m + n + 2")
    expect((impacts.count(RIGHT), impacts.count(LEFT)) == (2, 2), "exponents are impacts less one")
    return Finding('after (53): "(m + n + 1)" impacts per cycle are m + n + 2; m impacts on the right need P3^(m-1)',
                   MISPRINT, "P2 P4 P1 P3: exponents 1 and 1, four impacts, two on each side")


def identity():
    """(30): P is not the identity at a fixed point; its derivative has determinant e^4."""
    product = listed("N = 2").jacobian()
    difference = product - arb_mat([[1, 0], [0, 1]])
    excludes(difference.det(), "DP - I")
    tiny(product.det() - arb("0.5") ** 4, "det DP")
    return Finding('(30)-(34): "P2 P1 = I" means P x = x; and "P(2) = I" for doubling an eigenvalue -1', MISPRINT,
                   f"N = 2 orbit, e = 1/2: det DP = {product.det().str(6)} = e^4, not 1")


def elastic():
    """(70), e = 1: cos th1 = -cos th0 holds on equispaced orbits only; N = 3, th0 = -1/2, th1 = 1/2 + 2 pi."""
    th0, cycles = arb("-0.5"), 3
    th1 = 2 * arb.pi() - th0
    h, turn = th1 - th0, cycles * arb.pi()
    v = th0.cos() * turn / (h - turn)
    expect(v < 0, "the start is on the left wall")
    c0 = -v + th0.cos()
    orbit = Orbit(Pair(c0 * h - th1.sin() + th0.sin(), 1), cycles, [(LEFT, th0, v), (RIGHT, th1, -v)])
    for miss in orbit.misses():
        tiny(miss, "the elastic orbit")
    orbit.require_first_contacts()
    tiny(th1.cos() - th0.cos(), "cos th1 = cos th0")
    excludes(th1.cos() + th0.cos(), "cos th1 = -cos th0")
    return Finding("(70): cos th1 = -cos th0 presupposes (64); for e = 1 only cos th1 = cos th0 follows", MISPRINT,
                   f"unequispaced orbit, N = {cycles}, d/A = {orbit.pair.gap.str(8)}, th0 = -1/2: cos th1 + cos th0 = "
                   f"{(th1.cos() + th0.cos()).str(6)}")


def gap():
    """Figures 12-14: the printed d = 9.42497 is not 3 pi."""
    difference = arb("9.42497") - 3 * arb.pi()
    excludes(difference, "9.42497 - 3 pi")
    expect(abs(arb("9.42478") - 3 * arb.pi()) < 5e-6, "9.42478 is 3 pi to five decimals")
    expect(abs(arb("12.56636") - 4 * arb.pi()) < 2e-5, "12.56636 is 4 pi but for its last digit")
    return Finding("figures 12-14: d = 9.42497 for 3 pi = 9.42478", MISPRINT, f"9.42497 - 3 pi = {difference.str(6)}")


CLAIMS = {"misprints": lambda quick: [velocity(), *jacobian(), count(), identity(), elastic(), gap()]}
