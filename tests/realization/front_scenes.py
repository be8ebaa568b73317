"""Scenes of made furniture in which every part moves by its own true joint: no hinges, no rails."""

from dataclasses import replace

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.realization.scene import Mover, Scene, Way
from grafu.synth.cabinet import Cabinet, make_cabinet
from grafu.synth.case import Case
from grafu.synth.layout import Layout
from grafu.vocabulary import PartLabel


def scene_of(asset: Asset) -> Scene:
    riders = {j.part: tuple(p.id for p in asset.parts if p.rides_on == j.part) for j in asset.joints}
    movers = {part: Mover(part, (part, *ids)) for part, ids in riders.items()}
    ways = {j.part: Way(j.axis, j.type, j.upper) for j in asset.joints}
    return Scene({p.id: p for p in asset.parts}, movers, asset.unit, ways=ways)


def cabinet(layout: Layout, width: float = 0.6, **sizes) -> Asset:
    return make_cabinet(Cabinet("cabinet", Case(width=width), layout, **sizes))


def without_handles(asset: Asset) -> Asset:
    return replace(asset, parts=tuple(p for p in asset.parts if p.label is not PartLabel.HANDLE))


def with_handles_in_their_fronts(asset: Asset) -> Asset:
    """The same with every handle a piece of the front that carries it."""
    handles = [p for p in asset.parts if p.label is PartLabel.HANDLE]
    more = {name: tuple(s for h in handles if h.rides_on == name for s in h.surfaces) for name in ids(asset)}
    parts = (replace(p, surfaces=(*p.surfaces, *more[p.id])) for p in asset.parts if p not in handles)
    return replace(asset, parts=tuple(parts))


def scaled(asset: Asset, factor: float) -> Asset:
    S = np.diag([factor, factor, factor, 1.0])
    parts = tuple(replace(p, surfaces=tuple(s.transformed(S) for s in p.surfaces)) for p in asset.parts)
    joints = tuple(
        replace(j, axis=j.axis.transformed(S), upper=j.upper * (factor if j.type == "prismatic" else 1.0))
        for j in asset.joints
    )
    return replace(asset, parts=parts, joints=joints)


def ids(asset: Asset) -> list[str]:
    return [p.id for p in asset.parts]


def with_parts(asset: Asset, *parts: Part) -> Asset:
    return replace(asset, parts=(*asset.parts, *parts))
