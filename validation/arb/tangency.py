"""Judges a document of homoclinic tangencies: the value of the parameter is enclosed by another program, in Arb balls.

Both invariant manifolds are straight lines here, so near to the saddle that what they differ by is less than any digit that is compared:
`F^(k + n + j)(p + u v_u + ..) = p + s v_s + ..` with k flights from the saddle before the word and j flights to it after it, for three unknowns
u, s and D, and parallel tangents. The remainder of the lines is bounded once, by a contraction in complex balls. Derivatives are jets
through all flights; interval Newton proves exactly one zero in a box, which has to lie inside the claimed bounds. Its Jacobian is regular, so the
tangency is quadratic and unfolds. All flights of the word are proved to end at their first contact.

q and m are enclosed over that box and compared with `quadratic` and `unfolding`, and no product of powers of the eigenvalues of an order from 2 to
`resonances_excluded_to` is one of them.

Not judged: that there is no second zero within the claimed bounds, whose boxes are too wide for balls through some 230 flights.
"""

import json
from collections import Counter, namedtuple

from flint import acb, arb, arb_mat, ctx

from compare import Disagreement
from flight import Flight, Undecided
from scene import LEFT, RIGHT, Motion

# Flights near the saddle before the word and after it, bits, and the radii of the box of unknowns, relatively.
BEFORE, AFTER, BITS, BOX = 180, 34, 1400, (arb(10) ** -60, arb(10) ** -29, arb(10) ** -76)
# The local theorem: the radius of the polydisc and of the parameter, on each side, and that of the complex D.
RADII, DISC = {"unstable": arb("0.004"), "stable": arb("0.00001")}, arb(10) ** -30
FIRST_BITS = 128
# q and m are compared if this much of them is certain.
LEAST_BITS = 20


def disc(radius):
    """A square of complex numbers around 0."""
    return acb(arb(0, radius), arb(0, radius))


class Pair:
    """e and D, real or complex, in units in which A and W are 1."""

    def __init__(self, e, gap):
        self.e, self.gap = e, gap

    def saddle(self, guess):
        """Phase and speed of the equispaced orbit of one period, (66) and (67), by interval Newton from a guess."""
        kappa = (1 + self.e) / (1 - self.e)
        pi = arb.pi()
        value = lambda th: pi * kappa * th.cos() + 2 * th.sin() - self.gap
        slope = lambda th: 2 * th.cos() - pi * kappa * th.sin()
        middle = arb(guess)
        for _ in range(12):
            off = self.gap.real.mid() if isinstance(self.gap, acb) else self.gap.mid()
            middle = (middle - (pi * kappa * middle.cos() + 2 * middle.sin() - off) / slope(middle)).mid()
        is_complex = isinstance(self.gap, acb)
        reach = arb(2) ** -20
        ball = acb(middle + arb(0, reach), arb(0, reach)) if is_complex else middle + arb(0, reach)
        found = middle - value(acb(middle) if is_complex else middle) / slope(ball)
        if not (ball.contains(found) if is_complex else ball.contains_interior(found)):
            raise Undecided("the saddle")
        return found, 2 * found.cos() / (1 - self.e)

    def contact(self, state, is_far, guess):
        """The duration of all flights of a set, one zero of the height in a ball around the guess."""
        th, w = state
        slope = self.e * w + th.cos()
        level = self.gap if is_far else 0 * self.gap
        height = lambda h: slope * h - (th + h).sin() + th.sin() - level
        speed = lambda h: slope - (th + h).cos()
        wide = isinstance(th, acb)
        for power in range(-3, -40, -1) if wide else range(-20, -60, -4):
            reach = arb(2) ** power
            ball = acb(arb(guess) + arb(0, reach), arb(0, reach)) if wide else arb(guess) + arb(0, reach)
            if speed(ball).contains(0):
                continue
            found = guess - height(acb(guess) if wide else arb(guess)) / speed(ball)
            if ball.contains(found):
                return found
        raise Undecided("a contact")

    def jacobian(self, state, h, is_far):
        """(A.7) of the reduced map."""
        th, w = state
        v = self.e * w + th.cos() - (th + h).cos()
        a, b = (h * th.sin() + self.e * w) / v, -self.e * h / v
        sign = 1 if is_far else -1
        return [[a, b], [sign * ((th + h).sin() * a - th.sin()), sign * ((th + h).sin() * b + self.e)]]

    def eigen(self, guess):
        """The saddle, and (eigenvalue, slope of the eigenvector), unstable and stable."""
        state = self.saddle(guess)
        [[a, b], [c, d]] = self.jacobian(state, arb.pi() if isinstance(state[0], arb) else acb(arb.pi()), True)
        half = (a + d) / 2
        root = (half * half - self.e * self.e).sqrt()
        unstable = half - root if half.real < 0 else half + root
        stable = self.e * self.e / unstable
        return state, [(value, (value - a) / b) for value in (unstable, stable)]


def remainder(e, gap, guess, side):
    """A bound c: the invariant manifold is p + v sigma + rest, |rest| <= c |sigma|^2 in both components, for |sigma| <= RADII[side].

    In coordinates x = p* + Q y along the eigenvectors of the middle, with y = a sigma + h: T(h)(sigma) = f(y(L sigma)) - a sigma, f the map (its
    inverse for the stable side), contracts |h| <= m (|sigma|/R)^2 by |f'| |L|^2, for each complex D of the disc.
    """
    radius = RADII[side]
    complex_pair = Pair(acb(e), acb(gap.mid()) + disc(DISC))
    (p, own), (star, (u, s)) = complex_pair.eigen(guess), Pair(e, gap.mid()).eigen(guess)
    value, slope = own[0 if side == "unstable" else 1]
    shrink = 1 / value if side == "unstable" else value
    # Q has the columns (1, u) and (1, s).
    area = s[1] - u[1]
    to = lambda x, y: ((s[1] * x - y) / area, (y - u[1] * x) / area)
    a = to(acb(1), slope)
    offset = max(abs(x).upper() for x in to(p[0] - star[0], p[1] - star[1]))
    y1, y2 = disc(radius + offset), disc(radius + offset)
    box = (star[0] + y1 + y2, star[1] + u[1] * y1 + s[1] * y2)
    if side == "unstable":
        [[m00, m01], [m10, m11]] = complex_pair.jacobian(box, complex_pair.contact(box, True, arb.pi().mid()), True)
    else:
        # The inverse: its derivative over the box is that of the map at the preimages, whose phases solve the flight backwards.
        [[m00, m01], [m10, m11]] = backward(complex_pair, box, star)
    columns = [to(m00 + m01 * slope_, m10 + m11 * slope_) for slope_ in (u[1], s[1])]
    derivative = [[columns[0][0], columns[1][0]], [columns[0][1], columns[1][1]]]
    norm = max(sum((abs(x).upper() for x in row), arb(0)) for row in derivative)
    shrunk = abs(shrink).upper()
    off = [sum((derivative[i][j] * a[j] for j in (0, 1)), acb(0)) * shrink - a[i] for i in (0, 1)]
    first = radius * max(abs(x).upper() for x in off)
    kappa = norm * shrunk * shrunk
    if not kappa < 1:
        raise Undecided("the local theorem does not contract")
    m = first / (1 - kappa)
    if not offset + max(abs(x).upper() for x in a) * radius * shrunk + m * shrunk * shrunk < radius + offset:
        raise Undecided("the local theorem leaves its polydisc")
    # Back to phase and speed: |x| <= |y1| + |y2|, |w| <= |u||y1| + |s||y2|.
    return (m * (2 + abs(u[1]) + abs(s[1])) / (radius * radius)).upper()


def backward(pair, box, star):
    """The derivative of the inverse over a box of states after a flight to the far wall: det DF = e^2 w/w'."""
    th1, w1 = box
    drift = w1 - th1.cos()
    # drift (th1 - th0) - pi drift... : the flight from th0 lasts h = th1 + pi - th0.
    height = lambda h: drift * h + th1.sin() + (th1 - h + arb.pi()).sin() - pair.gap
    slope = lambda h: drift - (th1 - h + arb.pi()).cos()
    for power in range(-2, -30, -1):
        ball = acb(arb.pi() + arb(0, arb(2) ** power), arb(0, arb(2) ** power))
        if slope(ball).contains(0):
            continue
        h = acb(arb.pi().mid()) - height(acb(arb.pi().mid())) / slope(ball)
        if ball.contains(h):
            break
    else:
        raise Undecided("a flight backward")
    th0 = th1 - h + arb.pi()
    w0 = (drift - th0.cos()) / pair.e
    [[a, b], [c, d]] = pair.jacobian((th0, w0), h, True)
    determinant = a * d - b * c
    return [[d / determinant, -b / determinant], [-c / determinant, a / determinant]]


# The powers of a jet in a parameter x and D: 1, x, D, x^2, x D.
PRODUCTS = [[(0, 0)], [(0, 1), (1, 0)], [(0, 2), (2, 0)], [(0, 3), (1, 1), (3, 0)], [(0, 4), (1, 2), (2, 1), (4, 0)]]


def times(f, g):
    return [sum((f[i] * g[j] for i, j in pairs), arb(0)) for pairs in PRODUCTS]


def plus(*jets):
    return [sum(parts, arb(0)) for parts in zip(*jets)]


def scaled(f, factor):
    return [factor * x for x in f]


def of(f, value, first, second):
    rest = [arb(0), *f[1:]]
    square = times(rest, rest)
    return [value if i == 0 else first * rest[i] + second / 2 * square[i] for i in range(5)]


def sine(f):
    s, c = f[0].sin(), f[0].cos()
    return of(f, s, c, -s)


def cosine(f):
    s, c = f[0].sin(), f[0].cos()
    return of(f, c, -s, -c)


def guess_of(pair, state):
    """About when the first contact comes, and whether with the far wall, in doubles."""
    import math

    th, w, e, gap = (float(x.mid()) for x in (*state, pair.e, pair.gap))
    slope, h = e * w + math.cos(th), 1 / 64
    height = lambda h: slope * h - math.sin(th + h) + math.sin(th)
    while 0 < height(h) < gap:
        h += 1 / 64
    is_far, low = height(h) >= gap, h - 1 / 64
    for _ in range(50):
        middle = (low + h) / 2
        low, h = (middle, h) if 0 < height(middle) < gap else (low, middle)
    return h, is_far


# The jets of phase and speed over a box without the remainder of the line that they come from, their values at its middle, and the vector that the
# remainder and its derivatives are multiples of.
State = namedtuple("State", "jets middle rest")
# The deviations of the unknown of the manifold, and of D; the remainder and its derivatives.
Offs = namedtuple("Offs", "unknown gap rests")


def whole(state, offs):
    """The jets of phase and speed with the remainder."""
    found = []
    for jet, at, rest in zip(*state):
        slopes = [jet[power] + rest * offs.rests[power] for power in range(1, 5)]
        found.append([at + jet[1] * offs.unknown + jet[2] * offs.gap + rest * offs.rests[0], *slopes])
    return tuple(found)


def fly(pair, gap_jet, offs, state, is_far):
    """The state at the next impact.

    Derivatives go on by the Jacobian over the whole set, values by the mean value theorem: balls alone would lose two digits for each that is
    worth one.
    """
    (mid_th, mid_w), rest = state.middle, state.rest
    th, w = whole(state, offs)
    guess, found = guess_of(pair, (mid_th, mid_w))
    if found != is_far:
        raise Disagreement("a flight of the word ends on the other wall")
    own = Pair(pair.e, pair.gap.mid())
    middle, slope = arb(guess), (own.e * mid_w + mid_th.cos()).mid()
    for _ in range(11):
        at = (mid_th.mid() + middle).mid()
        value = slope * middle - at.sin() + mid_th.mid().sin() - (own.gap if is_far else 0)
        middle = (middle - value / (slope - at.cos())).mid()
    h = pair.contact((th[0], w[0]), is_far, middle)
    h_mid = h.intersection(own.contact((mid_th, mid_w), is_far, middle))
    jacobian = pair.jacobian((th[0], w[0]), h, is_far)
    sign, turn = (1, arb.pi()) if is_far else (-1, arb(0))
    v = pair.e * w[0] + th[0].cos() - (th[0] + h).cos()
    by_gap = [1 / v, sign * (th[0] + h).sin() / v] if is_far else [arb(0), arb(0)]
    moved = lambda vector: tuple(jacobian[i][0] * vector[0] + jacobian[i][1] * vector[1] for i in (0, 1))
    arrival = own.e * mid_w + mid_th.cos() - (mid_th + h_mid).cos()
    at, rest = (mid_th + h_mid + turn, sign * arrival), moved(rest)
    first, second, third, fourth = (moved([jet[power] for jet in state.jets]) for power in (1, 2, 3, 4))
    more = bent(pair, gap_jet, ([*th[:3], arb(0), arb(0)], [*w[:3], arb(0), arb(0)]), h, is_far)
    jets = tuple([arb(0), first[i], second[i] + by_gap[i], third[i] + more[i][0], fourth[i] + more[i][1]] for i in (0, 1))
    return State(jets, at, rest)


def bent(pair, gap_jet, state, h, is_far):
    """The coefficients of x^2 and x D of phase and speed after a flight, of a state without such terms."""
    th, w = state
    slope = plus(scaled(w, pair.e), cosine(th))
    speed = slope[0] - (th[0] + h).cos()
    phase = [th[0] + h, *[arb(0)] * 4]
    for powers in ((1, 2), (3, 4)):
        height = plus(times(slope, plus(phase, scaled(th, -1))), scaled(sine(phase), -1), sine(th), scaled(gap_jet, -1 if is_far else 0))
        for i in powers:
            phase[i] = -height[i] / speed
    after = scaled(plus(slope, scaled(cosine(phase), -1)), 1 if is_far else -1)
    return phase[3:], after[3:]


def line(pair, gap_jet, guess, side, parameter, bound):
    """The point of an invariant manifold with this coordinate along its eigenvector, and the deviations of `fly`.

    It is the straight line, and a multiple of the other eigenvector that is at most `bound` times the square; its derivatives by Cauchy, on twice
    the disc and on half of that of D.
    """
    gap = gap_jet[0]
    own = Pair(pair.e, gap.mid())
    which = 0 if side == "unstable" else 1
    (th, w), eigen = pair.eigen(guess)
    (mid_th, mid_w), mid_eigen = own.eigen(guess)
    (value, slope), across = eigen[which], eigen[1 - which][1]
    kappa = (1 + pair.e) / (1 - pair.e)
    # Derivatives by D, of (67), (66) and the slope of the eigenvector, which is (value - a)/b at the saddle.
    dth = 1 / (2 * th.cos() - arb.pi() * kappa * th.sin())
    dw = -2 * th.sin() * dth / (1 - pair.e)
    dslope = slope_derivative(pair, th, w, value, dth)
    size = abs(parameter).upper()
    square = bound * size * size
    rests = [square, 4 * square / size, 2 * square / DISC, 8 * square / (size * size), 8 * square / (size * DISC)]
    rests = [arb(0, abs(x).upper()) for x in rests]
    jets = [arb(0), arb(1), dth, arb(0), arb(0)], [arb(0), slope, dw + dslope * parameter, arb(0), dslope]
    middle = (mid_th + parameter.mid(), mid_w + mid_eigen[which][1] * parameter.mid())
    return State(jets, middle, (arb(1), across)), Offs(parameter - parameter.mid(), gap - gap.mid(), rests)


def slope_derivative(pair, th, w, value, dth):
    """The derivative by D of (value - a)/b, with a = (pi sin th + e w)/w and b = -e pi/w at the saddle."""
    e, pi = pair.e, arb.pi()
    dw = -2 * th.sin() * dth / (1 - e)
    tangent = th.tan()
    half = e + pi / 4 * (1 - e * e) * tangent
    dhalf = pi / 4 * (1 - e * e) * (1 + tangent * tangent) * dth
    # value^2 - 2 half value + e^2 = 0
    dvalue = 2 * dhalf * value / (2 * value - 2 * half)
    a, b = (pi * th.sin() + e * w) / w, -e * pi / w
    da = pi * (th.cos() * dth * w - th.sin() * dw) / (w * w)
    db = e * pi * dw / (w * w)
    return (dvalue - da) / b - (value - a) * db / (b * b)


def shot(e, word, guess, bounds, unknowns):
    """The three equations and their Jacobian over a box, the states at the impacts of the word, and the jets where the word ends, after all
    flights, and of the stable manifold there."""
    u, s, gap = unknowns
    pair, gap_jet = Pair(e, gap), [gap, arb(0), arb(1), arb(0), arb(0)]
    state, offs = line(pair, gap_jet, guess, "unstable", u, bounds[0])
    end, end_offs = line(pair, gap_jet, guess, "stable", s, bounds[1])
    visited, passed = [], []
    for letter in "F" * BEFORE + word + "F" * AFTER:
        passed.append(whole(state, offs))
        visited.append(tuple(jet[0] for jet in passed[-1]))
        state = fly(pair, gap_jet, offs, state, letter == "F")
    state, end = whole(state, offs), whole(end, end_offs)
    turns = round(float(((state[0][0] - end[0][0]) / (2 * arb.pi())).mid()))
    off = [state[0][0] - end[0][0] - 2 * arb.pi() * turns, state[1][0] - end[1][0]]
    cross = lambda i, j: state[0][i] * end[1][j] - state[1][i] * end[0][j]
    values = [*off, cross(1, 1)]
    rows = [[state[i][1], -end[i][1], state[i][2] - end[i][2]] for i in (0, 1)]
    rows.append([2 * cross(3, 1), 2 * cross(1, 3), cross(4, 1) + cross(1, 4)])
    last = BEFORE + len(word)
    return values, rows, visited[BEFORE : last + 1], (passed[last], state, end, visited[last:])


def unfolding(pair, ends, eigenvalues):
    """q and m: `det(P_s', X)/abs(P_s')` of the differences X of second derivatives by sigma_u, and of derivatives by D, at the end of the word.

    They are compared after the k flights to the saddle, whose derivative G takes X and P_s' to those of the images: what second derivatives of
    these flights add is the same for both curves, and what a change of parameters with D adds is a multiple of P_s'. det G = e^(2k) w/w'.
    """
    (unstable, stable), (word, flown, line, visited) = eigenvalues, ends
    # The coordinates along the eigenvectors are the parameters, some flights away: derivatives by sigma_u and sigma_s.
    u, s = unstable**BEFORE, stable**AFTER
    image = tangent = [x[1] * s for x in line]
    area = pair.e ** (2 * AFTER) * word[1][0] / flown[1][0]
    arrivals = [*visited[1:], tuple(x[0] for x in flown)]
    for (th, w), (arrival, _) in reversed(list(zip(visited, arrivals))):
        [[a, b], [c, d]] = pair.jacobian((th, w), arrival - arb.pi() - th, True)
        tangent = [d * tangent[0] - b * tangent[1], a * tangent[1] - c * tangent[0]]
    tangent = [x / area for x in tangent]
    square = tangent[0] ** 2 + tangent[1] ** 2
    factor = (word[0][1] * tangent[0] + word[1][1] * tangent[1]) / u / square
    across = lambda x: (image[0] * x[1] - image[1] * x[0]) / (area * square.sqrt())
    bend = [2 * (a[3] / u**2 - b[3] * (s * factor) ** 2) for a, b in zip(flown, line)]
    return across(bend), across([a[2] - b[2] for a, b in zip(flown, line)])


def solve(e, word, guess, claims):
    """(box, visited, ends): a box of the unknowns at the saddle's ends with exactly one zero, and what `shot` finds over it."""
    (unstable, stable, gap) = claims
    eigen = Pair(e, gap.mid()).eigen(guess)[1]
    at = [unstable.mid() / eigen[0][0].mid() ** BEFORE, stable.mid() * eigen[1][0].mid() ** AFTER, gap.mid()]
    at = [x.mid() for x in at]
    rests = [remainder(e, gap, guess, side) for side in ("unstable", "stable")]
    for _ in range(8):
        values, rows, *_ = shot(e, word, guess, [arb(0), arb(0)], at)
        step = arb_mat(rows).mid().solve(arb_mat([[v.mid()] for v in values]))
        at = [(x - step[i, 0]).mid() for i, x in enumerate(at)]
        if all(abs(step[i, 0]) < abs(at[i]) * BOX[i] / 1024 for i in range(3)):
            break
    inverse = arb_mat(rows).mid().inv().mid()
    box = [x + arb(0, (abs(x) * radius).upper()) for x, radius in zip(at, BOX)]
    values, *_ = shot(e, word, guess, rests, at)
    _, rows, visited, ends = shot(e, word, guess, rests, box)
    change = arb_mat(3, 3, [1 if i == j else 0 for i in range(3) for j in range(3)]) - inverse * arb_mat(rows)
    moved = inverse * arb_mat([[v] for v in values])
    image = [at[i] - moved[i, 0] + sum((change[i, j] * (box[j] - at[j]) for j in range(3)), arb(0)) for i in range(3)]
    if not all(box[i].contains_interior(image[i]) for i in range(3)):
        raise Undecided("interval Newton does not map the box into itself")
    # The coordinate along the eigenvector is the parameter of the manifold but for the remainder.
    parameters = [x * (1 + arb(0, (rest * abs(x)).upper())) for x, rest in zip(image, rests)]
    return [*parameters, image[2]], visited, ends


def bounds(pair):
    return arb(pair[0]).union(arb(pair[1]))


def inside(name, found, claimed):
    """The bounds overlap the ball, and hold all of it where they are a thousand times wider."""
    low, high = arb(claimed[0]), arb(claimed[1])
    if found < low or found > high:
        raise Disagreement(f"{name}: {found.str(40)} is not in {claimed}")
    if high - low > 1000 * found.rad() and not (low <= found and found <= high):
        raise Disagreement(f"{name}: {found.str(40)} is not inside {claimed}")


def first_contacts(e, gap, word, visited):
    """All flights of the word end at their first contact, on the wall of the letter."""
    ctx.prec = FIRST_BITS
    for letter, (th, w) in zip(word, visited):
        motion = Motion([(arb(1), arb(1), arb(0))], gap, e)
        wall, _ = Flight(motion, LEFT, th, arb(0), e * w).first_contact()
        if wall != (RIGHT if letter == "F" else LEFT):
            raise Disagreement("a flight of the word ends on the other wall")


def no_resonance(eigenvalues, highest):
    """No product of powers of both eigenvalues, of an order from 2 to `highest`, is one of them."""
    powers = [[x**n for n in range(highest + 1)] for x in eigenvalues]
    for order in range(2, highest + 1):
        for j in range(order + 1):
            product = powers[0][j] * powers[1][order - j]
            if any(product.overlaps(x) for x in eigenvalues):
                raise Undecided(f"a resonance of order {order} is not excluded")


def judge_tangency(document):
    """The number of tangencies whose parameters are enclosed again, inside the claimed bounds."""
    scene = document["scene"]
    for claim in document["tangencies"]:
        # It is the gap that varies here.
        if claim["key"] != "pair.gap" or len(scene["excitation"]["amplitude"]) != 1:
            raise Undecided("only the gap of one harmonic is judged")
        ctx.prec = BITS
        amplitude, e = arb(scene["excitation"]["amplitude"][0]), arb(scene["restitution"])
        gap, guess = bounds(claim["parameter"]) / amplitude, bounds(claim["saddle"]["phase"]).mid()
        claims = (bounds(claim["unstable"]), bounds(claim["stable"]), gap)
        image, visited, ends = solve(e, claim["flights"], guess, claims)
        pair = Pair(e, image[2])
        (th, w), ((unstable, _), (stable, _)) = pair.eigen(guess)
        inside("parameter", amplitude * image[2], claim["parameter"])
        inside("unstable", image[0] * unstable**BEFORE, claim["unstable"])
        inside("stable", image[1] / stable**AFTER, claim["stable"])
        inside("phase", th, claim["saddle"]["phase"])
        inside("speed", w, claim["saddle"]["speed"])
        inside("unstable eigenvalue", unstable, claim["saddle"]["eigenvalues"][0])
        inside("stable eigenvalue", stable, claim["saddle"]["eigenvalues"][1])
        no_resonance((unstable, stable), claim["resonances_excluded_to"])
        quadratic, unfolds = unfolding(pair, ends, (unstable, stable))
        for name, found in (("quadratic", quadratic), ("unfolding", unfolds)):
            if found.contains(0) or found.rel_accuracy_bits() < LEAST_BITS:
                raise Undecided(f"the {name} coefficient is {found.str(10)}")
            inside(name, found, claim[name])
        for _, speed in visited:
            if not speed >= arb(claim["least_speed"]):
                raise Disagreement("an impact is slower than the least speed")
        first_contacts(e, image[2], claim["flights"], visited)
    return len(document["tangencies"])


def spoiled(document):
    """(name, copy) of documents that must be refused."""
    def copy(*changes):
        other = json.loads(json.dumps(document))
        for path, value in changes:
            place = other["tangencies"][0]
            for key in path[:-1]:
                place = place[key]
            place[path[-1]] = value
        return other

    [claim, *_] = document["tangencies"]
    eigenvalues, word = claim["saddle"]["eigenvalues"], claim["flights"]
    shifted = [(arb(end) * (1 + arb("1e-20"))).mid().str(40, radius=False) for end in claim["parameter"]]
    yield "another parameter", copy((["parameter"], shifted))
    yield "exchanged eigenvalues", copy((["saddle", "eigenvalues"], eigenvalues[::-1]))
    yield "another word", copy((["flights"], word[:-1] + "N"))
    yield "exchanged manifolds", copy((["unstable"], claim["stable"]), (["stable"], claim["unstable"]))
    opposite = [f"-{end}".removeprefix("--") for end in claim["quadratic"][::-1]]
    yield "the other sign of q", copy((["quadratic"], opposite))
    near = [(arb(end) * (1 + arb("1e-4"))).mid().str(40, radius=False) for end in claim["unfolding"]]
    yield "another speed of unfolding", copy((["unfolding"], near))
    yield "a larger least speed", copy((["least_speed"], "0.9"))


def judge_document(path, few, _):
    """(tally, remark): the tangencies of a document in a file, and spoiled copies of it, or a few of them."""
    with open(path, encoding="utf-8") as file:
        document = json.load(file)
    proved = judge_tangency(document)
    count = 0
    for name, copy in list(spoiled(document))[:: 3 if few else 1]:
        try:
            judge_tangency(copy)
        except (Disagreement, Undecided):
            count += 1
            continue
        raise Disagreement(f"negative control: a copy with {name} was not refused")
    return Counter(spoiled=count), f"the parameters of homoclinic tangencies enclosed again: {proved}; {count} spoiled copies were refused"
