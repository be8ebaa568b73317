"""A thick door opens as wide as what slides out behind it needs, and no wider."""

from math import radians

import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.joints.config import RealizationConfig
from grafu.joints.joint_choice import with_choices
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.plan import JointChoice
from grafu.joints.realize import realize
from grafu.joints.wide_door_config import WideDoorConfig
from judging import GALLERY, installed, realized
from small_scenes import box, hinged, scene, sliding

RIGHT_EDGE = Axis(vec3(0.7, 0.0, 0.0), vec3(0.0, 0.0, 1.0))


def fridge(*more, wall=0.03, thick=0.07):
    """A refrigerator, 0.7 m wide and 0.65 deep: a thick door with racks on its back before a drawer."""
    case = [
        box("left", (0.0, 0.0, 0.0), (wall, 0.65, 1.2)),
        box("right", (0.7 - wall, 0.0, 0.0), (0.7, 0.65, 1.2)),
        box("floor", (wall, 0.0, 0.0), (0.7 - wall, 0.65, 0.06)),
        box("top", (wall, 0.0, 1.14), (0.7 - wall, 0.65, 1.2)),
        box("back", (wall, 0.6, 0.06), (0.7 - wall, 0.65, 1.14)),
        box("shelf", (wall, 0.12, 0.4), (0.7 - wall, 0.6, 0.41)),
    ]
    door = box("door", (0.0, -thick, 0.0), (0.7, -0.002, 1.2))
    bins = box("rack", (wall + 0.02, -0.002, 0.1), (0.68 - wall, 0.12, 0.38), carried_by="door")
    inner = box("drawer", (wall + 0.004, 0.13, 0.1), (0.696 - wall, 0.58, 0.38))
    joints = (hinged(axis=RIGHT_EDGE, upper=radians(110)), sliding("drawer", (0.0, -1.0, 0.0), 0.4))
    return scene(*case, door, bins, inner, *more, joints=joints)


def test_a_thick_door_opens_wider_for_the_drawer_behind_it():
    found = installed(realized(fridge()))
    assert radians(110) < found["door"].opening <= radians(165) + 1e-9
    assert found["drawer"].opening >= 0.7 * 0.4
    assert found["drawer"].after == ("door_joint",)
    assert any("slides out behind it" in note for note in found["door"].notes)


def test_without_wider_openings_the_drawer_stays_behind_it():
    config = RealizationConfig(wide_doors=WideDoorConfig(openings=(radians(105),)))
    found = installed(realized(fridge(), config))
    assert found["door"].opening <= radians(110) + 1e-9
    assert found["drawer"].restricted


def test_a_door_that_a_wall_stops_stays_as_it_is():
    wall = box("wall", (0.75, -1.0, 0.0), (0.8, 0.65, 1.2))
    found = installed(realized(fridge(wall)))
    assert found["door"].opening <= radians(110) + 1e-9
    assert not any("slides out behind it" in note for note in found["door"].notes)


def test_an_opening_that_was_chosen_stays():
    asset = fridge()
    plan = with_choices(plan_from_annotation(asset), {"door": JointChoice(opening=radians(100))}, asset, GALLERY)
    assert installed(realize(plan, asset, GALLERY))["door"].opening == pytest.approx(radians(100))


def test_a_door_out_of_the_way_opens_no_wider():
    asset = fridge(wall=0.15)
    found = installed(realized(asset))
    assert not found["drawer"].restricted
    assert found["door"].opening <= radians(110) + 1e-9
