"""What the network says about one graph, as plain arrays. It decides nothing and knows no file."""

from dataclasses import dataclass, fields
from typing import final

import numpy as np
from jaxtyping import Float32

from grafu.geometry.arrays import ArrayValue, freeze_arrays


@final
@dataclass(frozen=True, eq=False, slots=True)
class Scores(ArrayValue):
    """Logits and boxes of s slots: first one for each node that was seen, then the free ones.

    Boxes stand in the normalised frame of the features. A pair (i, j) asks about i as the child (the door, drawer or
    handle) and j as what carries it. `parent_abstain` and `hinge_abstain` speak for no slot at all. Codes are those of
    `grafu.graph.arrays` and, for motions, the authors' (official.md 3).
    """

    exists: Float32[np.ndarray, " s"]
    category: Float32[np.ndarray, "s labels"]
    centre: Float32[np.ndarray, "s 3"]
    half: Float32[np.ndarray, "s 3"]
    edge: Float32[np.ndarray, "s s kinds"]
    parent: Float32[np.ndarray, "s s"]
    parent_abstain: float
    hinge_target: Float32[np.ndarray, "s s"]
    hinge_abstain: float
    border: Float32[np.ndarray, "s s 4"]
    sign: Float32[np.ndarray, "s s 2"]
    slide: Float32[np.ndarray, "s s 6"]

    def __post_init__(self) -> None:
        freeze_arrays(self, dtype=np.float32)


SCORE_NAMES: tuple[str, ...] = tuple(field.name for field in fields(Scores))
