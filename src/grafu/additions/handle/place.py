"""Adds handles to doors and drawers that cannot be grasped: chosen, sized, set flush, clear through all motions.

A handle that finds no place is refused with a reason; nothing that can be grasped gets another one.
"""

from collections.abc import Iterable, Iterator, Mapping
from typing import final

from grafu.additions.handle.config import HandleConfig
from grafu.additions.handle.fit import HandleObstacles, HandleShape, fitted, ground_of, handle_obstacles
from grafu.additions.handle.grasp_config import ReliefConfig
from grafu.additions.handle.relief import Relief, Reliefs
from grafu.additions.handle.spots import Extent, Spot, spots_on
from grafu.additions.handle.style import HandleStyle, Sibling, choose_style, named_template, siblings_of
from grafu.additions.likeness import surface_like
from grafu.additions.step import Addition, Grasp, added_part, free_ids
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mat4, Vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.refusal import Asked, Reason, Refusal
from grafu.scene.scene import Scene
from grafu.templates.template import HandleTemplate
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True, eq=False)
class Handles:
    """The handles that were added, the moving bodies that got none, and the scene with the handles attached."""

    additions: tuple[Addition, ...]
    refused: tuple[Refusal, ...]
    scene: Scene


def add_handles(
    scene: Scene,
    grasps: Mapping[str, Grasp],
    config: HandleConfig = HandleConfig(),
    hints: Mapping[str, Vec3] | None = None,
    own: Mapping[str, HandleTemplate] | None = None,
    reliefs: Reliefs | None = None,
) -> Handles:
    """Returns handles for the moving bodies of a scene that cannot be grasped.

    Args:
        scene: the final scene, with the motion of every moving body.
        grasps: how each moving body can be grasped; those left out are not looked at.
        config: style, sizes, places.
        hints: by moving body, where a handle was predicted (object frame): taken where it is clear and sensible.
        own: the user's handle templates by id, see `grafu.templates.user`.
        reliefs: those of the scene, if they exist already.

    Raises:
        TemplateError: if the config names a style that there is not.
    """
    wanting = bodies_without(scene, grasps, config)
    if not wanting:
        return Handles((), (), scene)
    siblings = siblings_of(scene)
    reliefs = reliefs or Reliefs(scene, ReliefConfig())
    style = choose_style([reliefs.of(m).front for m in wanting], siblings, scene.metre, config, own or {})
    task = _Task(style, siblings, config, hints or {}, reliefs)
    obstacles = handle_obstacles(scene)
    additions: list[Addition] = []
    refused: list[Refusal] = []
    for moving in wanting:
        found = _handles_for(scene, moving, obstacles, task)
        if isinstance(found, Refusal):
            refused.append(found)
            continue
        additions += found
        for addition in found:
            obstacles = obstacles.with_handle(moving, addition.part.mesh)
        scene = scene.with_parts(addition.part for addition in found)
    return Handles(tuple(additions), tuple(refused), scene)


def bodies_without(scene: Scene, grasps: Mapping[str, Grasp], config: HandleConfig = HandleConfig()) -> tuple[str, ...]:
    """Returns the moving bodies that need a handle: without a grasp, or with only an edge while others have handles."""
    shown = [g for moving, g in grasps.items() if moving in scene.moving_bodies]
    has_handles = any(g.kind in ("handle", "none") for g in shown)
    weak = {g.moving for g in shown if g.kind == "edge" and g.confidence < config.weak and has_handles}
    return tuple(g.moving for g in shown if g.kind == "none" or g.moving in weak)


@final
@dataclass(frozen=True, eq=False)
class _Task:
    """What all handles of one model have in common."""

    style: HandleStyle
    siblings: tuple[Sibling, ...]
    config: HandleConfig
    hints: Mapping[str, Vec3]
    reliefs: Reliefs


def _handles_for(scene: Scene, moving: str, obstacles: HandleObstacles, task: _Task) -> tuple[Addition, ...] | Refusal:
    """Returns the handle of one moving body, two on a wide drawer, or why there is none."""
    relief = task.reliefs.of(moving)
    ground = ground_of(scene, moving, relief)
    met, tried, blocked = "", False, 0
    for template, length, protrusion in _sizes(task.style, relief, task.config):
        shape = HandleShape(template.build(length, protrusion), task.config.foot_depth)
        spots = spots_on(relief, _extent(template, shape), task.siblings, task.hints.get(moving), task.config)
        for spot in _few(spots, task.config.trials.most_spots):
            tried = True
            poses = [fitted(ground, shape, spot, place, task.config) for place in spot.places]
            if any(pose is None for pose in poses):
                continue
            placed = [shape.mesh.transformed(pose) for pose in poses if pose is not None]
            met = next((b for mesh in placed if (b := obstacles.blocker(moving, mesh, task.config))), "")
            if not met:
                kept = [pose for pose in poses if pose is not None]
                return _additions(scene, moving, template, shape, kept, spot, task)
            blocked += 1
            if blocked >= task.config.trials.most_blocked:
                return _blocked(moving, met)
    if not tried:
        return Refusal(moving, Reason.TOO_SMALL, "its front is smaller than the smallest handle", Asked.GRASP)
    if not met:
        return Refusal(moving, Reason.NO_GROUND, "its front has no even, solid place for a handle's foot", Asked.GRASP)
    return _blocked(moving, met)


def _blocked(moving: str, met: str) -> Refusal:
    return Refusal(moving, Reason.IN_THE_WAY, f"wherever a handle sits, {met} is in the way", Asked.GRASP)


def _few(spots: Iterable[Spot], most: int) -> Iterator[Spot]:
    """Yields so many different spots at most."""
    seen: set[tuple[object, ...]] = set()
    for spot in spots:
        key = (spot.above, tuple((round(u, 4), round(v, 4)) for u, v in spot.places))
        if key in seen:
            continue
        if len(seen) >= most:
            return
        seen.add(key)
        yield spot


def _sizes(style: HandleStyle, relief: Relief, config: HandleConfig) -> Iterator[tuple[HandleTemplate, float, float]]:
    """Yields templates with lengths and protrusions to try, metres, best first."""
    s, box = relief.factor, relief.outline
    held = relief.front.held
    side = float(box.size[2] if held in ("left", "right") and style.template.turns else box.size[0])
    most = config.most * side
    seen = set()
    for flat in config.trials.protrusions:
        for ratio in config.trials.lengths:
            length = min(ratio * style.length, most)
            scale = length / style.length if style.template.family == "knob" else 1.0
            size = (style.template, length, flat * scale * style.protrusion)
            if length >= s * config.least and size[1:] not in seen:
                seen.add(size[1:])
                yield size
    for name, ratio, out in config.trials.spare:
        template = named_template(name, {})
        length = min(ratio * s * template.natural.length, most)
        if length >= s * config.least:
            yield template, length, out * s * template.natural.protrusion


def _extent(template: HandleTemplate, shape: HandleShape) -> Extent:
    size = shape.mesh.box.size
    return Extent(float(size[0]), float(size[2]), template.turns, template.id == "bar-profile")


def _additions(
    scene: Scene, moving: str, template: HandleTemplate, shape: HandleShape, poses: list[Mat4], spot: Spot, task: _Task
) -> tuple[Addition, ...]:
    names = free_ids(f"handle_{moving}", len(poses), scene.parts)
    found = []
    for name, pose in zip(names, poses, strict=True):
        surfaces = [_surface(mesh.transformed(pose), task.style) for mesh in shape.meshes]
        part = added_part(name, PartLabel.HANDLE, surfaces, moving)
        found.append(Addition(part, f"it could not be grasped: {spot.why}", template.id))
    return tuple(found)


def _surface(mesh: TriangleMesh, style: HandleStyle) -> Surface:
    return surface_like(mesh, style.alike, style.finish)
