"""Places concealed hinges: cups on the door's inner face, plates on the inner face of the case's side behind it.

The joint is one revolute axis, as near to the linkage's motion as the case and the neighbours allow; the door must be
free about it, and on the true path on which the linkage leads it. Where the side is not met, or the arm finds no room,
there are no such hinges.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Visual, VisualRole
from grafu.articulation.slip import Slip
from grafu.articulation.swing import Swing
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mat4, vec3
from grafu.geometry.swept_body import SweptBody
from grafu.geometry.transform import translation
from grafu.joints.concealed_config import ConcealedConfig
from grafu.joints.hinge.candidates import PinCandidate, heights_to_try
from grafu.joints.hinge.hardware import HingeSite, InstalledHinge, judged_hinge
from grafu.joints.hinge.search import DoorSearch
from grafu.joints.hinge.sites import placement_of, site_of
from grafu.joints.limits import in_the_way, is_free, swept_box
from grafu.joints.plan import CUP
from grafu.joints.report import Placement
from grafu.scene.obstacles import Obstacles
from grafu.templates.concealed import ConcealedHinge, ConcealedModel, axis_at
from grafu.templates.template import Gallery
from grafu.vocabulary import PartLabel


def place_concealed(search: DoorSearch, gallery: Gallery) -> Placement | None:
    """Returns a door on concealed hinges, about the first axis that leaves it free; None where they find no room."""
    if not gallery.concealed:
        return None
    model, clear = gallery.concealed[0], (judged for judged in search.concealed if judged.is_clear)
    for judged in clear:
        upper = search.widest(judged.axis, min(model.range, search.most))
        if upper < search.config.restricted * search.wanted:
            continue
        site = site_of(judged, upper, search)
        door = ConcealedDoor(model, judged.pin, site, search.neighbours, search.config.hinge.concealed)
        hinges = door.installed(search.count)
        if hinges and door.is_free():
            return replace(placement_of(judged, CUP, upper, hinges, search), slip=door.slip)
    return None


@final
@dataclass(frozen=True, eq=False)
class ConcealedDoor:
    """One door on concealed hinges: their model, the axis of its joint, and what they are tested against.

    `others` are the other moving bodies, at rest.
    """

    model: ConcealedModel
    pin: PinCandidate
    site: HingeSite
    others: Obstacles
    config: ConcealedConfig

    @property
    def slip(self) -> Slip:
        """What the door does beside the joint's motion, object frame."""
        frame, hinge = self.site.frame, self.model.natural
        beside = hinge.slips((self.pin.x, self.pin.y + frame.thickness))
        shifts = np.column_stack([beside, np.zeros(len(beside))]) @ frame.rotation.T
        return Slip(hinge.angles, shifts - shifts[0])

    def is_free(self) -> bool:
        """Whether the door cuts into nothing where the linkage leads it."""
        site, slip = self.site, self.slip

        def motion(value: float) -> Mat4:
            return np.asarray(translation(slip.shift(value)) @ site.motion(value))

        box = swept_box(site.door.box, motion, site.upper)
        near = [*in_the_way(site.obstacles, box), *in_the_way(self.others, box)]
        return is_free(site.door_body, motion, site.upper, near, self.config.poses)

    def installed(self, count: int) -> list[InstalledHinge]:
        """Returns so many hinges, each shifted along the edge where its place is taken; none where one finds none."""
        found: list[tuple[float, InstalledHinge]] = []
        for levels in heights_to_try(self.site.frame, count):
            apart = 2 * max(self.config.heights)
            free = (level for level in levels if all(abs(level - other) > apart for other, _ in found))
            one = next(((z, hinge) for z in free if (hinge := self._at(z)) is not None), None)
            if one is None:
                return []
            found.append(one)
        return [hinge for _, hinge in found]

    def _at(self, z: float) -> InstalledHinge | None:
        """Returns the hinge at a height, its arms among the static visuals; None where something is in its way."""
        side = self._side(z)
        if side is None or side > self.model.widest_side:
            return None
        frame, model = self.site.frame, self.model
        hinge = model.build(side, min(model.deepest, self.config.sunk * frame.thickness))
        T = np.asarray(frame.T_object_border @ translation(vec3(0.0, -frame.thickness, z)))
        static, dynamic = _visual("static", hinge.static, T), _visual("dynamic", hinge.dynamic, T)
        if not self.site.scene.is_near_static(static.mesh, self.site.anchor, self.site.holders) or self._cuts(static):
            return None
        judged = judged_hinge(InstalledHinge((static,), (dynamic,)), self.site)
        if judged is None or judged.struck_by:
            return None
        return replace(judged, static=(*judged.static, *self._arms(hinge, T)))

    def _cuts(self, static: Visual) -> bool:
        """Whether a plate and its arm stand in a shelf, a face frame or other hardware."""
        body = SweptBody(static.mesh, self.site.depth, pieces=[surface.mesh for surface in static.surfaces])
        body.place(np.eye(4))
        return any(body.penetrates(obstacle.collider) for obstacle in self.site.obstacles)

    def _arms(self, hinge: ConcealedHinge, T: Mat4) -> Iterator[Visual]:
        for arm in hinge.arms:
            swing = Swing(self.site.moving, axis_at(arm.pivot).transformed(T), hinge.angles, arm.turns)
            yield replace(_visual(arm.name, arm.surfaces, T), swing=swing)

    def _side(self, z: float) -> float | None:
        """Returns the x of the inner face of the case's side behind the door's edge; None where it is not flat."""
        frame = self.site.frame
        points = [
            vec3(self.config.start, -frame.thickness - depth, z + height)
            for depth in self.config.depths
            for height in self.config.heights
        ]
        met = self.site.static_rays.along(frame.to_object(np.array(points)), frame.direction(-1.0, 0.0, 0.0))
        if not np.all(met <= self.config.reach) or float(np.ptp(met)) > self.config.even:
            return None
        return self.config.start - float(met.min())


def _visual(end: str, surfaces: tuple[Surface, ...], T: Mat4) -> Visual:
    moved = tuple(surface.transformed(T) for surface in surfaces)
    return Visual(f"hinge_{end}", moved, VisualRole.HARDWARE, PartLabel.MISC)
