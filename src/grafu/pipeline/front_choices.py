"""Handles and grips of single fronts as the user chose: replaced, added, carved or left out. It chooses nothing."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import final

from grafu.additions.addition import Addition
from grafu.additions.grip.carve import carve_grip
from grafu.additions.grip.config import GripConfig, GripKind
from grafu.additions.grip.outcome import Carved
from grafu.additions.handle.config import HandleConfig
from grafu.additions.handle.grasp import Grasp
from grafu.additions.handle.place import add_handles
from grafu.geometry.arrays import Vec3
from grafu.pipeline.addition_config import AdditionConfig, HandleChoice
from grafu.refusal import Asked, Reason, Refusal
from grafu.scene.scene import Scene
from grafu.templates.template import HandleTemplate
from grafu.vocabulary import PartLabel

NO_HANDLE = "none"
ANY_GRIP = "grip"


@final
@dataclass(frozen=True)
class Fronts:
    """The scene with what was chosen, what was added and carved, and what was not, and why."""

    scene: Scene
    additions: tuple[Addition, ...] = ()
    carved: tuple[Carved, ...] = ()
    skipped: tuple[Refusal, ...] = ()


def without_replaced(scene: Scene, fronts: Mapping[str, HandleChoice]) -> tuple[Scene, frozenset[str]]:
    """Returns the scene without the handles that are replaced by what was chosen, and their ids."""
    gone = frozenset(
        member
        for moving, choice in fronts.items()
        if choice.replaces and moving in scene.moving_bodies
        for member in scene.moving_bodies[moving].members
        if member != moving and scene.parts[member].label is PartLabel.HANDLE
    )
    return scene.without_attached(gone), gone


def fit_fronts(
    scene: Scene, config: AdditionConfig, hints: Mapping[str, Vec3], own: Mapping[str, HandleTemplate]
) -> Fronts:
    """Returns the scene with the handles and grips that were chosen front by front.

    Raises:
        TemplateError: if a choice names a handle that there is not.
    """
    done = Fronts(scene)
    for moving, choice in config.fronts.items():
        if moving in scene.moving_bodies and choice.style != NO_HANDLE:
            done = _fitted(done, moving, choice, config, hints, own)
    return done


def _fitted(
    done: Fronts,
    moving: str,
    choice: HandleChoice,
    config: AdditionConfig,
    hints: Mapping[str, Vec3],
    own: Mapping[str, HandleTemplate],
) -> Fronts:
    if choice.style == ANY_GRIP or choice.style in tuple(GripKind):
        return _carved(done, moving, choice, config.grips or GripConfig())
    general = config.handles or HandleConfig()
    sizes = replace(general, count=choice.count, offset=choice.offset, length=choice.length or general.length)
    wanted = replace(sizes, style=choice.style or general.style)
    missing = {moving: Grasp(moving, "none", 1.0, "a handle was chosen")}
    found = add_handles(done.scene, missing, wanted, hints, own)
    chosen = tuple(replace(addition, why="it was chosen") for addition in found.additions)
    skipped = tuple(_not_chosen(refused) for refused in found.refused)
    others = sorted({addition.style for addition in chosen} - {choice.style})
    if choice.style and others:
        why = f"`{choice.style}` finds no room; it got `{'`, `'.join(others)}`"
        skipped += (_not_chosen(Refusal(moving, Reason.OTHER_STYLE, why, Asked.GRASP)),)
    return Fronts(found.scene, (*done.additions, *chosen), done.carved, (*done.skipped, *skipped))


def _carved(done: Fronts, moving: str, choice: HandleChoice, config: GripConfig) -> Fronts:
    if choice.style != ANY_GRIP:
        config = replace(config, kind=GripKind(choice.style))
    made = carve_grip(done.scene, moving, config)
    if isinstance(made, Carved):
        return replace(done, scene=done.scene.replaced([made.part]), carved=(*done.carved, made))
    return replace(done, skipped=(*done.skipped, _not_chosen(made)))


def _not_chosen(refusal: Refusal) -> Refusal:
    return replace(refusal, why=f"what it was to be grasped by: {refusal.why}")
