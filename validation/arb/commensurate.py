"""Commensurability of frequencies, and of phases with pi, decided from how they are written.

No ball tells a fraction from a number beside it. Here an expression is read as a fraction times powers of pi and of
square roots of primes; sqrt(8) and 2*sqrt(2) are the same, and what is not of this form is not judged.
"""
from math import gcd, lcm

from flint import fmpq, fmpz

from expression import ExpressionError, Reader, decimal


class NotAMultiple(ExpressionError):
    """The expression is not a fraction times powers of pi and of roots."""


class Multiple:
    """fraction * product of atom^power; an atom is "pi" or a prime under a square root."""

    def __init__(self, fraction, powers=()):
        self.fraction = fraction
        self.powers = {atom: power for atom, power in dict(powers).items() if power}

    @property
    def p(self):
        return self.exponent().p

    @property
    def q(self):
        return self.exponent().q

    def exponent(self):
        """The value where it must be a fraction."""
        if self.powers:
            raise NotAMultiple("an exponent is an integer")
        return self.fraction

    def __eq__(self, number):
        return self.fraction == number

    def __lt__(self, number):
        return self.exponent() < number

    def __neg__(self):
        return Multiple(-self.fraction, self.powers)

    def __add__(self, other):
        if self.fraction != 0 and other.fraction != 0 and self.powers != other.powers:
            raise NotAMultiple("a sum of different numbers")
        return Multiple(self.fraction + other.fraction, self.powers if self.fraction != 0 else other.powers)

    def __sub__(self, other):
        return self + -other

    def __mul__(self, other):
        fraction, powers = self.fraction * other.fraction, dict(self.powers)
        for atom, power in other.powers.items():
            total = powers.get(atom, 0) + power
            if atom != "pi":
                # sqrt(n)^2 is n.
                fraction, total = fraction * fmpq(atom) ** (total // 2), total % 2
            powers[atom] = total
        return Multiple(fraction, powers)

    def __truediv__(self, other):
        return self * Multiple(1 / other.fraction, {atom: -power for atom, power in other.powers.items()})

    def __pow__(self, exponent):
        power = Multiple(fmpq(1))
        for _ in range(exponent):
            power *= self
        return power


class _Multiples(Reader):
    """The same grammar with other values."""

    def literal(self, text):
        return Multiple(decimal(text))

    def pi(self):
        return Multiple(fmpq(1), {"pi": 1})

    def call(self, function, value):
        if function != "sqrt" or value.powers or value.fraction < 0:
            raise NotAMultiple(f"{function} of this")
        return square_root(value.fraction)


def square_root(fraction):
    """sqrt(p/q) = sqrt(p q)/q, prime by prime."""
    if fraction == 0:
        return Multiple(fmpq(0))
    root = Multiple(fmpq(1, fraction.q))
    for prime, power in fmpz(fraction.p * fraction.q).factor():
        root *= Multiple(fmpq(prime) ** (power // 2), {int(prime): power % 2})
    return root


def common_measure(texts):
    """The largest fraction g such that all the numbers are whole multiples of g times the first; None: not seen."""
    try:
        first, *others = [_Multiples(text).whole() for text in texts]
        ratios = [fmpq(1)] + [(other / first).exponent() for other in others]
    except NotAMultiple:
        return None if len(texts) > 1 else fmpq(1)
    return fmpq(gcd(*(int(ratio.p) for ratio in ratios)), lcm(*(int(ratio.q) for ratio in ratios)))


def half_turns(text):
    """k if the expression is the whole multiple k pi; None otherwise, or if that is not seen."""
    try:
        value = _Multiples(text).whole()
    except NotAMultiple:
        return None
    turns = value.fraction
    return int(turns.p) if turns.q == 1 and (turns == 0 or value.powers == {"pi": 1}) else None
