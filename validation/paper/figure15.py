"""Figure 15: the printed one-cycle motion is unstable, the double of it attracts."""
from flint import arb

from attract import enters
from finding import FALSE, PROVED, Finding, expect
from pair import LEFT, RIGHT
from periodic import find
from program import Run

RADIUS, IMPACTS = arb("2e-6"), 10000


def figure_15(quick):
    """Word, eigenvalues, and where the printed start goes."""
    run = Run("scenes/figure-15.toml", "--impacts", str(IMPACTS), "--arithmetic", "interval")
    walls = [wall for wall, _, _ in run.impacts]
    expect(walls[:5000] == [RIGHT, RIGHT, LEFT, LEFT, LEFT] * 1000, "the walls of figure 15")
    wall, th, v = run.impacts[-6]
    turns = (th / (2 * arb.pi())).mid().floor()
    seed = wall, (th - 2 * arb.pi() * turns).mid(), v.mid()
    single, double = find(run.pair, *seed, 5, 1), find(run.pair, *seed, 10, 2)
    expect(single.word() == "P4 P4 P1 P3 P2" and not single.stable(), "the one-cycle orbit is unstable")
    first = single.eigenvalues()[0]
    expect(abs(first + arb("1.0021046")) < 1e-7, "its eigenvalue")
    expect(double.stable() and abs(double.eigenvalues()[1] - arb("0.9915971")) < 1e-7, "the double's eigenvalue")
    halves = [(abs(th1 - th0 - 2 * arb.pi()), abs(v1 - v0))
              for (_, th0, v0), (_, th1, v1) in zip(double.states[:5], double.states[5:])]
    apart = [max(part, key=lambda x: x.mid()) for part in zip(*halves)]
    expect(apart[0] > 0, "the double is not the one-cycle orbit run twice")
    steps = [(n, run.impacts[n - 1]) for n in range(len(walls) - 5, 0, -10)]
    n, q = enters(double, reversed(steps), RADIUS)
    return [
        Finding("figure 15's one-cycle orbit of 5 impacts, m = 2 and n = 3", FALSE,
                f"it exists, but is unstable: eigenvalues {single.shown()}"),
        Finding("figure 15's attractor: its double, 10 impacts in 2 cycles", PROVED,
                f"eigenvalues {double.shown()}; the printed start is inside its basin from impact {n} on, where two "
                f"cycles shrink a box by {q.str(6)}; its halves differ by at most {apart[0].str(4)} in th and "
                f"{apart[1].str(4)} in v/(A W)"),
    ]


CLAIMS = {"figure-15": figure_15}
