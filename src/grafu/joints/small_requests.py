"""Which small parts are to move by themselves: those that are stated, else those found by shape."""

from collections.abc import Collection
from dataclasses import replace

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import Asset
from grafu.geometry.arrays import Mat4
from grafu.joints.building_doors import building_door
from grafu.joints.config import RealizationConfig
from grafu.joints.door_levers import lever_requests
from grafu.joints.plan import JointRequest
from grafu.joints.realize import Realized
from grafu.joints.report import Installed
from grafu.joints.small_parts import are_links, small_parts, stated_small_parts
from grafu.joints.swivel_mirrors import mirror_requests
from grafu.joints.swivels import swivel_requests


def found_requests(
    made: ArticulatedObject, asset: Asset, config: RealizationConfig, chosen: Collection[str] | None
) -> tuple[JointRequest, ...]:
    """Returns the levers of a building's doors, with their bolts, mirrors, what swivels, and small parts by shape."""
    door = building_door(asset)
    levers = lever_requests(made, [leaf.id for leaf in door.leaves] if door else (), config.lever)
    mirrors = mirror_requests(made, asset)
    swivels = swivel_requests(made, asset)
    taken = {name for request in (*levers, *mirrors, *swivels) for name in (request.moving, *request.attached)}
    others = (r for r in small_parts(made, config.small) if taken.isdisjoint((r.moving, *r.attached)))
    if chosen is not None:
        others = (r for r in others if r.moving in chosen or are_links(asset, (r.moving, *r.attached)))
    return (*levers, *mirrors, *others, *swivels)  # casters first: the seat above them shows which end is theirs


def stated_requests(asset: Asset, realized: Realized, config: RealizationConfig) -> tuple[JointRequest, ...]:
    """Returns the small parts that the input states joints for, with their axes where the parts are now.

    A door that was drawn ajar took what is on it along when it was closed.
    """
    of_link = {visual.name: link.id for link in realized.object.links for visual in link.visuals}
    closing = {done.moving: _closing(done) for done in realized.report.installed}
    return tuple(
        replace(request, axis=request.kind.mapped_axis(request.axis, closing[link]))
        if (link := of_link.get(request.moving, "")) in closing
        else request
        for request in stated_small_parts(asset, config.plan)
    )


def _closing(door: Installed) -> Mat4:
    """Returns the motion by which a door that was drawn ajar was closed; none where it was not."""
    drawn_at = sum((clearance.amount for clearance in door.clearances if clearance.kind == "closed"), 0.0)
    return motion_kind(door.type).transform(door.initial_axis, -drawn_at)
