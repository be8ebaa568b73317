"""Handles where one moving body waits for another: doors that must be open before the drawers behind them can move."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest
import trimesh

from front_scenes import cabinet, scene_of, without_handles
from grafu.additions.handle.grasp import find_grasps
from grafu.additions.handle.place import add_handles
from grafu.geometry.intersection import MeshCollider
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.scene.scene import JointMotion, Scene
from grafu.synth.fronts.layout import Door, Drawer, Pair, Stack
from grafu.synth.samples import KINDS
from grafu.templates.gallery import builtin_gallery

BEHIND = ("drawers behind a pair", "drawers behind an inset door")
POSES = 40


def behind_a_door() -> Scene:
    """Two drawers without handles, as high as the inset door before them."""
    return scene_of(without_handles(KINDS["drawers behind an inset door"]()))


def with_way(scene: Scene, moving: str, **changes) -> Scene:
    return replace(
        scene, joint_motions={**scene.joint_motions, moving: replace(scene.joint_motions[moving], **changes)}
    )


def at(joint_motion: JointMotion, value: float) -> np.ndarray:
    return joint_motion.kind.transform(joint_motion.axis, value)


def posed(meshes, T: np.ndarray) -> trimesh.collision.CollisionManager:
    manager = trimesh.collision.CollisionManager()
    for number, mesh in enumerate(meshes):
        manager.add_object(str(number), mesh.to_trimesh(), transform=T)
    return manager


def meshes_of(scene: Scene, moving: str):
    return [scene.parts[member].mesh for member in scene.moving_bodies[moving].members]


def meets(scene: Scene, moving: str, other: str, value: float) -> bool:
    """Whether anything on a moving body meets another moving body, fixed at a joint value, along its whole path."""
    fixed = posed(meshes_of(scene, other), at(scene.joint_motions[other], value))
    joint_motion = scene.joint_motions[moving]
    poses = [at(joint_motion, v) for v in np.linspace(0.0, joint_motion.upper, POSES)]
    return any(fixed.in_collision_single(m.to_trimesh(), transform=T) for m in meshes_of(scene, moving) for T in poses)


def free_travel(scene: Scene, moving: str, other: str, value: float) -> float:
    """How far a bare moving body comes before it meets another one that is fixed at a joint value."""
    steps = np.linspace(0.0, scene.joint_motions[moving].upper, 120)
    joint_motions = [with_way(scene, moving, upper=float(v)) for v in steps]
    return next(
        (float(steps[k - 1]) for k, s in enumerate(joint_motions) if k and meets(s, moving, other, value)), steps[-1]
    )


def test_a_drawers_handle_is_clear_of_a_door_that_opens_little():
    scene = with_way(behind_a_door(), "door", upper=radians(55))
    travel = free_travel(scene, "drawer_1", "door", radians(55))
    assert 0.02 < travel < 0.2
    scene = with_way(with_way(scene, "drawer_1", upper=travel), "drawer_2", upper=travel)
    handles = add_handles(scene, find_grasps(scene))
    assert all(not meets(handles.scene, drawer, "door", radians(55)) for drawer in ("drawer_1", "drawer_2"))
    held = {a.part.carried_by for a in handles.additions} | {refused.part for refused in handles.refused}
    assert {"drawer_1", "drawer_2"} <= held


def test_a_handle_does_not_run_into_a_door_that_nobody_opens_first():
    scene = with_way(with_way(behind_a_door(), "drawer_1", after=()), "drawer_2", after=())
    travel = free_travel(scene, "drawer_1", "door", 0.0)
    scene = with_way(with_way(scene, "drawer_1", upper=travel), "drawer_2", upper=travel)
    handles = add_handles(scene, find_grasps(scene))
    assert all(not meets(handles.scene, drawer, "door", 0.0) for drawer in ("drawer_1", "drawer_2"))


@pytest.mark.parametrize("layout", [Door(behind=Stack((Drawer(handle="none"),) * 3)), Pair(behind=Drawer())])
def test_a_doors_handle_sits_as_if_nothing_were_behind_the_door(layout):
    """Drawers come out when the door is open: what they pass is not where its handle is then."""
    plain = without_handles(cabinet(replace(layout, behind=None), mount="inset"))
    full = without_handles(cabinet(layout, mount="inset"))
    doors = [joint.part for joint in plain.joints]
    at_rest = []
    for asset in (plain, full):
        scene = scene_of(asset)
        found = {a.part.carried_by: a.part.box for a in add_handles(scene, find_grasps(scene)).additions}
        at_rest.append([found[door] for door in doors])
    for alone, before in zip(*at_rest, strict=True):
        assert before.center[0] == pytest.approx(alone.center[0], abs=1e-3)  # its length is that of all fronts' median


@pytest.mark.parametrize("kind", BEHIND)
def test_whole_furniture_opens_in_order_with_its_new_handles(kind):
    made = functionalize(without_handles(KINDS[kind]()), MotionSource.ANNOTATION, builtin_gallery())
    scene = made.fittings.scene
    waiting = {moving: joint_motion.after for moving, joint_motion in scene.joint_motions.items() if joint_motion.after}
    assert waiting
    carved = {c.part.id for c in made.fittings.changes.carved}
    assert waiting.keys() <= {a.part.carried_by for a in made.additions} | carved
    assert "none" not in {g.kind for g in find_grasps(scene).values()}
    for moving, before in waiting.items():
        for door in before:
            assert not meets(scene, moving, door, scene.joint_motions[door].upper)
            handles = [a.part.mesh for a in made.additions if a.part.carried_by == moving]
            closed = [MeshCollider(mesh) for mesh in meshes_of(scene, door)]
            assert all(MeshCollider(h).distance(c) > 0 for h in handles for c in closed)


def test_the_final_scene_says_what_opens_first():
    made = functionalize(KINDS["drawers behind a pair"](), MotionSource.ANNOTATION, builtin_gallery())
    found = {
        moving: {f"{name}_joint" for name in joint_motion.after}
        for moving, joint_motion in made.fittings.scene.joint_motions.items()
    }
    assert found == {joint.child: set(joint.after) for joint in made.object.joints}
