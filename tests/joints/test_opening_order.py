"""Which joint waits for which: drawers behind doors, doors under an overlap; never in a circle."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.joints import order
from grafu.joints.config import RealizationConfig
from grafu.joints.nesting import bodies_of
from grafu.joints.order import BuiltJoint, Meetings, OpeningOrder, order_joints, stand_aside
from grafu.joints.plan import JointRequest
from grafu.metrics.collision import CollisionConfig, collision_shares
from grafu.scene.scene import Scene
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.fronts.layout import Drawer, Pair
from grafu.synth.samples import KINDS
from grafu.vocabulary import JointType
from judging import installed, realized, realized_kind
from small_scenes import DOOR, SIDE, box, hinged, scene

BEHIND = ("drawers behind a pair", "drawers behind an inset door")


def waits(obj: ArticulatedObject) -> dict[str, set[str]]:
    return {joint.child: {name.removesuffix("_joint") for name in joint.after} for joint in obj.joints}


def test_a_drawer_behind_a_pair_waits_for_both_doors():
    found = waits(realized_kind("drawers behind a pair").object)
    assert found == {"door_1": set(), "door_2": set(), "drawer": {"door_1", "door_2"}}


def test_drawers_behind_a_door_wait_for_it():
    found = waits(realized_kind("drawers behind an inset door").object)
    assert found == {"door": set(), "drawer_1": {"door"}, "drawer_2": {"door"}}


@pytest.mark.parametrize("kind", [k for k in KINDS if k not in BEHIND])
def test_nothing_waits_where_nothing_is_in_the_way(kind):
    assert not any(waits(realized_kind(kind).object).values())


@pytest.mark.parametrize("kind", BEHIND)
def test_once_the_doors_are_open_nothing_collides_with_them(kind):
    obj = realized_kind(kind).object
    tolerance = CollisionConfig(poses=12, tolerance=0.0008, moving_bodies=True, hardware=False)
    assert collision_shares(obj, tolerance) == {joint.id: 0.0 for joint in obj.joints}


@pytest.mark.parametrize("kind", BEHIND)
def test_the_report_and_the_object_state_the_same_order(kind):
    result = realized_kind(kind)
    for joint in result.object.joints:
        assert installed(result)[joint.child].after == joint.after
        assert set(joint.after) <= {other.id for other in result.object.joints}


def overlapping_pair():
    """The left door carries a strip that covers the right door's edge: it must open first."""
    strip = box("handle_strip", (0.39, -0.03, 0.0), (0.43, -0.02, 0.6), carried_by="door")
    right = box("door_2", (0.405, -0.02, 0.0), (0.8, 0.0, 0.6))
    far = box("far_side", (0.8, 0.0, 0.0), (0.82, 0.4, 0.6))
    axis = Axis(vec3(0.8, 0.0, 0.0), vec3(0.0, 0.0, 1.0))
    return scene(DOOR, SIDE, strip, right, far, joints=(hinged(), hinged("door_2", axis)))


def test_a_door_under_anothers_overlap_waits_for_it():
    found = waits(realized(overlapping_pair()).object)
    assert found == {"door": set(), "door_2": {"door"}}


def test_a_drawer_does_not_wait_for_doors_that_hardly_open():
    """A post before the doors keeps them nearly shut: open or not, they stand before the drawer."""
    asset = make_cabinet(Cabinet(layout=Pair(behind=Drawer(handle="none"))))
    assert set(installed(realized(asset))["drawer"].after) == {"door_1_joint", "door_2_joint"}
    front = float(asset.part("door_1").box.low[1])
    post = box("post", (-0.3, front - 0.12, 0.0), (0.3, front - 0.06, 0.72))
    held = installed(realized(replace(asset, parts=(*asset.parts, post))))
    assert "drawer" not in held or held["drawer"].opening < 0.1


def test_order_is_never_circular():
    for kind in BEHIND:
        order = waits(realized_kind(kind).object)
        while order:
            free = [name for name, before in order.items() if not before & order.keys()]
            assert free, order
            for name in free:
                del order[name]


def stack(opens: float) -> tuple[list[BuiltJoint], Scene]:
    """A lid, which opens by so many degrees, and the seat below it, which would open further."""
    pan = box("pan", (0.0, 0.0, 0.0), (0.4, 0.45, 0.4))
    seat = box("seat", (0.0, 0.0, 0.402), (0.4, 0.45, 0.42))
    lid = box("lid", (0.0, 0.0, 0.422), (0.4, 0.45, 0.44))
    pin = Axis(vec3(0.0, 0.452, 0.401), vec3(-1.0, 0.0, 0.0))
    requests = [JointRequest(name, JointType.REVOLUTE, pin, "rule") for name in ("lid", "seat")]
    moving = Scene({p.id: p for p in (pan, seat, lid)}, bodies_of(requests), 0.5)
    upper = {"lid": np.radians(opens), "seat": np.radians(90.0)}
    met = {"lid": (), "seat": ("lid",)}
    built = [BuiltJoint(n, pin.rotation, float(upper[n]), float(upper[n]), met[n]) for n in ("lid", "seat")]
    return built, moving


def stacked(opens: float) -> OpeningOrder:
    """The order of the seat."""
    built, moving = stack(opens)
    return order_joints(built, Meetings(moving), RealizationConfig())["seat"]


def test_joints_that_were_swept_past_each_other_are_not_swept_again(monkeypatch):
    asked, sweeps = list[str](), order._is_free_of
    monkeypatch.setattr(order, "_is_free_of", lambda joint, *rest: asked.append(joint.moving) or sweeps(joint, *rest))
    (lid, seat), moving = stack(80.0)
    meetings, config = Meetings(moving), RealizationConfig()

    def ordered(*joints: BuiltJoint) -> dict[str, OpeningOrder]:
        return stand_aside(order_joints(joints, meetings, config), joints, meetings, config)

    first, before = ordered(lid, seat), len(asked)
    assert ordered(lid, seat) == first
    assert len(asked) == before > 0
    wider = replace(lid, upper=lid.upper + 0.1)
    assert ordered(wider, seat) == stand_aside(
        order_joints([wider, seat], Meetings(moving), config), [wider, seat], Meetings(moving), config
    )


def test_a_seat_opens_after_its_lid_and_as_far_as_that():
    order = stacked(80.0)
    assert order.after == ("lid",)
    assert np.radians(74) < order.upper < np.radians(82)
    assert stacked(95.0).upper == np.radians(90.0)


def test_a_seat_does_not_wait_for_a_lid_that_hardly_opens():
    order = stacked(30.0)
    assert order.after == ()
    assert order.upper < np.radians(5)


@pytest.mark.parametrize(("opens", "after"), [(55.0, ("lid",)), (40.0, ())])
def test_what_hardly_opens_below_a_closed_lid_waits_for_it_though_that_opens_half(opens, after):
    order = stacked(opens)
    assert order.after == after
    assert bool(np.degrees(order.upper) > 40.0) is bool(after)
