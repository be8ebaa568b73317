"""What all steps must see alike: the floor, what stands in the way, and the piece with everything closed."""

from dataclasses import replace

import numpy as np
import pytest

from front_scenes import cabinet, scene_of, without_handles
from grafu.additions.closed_scene import closed_scene
from grafu.additions.grip.carve import Carved, carve_grip
from grafu.additions.grip.config import GripConfig
from grafu.additions.handle.config import HandleConfig
from grafu.additions.handle.fit import handle_obstacles
from grafu.additions.handle.grasp import find_grasps
from grafu.additions.handle.place import add_handles
from grafu.asset.part import Asset
from grafu.geometry.arrays import vec3
from grafu.geometry.transform import translation
from grafu.joints.config import RealizationConfig
from grafu.joints.hinge.search import door_search
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.rail.search import drawer_search
from grafu.pipeline.additions import planned_scene
from grafu.scene.scene import Scene
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Drawer, Stack
from grafu.vocabulary import PartLabel

LAYOUT = Stack((Drawer(), Door()), (1.0, 3.0))
DROP = 0.45


def moved(asset: Asset, up: float) -> Asset:
    """The same so many metres higher."""
    T = translation(vec3(0.0, 0.0, up))
    parts = tuple(replace(p, surfaces=tuple(s.transformed(T) for s in p.surfaces)) for p in asset.parts)
    return replace(asset, parts=parts, joints=tuple(replace(j, axis=j.axis.transformed(T)) for j in asset.joints))


def wardrobe() -> Asset:
    """One with a door so tall that hands, not its middle, decide how high it is gripped."""
    return without_handles(make_cabinet(Cabinet("wardrobe", Case(width=0.6, height=2.1), Door())))


def handle_height(scene: Scene) -> float:
    [handle] = add_handles(scene, find_grasps(scene), HandleConfig()).additions
    return float(handle.part.box.center[2])


def grip_height(scene: Scene) -> float:
    carved = carve_grip(scene, "door", GripConfig())
    assert isinstance(carved, Carved)
    return float(carved.centre[2])


@pytest.mark.parametrize("height", [handle_height, grip_height])
def test_heights_for_hands_count_from_the_floor(height):
    plain, low = scene_of(wardrobe()), scene_of(moved(wardrobe(), -DROP))
    assert (plain.floor, low.floor) == pytest.approx((0.0, -DROP), abs=1e-9)
    assert height(low) == pytest.approx(height(plain) - DROP, abs=1e-6)
    assert 0.8 < height(plain) < 1.2


def test_the_floor_is_at_0_or_below_the_lowest_part_whether_it_moves_or_not():
    scene = scene_of(cabinet(LAYOUT))
    door = scene.parts["door"]
    lower = replace(door, surfaces=tuple(s.transformed(translation(vec3(0.0, 0.0, -0.3))) for s in door.surfaces))
    assert scene.replaced([lower]).floor == pytest.approx(float(lower.box.low[2]))
    assert scene_of(moved(cabinet(LAYOUT), 1.2)).floor == Scene({}, {}, 0.0).floor == 0.0  # hung on a wall


def test_doors_drawers_and_handles_meet_the_same_obstacles():
    asset = cabinet(LAYOUT)
    scene, config = scene_of(asset), RealizationConfig()
    requests = {r.moving: r for r in plan_from_annotation(asset).joints}
    door, drawer = (door_search(requests["door"], scene, config), drawer_search(requests["drawer"], scene, config))
    to_handles = handle_obstacles(scene)
    assert drawer is not None
    for some in (door.obstacles, drawer.obstacles, to_handles.still):
        assert len(some) == len(scene.still_obstacles) > 4
        assert all(one is other for one, other in zip(some, scene.still_obstacles, strict=True))
    assert [o.id for o in to_handles.moving["door"]] == list(scene.moving_bodies["door"].members)
    assert to_handles.moving["door"] is scene.body_obstacles("door")
    assert door.neighbours[0] is scene.other_bodies("door")[0]


def test_obstacles_of_named_parts_alone():
    scene = scene_of(cabinet(LAYOUT))
    names = [o.id for o in scene.static_obstacles][:2]
    assert [o.id for o in scene.static_obstacles_of(names)] == names
    assert scene.static_obstacles_of(()) is scene.static_obstacles


def test_a_piece_is_closed_once_for_all_steps():
    asset = cabinet(LAYOUT)
    plan = plan_from_annotation(asset)
    scene = planned_scene(asset, plan)
    assert closed_scene(scene, plan) is closed_scene(scene, plan.with_attached(()))
    ajar = replace(plan, joints=tuple(replace(r, drawn_at=0.1) for r in plan.joints))
    closed = closed_scene(scene, ajar).scene
    drawer = next(p.id for p in asset.parts if p.label is PartLabel.DRAWER)
    shift = closed.parts[drawer].box.center - scene.parts[drawer].box.center
    np.testing.assert_allclose(shift, (0.0, 0.1, 0.0), atol=1e-9)
