"""Section 3.1: eigenvalues (38) and what can happen to them."""
from finding import PROVED, Finding, expect, tiny
from listed import ORBITS, listed


def hopf(quick):
    """det DP = e^(2k) over k impacts, so a complex pair has modulus e^k < 1."""
    for name in ORBITS:
        orbit = listed(name)
        tiny(orbit.jacobian().det() - orbit.pair.e ** (2 * len(orbit.states)), f"det DP of {name}")
        values = orbit.eigenvalues()
        if values[0] == "complex":
            modulus = (values[1] ** 2 + values[2] ** 2).sqrt()
            expect(modulus < 1 and modulus.overlaps(orbit.pair.e ** len(orbit.states)), f"the modulus of {name}")
    return [Finding("no Poincare-Andronov-Hopf bifurcation, for e < 1", PROVED,
                    f"det DP = e^(2k): 0 to 20 digits on {len(ORBITS)} orbits of 2 to 10 impacts")]


CLAIMS = {"hopf": hopf}
