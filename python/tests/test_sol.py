"""Displacement and velocity of the ball between impacts, against (10)-(13) in 60 digits by mpmath and an integrator."""

import math

import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import impact_pair
from impact_pair import Scene

A, W, D, E = 8, mpmath.pi, mpmath.mpf("9.42497"), mpmath.mpf("0.5")


@pytest.fixture(scope="module")
def orbit():
    return impact_pair.solve(A=8, W="pi", d="9.42497", e="0.5", v0="-12.56636", impacts=60, digits=40)


def states(orbit, times):
    """y and y' from the last impact before each time, whose 40 digits are the command line's (test_run)."""
    mpmath.mp.dps = 60
    impacts = [(0, "left", mpmath.mpf("-12.56636"))]
    impacts += [(impact.time.lower, impact.wall, mpmath.mpf(impact.velocity.lower)) for impact in orbit]
    impacts = [(mpmath.mpf(time), -D / 2 if wall == "left" else D / 2, v) for time, wall, v in impacts]
    for t in times:
        t0, y0, v = [impact for impact in impacts if impact[0] <= t][-1]
        # (10): y'' = A W^2 sin(W t), from y0 with -e v.
        c = -E * v + A * W * mpmath.cos(W * t0)
        h = mpmath.mpf(t) - t0
        y = y0 + c * h - A * (mpmath.sin(W * t) - mpmath.sin(W * t0))
        yield y, c - A * W * mpmath.cos(W * t)


def test_states_hold_those_of_mpmath(orbit):
    times = np.random.default_rng(12).uniform(0.0, orbit.t[-1], 400)
    found = orbit(times)
    for i, (y, v) in enumerate(states(orbit, times.tolist())):
        slack = mpmath.mpf(10) ** -36
        assert found.y_bounds[i, 0] - slack <= y <= found.y_bounds[i, 1] + slack
        assert found.v_bounds[i, 0] - slack <= v <= found.v_bounds[i, 1] + slack
    assert (found.y_bounds[:, 1] - found.y_bounds[:, 0] < 1e-10).all()
    assert (np.abs(found.y_bounds) <= 4.7124850000001).all()


def test_an_integrator_agrees(orbit):
    """SciPy from the state after impact 7, up to the next one."""
    t0, t1 = orbit.t[6], orbit.t[7]
    side = -1 if orbit.walls[6] == "left" else 1
    flight = solve_ivp(
        lambda t, s: (s[1], 8 * math.pi**2 * math.sin(math.pi * t)),
        (t0, t1),
        (side * 9.42497 / 2, -0.5 * orbit.v[6]),
        method="DOP853",
        rtol=1e-12,
        atol=1e-12,
        dense_output=True,
    )
    times = np.linspace(t0 + 1e-6, t1 - 1e-6, 100)
    found = orbit(times)
    assert np.abs(found.y - flight.sol(times)[0]).max() < 1e-8
    assert np.abs(found.v - flight.sol(times)[1]).max() < 1e-8


def test_arrays_are_read_only(orbit):
    for name in ("t_bounds", "v_bounds", "event_bounds", "sides", "event_sides", "walls", "mappings", "event_kinds"):
        assert not getattr(orbit, name).flags.writeable, name
    found = orbit([0.5, 0.6])
    assert not any(one.flags.writeable for one in (found.t, found.y_bounds, found.v_bounds, found.at_impact))


def test_the_velocity_at_an_impact_is_not_the_middle_of_both(orbit):
    between = 0.5 * (orbit.t[:-1] + orbit.t[1:])
    times = np.sort(np.append(orbit.t, between))
    found = orbit(times)
    assert np.array_equal(found.at_impact, np.isin(times, orbit.t))
    assert np.array_equal(np.isnan(found.v), found.at_impact)
    assert np.isnan(orbit(orbit.t).v).all()


def test_at_an_impact_both_velocities_are_possible():
    orbit = Scene.named("figure-14").run(impacts=10, arithmetic="interval")
    found = orbit(orbit.t[4])
    before, after = orbit.v_bounds[4], -0.5 * orbit.v_bounds[4]
    assert found.v_bounds[0, 0] <= before[0] + 1e-9
    assert found.v_bounds[0, 1] >= after[0] - 1e-9


def test_nothing_is_said_where_nothing_is_proved(orbit):
    assert np.isnan(orbit([-0.5, orbit.t[-1] + 0.01]).y_bounds).all()
    assert not np.isnan(orbit(0.0).y_bounds).any()
    until = Scene.named("figure-14").run(until=3)
    assert not np.isnan(until([2.99, 3.0]).y_bounds).any()
    assert np.isnan(until(3.01).y_bounds).all()


def test_rest_and_release():
    orbit = Scene.named("chatter").run()
    rest = next(event for event in orbit.events if isinstance(event, impact_pair.Rest))
    still = orbit(np.linspace(rest.time.float64[1] + 1e-6, 1 - 1e-6, 20))
    assert (still.v_bounds == 0).all()
    assert np.ptp(still.y_bounds) < 1e-12
    assert np.isnan(orbit(rest.time.mid).y_bounds).all()
    # While infinitely many impacts pass only the wall is near: nothing is claimed; after the release the ball leaves it.
    assert orbit(1.5).v_bounds[0, 0] > 0
