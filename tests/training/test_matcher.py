"""Which slot answers for which node: by category and place, anchors pinned or not, in any order."""

from dataclasses import replace

import pytest
import torch
from perfect_answers import ORDER, perfect, place, targets_of, truth_of, two_cabinets

from grafu.graph.arrays import ATTACHED, HANDLE, NONE, NULL, UNKNOWN
from grafu.graph.functional_graph import FunctionalGraph
from grafu.training.loss_config import PAPER, LossConfig
from grafu.training.matcher import anchored_nodes, anchored_slots, assignment_costs, match_slots
from grafu.training.targets import stack_targets
from small_graphs import cabinet


@pytest.mark.parametrize("config", [LossConfig(), PAPER, LossConfig(match_cost="probability")])
def test_perfect_answers_are_matched_to_what_they_say(config: LossConfig) -> None:
    targets = two_cabinets()
    matching = match_slots(perfect(targets), targets, config)
    assert matching[:, :16].tolist() == targets.anchors.tolist()
    assert matching[0, 16:].tolist() == [NONE, NONE, place("knob_4"), place("knob_2")]
    assert matching[1, 16:19].tolist() == [NONE] * 3
    assert matching[1, 19] != NONE


def test_pinned_slots_keep_their_node_whatever_they_say() -> None:
    targets = two_cabinets()
    spoilt = perfect(targets)
    spoilt = replace(spoilt, centre=spoilt.centre.flip(1), category=spoilt.category.flip(1))
    assert match_slots(spoilt, targets, LossConfig())[:, :16].tolist() == targets.anchors.tolist()
    assert match_slots(spoilt, targets, PAPER)[0, :16].tolist() != targets.anchors[0].tolist()


def test_the_order_of_free_slots_decides_nothing() -> None:
    targets, order = two_cabinets(), torch.tensor([*range(16), 18, 16, 19, 17])
    one = perfect(targets)
    turned = replace(one, **{name: getattr(one, name)[:, order] for name in ("exists", "category", "centre", "half")})
    assert (
        match_slots(turned, targets, LossConfig()).tolist()
        == match_slots(one, targets, LossConfig())[:, order].tolist()
    )


def test_the_nearer_of_two_like_nodes_is_taken() -> None:
    targets = stack_targets([targets_of(cabinet(), ["knob_1", "knob_4"])])
    answers = perfect(targets, free=1)
    for node in ("knob_1", "knob_4"):
        centre = answers.centre.clone()
        centre[0, -1] = targets.boxes[0, place(node), :3] + 0.01
        assert match_slots(replace(answers, centre=centre), targets, LossConfig())[0, -1] == place(node)


def test_costs_are_category_and_twice_the_distance() -> None:
    targets = stack_targets([targets_of(cabinet(), ["knob_1"])])
    answers = perfect(targets)
    answers = replace(answers, category=torch.zeros_like(answers.category))
    knob, at = place("knob_1"), answers.exists.shape[1] - 1
    costs = assignment_costs(answers, targets, LossConfig())
    assert costs[0, at, knob] == pytest.approx(torch.tensor(14.0).log().item(), abs=1e-6)
    distance = (targets.boxes[0, 0, :3] - targets.boxes[0, knob, :3]).norm()
    assert (costs[0, at, 0] - costs[0, at, knob]).item() == pytest.approx(2 * distance.item(), rel=1e-5)
    likely = assignment_costs(answers, targets, LossConfig(match_cost="probability"))
    assert likely[0, at, knob].item() == pytest.approx(-1 / 14)


def test_an_unknown_label_costs_nothing() -> None:
    targets = two_cabinets()
    masked = replace(targets, labels=torch.full_like(targets.labels, UNKNOWN))
    answers = perfect(targets)
    costs = assignment_costs(answers, masked, LossConfig())
    assert torch.allclose(costs, 2 * torch.cdist(answers.centre, targets.boxes[..., :3]))


def test_more_missing_nodes_than_free_slots_leave_some_unclaimed() -> None:
    targets = stack_targets([targets_of(cabinet(), [name for name in ORDER if name.startswith("knob")])])
    matching = match_slots(perfect(targets, free=2), targets, LossConfig())
    assert (matching[0, -2:] != NONE).all()
    assert len(set(matching[0].tolist())) == 16
    assert (targets.labels[0][matching[0, -2:]] == HANDLE).all()


def test_anchored_slots_and_nodes_leave_padding_out() -> None:
    targets = two_cabinets()
    assert anchored_slots(perfect(targets), targets).sum(dim=1).tolist() == [16, 12]
    assert anchored_nodes(targets).sum(dim=1).tolist() == [16, 12]
    assert not anchored_nodes(targets)[0, place("knob_2")]


def test_scores_that_are_not_numbers_still_give_an_assignment() -> None:
    targets = two_cabinets()
    answers = perfect(targets)
    broken = replace(answers, centre=torch.full_like(answers.centre, torch.nan))
    assert (match_slots(broken, targets, LossConfig())[0, 16:] != NONE).sum() == 2


def test_a_graph_without_nodes_matches_nothing() -> None:
    targets = stack_targets([targets_of(FunctionalGraph("nothing", ()))])
    assert match_slots(perfect(targets), targets, LossConfig()).tolist() == [[NONE] * 4]


TARGETS = two_cabinets()
TRUTH = truth_of(perfect(TARGETS), TARGETS)


def test_an_added_slot_answers_for_the_missing_node() -> None:
    assert TRUTH.labels[0, -1] == HANDLE
    assert TRUTH.boxes[0, -1].tolist() == TARGETS.boxes[0, place("knob_2")].tolist()
    door = int((TARGETS.anchors[0] == place("door_2")).nonzero())
    assert TRUTH.edges[0, -1, door] == TRUTH.edges[0, door, -1] == ATTACHED
    assert TRUTH.child[0, -1, door]
    assert not TRUTH.child[0, door, -1]


def test_a_slot_that_answers_for_nothing_says_nothing() -> None:
    spare = 16  # the first free slot
    assert TRUTH.labels[0, spare] == UNKNOWN
    assert (TRUTH.edges[0, spare] == NULL).all()
    assert not TRUTH.child[0, spare].any()
    assert TRUTH.border[0, spare] == TRUTH.sign[0, spare] == TRUTH.slide[0, spare] == NONE


def test_slots_are_anchored_free_or_padding() -> None:
    assert TRUTH.anchored.sum(dim=1).tolist() == [16, 12]
    assert TRUTH.free.sum(dim=1).tolist() == [4, 4]
    assert TRUTH.matched.sum(dim=1).tolist() == [18, 13]
    assert TRUTH.missing.tolist() == [2, 1]


def test_real_pairs_join_different_slots_that_are_nodes() -> None:
    assert TRUTH.real_pairs.sum(dim=(1, 2)).tolist() == [18 * 17, 13 * 12]
    assert not TRUTH.real_pairs.diagonal(dim1=1, dim2=2).any()
