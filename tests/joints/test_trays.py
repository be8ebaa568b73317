"""Trays with a rim behind doors slide out once these are open; shelves, basins and what fills its compartment stay."""

from dataclasses import replace

import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.graph.parse import parse_graph
from grafu.joints.motion_choice import choice_in_words
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.joints.trays import with_trays
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType, PartLabel
from judging import swept_collisions
from small_scenes import BASE_CASE, box, cylinder, scene

ONE = (box("door", (0.0, -0.02, 0.1), (0.6, -0.001, 0.8)),)
TWO = (box("door", (0.0, -0.02, 0.1), (0.298, -0.001, 0.8)), box("other", (0.302, -0.02, 0.1), (0.6, -0.001, 0.8)))


def tray(name="tray", x=(0.05, 0.55), y=(0.02, 0.48), z=(0.3, 0.36), rims="left right front back"):
    """A board of 1 cm with rims of 1 cm around it, in one part."""
    walls = {
        "left": ((x[0], y[0], z[0]), (x[0] + 0.01, y[1], z[1])),
        "right": ((x[1] - 0.01, y[0], z[0]), (x[1], y[1], z[1])),
        "front": ((x[0], y[0], z[0]), (x[1], y[0] + 0.01, z[1])),
        "back": ((x[0], y[1] - 0.01, z[0]), (x[1], y[1], z[1])),
    }
    boards = [box("w", (x[0], y[0], z[0]), (x[1], y[1], z[0] + 0.01)), *(box("w", *walls[k]) for k in rims.split())]
    surfaces = tuple(surface for board in boards for surface in board.surfaces)
    return replace(box(name, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=surfaces, label=PartLabel.SHELF)


def turning(door, at, level=False):
    axis = Axis(vec3(0.3, -0.02, 0.1), vec3(1.0, 0.0, 0.0)) if level else Axis(vec3(at, 0.0, 0.4), vec3(0.0, 0.0, -1.0))
    return JointRequest(door.id, JointType.REVOLUTE, axis, "network")


def trays(*parts, doors=ONE, level=False):
    asset = scene(*doors, *BASE_CASE, *parts)
    requests = tuple(turning(door, at, level) for door, at in zip(doors, (0.0, 0.6), strict=False))
    plan = with_trays(RealizationPlan(requests, ()), asset, parse_graph(asset))
    return {one.moving: one for one in plan.joints[len(doors) :]}


def test_trays_slide_out_once_the_door_is_open():
    grip = cylinder("handle", ((0.57, -0.05, 0.4), (0.57, -0.05, 0.5)))
    posts = [cylinder(f"handle_post_{k}", ((0.57, -0.05, z), (0.57, -0.02, z))) for k, z in enumerate((0.41, 0.49))]
    asset = scene(*ONE, grip, *posts, *BASE_CASE, tray("low", z=(0.2, 0.26)), tray("high", z=(0.5, 0.56)))
    config = PipelineConfig(Settings(motions={"door": choice_in_words("left")}))
    made = functionalize(asset, MotionSource.NETWORK, builtin_gallery(), config)
    joints = made.object.joint_of
    for name in ("low", "high"):
        assert joints[name].type is JointType.PRISMATIC
        assert joints[name].after == (joints["door"].id,)
        assert joints[name].limits.upper > 0.3
        assert not swept_collisions(made.object, joints[name], 15)


@pytest.mark.parametrize(("doors", "count"), [(ONE, 1), (TWO, 1)])
def test_a_tray_may_be_as_wide_as_the_opening_of_two_doors(doors, count):
    assert len(trays(tray(), doors=doors)) == count


def test_what_lies_in_a_tray_slides_along():
    ((name, found),) = trays(tray(), box("plate", (0.2, 0.2, 0.31), (0.3, 0.3, 0.33))).items()
    assert (name, found.attached) == ("tray", ("plate",))


STAYS = {
    "a board": (box("shelf", (0.05, 0.02, 0.3), (0.55, 0.48, 0.34)),),
    "a board with one lip": (tray(rims="front"),),
    "a shelf with rims that fills its compartment": (tray(x=(0.021, 0.579)),),
    "a basin": (tray(z=(0.3, 0.55)),),
    "half a tray": (tray(x=(0.05, 0.25)),),
    "a door rack": (tray(y=(0.02, 0.12)),),
    "nothing": (),
}


@pytest.mark.parametrize("what", STAYS)
def test_other_things_behind_the_door_stay(what):
    assert trays(*STAYS[what]) == {}


def test_a_tray_on_runners_slides_and_one_behind_a_door_that_drops_stays():
    runners = [box(f"runner_{k}", (x, 0.05, 0.3), (x + 0.029, 0.5, 0.315)) for k, x in enumerate((0.0205, 0.5505))]
    assert set(trays(tray(), *runners)) == {"tray"}
    assert trays(tray(), level=True) == {}
