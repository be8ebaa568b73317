"""`carve_grip`: a recessed grip in a door or drawer front of the final scene, or a reason why there is none.

The new part has the old one's id, box, materials and texture coordinates; it lost what was cut, and the cut shows the
material of the front. Nothing is added outside the old part, so that every motion stays as free as it was.
"""

from collections import Counter
from dataclasses import replace
from typing import final

import numpy as np

from grafu.additions.grip.config import GripConfig, GripKind, GripProfile
from grafu.additions.grip.ground import GripSite, front_part, site_of
from grafu.additions.grip.place import levelled, spots
from grafu.additions.grip.shape import GripCut, cutters, grip_frame, lining, tilted, union
from grafu.additions.likeness import surface_like
from grafu.asset.part import Part, PartSource
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import ArrayValue, Points, Vec3, distinct, freeze_arrays
from grafu.geometry.bodywork import CutOut, cut_out
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.solids import ConvexSolid
from grafu.refusal import Asked, Reason, Refusal
from grafu.scene.front import front_of
from grafu.scene.scene import Scene
from grafu.vocabulary import PartLabel

BOX_TOLERANCE = 1e-6
"""Distance between the corners of boxes that are the same, metres."""


@final
@dataclass(frozen=True, eq=False)
class Carved(ArrayValue):
    """A part with its grip, at rest in the object frame.

    `centre` is the middle of the grip's mouth on the front, `direction` the unit vector along its length, `outward`
    the front's; `size` is its length, width and depth in metres (a through-going one is as deep as the front is
    thick). `volume` and `area` say what was taken away: cubic metres of solids, square metres of surface.
    """

    part: Part
    kind: GripKind
    profile: GripProfile
    centre: Vec3
    direction: Vec3
    outward: Vec3
    size: Vec3
    volume: float
    area: float

    def __post_init__(self) -> None:
        freeze_arrays(self)


def carve_grip(scene: Scene, moving_id: str, config: GripConfig, spot: Vec3 | None = None) -> Carved | Refusal:
    """Returns the moving body's front with a grip, or why it takes none.

    Args:
        scene: the final scene, with hardware and joint motions.
        moving_id: the door or drawer.
        config: what to carve.
        spot: a point of the object frame (metres) near which the grip is wanted; others are tried where it is no good.

    Raises:
        KeyError: if the scene has no such moving body.
    """
    moving = scene.moving_bodies[moving_id]
    if moving_id not in scene.joint_motions:
        return _no_grip(moving_id, Reason.NO_MOTION)
    frame = grip_frame(scene.parts[moving.id].mesh, front_of(scene, moving_id), config)
    part = front_part(scene, moving_id, frame)
    if part.id != moving_id:
        local = Box.around(frame.local(part.mesh.vertices[distinct(part.mesh.faces)]))
        frame = replace(frame, box=local)
    site = site_of(scene, moving_id, frame, part, config.ground)
    reasons: list[tuple[GripKind, Counter[Reason]]] = []
    for kind in config.kinds:
        met: Counter[Reason] = Counter()
        for cut in spots(frame, config, kind, scene, spot):
            found = levelled(site, cut, config)
            made = found if isinstance(found, Reason) else _carved(site, found, config)
            if isinstance(made, Carved):
                return made
            met[made] += 1
        reasons.append((kind, met or Counter({Reason.TOO_SMALL: 1})))
    details = "; ".join(f"{kind}: {', '.join(reason for reason, _ in met.most_common())}" for kind, met in reasons)
    return _no_grip(moving_id, reasons[-1][1].most_common(1)[0][0], details)


def _no_grip(moving_id: str, reason: Reason, details: str = "") -> Refusal:
    return Refusal(moving_id, reason, f"no grip: {reason} ({details})", Asked.GRASP)


def _carved(site: GripSite, cut: GripCut, config: GripConfig) -> Carved | Reason:
    """Returns the part less the grip, unless that would harm it."""
    frame = site.frame
    hulls = [
        ConvexSolid.around(_in_object(site, cut, np.asarray(solid.vertices))) for solid in cutters(cut, config.sizes)
    ]
    solids = [solid for solid in hulls if solid is not None]
    around = union(cut, config.sizes)
    whole = around and TriangleMesh(_in_object(site, cut, np.asarray(around.vertices)), around.faces)
    left = cut_out(site.body, solids, whole)
    expected = cut.size.length * cut.size.width * cut.size.depth
    if cut.kind is GripKind.GROOVE and not cut.is_hollow and left.volume < config.full * expected:
        return Reason.NO_THICKNESS
    surfaces = tuple(s for s in left.surfaces if not s.is_empty)
    if not left.is_whole or not surfaces:
        return Reason.WOULD_BREAK
    part = replace(site.part, surfaces=(*surfaces, *_walls(site, cut, left, config)))
    if not _has_same_box(site.part, part):
        return Reason.WOULD_BREAK
    size = np.array([cut.size.length, cut.size.width, cut.size.depth])
    direction, outward = frame.rotation[:, 0], frame.rotation[:, 2]
    if size[1] > size[0]:
        size, direction = size[[1, 0, 2]], frame.rotation[:, 1]
    middle = np.array([*cut.box.center[:2], cut.face])
    centre = frame.in_object(middle[None])[0]
    return Carved(part, cut.kind, cut.profile, centre, direction, outward, size, left.volume, left.area)


def _walls(site: GripSite, cut: GripCut, left: CutOut, config: GripConfig) -> tuple[Surface, ...]:
    """Returns the faces of the cut in the material of the front that was cut, textured as it is."""
    wall = left.wall
    if cut.is_hollow and cut.size.depth > site.seam:
        lined = lining(cut, config.sizes)
        wall = TriangleMesh(_in_object(site, cut, np.asarray(lined.vertices)), lined.faces)
    if not len(wall.faces):
        return ()
    skin = site.part.surfaces[left.skin]
    like = Part("skin", PartLabel.UNKNOWN, (skin,), PartSource(""))
    return (surface_like(wall, [like], skin.material),)


def _in_object(site: GripSite, cut: GripCut, points: Points) -> Points:
    return site.frame.in_object(tilted(cut, points))


def _has_same_box(before: Part, after: Part) -> bool:
    return bool(
        np.abs(before.box.low - after.box.low).max() < BOX_TOLERANCE
        and np.abs(before.box.high - after.box.high).max() < BOX_TOLERANCE
    )
