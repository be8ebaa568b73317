"""What is done where a stage is more than the budget holds: less, but whole. Each says in words what was left out."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TypeVar

from grafu.asset.part import Asset
from grafu.completion.rule import complete_by_rule
from grafu.geometry.budget import within
from grafu.graph.completion import GraphCompletion, RefusedMotion
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.parse import ParsingConfig
from grafu.pipeline.body_additions import Body
from grafu.pipeline.fittings import Fittings
from grafu.realization.carcass.complete import CarcassCompletion
from grafu.realization.drawer_box.complete import DrawerBoxes
from grafu.realization.handle.grasp import held_by_label
from grafu.realization.plan import RealizationPlan
from grafu.realization.realize import Realized, realize
from grafu.realization.report import Skipped, SkipReason
from grafu.realization.scene import Scene
from grafu.realization.top.complete import TopVerdict
from grafu.templates.template import Gallery

T = TypeVar("T")

_HALF = 0.5  # of the time that is left: each simpler way gets so much


def by_contacts(parsing: ParsingConfig, make: Callable[[ParsingConfig], T]) -> T:
    """Returns what is made with contacts as they are parsed, else by boxes, else without contacts."""
    return within(
        _HALF,
        partial(make, parsing),
        lambda _: within(_HALF, partial(make, replace(parsing, contact="box")), partial(_bare, parsing, make)),
    )


def _bare(parsing: ParsingConfig, make: Callable[[ParsingConfig], T], _: str) -> T:
    return make(replace(parsing, contact="none"))


def without_network(graph: FunctionalGraph, why: str) -> GraphCompletion:
    """Returns the graph as the rule completes it; where that is too much, too, every door and drawer is refused."""
    refused = tuple(RefusedMotion(node.id, why, is_too_complex=True) for node in graph.nodes if node.label.is_movable)
    still = partial(GraphCompletion, graph, graph, "rule", (), (), refused)
    return within(_HALF, partial(complete_by_rule, graph), lambda _: still())


def bare_body(asset: Asset, plan: RealizationPlan, why: str) -> Body:
    """Returns the asset as it is, nothing added."""
    skipped = (Skipped("top and drawer boxes", SkipReason.TOO_COMPLEX, why),)
    return Body(asset, plan, TopVerdict(True, 1.0, why), CarcassCompletion(), DrawerBoxes(), (), skipped)


def without_joints(plan: RealizationPlan, asset: Asset, why: str) -> Realized:
    """Returns the asset as one rigid body: none of the plan's joints is built."""
    still = realize(RealizationPlan((), plan.refused), asset, Gallery((), ()))
    skipped = (Skipped(request.moving, SkipReason.TOO_COMPLEX, why) for request in plan.joints)
    return replace(still, report=replace(still.report, outcomes=(*skipped, *still.report.outcomes)))


def bare_fittings(scene: Scene, why: str) -> Fittings:
    """Returns the scene as it is, nothing added; what can be grasped is known of what has a handle by name alone."""
    found = {moving: held_by_label(scene, moving) for moving in scene.moving_bodies}
    grasps = {moving: grasp for moving, grasp in found.items() if grasp is not None}
    skipped = (Skipped("handles, grips and interiors", SkipReason.TOO_COMPLEX, why),)
    return Fittings(scene, grasps=grasps, skipped=skipped)
