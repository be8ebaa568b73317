"""How moving bodies may be expected to move before their joints are built, so that hardware keeps out of their way.

A door is expected to turn about the first pin of a hinge class that leaves it free, else about the axis that was asked
for; a drawer slides. What is built later may differ.
"""

from collections.abc import Iterable, Iterator

from grafu.realization.config import RealizationConfig
from grafu.realization.hinge.search import door_search
from grafu.realization.plan import JointRequest
from grafu.realization.rail.search import drawer_search
from grafu.realization.scene import JointMotion, Scene
from grafu.vocabulary import JointType


def expected_motions(
    requests: Iterable[JointRequest], scene: Scene, config: RealizationConfig
) -> dict[str, JointMotion]:
    """Returns the expected motion of each requested joint, by moving body; none for drawers that no rails can carry."""
    return dict(_motions(requests, scene, config))


def _motions(
    requests: Iterable[JointRequest], scene: Scene, config: RealizationConfig
) -> Iterator[tuple[str, JointMotion]]:
    for request in requests:
        if request.type is JointType.REVOLUTE:
            door = door_search(request, scene, config)
            yield request.moving, JointMotion(door.expected_axis, request.type, door.wanted, is_built=False)
            continue
        drawer = drawer_search(request, scene, config)
        if drawer is not None:
            yield request.moving, JointMotion(drawer.axis, request.type, drawer.wanted, is_built=False)
