"""How much two boxes have in common. It knows no parts."""

import numpy as np

from grafu.geometry.box import Box


def intersection_over_union(a: Box, b: Box, margin: float = 0.0) -> float:
    """Returns the shared volume over the joint volume of two boxes, each grown by `margin` on every side."""
    a, b = a.grown(margin), b.grown(margin)
    shared = float(np.prod(np.maximum(np.minimum(a.high, b.high) - np.maximum(a.low, b.low), 0.0)))
    joint = a.volume + b.volume - shared
    return shared / joint if joint > 0 else 0.0
