"""Section 4: "to ensure periodic motion, the amplitude A cannot exceed d/2"."""
from chaos import below
from finding import FALSE
from listed import finding


def half_gap(quick):
    """Stable periodic motions with A > d/2, and chaos with A < d/2."""
    statement = "periodic motion needs A <= d/2"
    return [finding("equispaced, A = 0.51 d", statement, FALSE),
            finding("five impacts on each side, A = 7.5 d", statement, FALSE), *below(quick)]


CLAIMS = {"half-gap": half_gap}
