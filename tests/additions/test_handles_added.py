"""Handles that are added: where, how large, how flush, and clear of everything by a judge of its own."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from front_scenes import cabinet, scaled, scene_of, with_parts, without_handles
from grafu.additions.handle.config import HandleConfig
from grafu.additions.handle.grasp import find_grasps
from grafu.additions.handle.place import Handles, add_handles, bodies_without
from grafu.asset.part import Asset
from grafu.errors import TemplateError
from grafu.geometry.arrays import vec3
from grafu.geometry.intersection import MeshCollider
from grafu.refusal import Reason
from grafu.synth.fronts.layout import CellRow, Door, Drawer, Pair, Stack
from grafu.synth.samples import KINDS
from grafu.templates.handles import HANDLES
from grafu.vocabulary import PartLabel
from small_scenes import box, hinged, scene
from sweeping import collisions

BARE = ("slab", "chamfered", "shaker", "glass", "muntins", "mirror", "raised panel", "two panels", "planks", "louvred")


def added(asset: Asset, config: HandleConfig = HandleConfig(), **more) -> Handles:
    found = scene_of(asset)
    return add_handles(found, find_grasps(found), config, **more)


def completed(asset: Asset, handles: Handles) -> Asset:
    return with_parts(asset, *(a.part for a in handles.additions))


def handle_of(handles: Handles, moving: str):
    (part,) = [a.part for a in handles.additions if a.part.carried_by == moving]
    return part


def assert_sits_and_stays_clear(asset: Asset, handles: Handles) -> None:
    """Every handle touches its front, hardly enters it, and neither hits nor is hit: by trimesh, not by the product."""
    whole = completed(asset, handles)
    for addition in handles.additions:
        part, front = addition.part, asset.part(addition.part.carried_by)
        assert MeshCollider(part.mesh).distance(MeshCollider(front.mesh)) < 1e-3
        still = trimesh.collision.CollisionManager()
        for other in whole.parts:
            if other.id != front.id and other.carried_by != front.id:
                still.add_object(other.id, other.mesh.to_trimesh())
        assert not still.in_collision_single(part.mesh.to_trimesh())
    for joint in whole.joints:
        opened = (
            scene_of(asset).joint_motions[joint.part].after
        )  # with all that rides on them they are out of the way by then
        ignored = frozenset(part.id for part in whole.parts if {part.id, part.carried_by} & {*opened})
        before = collisions(asset, joint.part, ignored=ignored)
        assert set(collisions(whole, joint.part, ignored=ignored)) <= set(before), joint.part


@pytest.mark.parametrize("template", HANDLES, ids=lambda t: t.id)
def test_every_style_can_be_named_and_sits_flush(template):
    asset = without_handles(cabinet(Stack((Pair(), Drawer()), (2.0, 1.0)), width=0.8))
    handles = added(asset, HandleConfig(style=template.id))
    assert {a.style for a in handles.additions} == {template.id}
    assert len(handles.additions) == 3
    assert_sits_and_stays_clear(asset, handles)


@pytest.mark.parametrize("leaf", BARE)
def test_every_front_style_gets_a_handle_on_something_solid(leaf):
    asset = without_handles(cabinet(Pair(leaf), width=0.9))
    handles = added(asset)
    assert len(handles.additions) == 2
    assert_sits_and_stays_clear(asset, handles)
    for addition in handles.additions:
        door = asset.part(addition.part.carried_by)
        clear = [s.mesh for s in door.surfaces if s.material.base_color[3] < 0.95]
        part = MeshCollider(addition.part.mesh)
        assert all(part.distance(MeshCollider(mesh)) > 1e-4 for mesh in clear)


@pytest.mark.parametrize("hinge", ["left", "right", "top", "bottom"])
def test_a_handle_lies_opposite_the_hinge(hinge):
    asset = without_handles(cabinet(Door(hinge), width=0.5))
    handle, door = handle_of(added(asset), "door").box, asset.part("door").box
    axis, end = {"left": (0, 1), "right": (0, -1), "top": (2, -1), "bottom": (2, 1)}[hinge]
    assert end * (handle.center[axis] - door.center[axis]) > 0.55 * door.half[axis]
    assert np.all(handle.low[[0, 2]] > door.low[[0, 2]])
    assert np.all(handle.high[[0, 2]] < door.high[[0, 2]])
    long, across = (2, 0) if hinge in ("left", "right") else (0, 2)
    assert handle.size[long] > 3 * handle.size[across]
    if long == 0:
        assert handle.center[0] == pytest.approx(door.center[0], abs=0.01)


def test_tall_doors_are_held_where_hands_are_and_low_ones_high():
    tall = KINDS["tall wardrobe"]()
    for part in (a.part for a in added(without_handles(tall)).additions):
        assert part.box.center[2] == pytest.approx(1.0, abs=0.05)
    low = without_handles(cabinet(Door(), width=0.5))
    assert handle_of(added(low), "door").box.center[2] > low.part("door").box.center[2] + 0.1


def test_drawers_are_held_in_their_middle_and_high_ones_above_it():
    asset = without_handles(cabinet(Stack((Drawer(), Drawer()), (3.0, 1.0)), width=0.6))
    for part in (a.part for a in added(asset).additions):
        drawer = asset.part(part.carried_by).box
        assert part.box.center[0] == pytest.approx(drawer.center[0], abs=1e-3)
        off = (part.box.center[2] - drawer.center[2]) / drawer.half[2]
        assert off > 0.2 if drawer.size[2] > 0.25 else abs(off) < 0.3


def test_wide_drawers_take_two():
    asset = without_handles(cabinet(Stack((Drawer(), Drawer())), width=1.2))
    handles = added(asset)
    assert [sum(a.part.carried_by == m for a in handles.additions) for m in ("drawer_1", "drawer_2")] == [2, 2]
    assert_sits_and_stays_clear(asset, handles)


@pytest.mark.parametrize("kind", ["fronts with finger holes", "fronts with lips", "overlay pair", "chest with a lid"])
def test_what_can_be_grasped_gets_nothing(kind):
    asset = KINDS[kind]()
    handles = added(asset)
    assert (handles.additions, handles.refused) == ((), ())
    assert handles.scene.parts.keys() == {p.id for p in asset.parts}


@pytest.mark.parametrize("kind", [k for k, make in KINDS.items() if any(p.label == "handle" for p in make().parts)])
def test_every_kind_of_furniture_that_lost_its_handles_can_be_grasped_again(kind):
    asset = without_handles(KINDS[kind]())
    handles = added(asset)
    assert handles.refused == ()
    assert_sits_and_stays_clear(asset, handles)
    again = find_grasps(handles.scene)
    assert "none" not in {g.kind for g in again.values()}
    assert bodies_without(handles.scene, again) == ()


def test_behind_a_door_a_handle_is_flat_enough():
    asset = without_handles(KINDS["drawers behind an inset door"]())
    handles = added(asset)
    doors = [asset.part(m) for m in ("door",)]
    for addition in handles.additions:
        part = MeshCollider(addition.part.mesh)
        if addition.part.carried_by != "door":
            assert all(part.distance(MeshCollider(d.mesh)) > 0 for d in doors)


@pytest.mark.parametrize("hinted", [False, True])
def test_one_lost_handle_is_like_the_others_wherever_one_was_predicted(hinted):
    asset = cabinet(CellRow((Door("left"), Door("right"), Door("left"))), width=1.2)
    lost, kept = (
        next(p for p in asset.parts if p.label is PartLabel.HANDLE and p.carried_by == f"door_{k}") for k in (1, 3)
    )
    rest = replace(asset, parts=tuple(p for p in asset.parts if p is not lost))
    predicted = lost.box.center - vec3(0.0, 0.0, 0.2)
    handles = added(rest, hints={"door_1": predicted} if hinted else None)
    (addition,) = handles.additions
    np.testing.assert_allclose(addition.part.box.center, lost.box.center, atol=0.012)
    assert addition.part.box.size.max() == pytest.approx(lost.box.size.max(), rel=0.02)
    assert addition.part.surfaces[0].material == kept.surfaces[0].material


def test_a_sensible_hint_is_followed_and_a_senseless_one_is_not():
    asset = without_handles(cabinet(Door("left", "slab"), width=0.5))
    door = asset.part("door").box
    high = vec3(float(door.high[0]) - 0.06, float(door.low[1]), float(door.low[2]) + 0.2)
    by_hinge = vec3(float(door.low[0]) + 0.05, float(door.low[1]), float(door.center[2]))
    at = handle_of(added(asset, hints={"door": high}), "door").box.center
    np.testing.assert_allclose(at[[0, 2]], high[[0, 2]], atol=0.005)
    in_the_middle = np.array(door.center) - (0, 0.5 * door.size[1], 0)
    for senseless in (by_hinge, in_the_middle):
        at = handle_of(added(asset, hints={"door": senseless}), "door").box.center
        assert at[0] > door.low[0] + 0.8 * door.size[0]


def test_a_door_too_small_for_anything_is_refused():
    sliver = box("door", (0.0, -0.02, 0.0), (0.012, 0.0, 0.6))
    found = scene_of(scene(sliver, box("side", (-0.02, 0.0, 0.0), (0.0, 0.6, 1.0)), joints=(hinged("door"),)))
    refused = add_handles(found, {m: replace(g, kind="none") for m, g in find_grasps(found).items()}).refused
    assert [(r.part, r.reason) for r in refused] == [("door", Reason.TOO_SMALL)]


def test_a_door_right_behind_something_is_refused_and_says_what_is_in_the_way():
    asset = without_handles(cabinet(Door(), width=0.5))
    door = asset.part("door").box
    y, around = float(door.low[1]), door.grown(0.1)
    screen = box("screen", (around.low[0], y - 0.02, around.low[2]), (around.high[0], y - 0.004, around.high[2]))
    found = scene_of(with_parts(asset, screen))
    handles = add_handles(found, find_grasps(found))
    assert [(r.part, r.reason) for r in handles.refused] == [("door", Reason.IN_THE_WAY)]
    assert "screen" in handles.refused[0].why


def test_a_pane_alone_carries_no_handle():
    asset = without_handles(cabinet(Door(leaf="glass"), width=0.5))
    door = asset.part("door")
    pane = next(s for s in door.surfaces if s.material.base_color[3] < 0.95)
    glass = replace(door, surfaces=tuple(replace(s, material=pane.material) for s in door.surfaces))
    handles = added(replace(asset, parts=tuple(glass if p is door else p for p in asset.parts)))
    assert [(r.part, r.reason) for r in handles.refused] == [("door", Reason.NO_GROUND)]


@pytest.mark.parametrize("factor", [0.1, 10.0])
def test_models_of_another_scale_get_handles_that_fit(factor):
    asset = scaled(without_handles(cabinet(Pair(), width=0.9)), factor)
    handles = added(asset)
    for part in (a.part for a in handles.additions):
        ratio = part.box.size.max() / asset.part(part.carried_by).box.size.max()
        assert 0.02 < ratio < 0.5
    assert len(handles.additions) + len(bodies_without(handles.scene, {})) == 2 or factor > 1


def test_an_unknown_style_is_an_error_in_one_line():
    with pytest.raises(TemplateError, match=r"must be one of .*: got 'golden'"):
        added(without_handles(cabinet(Door())), HandleConfig(style="golden"))


def test_ids_of_handles_are_new_and_begin_with_handle():
    asset = without_handles(cabinet(Pair(), width=0.9))
    taken = box("handle_door_1", (2.0, 2.0, 0.0), (2.1, 2.1, 0.1))
    names = [a.part.id for a in added(with_parts(asset, taken)).additions]
    assert len({*names, "handle_door_1"}) == 3
    assert all(name.startswith("handle") for name in names)
