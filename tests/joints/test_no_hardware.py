"""Doors and drawers that move freely where no hardware finds room: they get their joint, and the report states so."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from grafu.asset.part import Part
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.config import RealizationConfig
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.no_hardware import DRAWN, NO_HARDWARE
from grafu.joints.plan import JointChoice
from grafu.joints.realize import realize
from grafu.refusal import Reason
from grafu.vocabulary import MechanismClass, PartLabel
from judging import GALLERY, hardware, installed, realized
from small_scenes import DOOR, box, hinged, scene, sliding

NO_HINGES = replace(GALLERY, hinges=(), concealed=())
# It ends far below the door's upper end and above its lower one: pivots find no hold there.
POST = box("post", (-0.02, 0.0, 0.2), (0.0, 0.4, 0.4))
CASE = (
    box("left", (-0.02, -0.4, 0.0), (0.0, 0.0, 0.3)),
    box("right", (0.4, -0.4, 0.0), (0.42, 0.0, 0.3)),
    box("bottom", (-0.02, -0.4, -0.02), (0.42, 0.0, 0.0)),
    box("top", (-0.02, -0.4, 0.3), (0.42, 0.0, 0.32)),
    box("back", (-0.02, 0.0, -0.02), (0.42, 0.02, 0.32)),
)
# It fills its opening to the last tenth of a millimetre, and nothing may be trimmed.
DRAWER = box("drawer", (0.0, -0.4, 0.0), (0.4, 0.0, 0.3))
UNTRIMMED = RealizationConfig(trim=False)


def skipped(result) -> dict[str, Reason]:
    return {s.part: s.reason for s in result.report.skipped}


def hung(*parts, choice: JointChoice | None = None):
    asset = scene(*parts, joints=(hinged(),))
    plan = plan_from_annotation(asset)
    chosen = tuple(replace(joint, choice=choice or joint.choice) for joint in plan.joints)
    return realize(replace(plan, joints=chosen), asset, NO_HINGES)


def test_a_door_for_which_no_hinge_fits_turns_without_one():
    result = hung(DOOR, POST)

    joint = installed(result)["door"]
    assert (joint.template, joint.mechanism, joint.count) == (NO_HARDWARE, MechanismClass.NONE, 0)
    assert hardware(result, "door") == ([], [])
    assert joint.mount == "post"
    assert joint.opening > 1.5
    assert joint.collision_share == 0
    assert joint.largest_gap < 0.001
    assert joint.notes == ("no hinge or rail finds room: it moves without hardware",)


def test_a_drawer_without_room_for_rails_slides_without_them():
    result = realized(scene(DRAWER, *CASE, joints=(sliding("drawer", (0.0, -1.0, 0.0)),)), UNTRIMMED)

    joint = installed(result)["drawer"]
    assert (joint.template, joint.count, joint.restricted) == (NO_HARDWARE, 0, False)
    assert joint.opening >= 0.3


@pytest.mark.parametrize(("width", "slides"), [(0.4, True), (0.06, False)], ids=["a drawer", "a side of one"])
def test_a_single_board_of_a_drawer_does_not_slide_alone(width, slides):
    drawer = box("drawer", (0.0, -0.4, 0.0), (width, 0.0, 0.3))
    case = [
        box("left", (-0.02, -0.4, 0.0), (0.0, 0.0, 0.3)),
        box("right", (width, -0.4, 0.0), (width + 0.02, 0.0, 0.3)),
        box("bottom", (-0.02, -0.4, -0.02), (width + 0.02, 0.0, 0.0)),
        box("top", (-0.02, -0.4, 0.3), (width + 0.02, 0.0, 0.32)),
    ]
    result = realized(scene(drawer, *case, joints=(sliding("drawer", (0.0, -1.0, 0.0)),)), UNTRIMMED)

    assert ("drawer" in installed(result)) is slides
    assert slides or skipped(result) == {"drawer": Reason.NO_ROOM}


def test_a_board_that_fills_its_opening_does_not_slide_out_of_it():
    panel = box("drawer", (0.0, -0.006, 0.0), (0.4, 0.0, 0.3))
    case = [part for part in CASE if part.id != "back"]
    result = realized(scene(panel, *case, joints=(sliding("drawer", (0.0, -1.0, 0.0), 0.004),)), UNTRIMMED)

    assert skipped(result) == {"drawer": Reason.NO_ROOM}


@pytest.mark.parametrize(("name", "slides"), [("door", True), ("drawer", False)])
def test_the_leaf_of_a_sliding_door_slides_without_tracks_and_no_board_of_a_drawer_does(name, slides):
    """It stands in a case all around it, open at one end, and there is no track."""
    leaf = box(name, (0.0, -0.02, 0.0), (0.8, 0.02, 2.0))
    case = [box(f"wall_{k}", (0.0, y, -0.03), (1.6, y + 0.03, 2.03)) for k, y in enumerate((-0.0501, 0.0201))]
    case += [box(f"end_{k}", (0.0, -0.0201, z), (1.6, 0.0201, z + 0.03)) for k, z in enumerate((-0.0301, 2.0001))]
    asset = scene(leaf, *case, joints=(sliding(name, (1.0, 0.0, 0.0), 0.7),))
    result = realize(plan_from_annotation(asset), asset, replace(GALLERY, rails=()), UNTRIMMED)

    assert ([joint.template for joint in installed(result).values()] == [NO_HARDWARE]) is slides


@pytest.mark.parametrize(("has_handle", "is_case"), [(True, False), (True, True), (False, True)])
def test_what_is_only_guessed_to_be_a_drawer_is_one_without_rails_if_it_has_a_handle_and_is_no_case(
    has_handle, is_case
):
    guessed = replace(DRAWER, label=PartLabel.UNKNOWN, labelled_by="none")
    handle = [box("handle", (0.15, -0.43, 0.14), (0.25, -0.4, 0.16), "drawer")] if has_handle else []
    boards = [(-0.02, 0.0), (0.3, 0.32)]  # above and below it, and as wide as it
    plates = [box(f"plate_{k}", (0.0, -0.4, low), (0.4, 0.0, high)) for k, (low, high) in enumerate(boards)]
    asset = scene(guessed, *handle, *(plates if is_case else CASE), joints=(sliding("drawer", (0.0, -1.0, 0.0)),))

    assert skipped(realized(asset, UNTRIMMED)) == ({} if has_handle and not is_case else {"drawer": Reason.NO_ROOM})


def tub(name: str, low, high, thick: float = 0.02) -> Part:
    """Returns a box with walls and a floor, open from above, of unknown kind."""
    outer = trimesh.creation.box(bounds=(low, high))
    inner = trimesh.creation.box(bounds=(np.add(low, thick), (high[0] - thick, high[1] - thick, high[2] + 1.0)))
    mesh = trimesh.boolean.difference([outer, inner], engine="manifold")
    surface = Surface(TriangleMesh(np.asarray(mesh.vertices), np.asarray(mesh.faces)))
    return replace(DRAWER, id=name, surfaces=(surface,), label=PartLabel.UNKNOWN, labelled_by="none")


@pytest.mark.parametrize(
    ("lid", "gap", "walls", "slides"),
    [
        (False, 0.004, CASE, True),
        (False, 0.004, CASE[:1], True),
        (True, 0.004, CASE, True),
        (True, 0.004, CASE[:1], False),
        (False, 0.02, CASE, False),
    ],
    ids=["a box in a case", "a box at a wall", "a closed box in a case", "a closed box at a wall", "far from its case"],
)
def test_what_is_only_guessed_to_be_a_drawer_is_one_without_rails_if_it_is_an_open_box_or_stands_in_its_case(
    lid, gap, walls, slides
):
    body = tub("drawer", (gap, -0.4, gap), (0.4 - gap, -gap, 0.3 - gap))
    cover = box("cover", (gap, -0.4, 0.28 - gap), (0.4 - gap, -gap, 0.3 - gap)).surfaces if lid else ()
    asset = scene(
        replace(body, surfaces=(*body.surfaces, *cover)), *walls, joints=(sliding("drawer", (0.0, -1.0, 0.0)),)
    )
    result = realize(plan_from_annotation(asset), asset, replace(GALLERY, rails=()), UNTRIMMED)
    assert set(skipped(result)) == (set() if slides else {"drawer"})


def test_a_door_that_would_come_away_from_everything_gets_no_joint():
    away = box("post", (-0.02, 0.006, 0.2), (0.0, 0.4, 0.4))

    assert skipped(hung(DOOR, away)) == {"door": Reason.NO_ROOM}


@pytest.mark.parametrize("choice", [JointChoice(count=3), JointChoice(template="butt")])
def test_hardware_that_was_chosen_is_not_left_out(choice):
    assert skipped(hung(DOOR, POST, choice=choice)) == {"door": Reason.NO_ROOM}


def test_hardware_cannot_be_chosen_away():
    with pytest.raises(ValueError, match="must be a class of hinges or rails"):
        JointChoice(mechanism=MechanismClass.NONE)


def knuckle(name: str, low: float, high: float, x: float = -0.006, radius: float = 0.006) -> Part:
    """A barrel of a hinge along the door's left border, before its front."""
    tube = trimesh.creation.cylinder(radius=radius, height=high - low, sections=24)
    tube.apply_translation((x, -0.026, (low + high) / 2))
    return replace(box(name, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=(Surface(TriangleMesh.from_trimesh(tube)),))


SIDE_BEHIND = box("side", (-0.02, 0.001, 0.0), (0.02, 0.4, 0.6))


def test_a_door_turns_on_the_hinges_that_are_drawn():
    """The pin is that of the barrels, and no hinge is added beside them."""
    barrels = [knuckle("knuckle_1", 0.08, 0.14), knuckle("knuckle_2", 0.46, 0.52)]
    result = realized(scene(DOOR, SIDE_BEHIND, *barrels, joints=(hinged(),)))

    joint = installed(result)["door"]
    assert (joint.template, joint.mechanism, joint.count) == (DRAWN, MechanismClass.NONE, 0)
    assert hardware(result, "door") == ([], [])
    np.testing.assert_allclose(joint.axis.point[:2], (-0.006, -0.026), atol=1e-4)
    assert joint.collision_share == 0.0
    assert joint.opening > 1.5


@pytest.mark.parametrize(
    "barrels",
    [
        [knuckle("knuckle_1", 0.08, 0.14)],
        [knuckle("knuckle_1", 0.08, 0.14), knuckle("knuckle_2", 0.16, 0.22)],
        [knuckle("knuckle_1", 0.08, 0.14), knuckle("knuckle_2", 0.46, 0.52, x=-0.012)],
        [knuckle("post_1", 0.08, 0.14, x=-0.05, radius=0.04), knuckle("post_2", 0.46, 0.52, x=-0.05, radius=0.04)],
    ],
    ids=["one", "side by side", "two lines", "thick"],
)
def test_round_things_that_are_no_pair_of_hinges_carry_no_door(barrels):
    result = realized(scene(DOOR, SIDE_BEHIND, *barrels, joints=(hinged(),)))
    assert installed(result)["door"].template != DRAWN


def test_hinges_that_were_chosen_are_built_beside_drawn_ones():
    barrels = [knuckle("knuckle_1", 0.08, 0.14), knuckle("knuckle_2", 0.46, 0.52)]
    asset = scene(DOOR, SIDE_BEHIND, *barrels, joints=(hinged(),))
    plan = plan_from_annotation(asset)
    chosen = tuple(replace(joint, choice=JointChoice(count=2)) for joint in plan.joints)
    assert installed(realize(replace(plan, joints=chosen), asset, GALLERY))["door"].template != DRAWN


@pytest.mark.parametrize(("source", "is_built"), [("rule", True), ("network", False)])
def test_what_shape_tells_to_move_waits_for_what_lies_over_it(source, is_built):
    """A strip on the left door covers the edge of the right one; only flaps and the like are built without hinges."""
    strip = box("handle_strip", (0.39, -0.03, 0.0), (0.43, -0.02, 0.6), carried_by="door")
    right = box("door_2", (0.405, -0.02, 0.0), (0.8, 0.0, 0.6))
    far = box("far_post", (0.8, 0.0, 0.2), (0.82, 0.4, 0.4))
    axis = Axis(vec3(0.8, 0.0, 0.0), vec3(0.0, 0.0, 1.0))
    asset = scene(DOOR, POST, strip, right, far, joints=(hinged(), hinged("door_2", axis)))
    plan = plan_from_annotation(asset)
    told = tuple(replace(joint, source=source) for joint in plan.joints)

    found = installed(realize(replace(plan, joints=told), asset, NO_HINGES))

    assert ("door_2" in found) == is_built
    if is_built:
        assert found["door_2"].after == ("door_joint",)
