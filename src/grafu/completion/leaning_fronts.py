"""A plate that leans is no front of a drawer: what is only guessed to be one is a flap, and hangs on its lower border.

It is the fall front of a secretary, which slopes as it is closed, or a door that drops and is drawn half open.
"""

from typing import Final

from grafu.asset.part import Asset
from grafu.completion.lone_fronts import as_doors
from grafu.geometry.leaning import LeaningConfig, leans
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Rail
from grafu.graph.motion import face_to_border, signed_axis
from grafu.vocabulary import PartLabel

_DEPTH: Final = 1
_UP: Final = 2
_FRONT: Final = 2  # the face that looks to -Y


def with_leaning_fronts(
    completion: GraphCompletion,
    asset: Asset,
    config: LeaningConfig = LeaningConfig(),
) -> GraphCompletion:
    """Returns the completion in which guessed drawers that are plates at a slant drop. Labelled ones stay."""
    graph = completion.completed
    guessed = {d.part for d in completion.decisions if d.question == "label" and d.choice == PartLabel.DRAWER}
    known = {part.id for part in asset.parts}
    lower = face_to_border(_DEPTH, signed_axis(_UP, positive=False))
    found = {
        edge: lower
        for edge in graph.motions
        if isinstance(edge, Rail)
        and edge.axis == _FRONT
        and edge.coupling is None
        and edge.child in guessed & known
        and graph.node(edge.child).box.thin_axis == _DEPTH
        and leans(asset.part(edge.child).mesh, config)
    }
    return as_doors(completion, found) if found else completion
