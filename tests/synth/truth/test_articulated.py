from dataclasses import replace

import numpy as np
import pytest

from grafu.articulation.sweep import opening_stages
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.fronts.layout import Door, Drawer, Pair, Stack
from grafu.synth.kinds import KINDS, TIDY
from grafu.synth.truth.articulated import articulated_of


@pytest.mark.parametrize("name", list(KINDS)[::4])
def test_each_joint_becomes_a_link_and_the_rest_is_the_root(name):
    asset = KINDS[name]()
    made = articulated_of(asset)
    assert [j.child for j in made.joints] == [j.part for j in asset.joints]
    assert sorted(v.name for link in made.links for v in link.visuals) == sorted(p.id for p in asset.parts)
    for part in asset.parts:
        carrier = part.rides_on or part.id
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


def test_a_part_named_like_the_root_keeps_its_name():
    asset = make_cabinet(Cabinet())
    parts = tuple(replace(p, id="body") if p.id == "back_panel" else p for p in asset.parts)
    made = articulated_of(replace(asset, parts=parts))
    assert made.root == "body_"
    assert "body" in [v.name for v in made.link("body_").visuals]


def test_a_joint_on_what_rides_is_refused():
    asset = make_cabinet(Cabinet(layout=Door()))
    on_handle = replace(asset.joints[0], part="handle")
    with pytest.raises(ValueError, match="rides on nothing"):
        articulated_of(replace(asset, joints=(*asset.joints, on_handle)))


def test_still_furniture_is_one_link():
    asset = make_cabinet(Cabinet()).without_annotation()
    made = articulated_of(asset)
    assert len(made.links) == 1
    assert np.allclose(made.link("body").mesh.box.low, asset.box.low)
