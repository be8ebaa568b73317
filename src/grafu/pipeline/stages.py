"""The stages of one run, one after the other: told as they begin, timed, and kept within their fraction of the budget.

Fractions are of the time that is left when a stage begins, so that a stage that needs little leaves its rest to the
next.

What is done where a stage is more than the budget holds: less, but whole. Each states in words what was left out.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from time import perf_counter
from types import MappingProxyType
from typing import TypeVar, final

from grafu.additions.handle.grasp import held_by_label
from grafu.additions.step import StepResult
from grafu.asset.part import Asset
from grafu.completion.rule import complete_by_rule
from grafu.geometry.budget import Budget, within
from grafu.graph.completion import GraphCompletion
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.parse import ParsingConfig
from grafu.joints.plan import RealizationPlan
from grafu.joints.realize import Realized, realize
from grafu.pipeline.additions import planned_scene
from grafu.processes.limits import give_back_unused
from grafu.refusal import Asked, Reason, Refusal
from grafu.scene.scene import Scene
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
    refused = tuple(Refusal(node.id, Reason.TOO_COMPLEX, why) for node in graph.nodes if node.label.is_movable)
    still = partial(GraphCompletion, graph, graph, "rule", (), (), refused)
    return within(_HALF, partial(complete_by_rule, graph), lambda _: still())


def nothing_before_joints(asset: Asset, plan: RealizationPlan, why: str) -> StepResult:
    """Returns the asset as it is, nothing added."""
    refusal = Refusal("top and drawer boxes", Reason.TOO_COMPLEX, why, Asked.ADDITIONS)
    return StepResult(planned_scene(asset, plan), refusals=(refusal,))


def without_joints(plan: RealizationPlan, asset: Asset, why: str) -> Realized:
    """Returns the asset as one rigid body: none of the plan's joints is built."""
    still = realize(RealizationPlan((), plan.refused), asset, Gallery((), ()))
    skipped = (Refusal(request.moving, Reason.TOO_COMPLEX, why) for request in plan.joints)
    return replace(still, report=replace(still.report, outcomes=(*skipped, *still.report.outcomes)))


def nothing_after_joints(scene: Scene, why: str) -> tuple[StepResult, Scene]:
    """Returns the scene as it is, nothing added; what can be grasped is known of what has a handle by name alone."""
    found = {moving: held_by_label(scene, moving) for moving in scene.moving_bodies}
    grasps = {moving: grasp for moving, grasp in found.items() if grasp is not None}
    refusal = Refusal("handles, grips and interiors", Reason.TOO_COMPLEX, why, Asked.ADDITIONS)
    return StepResult(scene, refusals=(refusal,), grasps=grasps), scene


RATIOS: Mapping[str, float] = MappingProxyType(
    {"parse": 0.25, "complete": 0.3, "close": 0.1, "body": 0.25, "realize": 0.6, "fittings": 0.5}
    | {"small parts": 0.3, "lift arms": 0.2, "stays": 0.2, "grasp frames": 0.2}
)
"""What is left after them is for files and page; a stage that is not named here is short, and never given up."""
_INSTEAD: Mapping[str, str] = MappingProxyType(
    {
        "parse": "contacts were taken from boxes, or left out",
        "complete": "motions come from the rule",
        "close": "drawers that are drawn open stay so",
        "body": "no top and no drawer box was looked for",
        "realize": "no joint was built",
        "fittings": "no handle, grip or shelf was looked for",
        "small parts": "knobs, buttons and wheels stay on what carries them",
        "lift arms": "flaps that were to rise upright turn about their upper edges",
        "stays": "lids and flaps got no stays",
        "grasp frames": "no grasp frame was looked for",
    }
)


@final
class Stages:
    """Runs stages and keeps what they took; not a value.

    `laps` are seconds per stage, in order, all its turns together; `notes` state which stages were given up, why, and
    what was done instead.
    """

    def __init__(self, on_stage: Callable[[str], None], budget: Budget) -> None:
        self.laps: dict[str, float] = {}
        self.notes: list[str] = []
        self._given_up: set[str] = set()
        self._on_stage = on_stage
        self._budget = budget

    def timed(self, name: str, stage: Callable[[], T], instead: Callable[[str], T] | None = None) -> T:
        """Returns what a stage makes, or what is made `instead`, given why, where its fraction does not hold it."""
        self._on_stage(name)
        started = perf_counter()
        if instead is None:
            found = stage()
        else:
            with self._budget.in_force():
                found = within(RATIOS[name], stage, partial(self._other, name, instead))
        give_back_unused()
        self.laps[name] = self.laps.get(name, 0.0) + perf_counter() - started
        return found

    def gave_up(self, name: str) -> bool:
        """Whether something else was done instead of a stage."""
        return name in self._given_up

    def left_out(self, note: str) -> None:
        """Notes what was not done, and why."""
        self.notes.append(note)

    def given_up(self) -> tuple[tuple[str, ...], frozenset[str]]:
        """Returns the notes and the stages that were given up so far, for `take_back`."""
        return tuple(self.notes), frozenset(self._given_up)

    def take_back(self, before: tuple[tuple[str, ...], frozenset[str]]) -> None:
        """Drops what was given up since `before`: what these stages made is not used."""
        self.notes, self._given_up = list(before[0]), set(before[1])

    def _other(self, name: str, instead: Callable[[str], T], why: str) -> T:
        self._given_up.add(name)
        self.notes.append(f"{_INSTEAD[name]}: {why}")
        return instead(why)
