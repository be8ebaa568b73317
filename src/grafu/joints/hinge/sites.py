"""What the hardware of a door is tested against about one pin, and the placement that it makes. It chooses nothing."""

from dataclasses import replace
from functools import cache

from grafu.articulation.articulated_object import Visual
from grafu.joints.hinge.hardware import HingeSite, InstalledHinge
from grafu.joints.hinge.judged import JudgedPin
from grafu.joints.hinge.search import DoorSearch
from grafu.joints.limits import in_the_way
from grafu.joints.report import Placement
from grafu.joints.support_block import nearest_part


def site_of(judged: JudgedPin, upper: float, search: DoorSearch) -> HingeSite:
    """Returns what the hardware of a door is tested against about a pin, opened up to `upper` (radians)."""
    box = search.scene.parts[search.request.moving].box
    extent, mount = search.scene.extent, search.request.choice.mount
    return HingeSite(
        moving=search.request.moving,
        frame=search.frame,
        door=search.scene.moving_mesh(search.request.moving),
        door_body=search.body,
        scene=search.scene,
        static_rays=search.static_rays,
        door_rays=search.door_rays,
        obstacles=tuple(in_the_way(search.obstacles, box.grown(search.config.hinge.around * extent))),
        neighbours=search.bodies_around,
        motion=cache(judged.axis.rotation),
        upper=upper,
        depth=search.depth,
        anchor=search.config.anchor,
        reach=search.config.chosen_reach if mount else search.config.hinge_bridge,
        config=search.config.hinge,
        block=search.config.block,
        holders=search.request.holders,
    )


def placement_of(
    judged: JudgedPin, template: str, upper: float, hinges: list[InstalledHinge], search: DoorSearch
) -> Placement:
    """Returns the placement of hinges about a pin; their visuals get names that are unique in the object."""
    part = search.request.moving
    static = [_named(v, part, k) for k, hinge in enumerate(hinges) for v in hinge.static]
    dynamic = [_named(v, part, k) for k, hinge in enumerate(hinges) for v in hinge.dynamic]
    return Placement(
        axis=judged.axis,
        upper=upper,
        mechanism=judged.pin.mechanism,
        template=template,
        mount=search.request.choice.mount or nearest_part(static[0], search.scene, search.request, search.config.block),
        count=len(hinges),
        dynamic=tuple(dynamic),
        static=tuple(static),
        in_way=judged.neighbours,
        struck_by=tuple(sorted({name for hinge in hinges for name in hinge.struck_by})),
    )


def _named(visual: Visual, part: str, index: int) -> Visual:
    """Returns the visual under a name that is unique in the object: kind, part, index, end."""
    kind, _, end = visual.name.partition("_")
    return replace(visual, name=f"{kind}_{part}_{index}_{end}")
