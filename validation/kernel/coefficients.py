#!/usr/bin/env python3
"""Prints the coefficients of src/kernel.rs. Needs mpmath. Run: python3 validation/kernel/coefficients.py

Each polynomial is a near-minimax fit (weighted least squares on Chebyshev points, which differs from
the minimax error by a small factor only) whose coefficients are rounded to binary64 one by one, lowest
first, refitting the remaining ones each time. Nothing here is trusted: `prove` bounds what is printed.
"""
from mpmath import mp, mpf, pi, cos, factorial, sqrt, atan, matrix, lu_solve

mp.prec = 300


def chebyshev_points(hi, n):
    return [hi * (1 - cos(pi * (2 * i + 1) / (2 * n))) / 2 for i in range(n)]


def fit(target, degree, hi, weight):
    """Rounded coefficients of a polynomial near `target` on [0, hi]; `weight` multiplies the error."""
    points = chebyshev_points(mpf(hi), 60)
    values = [target(x) for x in points]
    done = []
    while len(done) <= degree:
        powers = range(len(done), degree + 1)
        rows = [[weight(x) * x**p for p in powers] for x in points]
        right = [weight(x) * (v - sum(c * x**i for i, c in enumerate(done))) for x, v in zip(points, values)]
        n = len(powers)
        normal = matrix(n, n)
        moment = matrix(n, 1)
        for i in range(n):
            moment[i] = sum(row[i] * y for row, y in zip(rows, right))
            for j in range(n):
                normal[i, j] = sum(row[i] * row[j] for row in rows)
        done.append(mpf(float(lu_solve(normal, moment)[0])))
    error = max(abs(weight(x) * (target(x) - sum(c * x**i for i, c in enumerate(done))))
                for x in chebyshev_points(mpf(hi), 999))
    return done, error


def taylor(first):
    """(sum over n of (-1)^n (2 pi)^(2n+first) x^n / (2n+first)!): P for first = 3, Q for first = 2."""
    return lambda x: sum((-1)**n * (2 * pi)**(2*n + first) * x**n / factorial(2*n + first) for n in range(30))


def coarse(z):
    """acos(1 - z) / (2 pi sqrt(z)), continued to z = 0."""
    return atan(sqrt(z / (2 - z))) / (pi * sqrt(z)) if z else 1 / (pi * sqrt(2))


def show(name, found):
    coefficients, error = found
    print(f"{name}: weighted error 2^{float(mp.log(error, 2)):.2f}")
    for c in coefficients:
        print(f"    {float(c)!r:>24}, // {float(c).hex()}")


tau_hi = float(2 * pi)
print(f"TAU_HI {tau_hi!r} {tau_hi.hex()}\nTAU_LO {float(2 * pi - tau_hi)!r} {float(2 * pi - tau_hi).hex()}")
for name, first, power in (("P", 3, 1.5), ("Q", 2, 1)):
    # Constant term: the nearest double. The others minimise the absolute error of the sine and the cosine.
    whole = taylor(first)
    lead = mpf(float(whole(mpf(0))))
    print(f"{name}_0 {float(lead)!r} {float(lead).hex()}; relative error 2^{float(mp.log(abs(whole(mpf(0)) / lead - 1), 2)):.2f}")
    show(f"{name}_TAIL", fit(lambda x: (whole(x) - lead) / x, 5, mpf(1) / 64, lambda x: x**(1 + power)))
show("A", fit(coarse, 8, 1, lambda z: sqrt(z)))
