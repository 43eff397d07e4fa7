"""The interface of reference simulators: a name, the tolerance its user asks for, and a way to list contacts."""
from dataclasses import dataclass
from typing import NamedTuple, Protocol

from scene import Motion, Start


class Contact(NamedTuple):
    """A contact in doubles: time, wall and the relative velocity y' before it."""
    time: float
    wall: str
    before: float


@dataclass(frozen=True)
class Listing:
    """Contacts in order, and why the list ends: impacts, time, budget, outside or an error's name."""
    contacts: list[Contact]
    ended: str


class Simulator(Protocol):
    """A reference; `tolerance` is what its user asks for, in periods for times."""
    name: str
    tolerance: float

    def contacts(self, motion: Motion[float], start: Start[float], until: float, limit: int) -> Listing:
        """The contacts after `start` up to the time `until`, at most `limit`."""


def bounce(motion: Motion[float], contact: Contact) -> Start[float]:
    """(15), with the care users take: the ball leaves inward, whatever the sign of the computed velocity."""
    inward = 1.0 if contact.wall == "left" else -1.0
    return Start(contact.time, contact.wall, inward * motion.restitution * abs(contact.before))
