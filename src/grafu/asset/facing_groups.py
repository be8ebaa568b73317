"""A scene of furniture that faces several ways, told apart: what faces one way and stands together is a reading.

It settles no frame. Which shells stand apart, `grafu.segmentation.standing_apart` states.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final, final

import numpy as np

from grafu.asset.cutting import is_divided
from grafu.asset.furniture_pieces import parts_of
from grafu.asset.part import Frame, Part
from grafu.asset.reading import Reading
from grafu.asset.standing import front_votes, spelled, vector
from grafu.asset.standing_out import side_with_small_boxes
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Indices
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.segmentation.furniture_pieces import SceneShells
from grafu.segmentation.lids import count_held_fronts
from grafu.segmentation.mesh_shells import axes_from
from grafu.segmentation.standing_apart import GroupsApart, standing_apart


@final
@dataclass(frozen=True, slots=True)
class FacingConfig:
    """When a body of a group faces another way than the others.

    Raises:
        ValueError: if a number is not above 0.
    """

    agree: float = 0.8
    """Fraction of the votes of a body's labelled parts that one side must have to be its front: it is parted from its
    neighbours by that, so this is more than `FrontEvidenceConfig.unanimous`."""
    least: float = 1.0
    """Sum of votes at least: one door or drawer, or two handles."""
    others: float = 0.25
    """How many plates with handles the other three sides show at most (of those of the front)."""
    level: float = 0.06
    """How far the fronts of two bodies may be apart that stand in one row (metres): doors lie before their case."""
    parts: int = 3
    """Shells of a body at least: fewer are no furniture with a door or drawer."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


_DEFAULT: Final = FacingConfig()


@final
@dataclass(frozen=True)
class FacingGroup:
    """Furniture that stands together and faces one way: its parts, and its front where that told it from others."""

    reading: Reading
    front: str | None


@final
@dataclass(frozen=True)
class FurnishedScene:
    """The groups of a scene, and the parts that are floor, wall or prop; both are in the input's coordinates."""

    groups: tuple[FacingGroup, ...]
    others: tuple[Part, ...]


def facing_groups(
    reading: Reading, seen: Reading, frame: Frame, config: FacingConfig = _DEFAULT
) -> FurnishedScene | None:
    """Returns the groups of a scene, the largest first; None where all is one group.

    An object that holds shells of several groups is divided between them, unless it is said to be a door or drawer or
    is a link of a robot: such belongs to the group that has most of its surface.

    Args:
        reading: what was read, with at least one part.
        seen: the same with the labels that may tell: without those that are hidden.
        frame: how it stands as a whole, and its scale.
        config: when bodies of a group face different ways.
    """
    shells = SceneShells.of([part.mesh.transformed(frame.input_to_output) for part in reading.parts])
    apart = standing_apart(shells)
    found: list[tuple[np.ndarray, str | None]] = []
    for bodies in apart.groups:
        found += _facing(seen, shells, frame, bodies, config)
    if not found or (len(found) == 1 and not len(apart.room)):
        return None
    number = _with_whole_objects(seen, shells, [group for group, _ in found], apart)
    groups = [
        (FacingGroup(replace(reading, parts=parts_of(reading, shells, number == k), annotation=None), front), k)
        for k, (_, front) in enumerate(found)
        if (number == k).any()
    ]
    order = sorted(groups, key=lambda pair: -shells.box(np.flatnonzero(number == pair[1])).volume)
    return FurnishedScene(tuple(group for group, _ in order), parts_of(reading, shells, number < 0))


def _facing(
    reading: Reading, shells: SceneShells, frame: Frame, bodies: Sequence[np.ndarray], config: FacingConfig
) -> list[tuple[np.ndarray, str | None]]:
    """Returns the bodies of a group joined where they face one way, each with its front where there are several."""
    whole = np.sort(np.concatenate(bodies))
    if len(bodies) == 1:
        return [(whole, None)]
    fronts = [_shown_front(reading, shells, frame, body, config) for body in bodies]
    known = list(dict.fromkeys(front for front in fronts if front is not None))
    if len(known) < 2:
        return [(whole, None)]
    boxes = [shells.box(body) for body in bodies]
    for k, front in enumerate(fronts):
        if front is None:
            fronts[k] = _front_of_row(k, boxes, fronts, frame, config)
    joined = ((front, [body for body, own in zip(bodies, fronts, strict=True) if own == front]) for front in known)
    return [(np.sort(np.concatenate(held)), front) for front, held in joined]


def _shown_front(
    reading: Reading, shells: SceneShells, frame: Frame, body: np.ndarray, config: FacingConfig
) -> str | None:
    """Returns the front that a body's doors, drawers and handles show, in the input's coordinates; else None."""
    if len(body) < config.parts:
        return None
    chosen = np.isin(np.arange(len(shells.meshes)), body)
    parts = parts_of(reading, shells, chosen)
    whole = Box.enclosing(part.box for part in parts)
    votes = front_votes(parts, whole, frame.up)
    total, best = sum(votes.values()), max(votes, key=lambda side: votes[side])
    if total >= config.least and votes[best] >= config.agree * total:
        return best
    if is_divided(reading):
        return None  # its maker named or linked what moves: small parts beside it are no handles
    meshes = [shells.meshes[k] for k in body.tolist()]
    T = np.asarray(frame.input_to_output)[:3, :3]
    own = Box.enclosing(mesh.box for mesh in meshes)
    side = side_with_small_boxes([mesh.box for mesh in meshes], merge_meshes(meshes), own, "+Z")
    side = side or _side_of_held_fronts(meshes, config)
    if side is None:
        return None
    towards = T.T @ vector(side)
    axis = int(np.argmax(np.abs(towards)))
    return spelled(axis, bool(towards[axis] > 0))


def _side_of_held_fronts(meshes: Sequence[TriangleMesh], config: FacingConfig) -> str | None:
    """Returns the side, in the object frame, to which nearly all plates with handles face; None where none does."""
    counts = [count_held_fronts(meshes, axes=axes_from(turn)) for turn in range(4)]
    best = int(np.argmax(counts))
    is_clear = counts[best] >= 1 and sum(counts) - counts[best] <= config.others * counts[best]
    towards = axes_from(best)[2]
    axis = int(np.argmax(np.abs(towards)))
    return spelled(axis, bool(towards[axis] > 0)) if is_clear else None


def _front_of_row(
    k: int, boxes: Sequence[Box], fronts: Sequence[str | None], frame: Frame, config: FacingConfig
) -> str | None:
    """Returns the front of the body beside which another one stands in one row, or else of the one nearest to it."""

    def distance(other: int) -> tuple[bool, float, float]:
        towards = np.asarray(frame.input_to_output)[:3, :3] @ vector(str(fronts[other]))
        axis = int(np.argmax(np.abs(towards)))
        ends = (boxes[k].high, boxes[other].high) if towards[axis] > 0 else (boxes[k].low, boxes[other].low)
        is_level = abs(float(ends[0][axis] - ends[1][axis])) <= config.level
        return not is_level, boxes[k].gap(boxes[other]), -boxes[other].volume

    return fronts[min((other for other, front in enumerate(fronts) if front is not None), key=distance)]


def _with_whole_objects(
    reading: Reading, shells: SceneShells, groups: Sequence[np.ndarray], apart: GroupsApart
) -> Indices:
    """Returns the number of the group of each shell, -1 for none, where objects that move as one are of one group."""
    number = np.full(len(shells.meshes), -1, dtype=np.int64)
    for k, group in enumerate(groups):
        number[group] = k
    areas = np.array([mesh.area for mesh in shells.meshes])
    for k, part in enumerate(reading.parts):
        own = np.flatnonzero(shells.owner == k)
        found = number[own]
        if len(set(found.tolist())) < 2:
            continue
        is_one = part.label.is_movable or bool(part.source.link) or part.carried_by is not None
        held = found >= 0
        most = int(np.argmax(np.bincount(found[held], areas[own][held])))
        if is_one:
            number[own] = most
        else:
            number[np.intersect1d(own[~held], apart.alone)] = most
    return number
