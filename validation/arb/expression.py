"""Exact expressions of a scene file: decimals, fractions, + - * / ^ ( ), pi, sqrt, sin, cos.

A value stays a fraction (fmpq) as long as it can; pi, a root, a sine or a cosine turns it into a ball (arb) of the
current precision. `^` takes an integer exponent, groups to the right and binds tighter than a sign: -2^2 is -4.
"""
import re

from flint import arb, fmpq

TOKEN = re.compile(r"\s*(?:(\d[\d_]*\.?[\d_]*(?:[eE][-+]?\d+)?|\.\d[\d_]*(?:[eE][-+]?\d+)?)|([a-z]+)|([-+*/^()]))")
FUNCTIONS = {"sqrt": arb.sqrt, "sin": arb.sin, "cos": arb.cos}


class ExpressionError(ValueError):
    """A text of the scene file that is not an expression."""


def ball(value):
    """The value as a ball of the current precision."""
    return value if isinstance(value, arb) else arb(value)


def evaluate(text):
    """The value of an expression, a fraction or a ball that holds it."""
    value = Reader(text).whole()
    if isinstance(value, arb) and not value.is_finite():
        raise ExpressionError(f"{text!r} is not a finite number")
    return value


def decimal(text):
    """A decimal as written, as a fraction."""
    digits, _, exponent = text.replace("_", "").lower().partition("e")
    whole, _, part = digits.partition(".")
    return fmpq(int(whole + part)) * fmpq(10) ** (int(exponent or 0) - len(part))


class Reader:
    """One pass from left to right; each method reads one level of the grammar.

    `literal`, `pi` and `call` say what the values are.
    """

    def __init__(self, text):
        self.text = text
        self.tokens = []
        at = 0
        while text[at:].strip():
            match = TOKEN.match(text, at)
            if not match:
                raise ExpressionError(f"{text!r}: cannot read {text[at:].strip()!r}")
            self.tokens.append(match.group().strip())
            at = match.end()
        self.tokens.append(None)

    def peek(self):
        return self.tokens[0]

    def take(self):
        return self.tokens.pop(0)

    def expect(self, token):
        if self.peek() != token:
            raise ExpressionError(f"{self.text!r}: found {self.peek() or 'the end'!r}, expected {token or 'the end'!r}")
        self.take()

    def whole(self):
        value = self.sum()
        self.expect(None)
        return value

    def literal(self, text):
        return decimal(text)

    def pi(self):
        return arb.pi()

    def call(self, function, value):
        return FUNCTIONS[function](ball(value))

    def sum(self):
        value = self.product()
        while self.peek() in ("+", "-"):
            value = value + self.product() if self.sign() == "+" else value - self.product()
        return value

    def sign(self):
        """A sign, which none follows."""
        sign = self.take()
        if self.peek() in ("+", "-"):
            raise ExpressionError(f"{self.text!r}: found {self.peek()!r} after {sign!r}")
        return sign

    def product(self):
        value = self.signed()
        while self.peek() in ("*", "/"):
            if self.take() == "*":
                value = value * self.signed()
            else:
                value = self.quotient(value, self.signed())
        return value

    def quotient(self, value, divisor):
        if divisor == 0:
            raise ExpressionError(f"{self.text!r}: division by zero")
        return value / divisor

    def signed(self):
        if self.peek() in ("+", "-"):
            return self.power() if self.sign() == "+" else -self.power()
        return self.power()

    def power(self):
        base = self.atom()
        if self.peek() != "^":
            return base
        self.take()
        exponent = self.signed()
        if isinstance(exponent, arb) or exponent.q != 1:
            raise ExpressionError(f"{self.text!r}: an exponent is an integer")
        if exponent < 0:
            return self.quotient(self.literal("1"), base ** -int(exponent.p))
        return base ** int(exponent.p)

    def atom(self):
        token = self.take()
        if token == "(":
            value = self.sum()
            self.expect(")")
            return value
        if token == "pi":
            return self.pi()
        if token in FUNCTIONS:
            self.expect("(")
            value = self.call(token, self.sum())
            self.expect(")")
            return value
        if token is None or not (token[0].isdigit() or token[0] == "."):
            raise ExpressionError(f"{self.text!r}: found {token or 'the end'!r}, expected a value")
        return self.literal(token)
