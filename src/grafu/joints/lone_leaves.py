"""Doors of buildings that are drawn without a frame: one leaf with its panes, handles and locks, and nothing else."""

from collections.abc import Sequence

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.geometry.box import Box
from grafu.joints.building_doors import BuildingDoorConfig, hinged_side, is_on_leaf
from grafu.joints.framed_leaves import turning_leaf
from grafu.joints.plan import RealizationPlan
from grafu.vocabulary import PartLabel

_DEPTH, _UP = 1, 2


def lone_leaf_of(parts: Sequence[Part], config: BuildingDoorConfig = BuildingDoorConfig()) -> Part | None:
    """Returns the leaf of a door that is drawn alone; None where a part stands beside it, or it has no door's size.

    It is called a door, the largest one: a board of other furniture may have any size.
    """
    doors = [part for part in parts if part.label is PartLabel.DOOR]
    if not doors:
        return None
    leaf = max(doors, key=lambda part: float(np.prod(np.sort(part.box.size)[1:])))
    whole = Box.enclosing(part.box for part in parts)
    is_door = leaf.box.thin_axis == _DEPTH and leaf.box.size[_UP] >= max(config.tall, config.high * whole.size[_UP])
    others = [part for part in parts if part is not leaf]
    return leaf if is_door and all(is_on_leaf(part, leaf, config) for part in others) else None


def with_lone_leaf(
    plan: RealizationPlan, asset: Asset, config: BuildingDoorConfig = BuildingDoorConfig()
) -> RealizationPlan:
    """Returns the plan in which a leaf that stands alone turns, with all that is on it, about the side of no handle.

    The frame that carries it is an addition. Any other plan stays as it is, and so does a leaf that it moves.
    """
    leaf = lone_leaf_of(asset.parts, config)
    if leaf is None or plan.joints:
        return plan
    on_it = [part for part in asset.parts if part is not leaf]
    side = hinged_side(leaf, (leaf,), on_it, config)
    request = turning_leaf(leaf, on_it, asset, side, opens_backwards=False)
    parts = {part.id for part in asset.parts}
    return RealizationPlan((request,), tuple(r for r in plan.refused if r.part not in parts))
