"""SciPy's `solve_ivp`, one call a flight, with a terminal and directed event for each wall."""
import math

from scipy.integrate import solve_ivp

from scene import LEFT, RIGHT, SIGN, Motion, Start
from simulator import Contact, Listing, bounce

EVALUATIONS = 2_000_000  # of the right-hand side, for one list; no run on good ground comes near it


class OutOfBudget(Exception):
    """The right-hand side was evaluated too often."""


class BySolveIvp:
    """y'' = A W^2 sin(W t + tau), (10), by a Runge-Kutta method of SciPy."""

    def __init__(self, name: str, method: str, tolerance: float, steps: int | None = None, **options: float):
        """`steps`: least number of steps in a period (`max_step`); `options` go to `solve_ivp`."""
        self.name, self.method, self.tolerance, self.steps, self.options = name, method, tolerance, steps, options

    def contacts(self, motion: Motion[float], start: Start[float], until: float, limit: int) -> Listing:
        sin, w, tau, half = math.sin, motion.omega, motion.tau, motion.gap / 2
        push = motion.amplitude * w * w
        asked = 0

        def slope(time: float, state: list[float]) -> tuple[float, float]:
            nonlocal asked
            asked += 1
            if asked > EVALUATIONS:
                raise OutOfBudget
            return state[1], push * sin(w * time + tau)

        def left(_time: float, state: list[float]) -> float:
            return state[0] + half

        def right(_time: float, state: list[float]) -> float:
            return state[0] - half

        left.terminal = right.terminal = True
        left.direction, right.direction = -1, 1
        options = dict(self.options)
        if self.steps:
            options["max_step"] = motion.period / self.steps
        found: list[Contact] = []
        while len(found) < limit:
            try:
                flight = solve_ivp(slope, (start.time, until), [SIGN[start.wall] * half, start.after],
                                   method=self.method, events=(left, right), **options)
            except OutOfBudget:
                return Listing(found, "budget")
            except ValueError as error:
                return Listing(found, f"ValueError: {error}")
            if flight.status != 1:
                outside = abs(flight.y[0, -1]) > 1.01 * half
                return Listing(found, "outside" if outside else "time" if flight.status == 0 else "step size")
            wall, event = (LEFT, 0) if len(flight.t_events[0]) else (RIGHT, 1)
            contact = Contact(flight.t_events[event][0], wall, flight.y_events[event][0][1])
            found.append(contact)
            start = bounce(motion, contact)
        return Listing(found, "impacts")
