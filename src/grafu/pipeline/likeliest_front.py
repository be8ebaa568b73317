"""Which side of a piece is its front where neither labels nor shape show it: where the network lets fronts open to.

The network was trained on pieces whose front is -Y: it is asked about all four sides. What a format states alone, as
glTF does, is asked about too: many files do not keep to it.
"""

from collections.abc import Callable
from dataclasses import replace
from math import fsum
from typing import Final, final

import numpy as np

from grafu.asset.edit import moved
from grafu.asset.frame import front_is_assumed
from grafu.asset.part import Asset, Standing
from grafu.asset.standing import spelled
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat3, frozen_array
from grafu.geometry.config_checks import require_positive
from grafu.geometry.transform import from_rotation
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Hinge, MotionEdge, Rail
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import opening_face
from grafu.pipeline.several_pieces import piece_alone

_FRONT: Final = 2  # the signed axis -Y
_QUARTER: Final = frozen_array(np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]))
_OF_MOTION: Final = ("label", "border", "sign", "slide")


@final
@dataclass(frozen=True, slots=True)
class LikeliestFrontConfig:
    """When the network turns a piece.

    Raises:
        ValueError: if a number is not above 0.
    """

    margin: float = 0.8
    """How much more of doors and drawers, each counted by its confidence, open to the front of the turned piece. Of 26
    real ones two differ by 1.0, and are turned rightly; the next, a trunk, by 0.7, all others by less than 0.3. Of 26
    nameless ones whose GLB faces +X six show nothing, and five of these differ by 0.9 or more, rightly."""
    most: int = 100
    """Parts of the largest piece that is turned: each side costs a forward pass."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


def with_likeliest_front(
    asset: Asset,
    complete: Callable[[Asset], GraphCompletion],
    config: LikeliestFrontConfig = LikeliestFrontConfig(),
) -> Asset:
    """Returns the asset with the side in front to which most doors and drawers open; as it is where its front is shown.

    `complete` is how the network completes an asset.
    """
    if asset.standings:
        return replace(asset, standings=tuple(_likeliest(asset, one, complete, config) for one in asset.standings))
    if not front_is_assumed(asset.frame) or len(asset.parts) > config.most:
        return asset
    turned = [asset]
    for _ in range(3):
        turned.append(moved(turned[-1], from_rotation(_QUARTER)))
    scores = [_opening_to_front(complete(one)) for one in turned]
    best = int(np.argmax(scores))
    return _with_words(turned[best]) if scores[best] >= scores[0] + config.margin else asset


def _likeliest(
    asset: Asset, standing: Standing, complete: Callable[[Asset], GraphCompletion], config: LikeliestFrontConfig
) -> Standing:
    """Returns how one of several pieces stands, turned where its front is not shown."""
    piece = piece_alone(asset, standing)
    if not piece.parts:
        return standing
    turned = with_likeliest_front(piece, complete, config)
    T = turned.frame.input_to_output @ np.linalg.inv(piece.frame.input_to_output)
    return replace(standing, T_piece_object=T @ standing.T_piece_object, frame=turned.frame)


def _opening_to_front(completion: GraphCompletion) -> float:
    """Returns how many of the input's doors and drawers open to the front, each counted by its confidence."""
    graph, added = completion.completed, set(completion.added)
    return fsum(
        _confidence(edge.child, completion)
        for edge in graph.motions
        if edge.child not in added and _face(edge, graph) == _FRONT
    )


def _face(edge: MotionEdge, graph: FunctionalGraph) -> int | None:
    """Returns the signed axis along which a door or drawer opens; None: it is neither."""
    if isinstance(edge, Hinge):
        return opening_face(graph.node(edge.child).box.thin_axis, edge.border, edge.sign)
    return edge.axis if isinstance(edge, Rail) else None


def _confidence(part: str, completion: GraphCompletion) -> float:
    return float(np.prod([d.score for d in completion.decisions if d.part == part and d.question in _OF_MOTION]))


def _with_words(asset: Asset) -> Asset:
    linear: Mat3 = asset.frame.input_to_output[:3, :3]
    side = linear.T @ np.array([0.0, -1.0, 0.0])
    front = spelled(int(np.abs(side).argmax()), bool(side[np.abs(side).argmax()] > 0))
    words = f"front is {front}: what the network takes for doors and drawers opens there; --front changes it"
    up, _, *rest = asset.frame.assumed
    return replace(asset, frame=replace(asset.frame, front=front, assumed=(up, words, *rest)))
