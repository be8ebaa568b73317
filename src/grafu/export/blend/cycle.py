"""The keys of the closed-open-closed animation. It does not know Blender."""

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.sweep import opening_stages
from grafu.export.blend.layout import FIRST_FRAME, LAST_FRAME, WIDEST_FRAME

Key = tuple[float, float]


def cycle_keys(articulated: ArticulatedObject) -> dict[str, tuple[Key, ...]]:
    """Returns for each moving joint its keys: frames and shares of its opening, closed 0, open 1.

    Joints of one stage open together, each stage while all before it are wide open; the way back is the mirror image.

    Raises:
        ArticulationError: if joints wait for one another.
    """
    stages = opening_stages(articulated)
    bounds = np.linspace(FIRST_FRAME, WIDEST_FRAME, len(stages) + 1)
    if len(stages) <= WIDEST_FRAME - FIRST_FRAME:  # else whole frames are too few
        bounds = np.round(bounds)
    keys: dict[str, tuple[Key, ...]] = {}
    for stage, start, end in zip(stages, bounds[:-1], bounds[1:], strict=True):
        keys |= dict.fromkeys(stage, _there_and_back(float(start), float(end)))
    return keys


def _there_and_back(start: float, end: float) -> tuple[Key, ...]:
    """Returns the keys of a joint that starts to open at one frame and is open at another, without repeated frames."""
    last = FIRST_FRAME + LAST_FRAME
    way = [(FIRST_FRAME, 0.0), (start, 0.0), (end, 1.0), (last - end, 1.0), (last - start, 0.0), (LAST_FRAME, 0.0)]
    return tuple(sorted({float(frame): share for frame, share in way}.items()))
