"""The Jacobian (A.7) of one mapping, its product over an orbit, and its eigenvalues (38)-(40)."""
from mpmath import cos, findroot, matrix, mpf, sin, sqrt

STEP = mpf(10) ** -15


def jacobian(A, W, tau, e, before, after):
    """d(t1, v1)/d(t0, v0) at two states (t, v) in a row, v before the impact: the corrected (A.7)."""
    (t0, v0), (t1, v1) = before, after
    a0, a1, h = A * W**2 * sin(W * t0 + tau), A * W**2 * sin(W * t1 + tau), t1 - t0
    dt_dt, dt_dv = (a0 * h - e * v0) / v1, e * h / v1
    return matrix([[dt_dt, dt_dv], [a1 * dt_dt - a0, a1 * dt_dv - e]])


def printed_a7(A, W, tau, e, before, after, mistake):
    """(A.7) with one of its slips as printed: "tau", t for tau in the second row, or "velocity", e v1 h for e h/v1."""
    (t0, v0), (t1, v1) = before, after
    a0, h = A * W**2 * sin(W * t0 + tau), t1 - t0
    a1 = A * W**2 * sin(W * t1 + (t1 if mistake == "tau" else tau))
    dt_dt, column = (a0 * h - e * v0) / v1, e * h * v1 if mistake == "velocity" else e * h / v1
    return matrix([[dt_dt, column], [a1 * dt_dt - a0, a1 * column - e]])


def image(A, W, tau, e, before, after, change):
    """The state after `before` plus a small change, near `after`, from (A.1)-(A.6)."""
    (t0, v0), (t1, _) = before, after
    level = displacement(A, W, tau, e, t0, v0, t1)
    t0, v0 = t0 + change[0], v0 + change[1]
    t1 = findroot(lambda t: displacement(A, W, tau, e, t0, v0, t) - level, t1, tol=mpf(10) ** -90)
    return matrix([t1, -A * W * cos(W * t1 + tau) - e * v0 + A * W * cos(W * t0 + tau)])


def displacement(A, W, tau, e, t0, v0, t):
    """y(t) - y(t0): the right-hand side of (A.2), (A.4), (A.6)."""
    return -A * sin(W * t + tau) + (-e * v0 + A * W * cos(W * t0 + tau)) * (t - t0) + A * sin(W * t0 + tau)


def derivative(A, W, tau, e, before, after):
    """The Jacobian by central differences; steps of 10^-15 leave an error of about 10^-30."""
    columns = []
    for change in ((STEP, 0), (0, STEP)):
        ahead, behind = (image(A, W, tau, e, before, after, [s * x for x in change]) for s in (1, -1))
        columns.append((ahead - behind) / (2 * STEP))
    return matrix([[columns[0][0], columns[1][0]], [columns[0][1], columns[1][1]]])


def states(orbit):
    """The start and the next two impacts of an orbit, as (t, v)."""
    return [(mpf(0), -orbit.speed)] + [(impact.time, impact.velocity) for impact in orbit.impacts(2)]


def steps(orbit):
    """The Jacobians of both mappings of an orbit, in time order."""
    found = states(orbit)
    return [jacobian(orbit.A, orbit.W, orbit.theta0, orbit.e, *pair) for pair in zip(found, found[1:])]


def product(orbit):
    """DP over one period: DP1 DP2."""
    first, second = steps(orbit)
    return second * first


def trace_determinant(m):
    return m[0, 0] + m[1, 1], m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0]


def eigenvalues(m):
    """(38)."""
    trace, determinant = trace_determinant(m)
    root = sqrt(trace**2 - 4 * determinant)
    return (trace + root) / 2, (trace - root) / 2


def radius(m):
    """The larger of the eigenvalues' sizes."""
    return max(abs(value) for value in eigenvalues(m))
