"""heyoka's Taylor integrator with terminal events, as its documentation bounces a ball."""
from functools import cache
from typing import Any

import heyoka as hy

from scene import LEFT, RIGHT, SIGN, Motion, Start
from simulator import Contact, Listing

NUDGE = 1e-14      # of the gap: started exactly on the wall, it does not see the first contact with that wall
STEPS = 1_000_000  # of the integrator, for one list


class Log:
    """The variables that the events' callbacks read and write."""

    def __init__(self) -> None:
        self.contacts: list[Contact] = []
        self.limit = 0
        self.restitution = 0.0


@cache
def integrator() -> tuple[Any, Log]:
    """The integrator of (10), compiled once a process: parameters A W^2, W, tau and d/2; (15) in the callbacks."""
    y, v = hy.make_vars("y", "v")
    log = Log()

    def bouncing(wall: str) -> Any:
        def bounce(ta: Any, _sign: int) -> bool:
            log.contacts.append(Contact(ta.time, wall, float(ta.state[1])))
            ta.state[1] *= -log.restitution
            return len(log.contacts) < log.limit
        return bounce

    events = [
        hy.t_event(y - hy.par[3], callback=bouncing(RIGHT), direction=hy.event_direction.positive),
        hy.t_event(y + hy.par[3], callback=bouncing(LEFT), direction=hy.event_direction.negative),
    ]
    equations = [(y, v), (v, hy.par[0] * hy.sin(hy.par[1] * hy.time + hy.par[2]))]
    return hy.taylor_adaptive(equations, [0.0, 0.0], pars=[0.0] * 4, t_events=events), log


class ByTaylor:
    """Terminal events in both directions of the box, the bounce in their callbacks."""

    name = "heyoka"
    tolerance = NUDGE

    def contacts(self, motion: Motion[float], start: Start[float], until: float, limit: int) -> Listing:
        ta, log = integrator()
        half = motion.gap / 2
        log.contacts, log.limit, log.restitution = [], limit, motion.restitution
        ta.pars[:] = [motion.amplitude * motion.omega**2, motion.omega, motion.tau, half]
        ta.time = start.time
        ta.state[:] = [SIGN[start.wall] * (half - NUDGE * motion.gap), start.after]
        ta.reset_cooldowns()
        outcome = ta.propagate_until(until, max_steps=STEPS)[0]
        if len(log.contacts) == limit:
            return Listing(log.contacts, "impacts")
        if abs(ta.state[0]) > 1.01 * half:
            return Listing(log.contacts, "outside")
        return Listing(log.contacts, "time" if outcome == hy.taylor_outcome.time_limit else "budget")
