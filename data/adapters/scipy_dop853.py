"""SciPy's DOP853 at 1e-12 with a terminal, directed event for each wall: what most users write."""
import numpy as np
from scipy.integrate import solve_ivp

SIGN = {"left": -1.0, "right": 1.0}
EVALUATIONS = 200_000  # of the right-hand side in one scene


def simulate(scene, until, impacts):
    amplitude, frequency, phase = (np.array(scene["excitation"][key]) for key in ("amplitude", "frequency", "phase"))
    half, restitution, start = scene["gap"] / 2, scene["restitution"], scene["start"]
    push, asked = amplitude * frequency**2, 0

    def slope(time, state):
        nonlocal asked
        asked += 1
        if asked > EVALUATIONS:
            raise RuntimeError("too many evaluations")
        return state[1], push @ np.sin(frequency * time + phase)

    def left(_, state):
        return state[0] + half

    def right(_, state):
        return state[0] - half

    left.terminal = right.terminal = True
    left.direction, right.direction = -1, 1
    time, wall = start["time"], start.get("wall")
    state = [SIGN[wall] * half, -restitution * start["velocity"]] if wall else [start["position"], start["velocity"]]
    found = []
    while len(found) < impacts and time < until:
        flight = solve_ivp(slope, (time, until), state, method="DOP853", rtol=1e-12, atol=1e-12 * half, events=(left, right))
        if flight.status != 1:
            break
        number = 0 if len(flight.t_events[0]) else 1
        wall, time, velocity = ("left", "right")[number], flight.t_events[number][0], flight.y_events[number][0][1]
        found.append((time, wall, velocity))
        # The ball leaves inward, whatever the sign of the computed velocity.
        state = [SIGN[wall] * half, -SIGN[wall] * restitution * abs(velocity)]
    return found
