"""Leaves that make a table longer: halves that slide apart together, draw leaves that come out by themselves."""

from dataclasses import replace

import pytest

import grafu
from fold_judge import cuts, cutting_over_sweep, opened
from grafu.asset.part import Asset, PartSource
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.joints.extension_leaves import with_extension_leaves
from grafu.joints.motion_choice import choice_in_words, label_of_motion
from grafu.joints.plan import JointRequest, MotionRole, RealizationPlan
from grafu.synth.tables.extending import ExtendingTable, make_extending_table
from grafu.vocabulary import JointType, PartLabel
from small_scenes import box, scene

HALVES = ExtendingTable()
DRAWN = ExtendingTable(kind="draw leaves")


def unstated(asset: Asset, name: str = "table") -> Asset:
    return replace(asset, name=name, joints=())


def require_leaves(result: grafu.Result, leaves: tuple[str, str], coupled: bool) -> None:
    """Raises AssertionError unless both leaves come out to either side, alone or together, and nothing collides."""
    made = result.object
    joints = [made.joint_of[leaf] for leaf in leaves]
    length = float(result.asset.part(leaves[0]).box.size[0])

    assert all(joint.type is JointType.PRISMATIC and joint.parent == "body" for joint in joints)
    assert [round(float(joint.axis.direction[0])) for joint in joints] == [-1, 1]
    assert all(0.6 * length < joint.limits.upper < 0.75 * length for joint in joints)
    assert [joint.coupling is not None for joint in joints] == [False, coupled]
    assert all(record.notes == () and record.grasp == "edge" for record in result.joints)
    assert cutting_over_sweep(made) | cuts(made, opened(made, 0.0)) == set()
    assert result.added == ()


@pytest.mark.parametrize(
    ("table", "leaves", "coupled"),
    [(HALVES, ("top_half_1", "top_half_2"), True), (DRAWN, ("extension_leaf_1", "extension_leaf_2"), False)],
    ids=["halves", "draw leaves"],
)
@pytest.mark.parametrize("stated", ["user", "annotation"])
def test_stated_leaves_come_out_to_either_side(table, leaves, coupled, stated):
    asset = make_extending_table(table)
    if stated == "annotation":
        result = grafu.functionalize(asset, motion="annotation")
    else:
        motions = dict(zip(leaves, ("slide-left", "slide-right"), strict=True))
        result = grafu.functionalize(unstated(asset), motion="rule", motions=motions)

    require_leaves(result, leaves, coupled)


def test_names_show_leaves():
    drawn = grafu.functionalize(unstated(make_extending_table(DRAWN)), motion="rule")
    halves = grafu.functionalize(unstated(make_extending_table(HALVES), "extendable_table"), motion="rule")

    require_leaves(drawn, ("extension_leaf_1", "extension_leaf_2"), coupled=False)
    require_leaves(halves, ("top_half_1", "top_half_2"), coupled=True)


def test_a_top_in_two_halves_of_another_table_is_a_top():
    assert grafu.functionalize(unstated(make_extending_table(HALVES)), motion="rule").joints == ()


def test_a_leaf_that_is_called_so_and_hangs_below_is_none():
    asset = unstated(make_extending_table(HALVES))
    shelf = replace(box("shelf", (-0.5, -0.3, 0.2), (0.5, 0.3, 0.22)), source=PartSource("extension_shelf"))

    assert grafu.functionalize(replace(asset, parts=(*asset.parts, shelf)), motion="rule").joints == ()


@pytest.mark.parametrize(
    ("label", "word", "found"),
    [
        (PartLabel.TOP_PANEL, "slide-left", PartLabel.TOP_PANEL),
        (PartLabel.DRAWER, "slide-left", PartLabel.DRAWER),
        (PartLabel.TOP_PANEL, "pull", PartLabel.DRAWER),
    ],
)
def test_a_level_board_that_slides_to_a_side_is_no_drawer(label, word, found):
    (board,) = scene(replace(box("board", (0.0, 0.0, 0.7), (0.6, 0.8, 0.72)), label=label)).parts

    assert label_of_motion(board, choice_in_words(word)) is found


@pytest.mark.parametrize(
    ("source", "direction", "is_leaf"),
    [
        ("annotation", (1.0, 0.0, 0.0), True),
        ("annotation", (0.0, -1.0, 0.0), False),
        ("network", (1.0, 0.0, 0.0), False),
    ],
)
def test_trays_and_what_is_only_predicted_are_no_leaves(source, direction, is_leaf):
    top, tray = box("top", (0.0, 0.0, 0.7), (1.0, 0.6, 0.72)), box("tray", (0.1, 0.0, 0.66), (0.9, 0.4, 0.68))
    leg = box("leg", (0.0, 0.0, 0.0), (0.05, 0.05, 0.66))
    request = JointRequest("tray", JointType.PRISMATIC, Axis(vec3(0.5, 0.2, 0.67), vec3(*direction)), source)
    (made,) = with_extension_leaves(RealizationPlan((request,)), scene(top, tray, leg)).joints

    assert (made.role is MotionRole.EXTENSION) is is_leaf


def test_a_travel_of_all_its_length_is_refused():
    with pytest.raises(ValueError, match="between 0 and 1"):
        ExtendingTable(travel=1.0)
