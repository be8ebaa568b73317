"""What is decided about a joint is built so, or not at all: the part stays still and the reason names the choice."""

from dataclasses import replace
from math import degrees, radians

import numpy as np
import pytest

from grafu.asset.part import Asset
from grafu.errors import OptionError
from grafu.joints.joint_choice import with_choices
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.plan import JointChoice
from grafu.joints.realize import Realized, realize
from grafu.joints.report import Installed
from grafu.refusal import Refusal
from grafu.vocabulary import MechanismClass
from judging import GALLERY, hardware, made_kind, swept_collisions
from small_scenes import DOOR, SIDE, box, drawer, hinged, scene

KIND = "overlay pair"
ALLOWS_NO_MORE = "`butt` or what stands around it allows no more"


def chosen(asset: Asset, **choices: JointChoice) -> Realized:
    return realize(with_choices(plan_from_annotation(asset), choices, asset, GALLERY), asset, GALLERY)


def outcome(result: Realized, part: str) -> Installed | Refusal:
    found = [o for o in result.report.installed if o.moving == part]
    return found[0] if found else next(o for o in result.report.skipped if o.part == part)


def clean(result: Realized, part: str) -> bool:
    joint = result.object.joint_of[part]
    return max(swept_collisions(result.object, joint).values(), default=0.0) < 1e-3


C, F, P = MechanismClass.C, MechanismClass.F, MechanismClass.P
FRAME = "overlay doors on a face frame"
NOT_OF_ITSELF = [(KIND, F), (KIND, P), ("inset pair", F), ("inset pair", P), (FRAME, C), (FRAME, F)]


@pytest.mark.parametrize(("kind", "mechanism"), NOT_OF_ITSELF)
def test_a_forced_class_is_built_and_free_or_refused_by_name(kind, mechanism):
    asset = made_kind(kind)
    result = chosen(asset, door_1=JointChoice(mechanism=mechanism))
    made = outcome(result, "door_1")
    assert outcome(result, "door_2").template
    if isinstance(made, Refusal):
        assert f"class {mechanism}" in made.why
    else:
        assert made.mechanism is mechanism
        assert clean(result, "door_1")


@pytest.mark.parametrize("model", [m.id for m in GALLERY.hinges_of(MechanismClass.C)])
def test_every_template_of_the_class_that_fits_can_be_had(model):
    result = chosen(made_kind(KIND), door_1=JointChoice(template=model))
    made = outcome(result, "door_1")
    assert (made.template, made.mechanism) == (model, MechanismClass.C)
    assert outcome(result, "door_2").template == "butt"


@pytest.mark.parametrize("count", [1, 3, 5])
def test_so_many_hinges_as_are_asked_for(count):
    result = chosen(made_kind(KIND), door_1=JointChoice(count=count))
    assert outcome(result, "door_1").count == count
    moving, _ = hardware(result, "door_1")
    assert len([v for v in moving if v.name.startswith("hinge_")]) == count


def test_a_joint_that_opens_less_than_chosen_says_by_how_much():
    short = outcome(chosen(made_kind(KIND), door_1=JointChoice(opening=radians(178))), "door_1")
    assert short.notes == (f"opens by {degrees(short.opening):.0f} of 178 degrees that were chosen: {ALLOWS_NO_MORE}",)
    slide = outcome(chosen(drawer(), drawer=JointChoice(opening=4.0)), "drawer")
    assert slide.notes[0].startswith(f"opens by {slide.opening:.3f} of 4.000 m that were chosen: `{slide.template}`")


def test_more_hinges_than_find_room_are_refused_not_left_out():
    board = box("door", (0.0, -0.02, 0.0), (0.4, 0.0, 0.04))
    wall = box("side", (-0.02, 0.0, 0.0), (0.0, 0.4, 0.04))
    made = outcome(chosen(scene(board, wall, joints=(hinged(),)), door=JointChoice(count=12)), "door")
    assert isinstance(made, Refusal)
    assert "12 of them" in made.why


def test_scale_makes_hinges_larger_and_keeps_the_door_free():
    lengths = {}
    for scale in (0.6, 1.0, 1.5):
        result = chosen(made_kind(KIND), door_1=JointChoice(scale=scale, template="butt"))
        moving, _ = hardware(result, "door_1")
        lengths[scale] = float(moving[0].mesh.box.size[2])
        assert clean(result, "door_1")
    assert lengths[0.6] == pytest.approx(0.6 * lengths[1.0], rel=0.15)
    assert lengths[1.5] == pytest.approx(1.5 * lengths[1.0], rel=0.15)


@pytest.mark.parametrize("angle", [5.0, 45.0, 80.0])
def test_a_chosen_opening_ends_the_joint_there_and_is_no_restriction(angle):
    made = outcome(chosen(made_kind(KIND), door_1=JointChoice(opening=radians(angle))), "door_1")
    assert made.opening == pytest.approx(radians(angle))
    assert made.notes == ()
    assert not made.restricted


def test_a_drawer_stops_where_it_is_told():
    made = outcome(chosen(drawer(), drawer=JointChoice(opening=0.1)), "drawer")
    assert made.opening == pytest.approx(0.1)


def test_flipping_hangs_the_door_on_its_other_border_and_opens_to_the_same_side():
    right = box("right", (0.4, 0.0, 0.0), (0.42, 0.4, 0.6))
    asset = scene(DOOR, SIDE, right, joints=(hinged(),))
    plain, turned = (outcome(chosen(asset, door=JointChoice(flipped=f)), "door") for f in (False, True))
    assert plain.axis.point[0] < 0.05
    assert turned.axis.point[0] > 0.35
    assert np.allclose(plain.axis.direction, -turned.axis.direction)
    middle = np.asarray(DOOR.box.center)
    for made in (plain, turned):
        opened = made.axis.rotation(0.5)
        assert (opened[:3, :3] @ middle + opened[:3, 3])[1] < middle[1] - 0.05


def test_a_door_with_nothing_on_its_other_border_is_not_flipped_into_the_air():
    made = outcome(chosen(scene(DOOR, SIDE, joints=(hinged(),)), door=JointChoice(flipped=True)), "door")
    assert isinstance(made, Refusal) or made.mount == "side"


@pytest.mark.parametrize("mechanism", [MechanismClass.CENTRE, MechanismClass.CORNER])
def test_rails_are_of_the_chosen_mount(mechanism):
    assert outcome(chosen(drawer(), drawer=JointChoice(mechanism=mechanism)), "drawer").mechanism is mechanism


def test_a_choice_for_a_part_without_a_joint_waits():
    plain = chosen(made_kind(KIND))
    assert chosen(made_kind(KIND), back_panel=JointChoice(count=3)).report.outcomes == plain.report.outcomes


@pytest.mark.parametrize(
    ("choice", "words"),
    [
        (JointChoice(template="spring"), "must be one of butt"),
        (JointChoice(template="butt", mechanism=MechanismClass.P), "`butt` is of class C"),
        (JointChoice(mechanism=MechanismClass.CORNER), "got the class corner-mount"),
        (JointChoice(mount="door_1"), "static part"),
        (JointChoice(mount="nowhere"), "static part"),
    ],
)
def test_what_cannot_be_is_said(choice, words):
    with pytest.raises(OptionError, match=words):
        chosen(made_kind(KIND), door_1=choice)


@pytest.mark.parametrize("choice", [JointChoice(count=3), JointChoice(flipped=True), JointChoice(scale=2.0)])
def test_slides_take_no_choice_for_hinges(choice):
    with pytest.raises(OptionError, match="for hinges"):
        chosen(drawer(), drawer=choice)


@pytest.mark.parametrize("wrong", [{"scale": 0.0}, {"count": -1}, {"opening": 0.0}, {"opening": float("nan")}])
def test_choices_check_themselves(wrong):
    with pytest.raises(ValueError, match="JointChoice"):
        replace(JointChoice(), **wrong)
