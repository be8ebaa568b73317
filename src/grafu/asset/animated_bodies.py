"""Nodes of a scene that its animations move, as bodies with the motion that such a move is: a turn or a slide.

Coordinates are those of the scene. What lies below such a node, and below no other, moves with it. An animation that
moves the whole piece, or only a little, states no motion of a part; one that is neither a turn about a fixed axis nor
a slide along a line is left out, with a note.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from math import pi, radians
from types import MappingProxyType
from typing import Final, final

import numpy as np

from grafu.articulation.motion_kind import MotionKind, kind_named
from grafu.asset.bodies import Body, BodyVisual, StatedMotion
from grafu.asset.scene_nodes import SceneNode, telling_name, with_split_meshes_whole
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4, Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive
from grafu.geometry.transform import invert

_BASE: Final = "scene"  # the body of what no animation moves


@final
@dataclass(frozen=True, slots=True)
class AnimatedMotionConfig:
    """Which motion an animation states.

    Raises:
        ValueError: if a number is not above 0.
    """

    turn: float = radians(3.0)
    """What turns less is not moved (radians) ..."""
    slide: float = 0.01
    """... nor what slides less (fraction of the diagonal of all)."""
    off: float = 0.02
    """How far a move may be off a turn about an axis, or off a line (fraction of the diagonal of all): keys are
    rounded, and set by hand."""
    askew: float = radians(5.0)
    """How far the axis of one key may be askew to that of the widest turn (radians) ..."""
    clear: float = radians(10.0)
    """... where the key turns so far that its axis is clear (radians)."""
    whole: float = 0.9
    """What fills more of the box around all is the whole piece, on a turntable (fraction)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


def animated_bodies(
    nodes: Sequence[SceneNode],
    moves: Mapping[int, Sequence[Sequence[Mat4]]],
    file: str,
    names: Mapping[int, str] = MappingProxyType({}),
    config: AnimatedMotionConfig = AnimatedMotionConfig(),
) -> tuple[list[Body], list[str]]:
    """Returns the bodies of a scene, and notes on animations that are left out.

    Args:
        nodes: each shape, in the coordinates of the scene.
        moves: by the number of a node, for each animation where it takes the node at each key: a rigid motion in the
            coordinates of the scene, relative to where the node is drawn, all that is above it at rest.
        file: the name of the file.
        names: of nodes, by number, that stand for what is called otherwise.
        config: which motion an animation states.
    """
    if not nodes:
        return [], []
    whole = _box(nodes)
    motions: dict[int, StatedMotion] = {}
    notes = []
    for number, runs in moves.items():
        below = [node for node in nodes if any(number == above for above, _ in node.chain)]
        if not below or not _is_moved(runs, whole, config) or _is_whole(below, nodes, whole, config):
            continue
        motion = _motion(runs, whole, config)
        if motion is None:
            name = next(name for above, name in below[0].chain if above == number)
            notes.append(f"the animation of {name} is neither a turn about an axis nor a slide, and is not read")
        else:
            motions[number] = motion
    return _bodies(nodes, motions, file, names), notes


def _bodies(
    nodes: Sequence[SceneNode], motions: Mapping[int, StatedMotion], file: str, called: Mapping[int, str]
) -> list[Body]:
    """Returns a body for each node that moves, and one for all that does not."""
    of: dict[int | None, list[SceneNode]] = {None: []} | {number: [] for number in motions}
    above: dict[int, int | None] = {}
    names: dict[int, str] = {}
    for node in nodes:
        carriers = [(number, name) for number, name in node.chain if number in motions]
        for k, (number, name) in enumerate(carriers):
            above[number], names[number] = (
                (carriers[k - 1][0] if k else None),
                called.get(number) or name or f"node_{number}",
            )
        start = next((k for k, (number, _) in enumerate(node.chain) if carriers and number == carriers[-1][0]), 0)
        of[carriers[-1][0] if carriers else None].append(replace(node, chain=node.chain[start:]))
    links = {number: f"node {number}" for number in motions}
    found = [Body(_BASE, _BASE, _visuals(of[None], _BASE, file))]
    for number, motion in motions.items():
        parent = above[number]
        link = links[number]
        visuals = _visuals(of[number], link, file)
        found.append(Body(names[number], link, visuals, motion, None if parent is None else links[parent]))
    return found


def _visuals(nodes: list[SceneNode], link: str, file: str) -> tuple[BodyVisual, ...]:
    return tuple(BodyVisual(telling_name(node), node.surfaces, link, file) for node in with_split_meshes_whole(nodes))


def _is_moved(runs: Iterable[Sequence[Mat4]], whole: Box, config: AnimatedMotionConfig) -> bool:
    middle, least = whole.center, config.slide * whole.diagonal
    return any(
        _angle(T) >= config.turn or float(np.linalg.norm(T[:3, :3] @ middle + T[:3, 3] - middle)) >= least
        for run in runs
        for T in run
    )


def _is_whole(below: Sequence[SceneNode], nodes: Sequence[SceneNode], whole: Box, config: AnimatedMotionConfig) -> bool:
    return len(below) == len(nodes) or bool(np.prod(_box(below).size) > config.whole * np.prod(whole.size))


def _motion(runs: Sequence[Sequence[Mat4]], whole: Box, config: AnimatedMotionConfig) -> StatedMotion | None:
    """Returns the turn or slide that all runs of animations are; None: they are neither."""
    keys = [T for run in runs for T in run]
    if max(float(np.abs(T[:3, :3] @ T[:3, :3].T - np.eye(3)).max()) for T in keys) > config.off:
        return None  # stretched by the nodes above
    widest = max(keys, key=_angle)
    if _angle(widest) < config.turn:
        return _slide(keys, whole, config)
    return _turn(runs, widest, whole, config)


def _slide(keys: Sequence[Mat4], whole: Box, config: AnimatedMotionConfig) -> StatedMotion | None:
    shifts = np.array([T[:3, 3] for T in keys])
    farthest = shifts[int(np.argmax(np.linalg.norm(shifts, axis=1)))]
    direction = farthest / np.linalg.norm(farthest)
    values = shifts @ direction
    if np.linalg.norm(shifts - values[:, None] * direction, axis=1).max() > config.off * whole.diagonal:
        return None
    return StatedMotion(
        _kind("linear").type, Axis(whole.center, direction), min(0.0, float(values.min())), float(values.max())
    )


def _turn(
    runs: Sequence[Sequence[Mat4]], widest: Mat4, whole: Box, config: AnimatedMotionConfig
) -> StatedMotion | None:
    direction = _axis_of(widest)
    point = _fixed_point(widest, direction)
    values = [0.0]
    for run in runs:
        angles = np.unwrap([0.0, *(_angle_about(T, direction) for T in run)])
        values += angles.tolist()
        for T in run:
            is_askew = _angle(T) >= config.clear and abs(float(_axis_of(T) @ direction)) < np.cos(config.askew)
            if is_askew or np.linalg.norm(T[:3, :3] @ point + T[:3, 3] - point) > config.off * whole.diagonal:
                return None
    lower, upper = min(values), max(values)
    is_limited = upper - lower < 2 * pi - config.turn
    return StatedMotion(_kind("angular").type, Axis(point, direction), lower, upper, is_limited)


def _angle(T: Mat4) -> float:
    return float(np.arccos(np.clip((np.trace(T[:3, :3]) - 1.0) / 2.0, -1.0, 1.0)))


def _axis_of(T: Mat4) -> Vec3:
    """Returns the unit axis of a turn: that vector which it leaves, in the sense of the right-hand rule."""
    R = T[:3, :3]
    v = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    if np.linalg.norm(v) < 1e-6:  # a half turn: R + I is twice the projection on the axis
        columns = R + np.eye(3)
        v = columns[:, int(np.argmax(np.linalg.norm(columns, axis=0)))]
    return np.asarray(v / np.linalg.norm(v))


def _angle_about(T: Mat4, direction: Vec3) -> float:
    """Returns by how much T turns about a direction, -pi..pi."""
    angle = _angle(T)
    return angle if angle < 1e-9 or float(_axis_of(T) @ direction) > 0 else -angle


def _fixed_point(T: Mat4, direction: Vec3) -> Vec3:
    """Returns the point of the axis of a turn that is nearest to the origin, its shift along the axis left out."""
    shift = T[:3, 3] - direction * float(T[:3, 3] @ direction)
    half = _angle(T) / 2
    return 0.5 * (shift + np.cross(direction, shift) / np.tan(half))


def _kind(drive: str) -> MotionKind:
    kind = kind_named("usd drive", drive)
    assert kind is not None, "the table of motion kinds has both"
    return kind


def in_scene(T_scene_above: Mat4, local: Mat4) -> Mat4:
    """Returns a motion of a node in the coordinates of the node above it as one in those of the scene.

    What scales the node above must scale all axes alike: other motions are no rigid ones.
    """
    return np.asarray(T_scene_above @ local @ invert(T_scene_above))


def _box(nodes: Iterable[SceneNode]) -> Box:
    return Box.enclosing([s.mesh.box for node in nodes for s in node.surfaces if not s.is_empty])
