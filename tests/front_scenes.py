"""Scenes of synthetic furniture in which every part moves by its own true joint: no hinges, no rails.

Drawers wait for the doors that stand before them.
"""

from dataclasses import replace

import numpy as np

from grafu.asset.part import AnnotatedJoint, Asset, Part
from grafu.geometry.box import Box
from grafu.scene.scene import JointMotion, MovingBody, Scene
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Layout
from grafu.vocabulary import JointType, PartLabel


def scene_of(asset: Asset) -> Scene:
    attached = {j.part: tuple(p.id for p in asset.parts if p.carried_by == j.part) for j in asset.joints}
    moving_bodies = {part: MovingBody(part, (part, *ids)) for part, ids in attached.items()}
    joint_motions = {j.part: JointMotion(j.axis, j.type, j.upper, after=doors_before(asset, j)) for j in asset.joints}
    return Scene({p.id: p for p in asset.parts}, moving_bodies, asset.extent, joint_motions=joint_motions)


def doors_before(asset: Asset, joint: AnnotatedJoint) -> tuple[str, ...]:
    """The doors whose box a drawer runs into when it comes out by 0.2 m or as far as it goes."""
    if joint.type is not JointType.PRISMATIC:
        return ()
    path = asset.part(joint.part).box
    path = path.union(Box.around(path.corners() + min(joint.upper, 0.2) * joint.axis.direction))
    doors = (j.part for j in asset.joints if j.type is JointType.REVOLUTE)
    return tuple(door for door in doors if (path.axis_gaps(asset.part(door).box) < -1e-3).all())


def cabinet(layout: Layout, width: float = 0.6, **sizes) -> Asset:
    return make_cabinet(Cabinet("cabinet", Case(width=width), layout, **sizes))


def without_handles(asset: Asset) -> Asset:
    return replace(asset, parts=tuple(p for p in asset.parts if p.label is not PartLabel.HANDLE))


def with_handles_in_their_fronts(asset: Asset) -> Asset:
    """The same with every handle a piece of the front that carries it."""
    handles = [p for p in asset.parts if p.label is PartLabel.HANDLE]
    more = {name: tuple(s for h in handles if h.carried_by == name for s in h.surfaces) for name in ids(asset)}
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
