"""The rule-based baseline on small cabinets of boxes: doors, flaps, lids, drawers, handles, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.completion.config import DoorRuleConfig, DrawerRuleConfig, GuessConfig, RowConfig, RuleConfig
from grafu.completion.rule import complete_by_rule
from grafu.completion.votes import Votes
from grafu.geometry.box import Box
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Attached, Hinge, Rail
from grafu.graph.edit import mirrored, relabelled, without_nodes
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.motion import opening_face
from grafu.vocabulary import PartLabel

LABELS = {
    "left": PartLabel.SIDE_PANEL,
    "right": PartLabel.SIDE_PANEL,
    "middle": PartLabel.DIVIDER,
    "back": PartLabel.BACK_PANEL,
    "top": PartLabel.TOP_PANEL,
    "bottom": PartLabel.BOTTOM_PANEL,
}


def label_of(name: str) -> PartLabel:
    for word in ("door", "drawer", "handle"):
        if name.startswith(word):
            return PartLabel(word)
    return LABELS.get(name, PartLabel.UNKNOWN)


def scene(**boxes: tuple) -> FunctionalGraph:
    nodes = (
        PartNode(k, label_of(k), Box(np.array(low, float), np.array(high, float))) for k, (low, high) in boxes.items()
    )
    return FunctionalGraph("case", tuple(nodes))


def case(width: float = 1.0, height: float = 1.0) -> dict:
    """A case open to -Y: 0.5 deep, panels of 20 mm."""
    return {
        "left": ([0, 0, 0], [0.02, 0.5, height]),
        "right": ([width - 0.02, 0, 0], [width, 0.5, height]),
        "back": ([0.02, 0.48, 0], [width - 0.02, 0.5, height]),
        "bottom": ([0.02, 0, 0], [width - 0.02, 0.48, 0.02]),
        "top": ([0.02, 0, height - 0.02], [width - 0.02, 0.48, height]),
    }


def front(x0: float, x1: float, z0: float = 0.0, z1: float = 1.0) -> tuple:
    return [x0, -0.02, z0], [x1, 0.0, z1]


def knob(x: float, z: float, y: float = -0.02) -> tuple:
    return [x - 0.01, y - 0.03, z - 0.01], [x + 0.01, y, z + 0.01]


def hinge_of(graph: FunctionalGraph, door: str = "door") -> Hinge:
    return next(h for h in complete_by_rule(graph).completed.hinges if h.child == door)


@pytest.mark.parametrize(("x", "border", "mount"), [(0.45, 0, "left"), (0.05, 1, "right")])
def test_a_door_hangs_opposite_its_handle(x, border, mount):
    hinge = hinge_of(scene(**case(0.5), door=front(0, 0.5), handle=knob(x, 0.5)))
    assert (hinge.border, hinge.parent) == (border, mount)
    assert opening_face(1, hinge.border, hinge.sign) == 2  # it opens towards -Y


def test_doors_of_a_pair_hang_on_their_outer_sides():
    graph = scene(**case(), door_1=front(0, 0.499), door_2=front(0.501, 1))
    assert hinge_of(graph, "door_1") == Hinge("left", "door_1", 0, 0)
    assert hinge_of(graph, "door_2") == Hinge("right", "door_2", 1, 1)


@pytest.mark.parametrize(("z", "is_attached"), [(0.65, True), (0.715, True), (0.73, False)])
def test_a_knob_apart_from_the_outline_of_a_door_is_not_its(z, is_attached):
    graph = scene(**case(0.5), door=front(0, 0.5, 0, 0.7), handle=knob(0.25, z))
    assert bool(complete_by_rule(graph).completed.attachments) is is_attached


def test_handles_in_the_middle_of_the_top_leave_a_pair_a_pair():
    handles = {"handle_1": knob(0.25, 0.95), "handle_2": knob(0.75, 0.95)}
    graph = scene(**case(), door_1=front(0, 0.499), door_2=front(0.501, 1), **handles)
    assert [hinge_of(graph, d).border for d in ("door_1", "door_2")] == [0, 1]


def test_a_handle_outweighs_the_pair():
    graph = scene(**case(), door_1=front(0, 0.499), door_2=front(0.501, 1), handle=knob(0.05, 0.5))
    assert hinge_of(graph, "door_1").border == 1


def test_four_doors_are_two_pairs_and_a_divider_splits_three():
    four = {f"door_{k}": front(0.25 * k, 0.25 * k + 0.249) for k in range(4)}
    assert [hinge_of(scene(**case(), **four), d).border for d in four] == [0, 1, 0, 1]
    three = {f"door_{k}": front(0.33 * k, 0.33 * k + 0.329) for k in range(3)}
    middle = {"middle": ([0.65, 0, 0.02], [0.67, 0.48, 0.98])}
    assert [hinge_of(scene(**case(), **three, **middle), d).border for d in three] == [0, 1, 1]
    middle = {"middle": ([0.32, 0, 0.02], [0.34, 0.48, 0.98])}
    assert [hinge_of(scene(**case(), **three, **middle), d).border for d in three] == [0, 0, 1]


def test_a_lone_door_hangs_on_the_nearer_outer_side():
    assert hinge_of(scene(**case(), door=front(0, 0.4))).border == 0
    assert hinge_of(scene(**case(), door=front(0.6, 1))).border == 1


@pytest.mark.parametrize(("z", "border", "mount"), [(0.03, 3, "top"), (0.37, 2, "bottom")])
def test_a_wide_flap_hangs_opposite_its_handle(z, border, mount):
    hinge = hinge_of(scene(**case(1.0, 0.4), door=front(0, 1, 0, 0.4), handle=knob(0.5, z)))
    assert (hinge.border, hinge.parent) == (border, mount)
    assert opening_face(1, hinge.border, hinge.sign) == 2


def test_a_lid_hangs_on_the_back_and_opens_upwards():
    chest = case(1.0, 0.5)
    del chest["top"]
    hinge = hinge_of(scene(**chest, door=([0, -0.01, 0.5], [1, 0.5, 0.52])))
    assert (hinge.border, hinge.parent) == (3, "back")
    assert opening_face(2, hinge.border, hinge.sign) == 5


@pytest.mark.parametrize("turns", [1, 2, 3])
def test_doors_and_drawers_may_face_any_side(turns):
    straight = scene(**case(0.5), door=front(0, 0.5, 0, 0.6), handle_1=knob(0.45, 0.5), **drawer())
    turned = yawed(straight, turns)
    hinge, rail = hinge_of(turned), complete_by_rule(turned).completed.rails[0]
    front_face = {1: 1, 2: 3, 3: 0}[turns]
    assert hinge.parent == "left"
    assert opening_face(turned.node("door").box.thin_axis, hinge.border, hinge.sign) == front_face
    assert rail.axis == front_face


def yawed(graph: FunctionalGraph, turns: int) -> FunctionalGraph:
    R = np.linalg.matrix_power(np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), turns)
    nodes = (replace(n, box=Box.around(n.box.corners() @ R.T)) for n in graph.nodes)
    return replace(graph, nodes=tuple(nodes))


def test_a_mirrored_cabinet_is_completed_in_mirror_image():
    graph = scene(
        **case(), door_1=front(0, 0.499), door_2=front(0.501, 1), handle_1=knob(0.05, 0.5), handle_2=knob(0.95, 0.5)
    )
    for across in (0, 1):
        found = complete_by_rule(mirrored(graph, across)).completed
        assert set(found.edges) == set(mirrored(complete_by_rule(graph).completed, across).edges)


def drawer(x0: float = 0.03, x1: float = 0.47, handle: bool = True) -> dict:
    box = {"drawer": ([x0, -0.02, 0.7], [x1, 0.45, 0.95])}
    return box | ({"handle": knob((x0 + x1) / 2, 0.8)} if handle else {})


def test_a_drawer_runs_between_its_flanks_towards_the_front():
    completed = complete_by_rule(scene(**case(0.5), **drawer())).completed
    assert completed.rails == (Rail("left", "drawer", 2), Rail("right", "drawer", 2))
    assert completed.attachments == (Attached("drawer", "handle"),)


def test_a_drawer_without_a_handle_runs_away_from_the_back():
    assert complete_by_rule(scene(**case(0.5), **drawer(handle=False))).completed.rails[0].axis == 2


def test_a_desk_of_two_sides_has_drawers_both_ways():
    sides = {
        "left": ([0, 0, 0], [0.02, 1, 0.7]),
        "right": ([0.48, 0, 0], [0.5, 1, 0.7]),
        "top": ([0, 0, 0.7], [0.5, 1, 0.72]),
    }
    near, far = ([0.03, 0.0, 0.55], [0.47, 0.48, 0.69]), ([0.03, 0.52, 0.55], [0.47, 1.0, 0.69])
    rails = complete_by_rule(scene(**sides, drawer_1=near, drawer_2=far)).completed.rails
    assert {r.child: r.axis for r in rails} == {"drawer_1": 2, "drawer_2": 3}


def test_a_tray_hangs_under_its_top():
    tray = scene(top=([0, 0, 0.7], [1, 0.5, 0.73]), drawer=([0.3, 0.0, 0.65], [0.7, 0.4, 0.7]))
    assert complete_by_rule(tray).completed.rails == (Rail("top", "drawer", 2),)


def test_one_carcass_carries_both_sides_with_one_rail():
    body = scene(carcass=([0, 0, 0], [1, 0.5, 1]), drawer=([0.02, -0.02, 0.5], [0.98, 0.4, 0.7]))
    assert complete_by_rule(body).completed.rails == (Rail("carcass", "drawer", 2),)


def test_doors_that_lap_in_two_planes_slide_past_each_other():
    graph = scene(**case(), door_1=([0.02, 0.0, 0], [0.52, 0.02, 1]), door_2=([0.48, 0.025, 0], [0.98, 0.045, 1]))
    completion = complete_by_rule(graph)
    assert not completion.completed.hinges
    assert completion.refused == ()
    assert {(slide.child, slide.axis) for slide in completion.completed.slides} == {("door_1", 1), ("door_2", 0)}
    assert {d.question for d in completion.decisions if d.part == "door_1"} >= {"slide", "mount"}


@pytest.mark.parametrize(("offset", "slides"), [(0.03, 2), (0.01, 0)], ids=["in two planes", "a step"])
def test_doors_that_meet_slide_where_one_stands_clearly_before_the_other(offset, slides):
    behind = ([0.501, offset, 0], [0.98, offset + 0.02, 1])
    graph = scene(**case(), door_1=([0.02, 0.0, 0], [0.499, 0.02, 1]), door_2=behind)
    assert len(complete_by_rule(graph).completed.slides) == slides


def test_a_door_that_is_drawn_ajar_does_not_slide_past_its_closed_neighbour():
    """The box of a door that stands open by a tenth of its width is deep: its middle is far from the other's plane."""
    ajar = ([0.02, -0.06, 0], [0.499, 0.02, 1])
    graph = scene(**case(), door_1=ajar, door_2=([0.501, 0.0, 0], [0.98, 0.02, 1]))
    assert not complete_by_rule(graph).completed.slides


def test_a_sliding_door_without_anything_above_or_below_is_refused():
    graph = scene(
        back=([0, 0.5, 0], [1, 0.52, 1]),
        door_1=([0.02, 0.0, 0], [0.52, 0.02, 1]),
        door_2=([0.48, 0.025, 0], [0.98, 0.045, 1]),
    )
    completion = complete_by_rule(graph)
    assert completion.completed.slides == ()
    assert all("nothing near carries a track" in refusal.why for refusal in completion.refused)


def test_a_pair_whose_doors_lap_by_a_strip_still_swings():
    graph = scene(**case(), door_1=front(0, 0.505), door_2=front(0.5, 1))
    assert len(complete_by_rule(graph).completed.hinges) == 2


def test_without_static_parts_everything_is_refused():
    completion = complete_by_rule(scene(door=front(0, 1), drawer=([0, 0, 2], [1, 1, 3])))
    assert {r.part for r in completion.refused} == {"door", "drawer"}
    assert all("no static part" in r.why for r in completion.refused)


def test_a_door_far_from_everything_is_refused():
    graph = scene(**case(), door=([3, -0.02, 3], [3.5, 0, 4]))
    assert "near enough" in complete_by_rule(graph).refused[0].why


def test_a_handle_goes_to_the_part_behind_it():
    doors = {"door_1": front(0, 0.499), "door_2": front(0.501, 1)}
    graph = scene(**case(), **doors, handle_1=knob(0.48, 0.5), handle_2=knob(0.52, 0.5))
    found = {e.child: e.parent for e in complete_by_rule(graph).completed.attachments}
    assert found == {"handle_1": "door_1", "handle_2": "door_2"}


def test_a_handle_on_nothing_that_moves_is_named():
    completion = complete_by_rule(scene(**case(), handle=knob(0.5, 1.4)))
    assert completion.refused[0].part == "handle"
    assert "sits on no door" in completion.refused[0].why


def test_what_the_input_states_is_kept():
    graph = scene(**case(0.5), door=front(0, 0.5), handle=knob(0.45, 0.5))
    stated = replace(graph, edges=(Hinge("right", "door", 1, 1), Attached("door", "handle")))
    assert set(complete_by_rule(stated).completed.edges) == set(stated.edges)


def test_every_decision_has_a_score_and_its_runner_up():
    completion = complete_by_rule(scene(**case(0.5), door=front(0, 0.5, 0, 0.6), handle_1=knob(0.45, 0.5), **drawer()))
    border = completion.decision("door", "border")
    assert border is not None
    assert (border.choice, border.runner_up) == ("0", "1")
    assert border.score > 0.6 > border.runner_up_score
    questions = {(d.part, d.question) for d in completion.decisions}
    assert {("door", "sign"), ("door", "mount"), ("drawer", "slide"), ("drawer", "mount")} <= questions


def test_masked_doors_and_drawers_are_guessed_with_less_confidence():
    graph = scene(**case(0.5), door=front(0, 0.5, 0, 0.6), handle_1=knob(0.45, 0.5), **drawer())
    masked = relabelled(graph, {n.id: PartLabel.UNKNOWN for n in graph.nodes})
    completion = complete_by_rule(masked)
    labels = {n.id: n.label for n in completion.completed.nodes if n.label is not PartLabel.UNKNOWN}
    assert labels == {n.id: n.label for n in graph.nodes if not n.label.is_support}
    assert completion.completed.hinges[0].border == 0
    assert completion.completed.rails[0].axis == 2
    assert all(d.score < 0.9 for d in completion.decisions if d.question == "label")


def test_unlabelled_panels_of_a_labelled_model_stay_static():
    graph = scene(**case(), plate=front(0, 0.5), door=front(0.501, 1))
    assert complete_by_rule(graph).completed.node("plate").label is PartLabel.UNKNOWN


@pytest.mark.parametrize("missing", [(), ("left", "right"), ("left", "right", "back", "bottom", "top")])
def test_nothing_that_moves_means_nothing_to_do(missing):
    graph = without_nodes(scene(**case()), missing)
    completion = complete_by_rule(graph)
    assert completion.completed == graph
    assert completion.decisions == completion.refused == ()


def test_votes_rank_and_breaks_ties_by_order():
    votes = Votes(("a", "b", "c"))
    assert votes.ranking().choice == "a"
    votes.add("b", 1.0)
    votes.add("a", 0.5)
    votes.add("no_one", 9.0)
    ranking = votes.ranking()
    assert (ranking.choice, ranking.runner_up) == ("b", "a")
    assert 0 < ranking.runner_up_score < ranking.score < 1


def test_votes_for_one_choice_have_no_runner_up_and_of_none_is_refused():
    assert Votes(("a",)).ranking().runner_up is None
    with pytest.raises(ValueError, match="at least one choice"):
        Votes(())


def test_thresholds_of_the_rules_can_be_chosen():
    graph = scene(**case(0.5), door=front(0, 0.5, 0, 0.6), handle=knob(0.3, 0.3, y=-0.03), **drawer(handle=False))
    masked = relabelled(graph, {n.id: PartLabel.UNKNOWN for n in graph.nodes})

    def completed(of: FunctionalGraph = graph, **chosen) -> GraphCompletion:
        return complete_by_rule(of, RuleConfig(**chosen))

    assert completed().completed.hinges[0].border == 0
    assert completed(doors=DoorRuleConfig(slight=0.9)).completed.hinges[0].border == 1  # as if it were in the middle
    assert [r.part for r in completed(handle_reach=1e-3).refused] == ["handle"]  # it is 10 mm from its door
    assert len(completed().completed.rails) == 2
    assert len(completed(drawers=DrawerRuleConfig(least_flank=0.99)).completed.rails) < 2
    assert completed(masked).completed.hinges
    assert not completed(masked, guess=GuessConfig(plate=1e-3)).completed.hinges


@pytest.mark.parametrize(("chosen", "slides"), [({}, 2), ({"lap": (0.02, 0.1)}, 0), ({"lap_height": 1.1}, 0)])
def test_which_doors_slide_past_each_other_can_be_chosen(chosen, slides):
    behind = ([0.45, 0.01, 0.02], [0.98, 0.03, 0.98])
    graph = scene(**case(), door_1=([0.02, -0.02, 0.02], [0.55, 0.0, 0.98]), door_2=behind)

    assert len(complete_by_rule(graph, RuleConfig(rows=RowConfig(**chosen))).completed.slides) == slides


@pytest.mark.parametrize(("gap", "planes", "slides"), [(0.004, 0.0, 0), (-0.04, 0.02, 2), (-0.04, 0.0, 0)])
def test_doors_that_are_faces_slide_past_each_other_only_in_two_planes(gap, planes, slides):
    """Drawn without thickness in one plane they would slide into each other: they are a pair that swings."""
    left = ([0.02, 0.0, 0.02], [0.5 - gap / 2, 0.0, 0.98])
    right = ([0.5 + gap / 2, planes, 0.02], [0.98, planes, 0.98])
    completed = complete_by_rule(scene(**case(), door_1=left, door_2=right)).completed
    assert (len(completed.slides), len(completed.hinges)) == (slides, 2 - slides)


@pytest.mark.parametrize(("plane", "slides"), [(0.0, 0), (0.03, 0), (0.0305, 0), (0.05, 2)])
def test_a_face_beside_a_slab_slides_past_it_only_outside_its_depth(plane, slides):
    """One door of a pair may be a face, the other a slab: their middles are apart, but the face lies in the slab."""
    slab = ([0.02, 0.0, 0.02], [0.498, 0.03, 0.98])
    face = ([0.502, plane, 0.02], [0.98, plane, 0.98])
    completed = complete_by_rule(scene(**case(), door_1=slab, door_2=face)).completed
    assert (len(completed.slides), len(completed.hinges)) == (slides, 2 - slides)
