"""Bins behind doors at the side slide out once these are open; shelves, basins and small pots stay."""

from dataclasses import replace

import pytest

import grafu
from fold_judge import cuts
from grafu.asset.edit import mirrored
from grafu.asset.part import Asset
from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.transform import translation
from grafu.joints.waste_bins import is_bucket
from grafu.synth.cabinets.waste import WasteUnit, make_waste_unit
from grafu.vocabulary import JointType
from judging import swept_collisions
from small_scenes import box, cylinder

ON_RUNNERS = WasteUnit()
STANDING = WasteUnit(mount="inset", runners=False)


def unstated(asset: Asset) -> Asset:
    return replace(asset, joints=())


def require_bin(result: grafu.Result) -> None:
    """Raises AssertionError unless the bin slides out after the door, freely and far enough."""
    made = result.object
    joint, door = made.joint_of["container"], made.joint_of["door"]
    record = result.joint("container")

    assert (joint.type, joint.parent) == (JointType.PRISMATIC, "body")
    assert joint.after == (door.id,)
    assert joint.limits.upper > 0.6 * float(result.asset.part("container").box.size[1])
    assert not swept_collisions(made, joint, 15)
    assert cuts(made, {}) == set()
    assert record.grasp != "none"
    assert not any("container" in (one.part or "") for one in result.added)


@pytest.mark.parametrize("spec", [ON_RUNNERS, STANDING], ids=["on runners", "standing"])
def test_a_bin_slides_out_after_its_door(spec):
    require_bin(grafu.functionalize(unstated(make_waste_unit(spec)), motion="rule", motions={"door": "left"}))


def test_a_bin_slides_out_as_the_input_states():
    require_bin(grafu.functionalize(make_waste_unit(STANDING), motion="annotation"))


def test_a_small_bin_is_known_by_its_name_alone():
    small = replace(STANDING, tall=0.3, deep=0.3)
    for name, slides in (("container", False), ("waste_bin", True)):
        asset = unstated(make_waste_unit(replace(small, bin_name=name)))
        joints = grafu.functionalize(asset, motion="rule", motions={"door": "left"}).object.joint_of
        assert (name in joints) is slides


def test_what_hangs_high_is_a_basin():
    asset = make_waste_unit(STANDING)
    part = asset.part("container")
    up = translation(vec3(0.0, 0.0, 0.28))
    raised = replace(part, surfaces=tuple(surface.transformed(up) for surface in part.surfaces))
    parts = tuple(raised if one is part else one for one in asset.parts)
    made = grafu.functionalize(replace(asset, parts=parts, joints=()), motion="rule", motions={"door": "left"}).object

    assert "container" not in made.joint_of


def test_a_mirrored_unit_is_like_it():
    asset = mirrored(unstated(make_waste_unit(ON_RUNNERS)), "x")

    require_bin(grafu.functionalize(asset, motion="rule", motions={"door": "right"}))


def test_a_bucket_is_open_above_alone():
    bucket = make_waste_unit(ON_RUNNERS).part("container").mesh
    low, high = (tuple(float(x) for x in point) for point in (bucket.box.low, bucket.box.high))
    lid = box("lid", (low[0], low[1], high[2]), (high[0], high[1], high[2] + 0.002)).mesh
    floor = box("floor", low, (high[0], high[1], low[2] + 0.01)).mesh
    pipe = cylinder("pipe", ((0.0, 0.0, 0.0), (0.0, 0.0, 0.4)), 0.1).mesh

    assert is_bucket(bucket)
    assert not is_bucket(merge_meshes([bucket, lid]))
    assert not is_bucket(floor)
    assert not is_bucket(pipe)


def test_a_fraction_above_one_is_refused():
    with pytest.raises(ValueError, match="fractions between 0 and 1"):
        WasteUnit(tall=1.2)
