"""Figures 14, 16, 17 and a motion with A < d/2: seen chaotic, by growth enclosed along certified impacts."""
from itertools import groupby

from flint import arb, ctx

from finding import FALSE, SEEN, Finding, expect
from lyapunov import exponent
from program import Run

BITS, DIGITS = 192, "40"


def growth(source, impacts):
    """(run, exponent) over `impacts` certified impacts."""
    with ctx.workprec(BITS):
        run = Run(source, "--impacts", str(impacts), "--digits", DIGITS)
        expect(run.count("rest") == 0 and run.count("graze") == 0, "no impact sticks")
        value = exponent(run)
    expect(value.rad() < 1e-6, "the exponent is known")
    return run, value


def chaotic(source, expected, statement, impacts, verdict=SEEN):
    """A finding: the exponent is near the one of long runs."""
    run, value = growth(source, impacts)
    expect(abs(value / arb(expected) - 1) < (0.04 if impacts > 1000 else 0.12), f"{statement}: {value.str(6)}")
    series = max(len(list(group)) for _, group in groupby(wall for wall, _, _ in run.impacts))
    return Finding(statement, verdict, f"{value.str(6)} per impact over {len(run.impacts):,} certified impacts, "
                   f"no rest, at most {series} impacts on a wall in a row")


def figure(number, expected, name):
    """The check of one figure of the paper."""
    return lambda quick: [chaotic(f"scenes/figure-{number}.toml", expected, f"figure {number} is chaotic ({name})",
                                  1000 if quick else 10000)]


def below(quick):
    """Chaos where the paper has periodic motion."""
    found = []
    for ratio, e, expected in (("0.498", "0.8", "0.100"), ("0.45", "0.8", "0.083"), ("0.036", "0.9", "1.35")):
        found.append(chaotic(f"validation/paper/scenes/chaos-{ratio}.toml", expected,
                             f"chaos needs A > d/2: A = {ratio} d, e = {e} is chaotic, as far as seen",
                             1000 if quick else 5000, FALSE))
    return found


CLAIMS = {"figure-14": figure(14, "0.399", "random chaos"), "figure-16": figure(16, "0.149", "regular chaos"),
          "figure-17": figure(17, "0.393", "random chaos")}
