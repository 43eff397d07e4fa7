"""heyoka's adaptive Taylor method in doubles with terminal events at the walls."""
import heyoka as hy

SIGN = {"left": -1.0, "right": 1.0}
NUDGE = 1e-14  # of the gap: started exactly on the wall, it does not see the first contact with that wall


def simulate(scene, until, impacts):
    y, v = hy.make_vars("y", "v")
    terms = list(zip(*(scene["excitation"][key] for key in ("amplitude", "frequency", "phase"))))
    push = sum(a * w * w * hy.sin(w * hy.time + tau) for a, w, tau in terms)
    half, restitution, start = scene["gap"] / 2, scene["restitution"], scene["start"]
    found = []

    def event(wall):
        def reached(integrator, _):
            velocity = integrator.state[1]
            found.append((integrator.time, wall, velocity))
            integrator.state[1] = -SIGN[wall] * restitution * abs(velocity)
            return len(found) < impacts

        direction = hy.event_direction.negative if wall == "left" else hy.event_direction.positive
        return hy.t_event(y - SIGN[wall] * half, direction=direction, callback=reached)

    wall = start.get("wall")
    state = [SIGN[wall] * half * (1 - 2 * NUDGE), -restitution * start["velocity"]] if wall else [start["position"], start["velocity"]]
    integrator = hy.taylor_adaptive([(y, v), (v, push)], state, time=start["time"], t_events=[event("left"), event("right")])
    integrator.propagate_until(until, max_steps=200_000)
    return found
