"""The network's scores as probabilities, and the mean of two forward passes: a graph and its mirror image.

Border and sign of a hinge stand in one table: in the mirror the sign turns or stays by the border. It decides nothing.
"""

from dataclasses import replace
from typing import Any, final

import numpy as np

from grafu.completion.features import Scores
from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, freeze_arrays
from grafu.graph.edges import BORDERS, SIGNED_AXES, SIGNS
from grafu.graph.motion import mirror_face, mirror_hinge
from grafu.shapes import Float, Int64


@final
@dataclass(frozen=True, eq=False, slots=True)
class Probabilities(ArrayValue):
    """Probabilities for s slots, the first n of them nodes of the input.

    `centre` and `half` stand in the normalised frame. `hinge[i, j]` is a table of border and sign. `parent` and
    `mount` stay logits, beside the logit of none, because what they choose among depends on the labels. `body[i, j]` is
    that i and j move as one, `ajar` that a part is drawn open, `piece` what the whole is, as in `Scores`.
    """

    exists: Float[np.ndarray, " s"]
    label: Float[np.ndarray, "s labels"]
    centre: Float[np.ndarray, "s 3"]
    half: Float[np.ndarray, "s 3"]
    edge: Float[np.ndarray, "s s kinds"]
    parent: Float[np.ndarray, "s s"]
    no_parent: float
    mount: Float[np.ndarray, "s s"]
    no_mount: float
    hinge: Float[np.ndarray, "s s 4 2"]
    slide: Float[np.ndarray, "s s 6"]
    body: Float[np.ndarray, "s s"]
    ajar: Float[np.ndarray, " s"]
    piece: Float[np.ndarray, " pieces"]

    def __post_init__(self) -> None:
        freeze_arrays(self, dtype=np.float64)


def probabilities_of(scores: Scores) -> Probabilities:
    """Returns the scores of one forward pass as probabilities."""
    border, sign = softmax(scores.border), softmax(scores.sign)
    return Probabilities(
        exists=_sigmoid(scores.exists),
        label=softmax(scores.category),
        centre=scores.centre.astype(np.float64),
        half=scores.half.astype(np.float64),
        edge=softmax(scores.edge),
        parent=scores.parent.astype(np.float64),
        no_parent=scores.parent_abstain,
        mount=scores.hinge_target.astype(np.float64),
        no_mount=scores.hinge_abstain,
        hinge=border[..., :, None] * sign[..., None, :],
        slide=softmax(scores.slide),
        body=_sigmoid(scores.body),
        ajar=_sigmoid(scores.ajar),
        piece=softmax(scores.piece),
    )


def mirrored_back(probabilities: Probabilities, thin: Int64[np.ndarray, " n"], across: int) -> Probabilities:
    """Returns the probabilities of the mirror image across an axis, mapped back to the graph.

    `thin` are the thin axes of the boxes of the seen nodes; free slots, which are none's, keep their hinges.
    """
    signs = np.ones(3)
    signs[across] = -1.0
    faces = [mirror_face(code, across) for code in SIGNED_AXES]
    hinge = probabilities.hinge.reshape(*probabilities.hinge.shape[:2], -1).copy()
    for axis in range(3):
        images = [mirror_hinge(axis, border, sign, across) for border in BORDERS for sign in SIGNS]
        rows = np.flatnonzero(thin == axis)
        hinge[rows] = hinge[rows][:, :, [2 * border + sign for border, sign in images]]
    return replace(
        probabilities,
        centre=probabilities.centre * signs,
        hinge=hinge.reshape(probabilities.hinge.shape),
        slide=probabilities.slide[..., faces],
    )


_OF_PAIRS = ("edge", "parent", "mount", "hinge", "slide", "body")


def averaged(first: Probabilities, second: Probabilities, seen: int) -> Probabilities:
    """Returns the mean of two passes over the first `seen` slots and their pairs; free slots are those of the first.

    In each pass the free slots may stand for other parts.
    """

    def mean(name: str, *, pairs: bool) -> np.ndarray:
        a, b = getattr(first, name), getattr(second, name)
        found = np.array(a)
        where = (slice(seen), slice(seen)) if pairs else slice(seen)
        found[where] = (a[where] + b[where]) / 2
        return found

    by_slot: dict[str, Any] = {name: mean(name, pairs=False) for name in ("label", "centre", "half", "ajar")}
    by_pair: dict[str, Any] = {name: mean(name, pairs=True) for name in _OF_PAIRS}
    return replace(first, **by_slot, **by_pair, piece=(first.piece + second.piece) / 2)


def _sigmoid(logits: np.ndarray) -> np.ndarray:
    found: np.ndarray = 1.0 / (1.0 + np.exp(-np.clip(logits.astype(np.float64), -60.0, 60.0)))
    return found


def softmax(logits: np.ndarray) -> np.ndarray:
    """Returns the softmax of logits along the last axis; of no logits none."""
    if not logits.shape[-1]:
        return np.zeros(logits.shape)
    weights = np.exp(logits.astype(np.float64) - logits.max(axis=-1, keepdims=True))
    normalised: np.ndarray = weights / weights.sum(axis=-1, keepdims=True)
    return normalised
