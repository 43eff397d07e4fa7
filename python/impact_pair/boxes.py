"""Images of boxes under the reduced impact map, for programs that search on grids, such as CMGDB."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from . import _core
from ._exact import doubles_of, whole
from ._progress import Progress, reporting
from .bounds import doubles
from .errors import RangeError

if TYPE_CHECKING:
    import numpy.typing as npt

    from .bounds import Doubles

#: By the numbers of the compiled module.
REASONS = np.array(["", "rest", "long", "interrupted"])


@dataclass(frozen=True)
class BoxImages:
    """Enclosures of the images of n boxes: least phase, least speed, greatest phase, greatest speed.

    Phases begin in [0, 1) and may end beyond 1, as they are modulo 1; those of a whole period are [0, 1]. Where nothing is proved,
    and on a wall where nothing lands, all four are NaN.
    """

    #: Around all landings (n, 4).
    rects: Doubles
    #: Around those on the wall that was left (n, 4).
    near: Doubles
    #: Around those on the other wall (n, 4).
    far: Doubles
    #: Reasons why nothing is proved (n,): ``"rest"``, a ball may come to rest; ``"long"``, a flight may last over 64 forcing periods;
    #: ``"interrupted"``, Ctrl-C came before; or ``""``.
    reasons: npt.NDArray[np.str_]

    @property
    def decided(self) -> npt.NDArray[np.bool_]:
        """True where the image is proved to be in its rectangles (n,)."""
        return np.asarray(self.reasons == "")

    @property
    def interrupted(self) -> bool:
        """True if Ctrl-C ended the computation."""
        return bool((self.reasons == "interrupted").any())

    def __len__(self) -> int:
        return len(self.reasons)


def box_map(scene: _core.Scene, rects: npt.ArrayLike, columns: int, progress: Progress) -> BoxImages:
    """Return the images of boxes: see :meth:`impact_pair.Scene.box_map`."""
    boxes = np.ascontiguousarray(doubles_of("rects", rects))
    if boxes.ndim != 2 or boxes.shape[1] != 4:
        message = f"rects has the shape {boxes.shape}, but must have (n, 4): least phase and speed, greatest phase and speed"
        raise RangeError(message, "rects", str(boxes.shape))
    with reporting(progress, "boxes", len(boxes)) as report:
        near, far, hull, reasons = _core.box_map(scene, boxes.tobytes(), whole("columns", columns), report)
    named = REASONS[np.frombuffer(reasons, dtype=np.uint8)]
    return BoxImages(doubles(hull, -1, 4), doubles(near, -1, 4), doubles(far, -1, 4), named)
