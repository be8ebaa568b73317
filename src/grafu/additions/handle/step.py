"""The steps of doors and drawers: handles and grips where nothing can be grasped, and what was chosen front by front.

A front that cannot be grasped gets a handle, and where none fits a grip. It decides nothing about sizes and places.
"""

from collections.abc import Mapping
from dataclasses import field, replace
from typing import final

from grafu.additions.grip.carve import Carved, carve_grip
from grafu.additions.grip.config import GripConfig, GripKind
from grafu.additions.handle.config import ANY_GRIP, NO_HANDLE, HandleChoice, HandleConfig
from grafu.additions.handle.grasp import find_grasps
from grafu.additions.handle.grasp_config import GraspConfig
from grafu.additions.handle.place import add_handles, bodies_without
from grafu.additions.handle.relief import Reliefs
from grafu.additions.step import Changes, Grasp, StepRequest, StepResult
from grafu.dataclass import dataclass
from grafu.joints.plan import MotionRole
from grafu.refusal import Asked, Reason, Refusal
from grafu.scene.scene import Scene
from grafu.visible import ShortRepr
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True)
class FrontConfig(ShortRepr):
    """What fronts are grasped by (None: no handles, no grips), what counts as a grasp, and by front what was chosen."""

    handles: HandleConfig | None = field(default_factory=HandleConfig)
    grips: GripConfig | None = field(default_factory=GripConfig)
    grasp: GraspConfig = GraspConfig()
    fronts: Mapping[str, HandleChoice] = field(default_factory=dict)


def clear_fronts(scene: Scene, _: StepRequest, config: FrontConfig) -> StepResult:
    """Returns the scene without the handles that are replaced by what was chosen."""
    gone = frozenset(
        member
        for moving, choice in config.fronts.items()
        if choice.replaces and moving in scene.moving_bodies
        for member in scene.moving_bodies[moving].members
        if member != moving and scene.parts[member].label is PartLabel.HANDLE
    )
    return StepResult(scene.without_parts(gone), changes=Changes(gone))


def add_grasps(scene: Scene, request: StepRequest, config: FrontConfig) -> StepResult:
    """Returns the scene with handles, else grips, on what cannot be grasped, and how all could be grasped before.

    Fronts for which something was chosen are left alone, and with `only_expected` those for which nothing is expected.

    Raises:
        TemplateError: if the config names a handle that there is not.
    """
    reliefs = Reliefs(scene, config.grasp.relief)
    grasps = find_grasps(scene, config.grasp, reliefs) | _supports(scene, request)
    free = {moving: grasp for moving, grasp in grasps.items() if _may_get_one(moving, request, config)}
    made = StepResult(scene, grasps=grasps)
    wanting: dict[str, Refusal | None] = {}
    if config.handles is not None:
        found = add_handles(scene, free, config.handles, request.handles, request.own_handles, reliefs)
        made = replace(made, scene=found.scene, additions=found.additions).without(request.rejected, scene)
        wanting = {refused.part: refused for refused in found.refused}
    elif config.grips is not None:
        wanting = dict.fromkeys(bodies_without(scene, free))
    return made.then(_gripped(made.scene, wanting, config.grips))


def _may_get_one(moving: str, request: StepRequest, config: FrontConfig) -> bool:
    return moving not in config.fronts and (moving in request.handles or not request.only_expected)


def _supports(scene: Scene, request: StepRequest) -> dict[str, Grasp]:
    """Returns how what carries a raised leaf is grasped: a hand below the leaf pulls it out by its free end."""
    supports = [r.moving for r in request.plan.joints if r.role is MotionRole.SUPPORT]
    boxes = {moving: scene.parts[moving].box for moving in supports if moving in scene.moving_bodies}
    why = "what carries a raised leaf is pulled out by its end"
    return {name: Grasp(name, "edge", 1.0, why, box.center, float(box.size.min())) for name, box in boxes.items()}


def _gripped(scene: Scene, wanting: Mapping[str, Refusal | None], config: GripConfig | None) -> StepResult:
    """Returns the scene with grips in fronts for which there is no handle, and the refusals of the others."""
    carved: list[Carved] = []
    failed: list[Refusal] = []
    for moving, no_handle in wanting.items():
        made = None if config is None else carve_grip(scene, moving, config)
        if isinstance(made, Carved):
            carved.append(made)
        else:
            failed.append(_no_grasp(*(one for one in (no_handle, made) if one is not None)))
    new = scene.replaced(one.part for one in carved)
    return StepResult(new, changes=Changes(carved=tuple(carved)), refusals=tuple(failed))


def _no_grasp(first: Refusal, *others: Refusal) -> Refusal:
    """Returns several refusals of one front as one, with the reason of the first."""
    said = "; ".join((first.why, *(other.why for other in others)))
    return replace(first, why=f"nothing to grasp it by: {said}")


def add_chosen(scene: Scene, request: StepRequest, config: FrontConfig) -> StepResult:
    """Returns the scene with the handles and grips that were chosen front by front.

    Raises:
        TemplateError: if a choice names a handle that there is not.
    """
    done = StepResult(scene)
    for moving, choice in config.fronts.items():
        if choice.style == NO_HANDLE:
            continue
        if moving in scene.moving_bodies:
            done = done.then(_fitted(done.scene, moving, choice, request, config))
        else:
            still = Refusal(moving, Reason.UNSUITABLE, "it does not move", Asked.GRASP)
            done = done.then(StepResult(done.scene, refusals=(_not_chosen(still),)))
    return done


def _fitted(scene: Scene, moving: str, choice: HandleChoice, request: StepRequest, config: FrontConfig) -> StepResult:
    if choice.style == ANY_GRIP or choice.style in tuple(GripKind):
        return _carved(scene, moving, choice, config.grips or GripConfig())
    general = config.handles or HandleConfig()
    sizes = replace(general, count=choice.count, offset=choice.offset, length=choice.length or general.length)
    wanted = replace(sizes, style=choice.style or general.style)
    missing = {moving: Grasp(moving, "none", 1.0, "a handle was chosen")}
    reliefs = Reliefs(scene, config.grasp.relief)
    found = add_handles(scene, missing, wanted, request.handles, request.own_handles, reliefs)
    chosen = tuple(replace(addition, why="it was chosen") for addition in found.additions)
    refusals = tuple(_not_chosen(refused) for refused in found.refused)
    others = sorted({addition.style for addition in chosen} - {choice.style})
    if choice.style and others:
        why = f"`{choice.style}` finds no room; it got `{'`, `'.join(others)}`"
        refusals += (_not_chosen(Refusal(moving, Reason.OTHER_STYLE, why, Asked.GRASP)),)
    return StepResult(found.scene, chosen, refusals=refusals)


def _carved(scene: Scene, moving: str, choice: HandleChoice, config: GripConfig) -> StepResult:
    config = replace(
        config,
        kind=config.kind if choice.style == ANY_GRIP else GripKind(choice.style),
        profile=choice.profile or config.profile,
        sizes=config.sizes.with_lengths(choice.length, choice.width, choice.depth),
    )
    made = carve_grip(scene, moving, config)
    if isinstance(made, Carved):
        return StepResult(scene.replaced([made.part]), changes=Changes(carved=(made,)))
    return StepResult(scene, refusals=(_not_chosen(made),))


def _not_chosen(refusal: Refusal) -> Refusal:
    return replace(refusal, why=f"what it was to be grasped by: {refusal.why}")
