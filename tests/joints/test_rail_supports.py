"""What holds rails away from walls, as it is chosen: a slab to the wall, an upright board, or nothing at all."""

import numpy as np
import pytest

from grafu.articulation.articulated_object import Visual
from grafu.asset.part import Asset
from grafu.errors import OptionError
from grafu.geometry.intersection import MeshCollider
from grafu.joints.joint_choice import with_choices
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.plan import JointChoice, Supports
from grafu.joints.realize import Realized, realize
from grafu.joints.report import Installed
from grafu.refusal import Refusal
from grafu.vocabulary import MechanismClass
from judging import GALLERY, hardware, swept_collisions
from small_scenes import DOOR, SIDE, box, drawer, hinged, scene, sliding


def built(asset: Asset, supports: Supports, **choice) -> Realized:
    choices = {"drawer": JointChoice(supports=supports, **choice)}
    return realize(with_choices(plan_from_annotation(asset), choices, asset, GALLERY), asset, GALLERY)


def closed_case(gap: float = 0.08) -> Asset:
    """The drawer of `drawer` with a floor below and a board above."""
    asset, w = drawer(gap), 0.2 + gap
    boards = [box(name, (-w, -0.2, z), (w, 0.25, z + 0.02)) for name, z in (("floor", -0.02), ("cover", 0.2))]
    return scene(*asset.parts, *boards, joints=asset.joints)


def supports_of(result: Realized) -> list[Visual]:
    return [v for v in hardware(result, "drawer")[1] if v.name.startswith("support_")]


def clean(result: Realized) -> bool:
    return max(swept_collisions(result.object, result.object.joint_of["drawer"]).values(), default=0.0) < 1e-3


@pytest.mark.parametrize("mechanism", [MechanismClass.CENTRE, MechanismClass.CORNER])
def test_slabs_reach_out_to_the_walls(mechanism):
    asset = closed_case()
    result = built(asset, Supports.SLAB, mechanism=mechanism)
    slabs = supports_of(result)
    assert len(slabs) == 2
    for slab, wall in zip(sorted(slabs, key=lambda v: v.mesh.box.center[0]), ("side_left", "side_right"), strict=True):
        assert MeshCollider(slab.mesh).is_within(1e-3, MeshCollider(asset.part(wall).mesh))
        assert slab.mesh.box.size[1] > 0.3
    assert clean(result)


@pytest.mark.parametrize("mechanism", [MechanismClass.CENTRE, MechanismClass.CORNER])
def test_dividers_stand_from_floor_to_cover(mechanism):
    asset = closed_case()
    result = built(asset, Supports.DIVIDER, mechanism=mechanism)
    boards = supports_of(result)
    rails = [v.mesh for v in hardware(result, "drawer")[1] if v.name.startswith("rail_")]
    assert len(boards) == 2
    for board in boards:
        size = board.mesh.box.size
        assert size[2] == pytest.approx(0.2, abs=2e-3)
        assert size[0] == pytest.approx(0.016, abs=1e-3)
        assert any(MeshCollider(board.mesh).is_within(1e-3, MeshCollider(rail)) for rail in rails)
        for name in ("floor", "cover"):
            assert MeshCollider(board.mesh).is_within(1e-3, MeshCollider(asset.part(name).mesh))
    assert clean(result)


def test_a_divider_without_a_cover_ends_with_the_rail():
    asset = closed_case()
    bare = scene(*(p for p in asset.parts if p.id != "cover"), joints=asset.joints)
    result = built(bare, Supports.DIVIDER)
    rails = [v.mesh.box.high[2] for v in hardware(result, "drawer")[1] if v.name.startswith("rail_")]
    for board in supports_of(result):
        assert board.mesh.box.low[2] == pytest.approx(0.0, abs=1e-3)
        assert board.mesh.box.high[2] == pytest.approx(max(rails), abs=1e-3)


def test_without_supports_rails_stand_where_they_touch_walls_and_nowhere_else():
    near = built(drawer(), Supports.NONE)
    assert isinstance(near.report.outcomes[0], Installed)
    assert not supports_of(near)
    far = built(closed_case(), Supports.NONE)
    assert isinstance(far.report.outcomes[0], Refusal)
    assert "supports: none" in far.report.outcomes[0].why


@pytest.mark.parametrize("supports", list(Supports))
def test_rails_that_touch_walls_are_the_same_whatever_supports_are_chosen(supports):
    plain, chosen = (hardware(built(drawer(), s), "drawer")[1] for s in (Supports.AUTO, supports))
    assert [v.name for v in plain] == [v.name for v in chosen]
    assert all(np.allclose(a.mesh.vertices, b.mesh.vertices) for a, b in zip(plain, chosen, strict=True))


def test_two_drawers_one_above_the_other_share_their_dividers():
    low = box("drawer", (-0.2, -0.2, 0.02), (0.2, 0.2, 0.17))
    high = box("drawer_2", (-0.2, -0.2, 0.19), (0.2, 0.2, 0.34))
    sides = [box(f"side_{n}", (x, -0.2, -0.02), (x + 0.02, 0.25, 0.38)) for n, x in (("left", -0.32), ("right", 0.3))]
    boards = [box(n, (-0.3, -0.2, z), (0.3, 0.25, z + 0.02)) for n, z in (("floor", -0.02), ("cover", 0.36))]
    joints = (sliding("drawer", (0.0, -1.0, 0.0)), sliding("drawer_2", (0.0, -1.0, 0.0)))
    asset = scene(low, high, *sides, *boards, joints=joints)
    choices = dict.fromkeys(("drawer", "drawer_2"), JointChoice(supports=Supports.DIVIDER))
    result = realize(with_choices(plan_from_annotation(asset), choices, asset, GALLERY), asset, GALLERY)
    for made in result.report.installed:
        assert made.collision_share == 0.0
        assert max(swept_collisions(result.object, result.object.joint_of[made.moving]).values(), default=0.0) < 1e-3
    assert len(result.report.installed) == 2
    boards = [v.mesh.box for v in hardware(result, "drawer")[1] if v.name.startswith("support_")]
    assert sorted(float(board.center[0]) > 0 for board in boards) == [False, True]
    assert all(board.size[2] == pytest.approx(0.36, abs=2e-3) for board in boards)


def test_hinges_take_no_supports():
    asset = scene(DOOR, SIDE, joints=(hinged(),))
    choices = {"door": JointChoice(supports=Supports.SLAB)}
    with pytest.raises(OptionError, match="for rails"):
        with_choices(plan_from_annotation(asset), choices, asset, GALLERY)
