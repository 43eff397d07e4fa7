"""Figures 12 and 13: attracted to the equispaced orbit, not periodic and not quasi-periodic."""
from flint import arb, ctx

from attract import contraction, enters, offset
from closed import Equispaced
from finding import FALSE, PROVED, Finding, expect, tiny
from periodic import Orbit, prove
from program import Run

BITS, RADIUS = 640, arb("0.0001")


def exact():
    """Figure 12 as it was meant: the orbit d = 3 pi, v = -4 pi of (66), (67), with A = 1, W = pi, e = 1/2, th0 = 0."""
    family, th0 = Equispaced("0.5"), arb(0)
    orbit = Orbit(family.pair(th0), 1, family.states(th0))
    for miss in orbit.misses():
        tiny(miss, "the exact orbit of figure 12")
    orbit.require_first_contacts()
    tiny(family.gap(th0) - 3 * arb.pi(), "d = 3 pi")
    tiny(orbit.states[0][2] * arb.pi() + 4 * arb.pi(), "v = -4 pi")
    return Finding("figure 12's exact orbit: d = 3 pi, v = -4 pi", PROVED, "d - 3 pi and v + 4 pi are 0 in (66), (67)")


def distances(orbit, run, coordinates):
    """max |s| of the states after 2, 20, 40, ... impacts."""
    shown = []
    for n in (2, 20, 40, 100, 200):
        s = offset(orbit, coordinates, *run.impacts[n - 1][1:])
        size = max(s, key=lambda x: abs(x).mid())
        shown.append(f"{n}: {abs(size).str(3, radius=False)}")
        expect(not size.contains(0), f"impact {n} may be on the orbit")
    return ", ".join(shown)


def attracted(scene, verdict, statement):
    """The orbit of a scene, proved, and that its 200 certified impacts are drawn into it and never are on it."""
    with ctx.workprec(BITS):
        run = Run(scene, "--impacts", "200", "--digits", "140")
        expect(not run.count("rest") and len(run.impacts) == 200, "200 impacts without rest")
        family = Equispaced(run.pair.e)
        orbit = prove(run.pair, family.seed(run.pair.gap), 1)
        expect(orbit.stable(), "the orbit is stable")
        every = [(n, run.impacts[n - 1]) for n in range(2, 201, 2)]
        n, q = enters(orbit, every, RADIUS)
        coordinates = contraction(orbit, RADIUS)[1]
        return orbit, Finding(statement, verdict, f"eigenvalues {orbit.shown()}; from impact {n} on inside a box that "
                              f"a cycle shrinks by {q.str(4)}; distance after impact "
                              f"{distances(orbit, run, coordinates)}")


def figure_12(quick):
    """Eigenvalues 0.24259, 0.25764; the printed start is not on the orbit."""
    orbit, finding = attracted("scenes/figure-12.toml", PROVED, "figure 12's start is attracted to, not on, the orbit")
    low, high = orbit.eigenvalues()
    expect(abs(low - arb("0.24259")) < 1e-5 and abs(high - arb("0.25764")) < 1e-5, "the eigenvalues of figure 12")
    return [exact(), finding]


def figure_13(quick):
    """Eigenvalues -0.19127 +- 0.16098 i: no quasi-periodic motion."""
    orbit, finding = attracted("scenes/figure-13.toml", FALSE, "figure 13 is unequispaced and quasi-periodic: it "
                               "spirals into the equispaced orbit")
    kind, real, imaginary = orbit.eigenvalues()
    expect(kind == "complex" and abs(real + arb("0.19127")) < 1e-5 and abs(imaginary - arb("0.16098")) < 1e-5,
           "the eigenvalues of figure 13")
    amplitude = arb("9.42497") * Equispaced("0.5").pitchfork()
    expect(amplitude > 3, "figure 13 is below the pitchfork")
    return [finding, Finding("with figure 12's d and e the motion becomes unequispaced at A = 2", FALSE,
                             f"the pitchfork is at A = {amplitude.str(8)}")]


CLAIMS = {"figure-12": figure_12, "figure-13": figure_13}
