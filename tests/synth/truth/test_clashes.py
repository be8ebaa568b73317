"""Sweeps of single joints: thin things in the path, solids within solids, meshes that are no boxes, open neighbours."""

import gc
from dataclasses import replace

import numpy as np
import pytest

from grafu.articulation.articulated_object import Coupling
from grafu.articulation.sweep import opening_stages
from grafu.asset.edit import yawed
from grafu.asset.part import AnnotatedJoint, Asset, Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.cabinets.folding import FoldingDoors, make_folding_doors
from grafu.synth.fronts.layout import Door, Drawer, Pair, Stack
from grafu.synth.noise.edits import with_doubled_faces, with_loose_faces, with_open_backs
from grafu.synth.pieces.shapes import turned
from grafu.synth.samples import KINDS, TIDY
from grafu.synth.truth import clashes as module
from grafu.synth.truth.clashes import articulated_of, clashes_of
from grafu.synth.truth.swept_pieces import DEPTH
from grafu.vocabulary import JointType, PartLabel


def block(low, high) -> TriangleMesh:
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


def part(name: str, mesh: TriangleMesh, label: PartLabel = PartLabel.BAR) -> Part:
    return Part(name, label, (Surface(mesh),), PartSource(name))


FRONT = part("drawer", block([0, 0, 0], [0.4, 0.018, 0.2]), PartLabel.DRAWER)
SLIDE = AnnotatedJoint("drawer", JointType.PRISMATIC, Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0)), 0.0, 0.4)


def before(*others: Part) -> Asset:
    return Asset("thing", "", "made", (FRONT, *others), joints=(SLIDE,))


@pytest.mark.parametrize("at", np.linspace(-0.39, -0.01, 9).tolist())
def test_the_thinnest_board_on_a_slide_is_met(at):
    board = part("board", block([0.1, at, 0.05], [0.2, at + 0.003, 0.1]))
    assert clashes_of(before(board)).hits("drawer") == {"board"}


@pytest.mark.parametrize("yaw", [0.3, np.pi / 2, 2.0])
def test_it_is_met_in_furniture_that_stands_askew(yaw):
    board = part("board", block([0.1, -0.2, 0.05], [0.2, -0.197, 0.1]))
    assert clashes_of(yawed(before(board), yaw)).hits("drawer") == {"board"}


def test_a_bar_that_is_no_box_is_met_by_its_mesh():
    near = part("near", turned(vec3(0.2, -0.1, -0.5), vec3(0.2, -0.1, 0.7), ((0.0, 0.02), (1.0, 0.02))))
    below = part("below", turned(vec3(0.2, -0.1, -0.5), vec3(0.2, -0.1, -0.002), ((0.0, 0.02), (1.0, 0.02))))
    assert clashes_of(before(near)).hits("drawer") == {"near"}
    assert clashes_of(before(below)).hits("drawer") == frozenset()


def test_a_box_wholly_within_the_moving_part_is_met():
    inner = part("inner", block([0.1, 0.004, 0.05], [0.2, 0.014, 0.1]))
    assert clashes_of(before(inner)).hits("drawer") == {"inner"}


@pytest.mark.parametrize(("sunk", "met"), [(0.0, False), (0.8 * DEPTH, False), (1.2 * DEPTH, True)])
def test_a_touch_is_no_clash(sunk, met):
    wall = part("wall", block([-0.1, -1, 0], [sunk, 1, 1]))
    assert bool(clashes_of(before(wall)).hits("drawer")) is met


@pytest.mark.parametrize("edit", [with_doubled_faces, with_loose_faces, with_open_backs])
def test_noisy_boards_are_met_like_clean_ones(edit):
    board = part("board", block([0.1, -0.2, -0.05], [0.2, -0.1, 0.1]))
    assert clashes_of(edit(before(board))).hits("drawer") == {"board"}


def test_what_is_behind_doors_meets_them_closed_and_not_open():
    clashes = clashes_of(make_cabinet(Cabinet(layout=Pair(behind=Drawer(handle="none")))))
    assert clashes.bodies_hit("drawer") == ("door_1", "door_2")
    assert clashes.hits("drawer", ("door_1",)) >= {"door_2"}
    assert clashes.hits("drawer", ("door_1", "door_2")) == frozenset()


def test_what_rides_counts_as_what_it_rides_on():
    knob = replace(part("knob", block([0.1, -0.03, 0.1], [0.12, 0, 0.12]), PartLabel.HANDLE), carried_by="drawer")
    bar = part("bar", block([0.11, -0.5, 0.11], [0.13, -0.41, 0.13]))
    assert clashes_of(before(knob, bar)).hits("drawer") == {"bar"}
    assert clashes_of(before(bar)).hits("drawer") == frozenset()


def test_an_asset_is_worked_out_once_and_forgotten_with_it():
    asset = before()
    known = len(module._known)
    assert clashes_of(asset) is clashes_of(asset)
    assert len(module._known) == known + 1
    del asset
    gc.collect()
    assert len(module._known) <= known


@pytest.mark.parametrize("name", list(KINDS)[::4])
def test_each_joint_becomes_a_link_and_the_rest_is_the_root(name):
    asset = KINDS[name]()
    made = articulated_of(asset)
    assert [j.child for j in made.joints] == [j.part for j in asset.joints]
    assert sorted(v.name for link in made.links for v in link.visuals) == sorted(p.id for p in asset.parts)
    for part in asset.parts:
        carrier = part.carried_by or part.id
        link = carrier if carrier in made.joint_of else made.root
        assert part.id in [v.name for v in made.link(link).visuals]


def test_joints_open_from_zero_to_their_upper_limit_about_their_axis():
    asset = TIDY["desk with a pedestal"]()
    for stated, joint in zip(asset.joints, articulated_of(asset).joints, strict=True):
        assert (joint.type, joint.axis) == (stated.type, stated.axis)
        assert (joint.limits.lower, joint.limits.upper) == (0.0, stated.upper)


@pytest.mark.parametrize("mount", ["overlay", "inset"])
def test_drawers_behind_a_pair_wait_for_both_doors(mount):
    inner = Stack((Drawer(), Drawer(handle="none")), between="nothing")
    made = articulated_of(make_cabinet(Cabinet(layout=Pair(behind=inner), mount=mount)))
    after = {j.child: j.after for j in made.joints}
    doors = ("door_1_joint", "door_2_joint")
    assert after == {"door_1": (), "door_2": (), "drawer_1": doors, "drawer_2": doors}
    assert opening_stages(made) == (doors, ("drawer_1_joint", "drawer_2_joint"))


def test_a_door_in_the_way_whether_open_or_closed_is_not_waited_for():
    asset = make_cabinet(Cabinet(layout=Door(behind=Stack((Drawer(),) * 2))))
    stuck = replace(asset, joints=tuple(replace(j, upper=0.05) if j.part == "door" else j for j in asset.joints))
    assert all(j.after == () for j in articulated_of(stuck).joints)


def test_what_follows_a_part_is_not_waited_for_by_it():
    tongue = part("half", block([0.1, -0.1, 0.05], [0.2, -0.09, 0.1]), PartLabel.DRAWER)  # in the way while closed
    away = AnnotatedJoint("half", JointType.PRISMATIC, Axis(vec3(0.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0)), 0.0, 0.5)
    asset = Asset("thing", "", "made", (FRONT, tongue), joints=(SLIDE, away))
    assert {j.child: j.after for j in articulated_of(asset).joints} == {"drawer": ("half_joint",), "half": ()}
    led = replace(asset, joints=(SLIDE, replace(away, coupling=Coupling("drawer"))))
    assert opening_stages(articulated_of(led)) == (("drawer_joint", "half_joint"),)


def test_a_part_named_like_the_root_keeps_its_name():
    asset = make_cabinet(Cabinet())
    parts = tuple(replace(p, id="body") if p.id == "back_panel" else p for p in asset.parts)
    made = articulated_of(replace(asset, parts=parts))
    assert made.root == "body_"
    assert "body" in [v.name for v in made.link("body_").visuals]


def test_two_joints_of_one_part_are_refused():
    asset = make_cabinet(Cabinet(layout=Door()))
    with pytest.raises(ValueError, match="a part of its own"):
        articulated_of(replace(asset, joints=asset.joints * 2))


@pytest.mark.parametrize("leaves", [2, 4])
def test_folding_leaves_hang_on_one_another_and_follow(leaves):
    made = articulated_of(make_folding_doors(FoldingDoors(leaves=leaves)))
    inner = [joint for joint in made.joints if joint.coupling is not None]
    assert len(inner) == leaves // 2
    for joint in inner:
        outer = made.joint_of[joint.parent]
        assert (joint.coupling.leader, joint.coupling.multiplier, outer.parent) == (outer.id, 2.0, made.root)


def test_a_folding_leaf_is_swept_with_the_one_that_it_hangs_on():
    asset = make_folding_doors(FoldingDoors(leaves=2, side="left"))
    free = clashes_of(asset)
    assert free.hits("door_1") == free.hits("door_2") == frozenset()
    outer = asset.part("door_1").box
    x, y, z = float(outer.high[0]), float(outer.low[1]) - 0.25, float(outer.center[2])
    post = part("post", block([x - 0.05, y, z], [x + 0.2, y + 0.05, z + 0.1]))  # only the inner leaf passes there
    assert clashes_of(replace(asset, parts=(*asset.parts, post))).hits("door_1") == {"post"}


def test_still_furniture_is_one_link():
    asset = make_cabinet(Cabinet()).without_annotation()
    made = articulated_of(asset)
    assert len(made.links) == 1
    assert np.allclose(made.link("body").mesh.box.low, asset.box.low)
