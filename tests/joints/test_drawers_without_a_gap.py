"""Two drawers that fill their case: rails of the first stand where the second does, which makes room for them."""

from dataclasses import replace

import pytest

from grafu.articulation.articulated_object import VisualRole
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.report import report_of
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel
from small_scenes import box, scene


def of_boards(name, label, *ends):
    boards = [box(f"{name}_{k}", low, high) for k, (low, high) in enumerate(ends)]
    whole = replace(boards[0], id=name, surfaces=tuple(surface for board in boards for surface in board.surfaces))
    return replace(whole, label=label, source=replace(whole.source, name=name), labelled_by="name")


def tray(name, low, high, wall=0.006):
    """A box that is open above."""
    (x0, y0, z0), (x1, y1, z1), t = low, high, wall
    sides = [((x0, y0, z0), (x0 + t, y1, z1)), ((x1 - t, y0, z0), (x1, y1, z1))]
    ends = [((x0, y0, z0), (x1, y0 + t, z1)), ((x0, y1 - t, z0), (x1, y1, z1))]
    return of_boards(name, PartLabel.DRAWER, *sides, *ends, ((x0, y0, z0), (x1, y1, z0 + t)))


def case():
    """A case that the two drawers fill without any clearance, open in front; they reach 10 mm into its back."""
    sides = [((-0.42, -0.3, 0.0), (-0.388, 0.3, 0.4)), ((0.388, -0.3, 0.0), (0.42, 0.3, 0.4))]
    back = ((-0.388, 0.26, 0.0), (0.388, 0.3, 0.4))
    levels = [((-0.388, -0.3, z), (0.388, 0.26, z + t)) for z, t in ((0.0, 0.032), (0.25, 0.15))]
    return of_boards("case", PartLabel.SIDE_PANEL, *sides, back, *levels)


@pytest.mark.parametrize("mirrored", [False, True])
def test_the_second_of_two_drawers_that_meet_makes_room_for_the_rails_of_the_first(mirrored):
    halves = [(-0.388, 0.0), (0.0, 0.388)]
    names = ["drawer_1", "drawer_2"][:: -1 if mirrored else 1]
    trays = [tray(name, (x0, -0.3, 0.032), (x1, 0.27, 0.25)) for name, (x0, x1) in zip(names, halves, strict=True)]
    made = functionalize(scene(case(), *trays), MotionSource.NETWORK, builtin_gallery())
    joints = {joint.child: joint for joint in made.object.joints}
    assert set(joints) == {"drawer_1", "drawer_2"}
    for name, joint in joints.items():
        assert joint.limits.upper > 0.3
        rails = [v for v in made.object.link(name).visuals if v.role is VisualRole.HARDWARE]
        assert len(rails) >= 2
    assert all(joint.collision_share == 0 and joint.count for joint in report_of(made).joints)
