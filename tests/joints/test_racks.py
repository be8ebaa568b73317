"""Wire baskets behind a door that drops slide out once it is open; shelves, and what doors at a side close, stay."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import merge_meshes
from grafu.graph.parse import parse_graph
from grafu.joints.motion_choice import choice_in_words
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.joints.racks import is_grid, with_racks
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.report import report_of
from grafu.pipeline.settings import Settings
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType, MechanismClass, PartLabel
from judging import swept_collisions
from small_scenes import BASE_CASE, box, cylinder, scene

DOOR = box("door", (0.0, -0.03, 0.1), (0.6, -0.001, 0.8))
BAR = cylinder("handle", ((0.05, -0.07, 0.74), (0.55, -0.07, 0.74)))
POSTS = [cylinder(f"handle_post_{k}", ((x, -0.07, 0.74), (x, -0.03, 0.74))) for k, x in enumerate((0.1, 0.5))]


def basket(name="basket", low=0.3, x=(0.025, 0.575), label=PartLabel.SHELF):
    """A basket of wires, 0.1 m high, in one part."""
    wires = [box("w", (at, 0.03, low), (at + 0.004, 0.5, low + 0.004)) for at in (x[0], 0.15, 0.3, 0.45, x[1] - 0.004)]
    for z in (low, low + 0.1):
        wires += [box("w", (x[0], y, z), (x[1], y + 0.004, z + 0.004)) for y in (0.03, 0.2, 0.35, 0.496)]
    wires += [box("w", (at, y, low), (at + 0.004, y + 0.004, low + 0.104)) for at in x[:1] for y in (0.03, 0.496)]
    surfaces = tuple(surface for wire in wires for surface in wire.surfaces)
    return replace(box(name, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=surfaces, label=label)


def request(level=True):
    lower, side = Axis(vec3(0.3, -0.03, 0.1), vec3(1.0, 0.0, 0.0)), Axis(vec3(0.0, 0.0, 0.4), vec3(0.0, 0.0, -1.0))
    return JointRequest("door", JointType.REVOLUTE, lower if level else side, "network")


def racks(*parts, level=True):
    asset = scene(DOOR, *BASE_CASE, *parts)
    plan = with_racks(RealizationPlan((request(level),), ()), asset, parse_graph(asset))
    return {one.moving: one for one in plan.joints[1:]}


def test_baskets_slide_out_once_the_door_is_open():
    asset = scene(DOOR, BAR, *POSTS, *BASE_CASE, basket("low_basket", 0.2), basket("high_basket", 0.5))
    config = PipelineConfig(Settings(motions={"door": choice_in_words("drop")}))
    made = functionalize(asset, MotionSource.NETWORK, builtin_gallery(), config)
    joints = made.object.joint_of
    assert {name: joint.type for name, joint in joints.items() if "basket" in name} == {
        "low_basket": JointType.PRISMATIC,
        "high_basket": JointType.PRISMATIC,
    }
    assert abs(joints["door"].axis.direction[0]) == pytest.approx(1.0)
    for name in ("low_basket", "high_basket"):
        assert joints[name].after == (joints["door"].id,)
        assert joints[name].limits.upper > 0.3
        assert not swept_collisions(made.object, joints[name], 15)
    report = report_of(made)
    assert {record.part: record.grasp for record in report.joints if "basket" in record.part} == {
        "low_basket": "edge",
        "high_basket": "edge",
    }
    assert [one.part for one in report.added if "basket" in (one.part or "")] == []
    assert report.verdict.colour != "red"


def slid(*parts):
    """The object of a dishwasher whose door drops, with these parts behind the door."""
    asset = scene(DOOR, BAR, *POSTS, *BASE_CASE, *parts)
    config = PipelineConfig(Settings(motions={"door": choice_in_words("drop")}))
    return functionalize(asset, MotionSource.NETWORK, builtin_gallery(), config)


def gap_of_guides(made, name):
    """The widest gap between a rack and either of its guides, in metres, over its motion."""
    joint = made.object.joint_of[name]
    rack = MeshCollider(merge_meshes([visual.mesh for visual in made.object.link(joint.child).visuals]))
    guides = [
        MeshCollider(v.mesh) for v in made.object.link(made.object.root).visuals if v.name.startswith(f"rail_{name}")
    ]
    assert len(guides) == 2
    assert all(any(guide.distance(MeshCollider(wall.mesh)) == 0 for wall in BASE_CASE) for guide in guides)
    gaps = []
    for travel in np.linspace(0.0, joint.limits.upper, 25):
        rack.place(joint.axis.shift(float(travel)))
        gaps += [rack.distance(guide) for guide in guides]
    return max(gaps), min(gaps)


def test_a_rack_that_nothing_holds_slides_between_guides_on_both_walls():
    made = slid(basket("basket", 0.3, x=(0.04, 0.55)))
    widest, least = gap_of_guides(made, "basket")
    assert 0 < least <= widest < 0.001
    (record,) = (one for one in report_of(made).joints if one.part == "basket")
    assert (record.template, record.count, record.mechanism) == ("guide", 2, MechanismClass.CENTRE)
    assert record.opening > 0.3


def test_a_rack_that_runs_on_what_is_drawn_gets_no_guides():
    runners = [box(f"runner_{k}", (x, 0.03, 0.3), (x + 0.02, 0.5, 0.304)) for k, x in enumerate((0.02, 0.56))]
    made = slid(basket("basket", 0.305, x=(0.03, 0.57)), *runners)
    (record,) = (one for one in report_of(made).joints if one.part == "basket")
    assert (record.template, record.count) == ("drawn", 0)
    assert not [visual for visual in made.object.link(made.object.root).visuals if "rail_basket" in visual.name]


def test_the_wires_of_a_rack_in_several_parts_slide_as_one():
    wires = [box(f"wire_{k}", (x, 0.03, 0.3), (x + 0.004, 0.5, 0.304)) for k, x in enumerate((0.03, 0.3, 0.566))]
    rails = [box(f"rail_{k}", (0.03, y, 0.3), (0.57, y + 0.004, 0.304)) for k, y in enumerate((0.496, 0.03))]
    ((name, found),) = racks(*wires, *rails).items()
    assert {name, *found.attached} == {part.id for part in (*wires, *rails)}
    assert slid(*wires, *rails).object.joint_of[name].limits.upper > 0.3


def supports(*heights):
    """A flat grid with rows of supports at both sides, in one part: only the grid would slide."""
    grid = [box("w", (x, 0.03, 0.3), (x + 0.004, 0.5, 0.304)) for x in (0.03, 0.3, 0.566)]
    grid += [box("w", (0.03, y, 0.3), (0.57, y + 0.004, 0.304)) for y in (0.03, 0.496)]
    rows = [box("w", (x, 0.03, z), (x + 0.004, 0.5, z + 0.004)) for z in heights for x in (0.026, 0.57)]
    surfaces = tuple(surface for wire in (*grid, *rows) for surface in wire.surfaces)
    return replace(box("rack", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=surfaces)


NO_RACKS = {
    "a grid in its supports": (supports(0.2, 0.3, 0.4, 0.5),),
    "a plate": (box("shelf", (0.03, 0.03, 0.3), (0.57, 0.5, 0.31)),),
    "a basket that is narrow": (basket(x=(0.2, 0.46)),),
    "nothing": (),
}


@pytest.mark.parametrize("what", NO_RACKS)
def test_other_things_behind_the_door_stay(what):
    assert racks(*NO_RACKS[what]) == {}


def test_a_basket_behind_a_door_at_its_side_stays():
    assert set(racks(basket())) == {"basket"}
    assert racks(basket(), level=False) == {}


def test_a_grid_is_mostly_open_from_above_and_from_its_sides():
    assert is_grid(basket().mesh)
    assert not is_grid(DOOR.mesh)
    assert not is_grid(merge_meshes([DOOR.mesh, BAR.mesh]))
    assert not is_grid(box("tray", (0.0, 0.0, 0.0), (0.5, 0.5, 0.01)).mesh)


def loose_rack(name, label=PartLabel.SHELF):
    """A rack whose upper ring of wires is drawn above its grid and touches nothing."""
    grid = [box("w", (x, 0.03, 0.3), (x + 0.004, 0.5, 0.304)) for x in (0.03, 0.3, 0.566)]
    grid += [box("w", (0.03, y, 0.3), (0.57, y + 0.004, 0.304)) for y in (0.03, 0.496)]
    ring = [box("w", (x, 0.03, 0.4), (x + 0.004, 0.5, 0.404)) for x in (0.03, 0.566)]
    surfaces = tuple(surface for wire in (*grid, *ring) for surface in wire.surfaces)
    return replace(box(name, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=surfaces, label=label)


def test_a_rack_that_is_one_link_is_one_though_its_wires_are_apart():
    rack = loose_rack("lower_rack")
    assert racks(rack) == {}

    def of_robot(link):
        parts = [replace(part, source=replace(part.source, link="body")) for part in (DOOR, *BASE_CASE)]
        mine = replace(rack, source=replace(rack.source, link=link))
        asset = replace(scene(*parts, mine), kind="urdf")
        return with_racks(RealizationPlan((request(),), ()), asset, parse_graph(asset)).joints[1:]

    assert [one.moving for one in of_robot("lower")] == ["lower_rack"]
    assert of_robot("body") == ()


def test_the_rails_on_the_walls_stay_as_a_rack_slides():
    rails = [box(f"rack_rail_{k}", (x, 0.03, 0.3), (x + 0.005, 0.5, 0.31)) for k, x in enumerate((0.02, 0.575))]
    ((name, found),) = racks(basket("basket", 0.3, x=(0.025, 0.575)), *rails).items()
    assert (name, found.attached) == ("basket", ())
