"""Tubes of the reduced impact map, by another program than the one under test: doubles propose, Arb balls prove (`quads.py`).

A tube is a chain of chords, with a quadrilateral cell between neighbours; followed over one impact it lies along another one.
"""
from collections import namedtuple

import numpy as np
from flint import arb

from compare import Disagreement
from quads import Chord, Flights, corners, cross, minus

TURN = 2 * np.pi
# Cells are at most so long, in forcing periods and speeds, and chords longer than the image they hold by a factor and an amount.
LONGEST, MARGIN, PAD = 0.003, 1.08, 2e-5
# Shorter at the ends of a tube, of which some cells are lost.
AT_ENDS = 0.02
# A stretch where the map seems to jump is not cut below this part of a cell.
FINEST = 2.0**-24
# Images lie in this many cells on either side of their own at most, and parts are halved that number of times.
WINDOW, HALVINGS = 2, 9
STEP, MOST_TURNS = 0.003, 6

# A part of a cell, between two shares of it; the cell of the next tube around which it is proposed to land, the wall, the phase.
Part = namedtuple("Part", "cell begin end place far guess")
RADIANS = np.array([TURN, 1.0])


def floating_map(law, states):
    """(images, far, Jacobians) of states, an array (n, 2), in doubles: phases in forcing periods, NaN where nothing is hit."""
    gap, e = float(law.gap), float(law.restitution)
    images, far, jacobians = [], [], []
    ahead = TURN * np.arange(STEP, MOST_TURNS, STEP)
    for chunk in np.array_split(states, max(1, len(states) // 500)):
        th, w = TURN * chunk[:, 0], chunk[:, 1]
        drift = e * w + np.cos(th)
        height = lambda x: drift * x - np.sin(th + x) + np.sin(th)
        z = drift[:, None] * ahead - np.sin(th[:, None] + ahead) + np.sin(th)[:, None]
        out = (z <= 0) | (z >= gap)
        first, hit = out.argmax(axis=1), out.any(axis=1)
        to_far = z[np.arange(len(z)), first] >= gap
        low, high = ahead[first] - TURN * STEP, ahead[first]
        for _ in range(50):
            middle = (low + high) / 2
            is_out = (height(middle) <= 0) | (height(middle) >= gap)
            low, high = np.where(is_out, low, middle), np.where(is_out, middle, high)
        x, sign = (low + high) / 2, np.where(to_far, 1.0, -1.0)
        rate = drift - np.cos(th + x)
        image = np.stack([(th + x) / TURN + to_far / 2, sign * rate], axis=1)
        by_start = [-TURN * (e * w + x * np.sin(th)), e * x]
        columns = []
        for height_by, drift_by in zip(by_start, [-TURN * np.sin(th), np.full_like(th, e)]):
            delay = -height_by / (TURN * rate)
            columns.append(np.stack([delay, sign * (drift_by + TURN * np.sin(th + x) * delay)], axis=1))
        image[~hit] = np.nan
        images.append(image), far.append(to_far), jacobians.append(np.stack(columns, axis=2))
    return np.concatenate(images), np.concatenate(far), np.concatenate(jacobians)


def contracting(law, states):
    """Unit vectors, phases in radians, along which four impacts contract most."""
    scale = np.diag(RADIANS)
    product = np.broadcast_to(np.eye(2), (len(states), 2, 2))
    for _ in range(4):
        states, _, jacobian = floating_map(law, states)
        product = np.where(np.isfinite(jacobian).all(axis=(1, 2))[:, None, None], jacobian @ product, product)
        states = np.nan_to_num(states, nan=1.0)
    *_, right = np.linalg.svd(scale @ product @ np.linalg.inv(scale))
    return right[:, 1, :]


def flat_cross(p, q):
    return p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]


def points(tube, at):
    """(bottoms, tops) at places along a tube, cells and shares in one number."""
    ends = np.array([[[float(x) for x in state] for state in chord] for chord in tube])
    cell = np.minimum(at.astype(int), len(tube) - 2)
    share = (at - cell)[:, None, None]
    between = (1 - share) * ends[cell] + share * ends[cell + 1]
    return between[:, 0], between[:, 1]


def sampled(law, tube):
    """Places along a tube, refined until images are near and straight, or the map jumps; with what they are mapped to."""
    at = np.arange(len(tube), dtype=float)
    for _ in range(26):
        middles = (at[1:] + at[:-1]) / 2
        both = np.sort(np.concatenate([at, middles]))
        bottom, top = points(tube, both)
        image, far, jacobian = floating_map(law, (bottom + top) / 2)
        half = np.einsum("nij,nj->ni", jacobian, (top - bottom) / 2)
        a, m, b = image[:-1:2] * RADIANS, image[1::2] * RADIANS, image[2::2] * RADIANS
        along = b - a
        long = np.hypot(along[:, 0], along[:, 1])
        with np.errstate(invalid="ignore", divide="ignore"):
            bulge = abs(flat_cross(along, m - a)) / long
            thick = abs(flat_cross(along, half[1::2] * RADIANS)) / long
            longest = np.full(len(long), TURN * LONGEST)
            longest[[0, -1]] *= AT_ENDS
            fine = (long <= longest) & (bulge <= straightness(thick)) & (far[:-1:2] == far[2::2])
        more = ~fine & (np.diff(at) > FINEST)
        if not more.any():
            return at, image[::2], far[::2], half[::2], fine
        at = np.sort(np.concatenate([at, middles[more]]))
    return at, image[::2], far[::2], half[::2], fine


def exact_chord(bottom, top):
    return Chord(*(tuple(arb(float(x)) for x in end) for end in (bottom, top)))


def kept(image, half):
    """Numbers of the images, radians and speeds, where the new tube has chords: not nearer than need be, nor around a bend."""
    far = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(image, axis=0).T))])
    numbers = [0]
    for number in range(1, len(image) - 1):
        start, to = numbers[-1], number + 1
        room = min(far[start], far[-1] - far[to])
        along = image[to] - image[start]
        long = np.hypot(*along)
        bulge = abs(flat_cross(along[None], image[start + 1 : to] - image[start])).max() / long
        thick = abs(flat_cross(along[None], half[number : number + 1])[0]) / long
        if far[to] - far[start] > min(0.4 * TURN * LONGEST, 0.3 * room) or bulge > straightness(thick):
            numbers.append(number)
    return np.array([*numbers, len(image) - 1])


def straightness(thick):
    """Largest deviation of an approximate chain from a straight line, from its thickness."""
    return 0.3 * ((MARGIN - 1) * thick + PAD)


def proposals(law, tube):
    """(parts, chords, guesses) for each stretch on which the map does not jump."""
    at, image, far, half, fine = sampled(law, tube)
    cuts = [-1, *np.flatnonzero(~fine), len(fine)]
    for before, after in zip(cuts, cuts[1:]):
        low, high = before + 1, after
        if high - low < 4 * WINDOW + 4:
            continue
        states, halves = image[low : high + 1], half[low : high + 1] * RADIANS
        numbers = kept(states * RADIANS, halves)
        tangent = np.gradient(states[numbers] * RADIANS, axis=0)
        direction = contracting(law, states[numbers])
        # The image of the old chord, where four impacts turn too much.
        lean = abs(flat_cross(tangent, direction)) / np.hypot(*tangent.T)
        own = halves[numbers] / np.hypot(*halves[numbers].T)[:, None]
        direction = np.where((lean > 0.2)[:, None], direction, own)
        sine = flat_cross(tangent, direction)
        thick = abs(flat_cross(tangent, halves[numbers]) / sine)
        reach = ((MARGIN * thick + PAD) * np.sign(sine))[:, None] * direction / RADIANS
        chords = [exact_chord(*ends) for ends in zip(states[numbers] - reach, states[numbers] + reach)]
        places = np.searchsorted(numbers, np.arange(high - low), side="right") - 1
        cells = np.minimum(at[low:high].astype(int), len(tube) - 2)
        parts = [
            Part(int(cell), float(begin - cell), float(end - cell), int(place), bool(wall), float(guess))
            for cell, begin, end, place, wall, guess in zip(cells, at[low:high], at[low + 1 :], places, far[low:high], states[:, 0])
        ]
        yield parts, chords


def turns_left(tube):
    """For each cell whether its window's edges and chords turn to the left, so that cells there are convex and apart."""
    edges = [(minus(b.bottom, a.bottom), minus(b.top, a.top)) for a, b in zip(tube, tube[1:])]
    across = [minus(chord.top, chord.bottom) for chord in tube]
    reach = 2 * WINDOW + 1
    return [
        all(cross(edge, chord) > 0 for edge in edges[cell] for chord in across[max(0, cell - reach) : cell + reach + 2])
        for cell in range(len(edges))
    ]


def is_held(image, tube, place):
    """True if an image lies in cells around `place`, away from their tops and bottoms."""
    if place < WINDOW or place + WINDOW + 1 >= len(tube):
        return False
    beyond = [image.beside(chord.bottom, minus(chord.top, chord.bottom)) for chord in tube[place - WINDOW : place + WINDOW + 2]]
    # The nearest chords that the image is behind, and before.
    low = max((number for number in range(WINDOW + 1) if beyond[number] < 0), default=None)
    high = min((number for number in range(WINDOW + 1, 2 * WINDOW + 2) if beyond[number] > 0), default=None)
    if low is None or high is None:
        return False
    chords = tube[place - WINDOW + low : place - WINDOW + high + 1]
    return all(
        image.beside(a.bottom, minus(b.bottom, a.bottom)) > 0 and image.beside(a.top, minus(b.top, a.top)) < 0
        for a, b in zip(chords, chords[1:])
    )


def is_mapped(law, tube, part, chords):
    """True if all of a part is proved to land, at first, around its place in the next chain of boxes."""
    start, end = tube[part.cell], tube[part.cell + 1]
    pieces = [(0, arb(part.begin), arb(part.end), arb(0), arb(1))]
    while pieces:
        depth, *shares = pieces.pop()
        flights = Flights.of_corners(law, corners(start, end, *shares))
        image = flights.land(part.far, part.guess - (0.5 if part.far else 0))
        if image is not None and is_held(image, chords, part.place):
            continue
        if depth == HALVINGS:
            return False
        a, b, c, d = shares
        if depth % 3 == 2:
            pieces += [(depth + 1, a, b, c, (c + d) / 2), (depth + 1, a, b, (c + d) / 2, d)]
        else:
            pieces += [(depth + 1, a, (a + b) / 2, c, d), (depth + 1, (a + b) / 2, b, c, d)]
    return True


def followed(law, tube, dropped):
    """(far, tube, parts) for each stretch that is proved to be followed over one impact; dropped cells count as not proved.

    No two stretches may be followed from parts with inner points in common: distinct words rest on that.
    """
    used = (-1, 0.0)
    for parts, chords in proposals(law, tube):
        straight = turns_left(chords)
        proved = [
            not dropped(part.place)
            and all(straight[max(0, part.place - WINDOW) : part.place + WINDOW + 2])
            and is_mapped(law, tube, part, chords)
            for part in parts
        ]
        begin = 0
        for end in range(len(parts) + 1):
            if end < len(parts) and proved[end]:
                continue
            if begin < end:
                # The ends of the stretch land before its first chord and behind its last one.
                first, last = parts[begin], parts[end - 1]
                if (first.cell, first.begin) < used:
                    raise Disagreement("two stretches of a tube are followed from one part of it")
                used = (last.cell, last.end)
                low, high = first.place + WINDOW + 2, last.place - WINDOW - 1
                if low < high:
                    yield parts[0].far, chords[low : high + 1], end - begin
            begin = end + 1
