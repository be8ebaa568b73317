"""What static functionalization found missing and made: tops, grasps, interiors, each looked at again afterwards."""

from dataclasses import dataclass
from typing import final

from grafu.additions.handle.grasp import find_grasp
from grafu.additions.interior.compartments import Compartment, find_compartments
from grafu.additions.interior.furnish import furnish
from grafu.additions.interior.request import InteriorKind, InteriorRequest
from grafu.additions.step import DeficiencyKind
from grafu.additions.top.complete import missing_top
from grafu.pipeline.functionalize import Functionalized
from grafu.scene.scene import Scene
from grafu.vocabulary import PartLabel

_ONE_PANEL = (InteriorRequest(InteriorKind.COUNTED, shelves=1), InteriorRequest(InteriorKind.COUNTED, dividers=1))


@final
@dataclass(frozen=True)
class GraspChange:
    """How a moving body can be grasped before and after, as the same search finds it: handle, recess, edge or none."""

    part: str
    before: str
    after: str


@final
@dataclass(frozen=True)
class Completeness:
    """What of a model's statics was missing, and what is there now.

    `topped` states about a topless model that the coverage test finds a top afterwards. `compartments` counts the rooms
    that are large enough for shelves or dividers, `filled` those that take one when it is asked for.
    """

    topless: bool
    topped: bool
    grasps: tuple[GraspChange, ...]
    compartments: int
    filled: int


def completeness_of(result: Functionalized) -> Completeness:
    """Returns what was missing and what was made in one result; compartments are furnished for the count alone."""
    topless = any(one.kind is DeficiencyKind.TOP for one in result.body.deficiencies)
    topped = topless and any(a.part.label is PartLabel.TOP_PANEL for a in result.body.additions)
    if topped:
        topped = missing_top(tuple(result.body.scene.parts.values()), result.plan.joints).covered
    return Completeness(topless, topped, _grasps(result), *_interiors(result))


def _grasps(result: Functionalized) -> tuple[GraspChange, ...]:
    """Returns the change of each moving body; only where nothing was found before is looked at again."""
    found = []
    for moving, grasp in result.fittings.grasps.items():
        after = grasp.kind if grasp.kind != "none" else find_grasp(result.fittings.scene, moving).kind
        found.append(GraspChange(moving, grasp.kind, after))
    return tuple(found)


def _interiors(result: Functionalized) -> tuple[int, int]:
    """Returns how many compartments there are, and how many take a shelf or else a divider."""
    scene = result.fittings.scene
    compartments = find_compartments(scene)
    return len(compartments), sum(_takes_a_panel(compartment, scene) for compartment in compartments)


def _takes_a_panel(compartment: Compartment, scene: Scene) -> bool:
    return any(furnish((compartment,), request, scene).additions for request in _ONE_PANEL)
