"""The reference simulators, and their answers and CPU times, two processes at a time."""
import time
from concurrent.futures import ProcessPoolExecutor
from statistics import median
from typing import NamedTuple

from by_scan import ByScan
from by_solve_ivp import BySolveIvp
from by_taylor import ByTaylor
from scene import Motion, Start
from simulator import Listing, Simulator

SIMULATORS: tuple[Simulator, ...] = (
    BySolveIvp("SciPy RK45, defaults", "RK45", 1e-3),
    BySolveIvp("SciPy DOP853, 1e-12", "DOP853", 1e-12, rtol=1e-12, atol=1e-12),
    BySolveIvp("SciPy DOP853, 1e-12, max_step T/50", "DOP853", 1e-12, steps=50, rtol=1e-12, atol=1e-12),
    ByScan(),
    ByTaylor(),
)
SLOWEST_FIRST = (2, 1, 0, 3, 4)
PROCESSES = 2
CHUNK = 20          # questions a task
REPEATED_FOR = 0.1  # seconds; a quick run is timed more often than once ...
REPEATED = 25       # ... up to this number of times


class Question(NamedTuple):
    """Contacts after `start` are requested, up to `until` and at most `limit`; `timed`: with care for the CPU time."""
    motion: Motion[float]
    start: Start[float]
    until: float
    limit: int
    timed: bool = False


class Answer(NamedTuple):
    """A list of contacts and the CPU time it took in seconds (the median, if it was timed more than once)."""
    listing: Listing
    seconds: float


def answer(simulator: Simulator, question: Question) -> Answer:
    """One answer; what is compiled at the first use is not counted."""
    motion, start, until, limit, timed = question
    if timed:
        simulator.contacts(motion, start, until, 1)
    seconds: list[float] = []
    while True:
        begun = time.process_time()
        listing = simulator.contacts(motion, start, until, limit)
        seconds.append(time.process_time() - begun)
        if not timed or sum(seconds) >= REPEATED_FOR or len(seconds) >= REPEATED:
            return Answer(listing, median(seconds))


def answer_chunk(number: int, questions: list[Question]) -> list[Answer]:
    """The answers of one simulator."""
    return [answer(SIMULATORS[number], question) for question in questions]


def ask_all(questions: list[Question]) -> list[list[Answer]]:
    """For each simulator, in the order of SIMULATORS, its answers."""
    with ProcessPoolExecutor(PROCESSES) as pool:
        futures = {number: [pool.submit(answer_chunk, number, questions[first:first + CHUNK])
                            for first in range(0, len(questions), CHUNK)] for number in SLOWEST_FIRST}
        return [[reply for future in futures[number] for reply in future.result()] for number in range(len(SIMULATORS))]
