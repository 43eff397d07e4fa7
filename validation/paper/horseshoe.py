"""Chaos proved with A far below d/2: an orbit for every sequence of two flight times.

Mirrored after each crossing (R2 of docs/proofs/reduction.md), an orbit of crossings is a sequence of phases y, flight i
lasting N_i half periods but for the difference of its phases. Displacement gives its drift C(N; y, z) = (d/A - sin z -
sin y)/(N pi + z - y), and (A.1), (A.3) ask for F = C(N; y, z) - e C(M; x, y) - (1 + e) cos y = 0 at each impact, with x
before and z after y. If F > 0 at y = alpha and F < 0 at y = beta for all x, z in [alpha, beta] and all M, N of two
odd numbers, the theorem of Poincare and Miranda solves all equations of any finite sequence of them at once, and
compactness those of any infinite one. With C > 1 the ball never turns, so no wall is touched between.
"""
from itertools import product

from flint import arb

from finding import PROVED, Finding, expect
from pair import ball

PIECES = 12
# A/d, e, the two N, the window [alpha, beta] of phases.
CASES = (("0.036", "0.9", (5, 7), "-2", "-0.9"), ("0.02", "0.5", (9, 11), "-1.9", "-0.5"),
         ("0.001", "0.9", (211, 213), "-2", "-0.9"))


def drift(gap, halves, y, z):
    """C(N; y, z)."""
    return (gap - z.sin() - y.sin()) / (halves * arb.pi() + z - y)


def balance(gap, e, halves, phases):
    """F at an impact, for the half periods M, N before and after it and the phases x, y, z."""
    (before, after), (x, y, z) = halves, phases
    return drift(gap, after, y, z) - e * drift(gap, before, x, y) - (1 + e) * y.cos()


def window(alpha, beta):
    """[alpha, beta] in balls that cover it."""
    ends = [alpha + (beta - alpha) * k / PIECES for k in range(PIECES + 1)]
    return [a.union(b) for a, b in zip(ends, ends[1:])]


def every_sequence(ratio, e, pair_of_halves, alpha, beta):
    """Proves the signs of F and C > 1 over the window; returns the least of |F| on the two sides and of C."""
    gap, e, alpha, beta = 1 / ball(ratio), ball(e), ball(alpha), ball(beta)
    pieces, margin, slowest = window(alpha, beta), arb(10), arb(10)
    for before, after in product(pair_of_halves, repeat=2):
        for x, z in product(pieces, repeat=2):
            low, high = (balance(gap, e, (before, after), (x, y, z)) for y in (alpha, beta))
            expect(low > 0 > high, f"the signs of F at A/d = {ratio}")
            c = drift(gap, after, x, z)
            expect(c > 1, f"the drift at A/d = {ratio}")
            margin, slowest = (part.lower() for part in (margin.min(low).min(-high), slowest.min(c)))
    return margin, slowest


def chaos_proved(quick):
    """The cases."""
    shown = []
    for ratio, e, halves, alpha, beta in CASES:
        margin, slowest = every_sequence(ratio, e, halves, alpha, beta)
        shown.append(f"A = {ratio} d, e = {e}, N in {halves}, phases in [{alpha}, {beta}]: |F| > "
                     f"{margin.str(3, radius=False)}, C > {slowest.str(4, radius=False)}")
    return [Finding("chaos exists with A < d/2: an orbit for every sequence of two flight times, entropy log 2",
                    PROVED, "; ".join(shown))]


CLAIMS = {"chaos-proved": chaos_proved}
