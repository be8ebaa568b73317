"""Temperatures: fitted on answers whose true odds are known, and folded into the last layers of a network."""

import pytest
import torch
from perfect_answers import perfect, truth_of, two_cabinets

from grafu.graph.arrays import ATTACHED, HINGE, RAIL, UNKNOWN
from grafu.training.calibration import HEADS, Answers, calibrated, fitted, head_answers
from random_graphs import graph, tiny_network


@pytest.mark.parametrize("sureness", [0.5, 1.0, 3.0])
def test_answers_that_are_too_sure_by_a_factor_get_it_as_temperature(sureness: float) -> None:
    torch.manual_seed(3)
    true = torch.randn(20_000, 5)
    right = torch.multinomial(true.softmax(dim=1), 1)[:, 0]
    assert fitted([Answers(sureness * true, right)]) == pytest.approx(sureness, rel=0.05)
    apart = [Answers(sureness * true[:5_000], right[:5_000]), Answers(sureness * true[5_000:], right[5_000:])]
    assert fitted(apart) == pytest.approx(fitted([Answers(sureness * true, right)]))


def test_choices_among_more_and_fewer_are_fitted_together() -> None:
    torch.manual_seed(4)
    wide, narrow = torch.randn(4_000, 7), torch.randn(4_000, 3)
    answers = [Answers(2.0 * one, torch.multinomial(one.softmax(dim=1), 1)[:, 0]) for one in (wide, narrow)]
    assert fitted(answers) == pytest.approx(2.0, rel=0.1)


def test_few_answers_change_nothing() -> None:
    assert fitted([Answers(torch.tensor([[9.0, 0.0]]), torch.tensor([1]))]) == 1.0
    assert fitted([]) == 1.0


@pytest.mark.parametrize("head", HEADS)
def test_a_temperature_divides_the_logits_of_its_head_alone(head: str) -> None:
    network = tiny_network()
    before, after = network(graph(7)), calibrated(network, {head: 2.0})(graph(7))
    own = {head, {"parent": "parent_abstain", "hinge_target": "hinge_abstain"}.get(head, head)}
    for name, value in vars(before).items():
        if name not in ("mask", "padding"):
            assert torch.allclose(getattr(after, name), value / 2 if name in own else value, atol=1e-5), name
    assert torch.equal(network(graph(7)).edge, before.edge)  # the network itself stays as it is


def test_what_is_asked_is_what_the_graph_holds() -> None:
    targets = two_cabinets()
    predictions = perfect(targets)
    truth = truth_of(predictions, targets)
    given = torch.full_like(targets.anchors, UNKNOWN)
    answers = head_answers(predictions, truth, given)
    shown = truth.anchored[:, :, None] & truth.anchored[:, None, :]

    def count(kind: int) -> int:
        return int((truth.child & (truth.edges == kind) & shown).sum())

    assert len(answers["border"].right) == len(answers["sign"].right) == count(HINGE) > 0
    assert len(answers["slide"].right) == count(RAIL) > 0
    assert len(answers["category"].right) == int(truth.anchored.sum())
    assert len(answers["parent"].right) >= count(ATTACHED) > 0
    for name, (logits, right) in answers.items():
        assert (logits.argmax(dim=1) == right).all(), name
    labelled = head_answers(predictions, truth, torch.zeros_like(given))
    assert len(labelled["category"].right) == 0  # a label that is given is no question
