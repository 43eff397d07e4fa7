#!/usr/bin/env python3
"""Counts the periodic motions of a scene again, in floats, by another method than `impact-pair cycles`.

    python3 validation/cycles/search.py scenes/figure-14.toml --impacts 7

A simulator of its own (steps and bisection, Newton's iteration at the end) follows the motion, every impact mirrored to the left wall. Where the orbit nearly comes
back after n impacts, Newton's iteration for F^n = 1 starts, with the product of the Jacobians (A.7); what it leads to is kept once,
if it lies where the orbit goes. That proves nothing: what was not met is missed. So it can refute a count, and found as many
states from long orbits it confirms one. Prints the number of states with F^n = 1 for each n.
"""

import argparse
import math
import tomllib

TURN = 2 * math.pi


def number(value):
    """A number of a scene: a decimal, or an expression of pi."""
    if isinstance(value, str):
        return float(eval(value.replace("^", "**"), {"__builtins__": {}}, {"pi": math.pi, "sqrt": math.sqrt}))
    return float(value)


class Map:
    """The impact map mirrored to the left wall: phase [rad] and speed over A W before the impact; lengths in A."""

    def __init__(self, gap, restitution):
        self.gap, self.e = gap, restitution

    def step(self, theta, w):
        """The next state, the Jacobian, and whether the far wall is touched; None where the ball does not leave."""
        c = self.e * w + math.cos(theta)

        def z(x):
            return c * x - math.sin(theta + x) + math.sin(theta)

        # Steps of at most 1/64 of the time in which velocities change by 1.
        x = 0.0
        low = 0.0
        h = 1 / 64
        for _ in range(200_000):
            x += h
            here = z(x)
            if here > self.gap or here < 0 and x > h:
                break
            if here < 0:
                # The ball is back within the first step, or does not leave.
                x -= h
                h /= 4
                if h < 1e-9:
                    return None
                continue
            # A near miss between two steps: look at the extremum.
            a, b = c - math.cos(theta + low), c - math.cos(theta + x)
            if a * b < 0:
                p, q = low, x
                for _ in range(50):
                    m = 0.5 * (p + q)
                    if (c - math.cos(theta + m)) * a > 0:
                        p = m
                    else:
                        q = m
                if not 0 <= z(0.5 * (p + q)) <= self.gap and p > 0:
                    x = 0.5 * (p + q)
                    here = z(x)
                    break
            low = x
            h = 1 / 64
        else:
            return None
        far = here > self.gap
        wall = self.gap if far else 0.0
        p, q = low, x
        beyond = (lambda x: z(x) > wall) if far else (lambda x: z(x) < wall)
        for _ in range(60):
            m = 0.5 * (p + q)
            if beyond(m):
                q = m
            else:
                p = m
        x = 0.5 * (p + q)
        theta1 = theta + x
        v = c - math.cos(theta1)
        if v == 0:
            return None
        sign = 1 if far else -1
        # (A.7) without units.
        t_t = (self.e * w + math.sin(theta) * x) / v
        t_w = -self.e * x / v
        # v = c - cos theta1, c = e w + cos theta.
        v_t = -math.sin(theta) + math.sin(theta1) * t_t
        v_w = self.e + math.sin(theta1) * t_w
        state = (theta1 + (math.pi if far else 0.0), sign * v)
        return state, ((t_t, t_w), (sign * v_t, sign * v_w)), far


def times(a, b):
    return tuple(tuple(sum(a[i][k] * b[k][j] for k in range(2)) for j in range(2)) for i in range(2))


def closed(the_map, state, n):
    """The state near this one that comes again after n impacts, by Newton's iteration."""
    theta, w = state
    for _ in range(30):
        at, product = (theta, w), ((1.0, 0.0), (0.0, 1.0))
        for _ in range(n):
            if at[1] < 0:
                return None
            found = the_map.step(*at)
            if found is None:
                return None
            at, jacobian, _ = found
            product = times(jacobian, product)
        miss = (math.remainder(at[0] - theta, TURN), at[1] - w)
        (a, b), (c, d) = product
        a, d = a - 1, d - 1
        determinant = a * d - b * c
        if determinant == 0:
            return None
        step = ((b * miss[1] - d * miss[0]) / determinant, (c * miss[0] - a * miss[1]) / determinant)
        size = math.hypot(*step)
        if size > 0.2:
            return None
        theta, w = theta + step[0], w + step[1]
        if size < 1e-11:
            return (theta % TURN, w) if w > 0 else None
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene")
    parser.add_argument("--impacts", type=int, default=7)
    parser.add_argument("--orbit", type=int, default=60_000, help="impacts to look at")
    parser.add_argument("--near", type=float, default=0.05, help="how near a return is that is tried")
    arguments = parser.parse_args()
    with open(arguments.scene, "rb") as file:
        scene = tomllib.load(file)
    shaking, pair = scene["excitation"], scene["pair"]
    the_map = Map(number(pair["gap"]) / number(shaking["amplitude"]), number(pair["restitution"]))
    start, frequency = scene["start"], number(shaking["frequency"])
    phase = frequency * number(start["time"]) + number(shaking["phase"]) + (math.pi if start["wall"] == "right" else 0)
    speed = abs(number(start["velocity"])) / (frequency * number(shaking["amplitude"]))
    state, orbit = (phase % TURN, speed), []
    for k in range(arguments.orbit + 1000):
        found = the_map.step(*state)
        if found is None:
            raise SystemExit("the floating orbit ends")
        state = (found[0][0] % TURN, found[0][1])
        if k >= 1000:
            orbit.append(state)
    for n in range(1, arguments.impacts + 1):
        known = {}

        def cell(state):
            return (round(state[0] * 1e5), round(state[1] * 1e5))

        def is_known(state):
            i, j = cell(state)
            near = (known.get((i + a, j + b)) for a in (-1, 0, 1) for b in (-1, 0, 1))
            return any(other and math.dist(other, state) < 1e-6 for other in near)

        for k in range(len(orbit) - n):
            (a, b), (c, d) = orbit[k], orbit[k + n]
            if math.hypot(math.remainder(c - a, TURN), d - b) > arguments.near:
                continue
            found = closed(the_map, orbit[k], n)
            while found is not None and not is_known(found):
                # All states of the cycle.
                known[cell(found)] = found
                image = the_map.step(*found)
                found = image and (image[0][0] % TURN, image[0][1])
        print(n, len(known), flush=True)


if __name__ == "__main__":
    main()
