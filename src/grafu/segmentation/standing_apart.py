"""Which shells of a scene are one group of furniture, and which bodies stand side by side in each.

It asks geometry alone, in metres, Z up. Groups stand apart from each other; bodies of a group touch, lie under one
worktop or stand on one plinth, and may face different ways, as the two wings of a corner kitchen do. Whether shells
touch, their boxes tell: every input is asked this, large ones too.
"""

from dataclasses import replace
from typing import Final, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mask, distinct, without
from grafu.geometry.components import linked
from grafu.geometry.config_checks import require_positive
from grafu.geometry.touching import near_ends
from grafu.segmentation.furniture_pieces import (
    FurnitureConfig,
    Groups,
    SceneShells,
    is_furniture,
    side_by_side,
    with_what_belongs,
    without_room,
)


@final
@dataclass(frozen=True, slots=True)
class ApartConfig:
    """What stands apart in a scene, and what only lies across several bodies. Lengths are metres.

    Raises:
        ValueError: if a number is not above 0.
    """

    gap: float = 0.05
    """As near as this, shells are of one group: a drawer or a door that is drawn loose stays with its case."""
    touch: float = 0.005
    """As near as this, two shells of a group touch."""
    lying: float = 0.15
    """Thickness at most of what lies across several bodies: worktops, and plinths ..."""
    short: float = 0.25
    """... its shorter side at least ..."""
    long: float = 0.6
    """... and its longer: shelves of one body are as small."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, eq=False, slots=True)
class GroupsApart:
    """The groups of furniture in a scene, each as its bodies: the numbers of the shells of each; and what lies alone.

    `room` are its floors and walls.
    """

    groups: tuple[tuple[np.ndarray, ...], ...]
    alone: np.ndarray
    room: np.ndarray


_APART: Final = ApartConfig()


def standing_apart(
    shells: SceneShells, config: ApartConfig = _APART, furniture: FurnitureConfig = FurnitureConfig()
) -> GroupsApart:
    """Returns the groups of furniture in a scene, and the bodies that stand side by side in each.

    Args:
        shells: the shells of the scene.
        config: what stands apart.
        furniture: what is a piece of furniture, and what a floor or a wall.
    """
    touching = without_room(shells, replace(furniture, touch=config.gap), by_boxes=True)
    if not touching:
        return GroupsApart((), np.zeros(0, np.int64), np.arange(len(shells.meshes)))
    found, alone = with_what_belongs(shells, touching, furniture)
    taken = np.concatenate([*found, *alone, np.zeros(0, np.int64)])
    room = without(np.arange(len(shells.meshes)), taken)
    bodies = tuple(tuple(_bodies(shells, group, config, furniture)) for group in found)
    return GroupsApart(bodies, np.concatenate([np.zeros(0, np.int64), *alone]).astype(np.int64), room)


def _bodies(shells: SceneShells, group: np.ndarray, config: ApartConfig, furniture: FurnitureConfig) -> Groups:
    """Returns the bodies of a group: what hangs together without what lies across, cut where two stand side by side."""
    lying = _lies_across(shells, group, config)
    rest = group[~lying]
    parted = _parted(shells, rest, config)
    large = [part for part in parted if is_furniture(shells.box(part), furniture)]
    if not large:
        return [group]
    single = replace(shells, owner=np.arange(len(shells.meshes)))
    bodies = [piece for part in large for piece in side_by_side(single, part, furniture)]
    if len(bodies) == 1:
        return [group]
    others = [part for part in parted if not any(part is one for one in large)]
    others += [np.array([k], dtype=np.int64) for k in group[lying].tolist()]
    return _with_nearest(shells, bodies, others)


def _lies_across(shells: SceneShells, group: np.ndarray, config: ApartConfig) -> Mask:
    size = shells.high[group] - shells.low[group]
    level = np.sort(size[:, :2], axis=1)
    flat: Mask = (size[:, 2] <= config.lying) & (level[:, 0] >= config.short) & (level[:, 1] >= config.long)
    return flat


def _parted(shells: SceneShells, group: np.ndarray, config: ApartConfig) -> Groups:
    """Returns what touches among some shells, in groups."""
    if not len(group):
        return []
    label = linked(len(group), *near_ends(shells.low[group], shells.high[group], config.touch))
    return [group[label == k] for k in distinct(label)]


def _with_nearest(shells: SceneShells, bodies: Groups, others: Groups) -> Groups:
    """Returns the bodies, each with those of the others that are nearest to it; of several that it shares most with."""
    boxes = [shells.box(body) for body in bodies]
    held: dict[int, list[np.ndarray]] = {}
    for other in others:
        box = shells.box(other)
        gaps = [round(one.gap(box), 3) for one in boxes]
        common = [np.maximum(np.minimum(one.high, box.high) - np.maximum(one.low, box.low), 0.0)[:2] for one in boxes]
        host = min(range(len(bodies)), key=lambda k: (gaps[k], -float(np.prod(common[k]))))
        held.setdefault(host, []).append(other)
    return [np.sort(np.concatenate([body, *held.get(k, [])])) for k, body in enumerate(bodies)]
