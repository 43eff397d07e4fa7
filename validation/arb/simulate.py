#!/usr/bin/env python3
"""Prints the proved impacts of a scene as CSV, with bounds rounded outward. Run: simulate.py SCENE --impacts N"""
import argparse
import csv
import sys
from fractions import Fraction

from expression import ExpressionError
from flight import Undecided
from orbit import orbit
from scene import Scene, SceneError

HEADER = ["event", "index", "mapping", "wall", "time_lower", "time_upper", "velocity_lower", "velocity_upper"]


def exact(number):
    """An exact ball as a fraction."""
    mantissa, exponent = (int(part) for part in number.man_exp())
    return Fraction(mantissa) * Fraction(2) ** exponent


def ends(ball):
    """Both ends of a ball, exact."""
    middle, radius = exact(ball.mid()), exact(ball.rad())
    return middle - radius, middle + radius


def decimal_below(value, places):
    """The largest decimal with `places` decimals that is not above a fraction."""
    units = value * 10**places // 1
    digits = str(abs(units)).rjust(places + 1, "0")
    return ("-" if units < 0 else "") + digits[: len(digits) - places] + "." + digits[len(digits) - places :]


def negated(text):
    """Minus a decimal."""
    return text[1:] if text.startswith("-") else "-" + text


def decimals(ball, places):
    """Two decimals with the ball between them."""
    lower, upper = ends(ball)
    return decimal_below(lower, places), negated(decimal_below(-upper, places))


def row(impact, places):
    """One impact as a row of the CSV; `places` are decimal places."""
    bounds = decimals(impact.time, places) + decimals(impact.velocity, places)
    return ["impact", impact.index, impact.mapping or "", impact.wall, *bounds]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene")
    parser.add_argument("--impacts", type=int, required=True)
    parser.add_argument("--digits", type=int, default=30, help="enclosures relative to 2 pi/W and A W (default 30)")
    asked = parser.parse_args()
    try:
        impacts, bits = orbit(Scene.read(asked.scene), asked.impacts, asked.digits)
    except (Undecided, ExpressionError, SceneError, OSError, ValueError) as error:
        sys.exit(f"error: {asked.scene}: {error}")
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(HEADER)
    table.writerows(row(impact, asked.digits + 6) for impact in impacts)
    print(f"{len(impacts)} impacts proved with {bits} bits", file=sys.stderr)


if __name__ == "__main__":
    main()
