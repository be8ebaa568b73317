"""Folding doors on synthetic furniture: pairs and corners, as the user states them and as names and hinges show."""

from collections.abc import Mapping
from dataclasses import replace
from math import degrees

import numpy as np
import pytest

import grafu
from fold_judge import cuts, cutting_over_sweep, free_edge, guide_of, loose, off_plane, opened, pairs_of
from grafu.asset.edit import mirrored, yawed
from grafu.asset.part import Asset, PartSource
from grafu.errors import OptionError
from grafu.joints.motion_choice import MotionChoice, Moves, Side
from grafu.pipeline.motion_choices import motions_of
from grafu.pipeline.move_options import move_options
from grafu.synth.cabinets.corner import InnerCorner
from grafu.synth.cabinets.folding import FoldingCorner, FoldingDoors, make_folding_corner, make_folding_doors
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Base, Top
from grafu.vocabulary import JointType
from small_scenes import box, cylinder, scene

SMALL = Case(0.8, 0.7, 0.4, base=Base("plinth"))
WIDE = Case(1.5, 1.9, 0.55)


def unstated(asset: Asset) -> Asset:
    """The same furniture, whose input states no joints and no leaf that another carries."""
    doors = (replace(p, carried_by=None) if p.id.startswith("door") else p for p in asset.parts)
    return replace(asset, parts=tuple(doors), joints=())


def called(asset: Asset, word: str) -> Asset:
    named = (replace(p, source=PartSource(f"{word}_{p.id}")) if p.id.startswith("door") else p for p in asset.parts)
    return replace(asset, parts=tuple(named))


def folded(asset: Asset, motions: Mapping[str, str] | None = None) -> grafu.Result:
    return grafu.functionalize(asset, motion="rule", motions=motions)


def require_sound(result: grafu.Result, pairs: int) -> None:
    """Raises AssertionError unless so many pairs fold, each in its plane, and nothing collides or is loose."""
    made, templates = result.object, {joint.part: joint.template for joint in result.report.joints}
    found = pairs_of(made)

    assert len(found) == pairs
    for outer, inner in found:
        assert (inner.parent, inner.coupling.multiplier) == (outer.child, 2.0)  # both axes are signed: positive opens
        assert float(outer.axis.direction @ inner.axis.direction) == pytest.approx(-1.0)
        assert off_plane(made, outer, inner, guide_of(made, outer, inner)) < 1e-6
        assert off_plane(made, outer, inner, free_edge(made, outer, inner)) <= 0.001
        assert 80 < degrees(outer.limits.upper) < 90
        assert templates[outer.child] == "pivot"
        hardware = {v.name for link in made.links for v in link.visuals}
        assert {f"rail_{inner.child}_track_static", f"rail_{inner.child}_track_dynamic"} <= hardware
    assert cuts(made, opened(made, 0.0)) == set()
    assert cutting_over_sweep(made) == set()
    assert loose(result) == set()


@pytest.mark.parametrize(
    ("doors", "motions"),
    [
        (FoldingDoors(case=SMALL), {"door_1": "fold-left"}),
        (FoldingDoors(case=SMALL, mount="inset", gap=0.002), {"door_1": "fold-right"}),
        (FoldingDoors(case=WIDE, leaves=4), {"door_2": "fold-left", "door_3": "fold-right"}),
        (FoldingDoors(case=replace(SMALL, top=Top("over", overhang=0.025))), {"door_2": "fold-left"}),
        (FoldingDoors(case=replace(SMALL, base=Base("none")), gap=0.0015), {"door_2": "fold-left"}),
    ],
    ids=["overlay", "inset", "four leaves", "under a top", "on the floor"],
)
def test_the_free_edge_stays_in_the_opening_and_nothing_collides(doors, motions):
    require_sound(folded(unstated(make_folding_doors(doors)), motions), doors.leaves // 2)


def test_left_and_right_are_mirror_images():
    asset = unstated(make_folding_doors(FoldingDoors(case=SMALL)))
    left, right = folded(asset, {"door_1": "fold-left"}), folded(mirrored(asset, "x"), {"door_1": "fold-right"})

    for part in ("door_1", "door_2"):
        one, other = (result.object.joint_of[part] for result in (left, right))
        assert one.limits.upper == pytest.approx(other.limits.upper)
        np.testing.assert_allclose(one.axis.point[:2] * (-1, 1), other.axis.point[:2], atol=1e-4)


def test_a_cabinet_that_stands_turned_folds_as_well():
    require_sound(
        folded(yawed(unstated(make_folding_doors(FoldingDoors(case=SMALL))), 0.5), {"door_2": "fold-left"}), 1
    )


def test_leaves_that_are_called_folding_fold_without_annotation():
    doors = FoldingDoors(case=WIDE, leaves=4)
    require_sound(folded(called(unstated(make_folding_doors(doors)), "Bi-Fold")), 2)
    graph = folded(called(unstated(make_folding_doors(FoldingDoors(case=SMALL))), "folding")).graph
    assert [hinge.coupling.leader for hinge in graph.hinges if hinge.coupling] == ["door_1"]


def test_leaves_that_are_called_otherwise_turn_by_themselves():
    made = folded(unstated(make_folding_doors(FoldingDoors(case=SMALL)))).object
    assert {(joint.parent, joint.coupling) for joint in made.joints} == {("body", None)}


def with_seam_hinges(depth: float, post: bool) -> Asset:
    """Two leaves before a case, hinges drawn on the seam between them at a depth; a post may stand behind it."""
    shell = [
        box("side_left", (-0.4, -0.2, 0.0), (-0.38, 0.2, 0.8)),
        box("side_right", (0.38, -0.2, 0.0), (0.4, 0.2, 0.8)),
        box("top", (-0.38, -0.2, 0.78), (0.38, 0.2, 0.8)),
        box("bottom", (-0.38, -0.2, 0.0), (0.38, 0.2, 0.02)),
        box("back", (-0.38, 0.19, 0.02), (0.38, 0.2, 0.78)),
        *([box("post", (-0.01, -0.19, 0.02), (0.01, -0.17, 0.78))] if post else []),
    ]
    leaves = [
        box("door_1", (-0.399, -0.22, 0.003), (-0.001, -0.202, 0.797)),
        box("door_2", (0.001, -0.22, 0.003), (0.399, -0.202, 0.797)),
    ]
    barrels = [
        cylinder(f"barrel_{k}", ((0.0, depth, z), (0.0, depth, z + 0.06)), 0.004) for k, z in enumerate((0.1, 0.6))
    ]
    return scene(*shell, *leaves, *barrels)


@pytest.mark.parametrize(
    ("depth", "post", "pairs"),
    [(-0.198, False, 1), (-0.198, True, 0), (-0.224, False, 0)],
    ids=["behind the seam", "on a post", "before the seam"],
)
def test_hinges_drawn_behind_a_seam_show_that_leaves_fold(depth, post, pairs):
    assert len(pairs_of(folded(with_seam_hinges(depth, post)).object)) == pairs


@pytest.mark.parametrize(("side", "stated"), [("left", "user"), ("right", "annotation")])
def test_two_leaves_in_a_corner_swing_out_one_on_the_other(side, stated):
    asset = make_folding_corner(FoldingCorner(side=side))
    first, second = ("door_1", "door_2") if side == "right" else ("door_2", "door_1")
    if stated == "user":
        result = folded(unstated(asset), {second: f"fold-{side}"})
    else:
        result = grafu.functionalize(asset, motion="annotation")
    made = result.object

    assert {joint.child: joint.parent for joint in made.joints} == {first: "body", second: first}
    assert all(joint.coupling is None and joint.type is JointType.REVOLUTE for joint in made.joints)
    assert all(degrees(joint.limits.upper) > 75 for joint in made.joints)
    assert cutting_over_sweep(made) | cuts(made, opened(made, 0.0)) == set()
    assert loose(result) == set()


def test_the_leaf_on_the_case_opens_as_far_as_a_wider_one_on_it_clears_the_case():
    corner = InnerCorner(along_x=0.95, along_y=0.75, depth=0.45, height=0.6, post=0.022)
    asset = unstated(make_folding_corner(FoldingCorner(case=corner, side="left")))
    made = folded(asset, {"door_1": "fold-left"}).object

    assert cutting_over_sweep(made) == set()
    assert degrees(made.joint_of["door_2"].limits.upper) > 60


LEFT_OF_TWO = box("door_1", (-0.4, -0.02, 0.0), (-0.1, 0.0, 0.6))
WIDER = box("door_2", (-0.098, -0.02, 0.0), (0.4, 0.0, 0.6))
AS_WIDE = box("door_2", (-0.098, -0.02, 0.0), (0.202, 0.0, 0.6))
CASE = (box("side", (-0.42, 0.001, 0.0), (-0.4, 0.4, 0.6)), box("side_2", (0.4, 0.001, 0.0), (0.42, 0.4, 0.6)))


@pytest.mark.parametrize(
    ("asset", "motions", "line"),
    [
        (
            scene(*CASE, LEFT_OF_TWO, WIDER),
            {"door_1": "fold-left"},
            "must be about equally wide to fold: got 0.300 m and",
        ),
        (scene(*CASE, LEFT_OF_TWO), {"door_1": "fold-left"}, "`door_1` needs a second leaf to fold with"),
        (scene(*CASE, box("door_1", (0.0, 0.0, 0.0), (0.3, 0.3, 0.3))), {"door_1": "fold-left"}, "no upright board"),
        (
            scene(*CASE, LEFT_OF_TWO, AS_WIDE),
            {"door_1": "fold-left", "door_2": "fold-right"},
            "`door_2` folds with `door_1` to the left: got right",
        ),
    ],
    ids=["widths", "alone", "no board", "two sides"],
)
def test_what_cannot_fold_is_refused_in_one_line(asset, motions, line):
    with pytest.raises(OptionError, match=line) as error:
        folded(asset, motions)
    assert "\n" not in str(error.value)


def test_options_and_choices_name_the_fold():
    result = folded(unstated(make_folding_doors(FoldingDoors(case=SMALL))), {"door_2": "fold-left"})
    fold = MotionChoice(Moves.FOLDS, Side.LEFT)

    assert motions_of(result.object) == {"door_1": fold, "door_2": fold}
    assert move_options(result.made)["door_1"] == ("--move door_1=fold-right", "--move door_1=fixed")


def test_one_leaf_of_those_called_folding_can_turn_by_itself():
    asset = called(unstated(make_folding_doors(FoldingDoors(case=SMALL))), "bifold")
    made = folded(asset, {"door_1": "left"}).object
    assert {joint.child: (joint.parent, joint.coupling) for joint in made.joints}["door_1"] == ("body", None)
    assert all(joint.coupling is None for joint in made.joints)


def test_hinges_between_leaves_keep_clear_of_what_stands_behind_them():
    asset = with_seam_hinges(-0.198, post=True)
    shelf = box("shelf", (-0.38, -0.2, 0.25), (0.38, 0.19, 0.3))  # at the height of a hinge
    parts = [part for part in asset.parts if part.id != "post" and not part.id.startswith("barrel")]
    result = folded(scene(*parts, shelf), {"door_1": "fold-left"})

    require_sound(result, 1)
    assert result.graph.hinges[1].coupling.leader == "door_1"
    assert result.made.completion.refused == ()
