"""A scene as exact texts, and its values as doubles for a simulator or as mpmath numbers for the judge."""
import ast
import operator
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, TypeVar

from mpmath import mp, mpf

LEFT, RIGHT = "left", "right"
SIGN = {LEFT: -1, RIGHT: 1}

Real = TypeVar("Real", float, mpf)

OPERATIONS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv}


def evaluate(text: str) -> mpf:
    """The value of decimals, pi, + - * / and parentheses in mpmath's current precision."""
    def walk(node: ast.expr) -> mpf:
        match node:
            case ast.Constant():
                return mpf(ast.get_source_segment(text, node))
            case ast.Name(id="pi"):
                return +mp.pi
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return -walk(operand)
            case ast.BinOp(left=left, op=sign, right=right) if type(sign) in OPERATIONS:
                return OPERATIONS[type(sign)](walk(left), walk(right))
        raise ValueError(f"cannot read {text!r}")
    return walk(ast.parse(text, mode="eval").body)


@dataclass(frozen=True)
class Motion(Generic[Real]):
    """A [length], W [rad/time], tau [rad] of (9); the gap d [length]; the restitution e of (15)."""
    amplitude: Real
    omega: Real
    tau: Real
    gap: Real
    restitution: Real

    @property
    def period(self) -> Real:
        """2 pi/W [time]."""
        return 2 * (mp.pi if isinstance(self.omega, mpf) else 3.141592653589793) / self.omega


@dataclass(frozen=True)
class Start(Generic[Real]):
    """The ball leaves `wall` at `time` with the relative velocity `after` = v+ [length/time], inward or 0."""
    time: Real
    wall: str
    after: Real


@dataclass(frozen=True)
class Scene:
    """The entries of a scene file that starts on a wall, as written; `before` is the velocity before the impact."""
    amplitude: str
    frequency: str
    phase: str
    gap: str
    restitution: str
    time: str
    wall: str
    before: str

    @classmethod
    def read(cls, path: Path) -> "Scene":
        """The scene in a TOML file; bare decimals are kept as they are written."""
        tables = tomllib.loads(path.read_text(), parse_float=str)
        excitation, pair, start = (tables[name] for name in ("excitation", "pair", "start"))
        entries = [excitation["amplitude"], excitation["frequency"], excitation["phase"], pair["gap"],
                   pair["restitution"], start["time"], start["wall"], start["velocity"]]
        return cls(*map(str, entries))

    def toml(self) -> str:
        """The scene file for impact-pair; every number is a quoted exact expression."""
        return (f'[excitation]\namplitude = "{self.amplitude}"\nfrequency = "{self.frequency}"\n'
                f'phase = "{self.phase}"\n'
                f'[pair]\ngap = "{self.gap}"\nrestitution = "{self.restitution}"\n'
                f'[start]\ntime = "{self.time}"\nwall = "{self.wall}"\nvelocity = "{self.before}"\n')

    def motion(self) -> Motion[mpf]:
        """The parameters in mpmath's current precision."""
        return Motion(*map(evaluate, (self.amplitude, self.frequency, self.phase, self.gap, self.restitution)))

    def start(self) -> Start[mpf]:
        """The departure from the first wall, by (15), in mpmath's current precision."""
        return Start(evaluate(self.time), self.wall, -evaluate(self.restitution) * evaluate(self.before))


def doubles(motion: Motion[mpf]) -> Motion[float]:
    """The parameters as a user types them: each rounded to a double."""
    return Motion(float(motion.amplitude), float(motion.omega), float(motion.tau), float(motion.gap),
                  float(motion.restitution))


def rounded(start: Start[mpf]) -> Start[float]:
    """The departure with time and velocity rounded to doubles."""
    return Start(float(start.time), start.wall, float(start.after))
