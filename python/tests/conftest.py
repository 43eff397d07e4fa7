"""The reference of the tests: the command line, built from the same sources."""

import json
import os
import subprocess
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
SCENES = ROOT / "scenes"


def program():
    """The command line: that of ``IMPACT_PAIR``, or the one that was built last."""
    if "IMPACT_PAIR" in os.environ:
        return Path(os.environ["IMPACT_PAIR"])
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    built = [path for path in (target / "release/impact-pair", target / "validation/impact-pair") if path.exists()]
    if not built:
        pytest.exit("build the command line first: cargo build --release", 2)
    return max(built, key=lambda path: path.stat().st_mtime)


class Cli:
    """Runs the command line on scenes of the repository."""

    def answer(self, *arguments, stdin=None):
        command = [program(), *map(str, arguments)]
        return subprocess.run(command, capture_output=True, text=True, cwd=ROOT, input=stdin, check=False)

    def text(self, *arguments, stdin=None):
        done = self.answer(*arguments, stdin=stdin)
        assert done.returncode in (0, 1), done.stderr
        return done.stdout

    def json(self, *arguments, **how):
        return json.loads(self.text(*arguments, "--format", "json", **how))

    def error(self, *arguments):
        done = self.answer(*arguments)
        assert done.returncode == 2
        return done.stderr


@pytest.fixture(scope="session")
def cli():
    return Cli()


def assert_rounded_outward(doubles, decimals):
    """Doubles (n, 2) are the ones next to the decimals, outside of them: Python's exact fractions judge."""
    assert len(doubles) == len(decimals)
    for (low, high), (lower, upper) in zip(doubles, decimals, strict=True):
        lower, upper = Fraction(Decimal(lower)), Fraction(Decimal(upper))
        assert Fraction(low) <= lower < Fraction(np.nextafter(low, np.inf))
        assert Fraction(np.nextafter(high, -np.inf)) < upper <= Fraction(high)
