"""The listing that `impact-pair run` gives of an orbit with rests, compared with the proved legs."""
from collections import namedtuple
from fractions import Fraction

from flint import arb, ctx, fmpq

from compare import Disagreement, bounds, judge_quantity, judge_row
from release import pressure
from simulate import exact

# Impacts and then, unless the listing ends before, a rest and its release; grazed: a graze is listed after the impacts.
Stretch = namedtuple("Stretch", "impacts rest release grazed", defaults=(False,))
# A release that was listed: impacts before it, and the `Origin` of the next leg.
Listed = namedtuple("Listed", "impacts origin")
# Largest ratio of a bound on the remaining time of a chatter to that time.
GENEROUS = Fraction(11, 10)
# Distance from a chatter that counts as far, in multiples of its length.
MID_PRESS = 100
# Error allowed in the library's own limits, which are doubles.
ROUNDING = Fraction(1, 10**9)


class Verdict:
    """The numbers of impacts, rests and enclosures that agree, and the proved end."""

    def __init__(self):
        self.impacts = self.rests = self.held = 0
        self.releases, self.proved_end = [], None

    def period(self):
        """(cycles, impacts) between the first two releases from one wall whose phases are the same, or None."""
        for number, release in enumerate(self.releases):
            for before in self.releases[:number]:
                if release.origin.wall == before.origin.wall:
                    cycles = release.origin.cycles_since(before.origin)
                    if cycles is not None:
                        return cycles, release.impacts - before.impacts
        return None


def stretches(rows):
    """The rows in stretches, up to a graze; refuses any other order of impacts, rests and releases."""
    impacts, rest = [], None
    for number, row in enumerate(rows, 1):
        kind = row["event"]
        if kind == "impact" and rest is None:
            impacts.append(row)
        elif kind == "rest" and rest is None:
            rest = row
        elif kind == "release" and rest is not None:
            yield Stretch(impacts, rest, row)
            impacts, rest = [], None
        elif kind == "graze" and rest is None:
            yield Stretch(impacts, None, None, True)
            return
        else:
            raise Disagreement(f"row {number}: {kind!r} cannot follow")
    yield Stretch(impacts, rest, None)


def check_order(rows):
    """Refuses a row that is certainly before the one above it."""
    last = None
    for number, row in enumerate(rows, 1):
        lower, upper = bounds(row, "time")
        if last is not None and upper < last:
            raise Disagreement(f"row {number} is before row {number - 1}")
        last = lower


def check_widths(rows, scene, digits):
    """Refuses a time that is wider than 10^-digits periods, but for a graze, which is known as far as it can be."""
    # The period is irrational: the ball's middle is near enough for a bound that is never met exactly.
    widest = exact(scene.motion().period().mid()) / 10**digits
    for number, row in enumerate(rows, 1):
        lower, upper = bounds(row, "time")
        if row["event"] != "graze" and upper - lower > widest * (1 + ROUNDING):
            raise Disagreement(f"row {number}: {float((upper - lower) / widest)} times as wide as asked for")


def judge_still(row, kind, wall, time):
    """A rest or a release at a proved time; True if the printed bounds hold all of its ball."""
    found = tuple(row[key] for key in ("event", "index", "mapping", "wall", "velocity_lower", "velocity_upper"))
    if found != (kind, "", "", wall, "", ""):
        raise Disagreement(f"found {','.join(found)!r}, proved {kind!r} on the {wall} wall")
    return judge_quantity("time", bounds(row, "time"), time)


def judge_impacts(stretch, origin, proved, verdict):
    """The impacts of a stretch against those of a leg."""
    if len(proved.impacts) < len(stretch.impacts):
        end = f"a rest on the {proved.rest.wall} wall" if proved.rest else "nothing more"
        raise Disagreement(f"{len(stretch.impacts)} impacts on end, proved {len(proved.impacts)} and {end}")
    for row, impact in zip(stretch.impacts, proved.impacts):
        verdict.impacts += 1
        placed = impact._replace(index=verdict.impacts, time=origin.shifted(impact.time, proved.bits))
        try:
            verdict.held += judge_row(row, placed)
        except Disagreement as error:
            raise Disagreement(f"impact {verdict.impacts}: {error}") from None


def judge_cut(stretch, origin, proved, limit, is_sharp):
    """The last listed impact is the first from which the chatter is at most half of 10^-digits periods long.

    Or one of the next: the library's bound on that time grows with its enclosure of the velocity, among others.
    """
    left = remaining(len(stretch.impacts), origin, proved)
    if left[-1] is None or left[-1] > limit * (1 + ROUNDING):
        raise Disagreement("a rest long before the end of the chatter")
    if not is_sharp or len(left) == 1 or left[-2] is None or not is_mid_press(origin, proved, limit):
        return
    bound = left[-2] * GENEROUS
    if len(left) > 2:
        row, impact = stretch.impacts[-2], proved.impacts[len(left) - 3]
        bound *= max(abs(value) for value in bounds(row, "velocity")) / abs(exact(impact.velocity.mid()))
    if bound < limit:
        raise Disagreement("impacts listed long after the chatter became too short")


def is_mid_press(origin, proved, limit):
    """The pressure hardly changes in the time `limit`: its beginning and its end are many times farther away."""
    with ctx.workprec(proved.bits):
        around = arb(proved.rest.time.mid(), arb(fmpq(limit.numerator, limit.denominator)) * MID_PRESS)
        return pressure(origin.scene.motion(), proved.rest.wall, around) > 0


def remaining(listed, origin, proved):
    """The times from the start and from each listed impact to the rest; None from a start inside the gap."""
    with ctx.workprec(proved.bits):
        start = None if origin.scene.start()[0] is None else origin.began(proved.bits)
        times = [start] + [impact.time for impact in proved.impacts[:listed]]
        return [None if time is None else exact((proved.rest.time - time).mid()) for time in times]


def chatter_limit(scene, digits):
    """Half of 10^-digits periods, about: a chatter that is shorter is not listed."""
    return exact(scene.motion().period().mid()) / (2 * 10**digits)


def judge(rows, timeline, is_sharp=True):
    """A `Verdict`; raises Disagreement at the first contradiction. `is_sharp`: chatter ends where it may."""
    verdict, origin = Verdict(), timeline.begin()
    limit = chatter_limit(timeline.scene, timeline.digits)
    for stretch in stretches(rows):
        proved = origin.prove(len(stretch.impacts) + stretch.grazed, stretch.rest is not None)
        if timeline.is_patient and proved.rest is not None and len(proved.impacts) < len(stretch.impacts):
            on = origin.prove_on(len(stretch.impacts), proved)
            proved = on if len(on.impacts) >= len(stretch.impacts) else proved
        if proved.reason is not None and len(proved.impacts) < len(stretch.impacts):
            verdict.proved_end = proved.reason
            stretch = Stretch(stretch.impacts[: len(proved.impacts)], None, None)
        judge_impacts(stretch, origin, proved, verdict)
        if stretch.grazed:
            judge_graze(proved, verdict)
        if stretch.rest is None:
            break
        if proved.rest is None:
            if proved.reason is None:
                raise Disagreement(f"after impact {verdict.impacts}: a rest, proved more impacts")
            verdict.proved_end = proved.reason
            break
        origin = judge_rest(stretch, origin, proved, verdict, limit, is_sharp)
    return verdict


def judge_graze(proved, verdict):
    """No wall is touched between proved impacts; beyond them a graze is possible, but never proved here."""
    if proved.reason is None:
        raise Disagreement(f"after impact {verdict.impacts}: a graze, proved none")
    verdict.proved_end = proved.reason


def judge_accumulation(stretch, origin, proved):
    """The time of a rest; where the bounds end so near to it that the ball sticks out, a narrower ball decides."""
    def judged(leg):
        return judge_still(stretch.rest, "rest", leg.rest.wall, origin.shifted(leg.rest.time, leg.bits))

    try:
        return judged(proved)
    except Disagreement:
        closer = origin.prove_closer(len(proved.impacts))
        if closer.rest is None:
            raise
        return judged(closer)


def judge_rest(stretch, origin, proved, verdict, limit, is_sharp):
    """The rest and the release of a stretch; the beginning of the next leg."""
    try:
        verdict.held += judge_accumulation(stretch, origin, proved)
        judge_cut(stretch, origin, proved, limit, is_sharp)
        verdict.rests += 1
        origin = origin.next(proved.rest)
        if stretch.release is not None:
            judge_still(stretch.release, "release", origin.wall, origin.time(proved.bits))
            verdict.releases.append(Listed(verdict.impacts, origin))
    except Disagreement as error:
        raise Disagreement(f"after impact {verdict.impacts}: {error}") from None
    return origin


def judge_period(verdict, outcome):
    """The outcome says `periodic`, and with which period, exactly when the listing has shown it.

    Where the frequencies of several harmonics are multiples of a root it need not be said.
    """
    period = verdict.period()
    said = outcome.get("period", {})
    found = (said.get("cycles"), said.get("impacts")) if outcome["kind"] == "periodic" else None
    if found is None and period is not None and verdict.releases[0].origin.timeline.scene.has_roots():
        return
    if found != period:
        raise Disagreement(f"period (cycles, impacts): found {found}, proved {period}")
