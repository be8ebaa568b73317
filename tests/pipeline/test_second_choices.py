"""A part that is blocked in the direction decided for it is built in the next likely one; the report states both."""

from dataclasses import replace

import pytest

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import Asset
from grafu.completion.rule import complete_by_rule
from grafu.errors import TooComplex
from grafu.geometry.budget import UNLIMITED
from grafu.graph.completion import BY_BOTH, BY_RULE, Decision, GraphCompletion
from grafu.graph.edges import Hinge, Rail, Slide
from grafu.graph.edit import as_contacts, rehung, with_edges
from grafu.graph.motion import opening_face
from grafu.graph.parse import parse_graph
from grafu.joints.plan import PlanConfig
from grafu.joints.realize import Realized
from grafu.pipeline.certainty import certainty_words
from grafu.pipeline.joint_stages import BuiltJoints, JointStages
from grafu.pipeline.motion_methods import MOTIONS
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.second_choices import second_choices
from grafu.pipeline.stages import Stages, without_joints
from grafu.pipeline.turned_doors import turned_doors
from grafu.processes.cache import NO_CACHE
from grafu.refusal import Reason, Refusal
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Drawer, Stack
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel
from small_scenes import box

LEFT, RIGHT, FRONT, BACK = "0", "1", "2", "3"
BACKWARDS = ((FRONT, 0.3), (LEFT, 0.05), (RIGHT, 0.005))
ASIDE = ((LEFT, 0.3), (FRONT, 0.05), (RIGHT, 0.005))


@pytest.fixture(scope="module")
def asset() -> Asset:
    return make_cabinet(Cabinet("made", Case(0.5, 0.9), Stack((Drawer(), Door()), (1.0, 3.0))))


def wrong(asset: Asset, others: tuple[tuple[str, float], ...], score: float = 0.6) -> GraphCompletion:
    """The rule's completion in which the drawer is to slide backwards, through the back panel."""
    right = complete_by_rule(parse_graph(asset))
    drawer = right.completed.rails[0].child
    edges = tuple(replace(e, axis=3) if isinstance(e, Rail) else e for e in right.completed.edges)
    runner_up = max(others, key=lambda other: other[1])
    stated = Decision(drawer, "slide", BACK, score, *runner_up, others=others)
    decisions = tuple(stated if d.question == "slide" else d for d in right.decisions)
    return replace(right, completed=replace(right.completed, edges=edges), decisions=decisions)


def built(asset: Asset, completion: GraphCompletion) -> BuiltJoints:
    source, config, stages = MotionSource.RULE, PipelineConfig(), Stages(lambda _: None, UNLIMITED)
    make = JointStages(asset, source, MOTIONS[source], {}, (), builtin_gallery(), config, stages, NO_CACHE)
    return make.with_second_choices(completion)


@pytest.mark.parametrize("others", [BACKWARDS, ASIDE], ids=["the second", "the third"])
def test_a_blocked_drawer_slides_where_it_can(asset: Asset, others: tuple[tuple[str, float], ...]) -> None:
    made = built(asset, wrong(asset, others))
    drawer = made.completion.completed.rails[0].child
    joint = made.realized.object.joint_of[drawer]
    assert joint.axis.direction.tolist() == [0.0, -1.0, 0.0]
    assert joint.limits.upper > 0.2
    done = next(one for one in made.realized.report.installed if one.moving == drawer)
    assert "towards the back (60%) it is blocked" in done.notes
    decision = made.completion.decision(drawer, "slide")
    assert decision is not None
    chosen = (decision.choice, decision.score, decision.runner_up, decision.by)
    assert chosen == (FRONT, dict(others)[FRONT], BACK, BY_BOTH)
    assert len(made.realized.report.installed) == 2


def test_what_is_unlikely_is_not_tried(asset: Asset) -> None:
    made = built(asset, wrong(asset, ((FRONT, 0.009), (LEFT, 0.001))))
    assert [refusal.reason for refusal in made.realized.report.skipped] == [Reason.BLOCKED]
    assert made.completion.completed.rails[0].axis == 3


def test_what_cannot_move_anyway_stays_as_decided(asset: Asset) -> None:
    first = wrong(asset, ((LEFT, 0.3), (RIGHT, 0.05), (FRONT, 0.04)))
    made = built(asset, first)
    assert made.completion is first
    assert [refusal.reason for refusal in made.realized.report.skipped] == [Reason.BLOCKED]


def test_a_door_on_another_border_opens_to_the_same_face(asset: Asset) -> None:
    right = complete_by_rule(parse_graph(asset))
    hinge = right.completed.hinges[0]
    graph = right.completed
    others = tuple((str(b), 0.1) for b in range(4) if b != hinge.border)
    decisions = tuple(
        Decision(hinge.child, "border", str(hinge.border), 0.6, *others[0], others=others)
        if (d.part, d.question) == (hinge.child, "border")
        else d
        for d in right.decisions
    )
    blocked = [Refusal(hinge.child, Reason.BLOCKED)]
    first = replace(right, decisions=decisions)
    for turn in range(3):
        other = second_choices(first, blocked, turn)
        assert other is not None
        turned = next(e for e in other.completed.edges if isinstance(e, Hinge))
        assert str(turned.border) == others[turn][0]
        thin = graph.node(hinge.child).box.thin_axis
        assert opening_face(thin, turned.border, turned.sign) == opening_face(thin, hinge.border, hinge.sign)
        words = " ".join(certainty_words(other, hinge.child))
        assert "opens to the front" in words


def opening_backwards(asset: Asset, other: float, by: str = "") -> GraphCompletion:
    """The rule's completion in which the door is to open into the case."""
    right = complete_by_rule(parse_graph(asset))
    hinge = right.completed.hinges[0]
    inwards = str(1 - hinge.sign)
    stated = Decision(hinge.child, "sign", inwards, 1.0 - other, str(hinge.sign), other, by)
    edges = tuple(replace(e, sign=1 - e.sign) if isinstance(e, Hinge) else e for e in right.completed.edges)
    decisions = tuple(stated if d.question == "sign" else d for d in right.decisions)
    return replace(right, completed=replace(right.completed, edges=edges), decisions=decisions)


def test_a_door_that_is_blocked_inwards_opens_outwards(asset: Asset) -> None:
    first = opening_backwards(asset, 0.14)
    made = built(asset, first)
    hinge = made.completion.completed.hinges[0]
    assert hinge == complete_by_rule(parse_graph(asset)).completed.hinges[0]
    done = next(one for one in made.realized.report.installed if one.moving == hinge.child)
    assert "towards the back (86%) it is blocked" in done.notes
    decision = made.completion.decision(hinge.child, "sign")
    assert decision is not None
    assert (decision.choice, decision.score, decision.by) == (str(hinge.sign), 0.14, BY_BOTH)
    assert len(made.realized.report.installed) == 2


@pytest.mark.parametrize(("other", "by"), [(0.005, ""), (0.14, BY_RULE)], ids=["ruled out", "of a rule"])
def test_a_face_that_is_ruled_out_is_not_tried(asset: Asset, other: float, by: str) -> None:
    first = opening_backwards(asset, other, by)
    made = built(asset, first)
    assert made.completion is first
    assert [refusal.reason for refusal in made.realized.report.skipped] == [Reason.BLOCKED]


def two_doors_without_a_divider() -> Asset:
    """A case whose two doors meet in the middle, with nothing there that could hold a hinge."""
    boards = {
        "left": ((-0.5, -0.25, 0.0), (-0.48, 0.25, 0.7)),
        "right": ((0.48, -0.25, 0.0), (0.5, 0.25, 0.7)),
        "bottom": ((-0.48, -0.25, 0.0), (0.48, 0.25, 0.02)),
        "top": ((-0.48, -0.25, 0.68), (0.48, 0.25, 0.7)),
        "back": ((-0.48, 0.23, 0.02), (0.48, 0.25, 0.68)),
        "door_1": ((-0.497, -0.27, 0.06), (-0.002, -0.2505, 0.64)),
        "door_2": ((0.002, -0.27, 0.06), (0.497, -0.2505, 0.64)),
    }
    parts = tuple(
        replace(box(name, *ends), label=PartLabel.DOOR if name.startswith("door") else PartLabel.SIDE_PANEL)
        for name, ends in boards.items()
    )
    return Asset("made", "", "made", parts)


@pytest.mark.parametrize(("likely", "built_side"), [(0.28, RIGHT), (0.005, LEFT)], ids=["likely enough", "unlikely"])
def test_a_door_that_nothing_holds_hangs_on_its_other_side(likely: float, built_side: str) -> None:
    asset = two_doors_without_a_divider()
    right = complete_by_rule(parse_graph(asset))
    edges = tuple(
        rehung(e, 0, right.completed) if isinstance(e, Hinge) and e.child == "door_2" else e
        for e in right.completed.edges
    )
    stated = Decision("door_2", "border", LEFT, 0.72, RIGHT, likely, others=((RIGHT, likely),))
    kept = tuple(d for d in right.decisions if (d.part, d.question) != ("door_2", "border"))
    made = built(asset, replace(right, completed=replace(right.completed, edges=edges), decisions=(*kept, stated)))
    hinge = next(e for e in made.completion.completed.hinges if e.child == "door_2")
    assert str(hinge.border) == built_side
    notes = [note for done in made.realized.report.installed if done.moving == "door_2" for note in done.notes]
    assert notes == (["towards the left (72%) nothing holds it"] if built_side == RIGHT else [])
    assert [refusal.reason for refusal in made.realized.report.skipped] == (
        [] if built_side == RIGHT else [Reason.NO_ROOM]
    )


def closed_by_a_door(name: str, label: PartLabel) -> tuple[Asset, GraphCompletion]:
    """A body with one leaf between two posts before it, which is to slide to the left."""
    leaf = replace(box(name, (-0.2, -0.21, 0.05), (0.15, -0.18, 0.25)), label=label)
    still = {
        "body": ((-0.25, -0.178, 0.0), (0.25, 0.24, 0.3)),
        "post_1": ((-0.25, -0.21, 0.0), (-0.205, -0.178, 0.3)),
        "post_2": ((0.155, -0.21, 0.0), (0.25, -0.178, 0.3)),
    }
    boards = (replace(box(name, *ends), label=PartLabel.SIDE_PANEL) for name, ends in still.items())
    asset = Asset("made", "", "made", (leaf, *boards))
    right = complete_by_rule(parse_graph(asset))
    graph = with_edges(as_contacts(right.completed), [Slide("body", name, 0)])
    stated = Decision(name, "slide", LEFT, 0.56, RIGHT, 0.44, others=((RIGHT, 0.44),))
    return asset, replace(right, completed=graph, decisions=(stated,))


def test_a_door_that_cannot_slide_turns() -> None:
    asset, sliding = closed_by_a_door("door", PartLabel.DOOR)
    made = built(asset, sliding)
    assert [hinge.child for hinge in made.completion.completed.hinges] == ["door"]
    done = made.realized.report.installed
    assert [motion_kind(one.type).turns for one in done] == [True]
    assert made.completion.decision("door", "slide") is None
    assert {d.by for d in made.completion.decisions} == {BY_RULE}
    assert "towards the left (56%) it is blocked" in done[0].notes


def test_only_doors_without_a_joint_turn_instead() -> None:
    _, sliding = closed_by_a_door("door", PartLabel.DOOR)
    assert turned_doors(sliding, []) is None
    assert turned_doors(sliding, [Refusal("door", Reason.UNSUPPORTED)]) is None
    assert turned_doors(sliding, [Refusal("door", Reason.BLOCKED)]) is not None
    _, tray = closed_by_a_door("tray", PartLabel.MISC)
    assert turned_doors(tray, [Refusal("tray", Reason.BLOCKED)]) is None


def test_other_refusals_change_nothing(asset: Asset) -> None:
    first = wrong(asset, BACKWARDS)
    drawer = first.completed.rails[0].child
    assert second_choices(first, [Refusal(drawer, Reason.NO_ROOM)]) is None
    assert second_choices(first, [Refusal(drawer, Reason.BLOCKED)], turn=3) is None
    assert second_choices(first, [Refusal(drawer, Reason.BLOCKED)], config=PlanConfig(other_direction=0.5)) is None


def test_a_try_that_was_given_up_leaves_no_note_behind(asset: Asset, monkeypatch: pytest.MonkeyPatch) -> None:
    config, stages = PipelineConfig(), Stages(lambda _: None, UNLIMITED)
    source = MotionSource.RULE
    make = JointStages(asset, source, MOTIONS[source], {}, (), builtin_gallery(), config, stages, NO_CACHE)
    first = make.built(wrong(asset, BACKWARDS))
    built_once = iter([first])

    def too_late(*_: object) -> BuiltJoints:
        for one in built_once:
            return one
        nothing = without_joints(first.plan, asset, "time is up")
        return first._replace(realized=stages.timed("realize", out_of_time, lambda _: nothing))

    def out_of_time() -> Realized:
        raise TooComplex("time is up")

    monkeypatch.setattr(JointStages, "built", too_late)
    assert make.with_second_choices(wrong(asset, BACKWARDS)) is first
    assert stages.notes == []
    assert not stages.gave_up("realize")
