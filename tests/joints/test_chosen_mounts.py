"""A mount that is chosen carries the joint, or the joint is refused by the mount's name: never is it another part."""

import pytest

from grafu.asset.part import Asset
from grafu.errors import OptionError
from grafu.geometry.intersection import MeshCollider
from grafu.joints.config import RealizationConfig
from grafu.joints.joint_choice import with_choices
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.plan import JointChoice
from grafu.joints.realize import Realized, realize
from grafu.joints.report import Installed
from grafu.refusal import Refusal
from grafu.vocabulary import JointType
from judging import GALLERY, hardware, made_kind, swept_collisions
from small_scenes import DOOR, SIDE, box, drawer, hinged, scene

RIGHT = box("right", (0.4, 0.0, 0.0), (0.42, 0.4, 0.6))


def outcome(asset: Asset, part: str, **choice) -> tuple[Realized, Installed | Refusal]:
    plan = with_choices(plan_from_annotation(asset), {part: JointChoice(**choice)}, asset, GALLERY)
    result = realize(plan, asset, GALLERY)
    (found,) = [o for o in result.report.outcomes if part in (getattr(o, "moving", ""), getattr(o, "part", ""))]
    return result, found


def touches(result: Realized, asset: Asset, part: str, mount: str) -> bool:
    """Whether static hardware of the part's joint sits on the mount as it was built."""
    static = next(v for v in result.object.link(result.object.root).visuals if v.name == mount)
    within = RealizationConfig().anchor * asset.extent
    _, still = hardware(result, part)
    return any(MeshCollider(v.mesh).is_within(within, MeshCollider(static.mesh)) for v in still)


@pytest.mark.parametrize("kind", ["overlay door, hinged right", "chest with a lid"])
def test_every_still_part_carries_the_joint_or_is_refused_by_name(kind):
    asset = made_kind(kind)
    moving = {r.moving for r in plan_from_annotation(asset).joints} | {p.id for p in asset.parts if p.carried_by}
    part = next(j.part for j in asset.joints)
    carried = 0
    for mount in (p.id for p in asset.parts if p.id not in moving):
        result, made = outcome(asset, part, mount=mount)
        if isinstance(made, Refusal):
            assert f"on `{mount}`" in made.why or "can carry" in made.why or "allows no" in made.why
            continue
        assert made.mount == mount
        assert touches(result, asset, part, mount)
        assert max(swept_collisions(result.object, result.object.joint_of[part]).values(), default=0.0) < 1e-3
        carried += 1
    assert carried


def test_a_door_hangs_at_the_border_by_which_its_mount_stands():
    asset = scene(DOOR, SIDE, RIGHT, joints=(hinged(),))
    places = {mount: outcome(asset, "door", mount=mount)[1].axis.point[0] for mount in ("side", "right")}
    assert places["side"] < 0.05
    assert places["right"] > 0.35


def test_what_stands_too_far_off_carries_nothing():
    far = box("far", (0.6, 0.0, 0.0), (0.62, 0.4, 0.6))
    _, made = outcome(scene(DOOR, SIDE, far, joints=(hinged(),)), "door", mount="far")
    assert isinstance(made, Refusal)
    assert "on `far`" in made.why


@pytest.mark.parametrize("mount", ["side_left", "side_right"])
def test_one_of_two_rails_sits_on_the_chosen_wall(mount):
    asset = drawer(gap=0.05)
    result, made = outcome(asset, "drawer", mount=mount)
    assert (made.type, made.mount) == (JointType.PRISMATIC, mount)
    assert touches(result, asset, "drawer", mount)


def test_a_mount_must_stand_still():
    asset = scene(DOOR, SIDE, box("handle", (0.3, -0.04, 0.2), (0.32, -0.02, 0.3), "door"), joints=(hinged(),))
    for mount, words in (("handle", "moves itself"), ("spoon", "is no part")):
        with pytest.raises(OptionError, match=words):
            outcome(asset, "door", mount=mount)
