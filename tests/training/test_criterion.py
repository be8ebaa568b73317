"""The whole loss: sums, weights, padding, order, gradients."""

from dataclasses import fields, replace

import pytest
import torch
from perfect_answers import perfect, targets_of, two_cabinets

from grafu.graph.functional_graph import FunctionalGraph
from grafu.network.batch import Predictions
from grafu.training.criterion import criterion
from grafu.training.loss_config import OFFICIAL, PAPER, LossConfig
from grafu.training.targets import TargetBatch, stack_targets
from small_graphs import cabinet

PAIRS = {"edge", "parent", "hinge_target", "border", "sign", "slide", "body"}
SINGLE = {"parent_abstain", "hinge_abstain", "piece"}


def noisy(predictions: Predictions, seed: int = 0) -> Predictions:
    """Answers that are right, but far from sure."""
    rng = torch.Generator().manual_seed(seed)
    values = {f.name: getattr(predictions, f.name) for f in fields(predictions) if f.name not in ("mask", "padding")}
    return replace(predictions, **{k: v / 10 + torch.randn(v.shape, generator=rng) for k, v in values.items()})


def with_gradients(predictions: Predictions) -> Predictions:
    values = {f.name: getattr(predictions, f.name) for f in fields(predictions) if f.name not in ("mask", "padding")}
    return replace(predictions, **{k: v.clone().requires_grad_() for k, v in values.items()})


@pytest.mark.parametrize("config", [LossConfig(), PAPER, OFFICIAL, LossConfig(box_error="absolute")])
def test_perfect_answers_cost_nothing(config: LossConfig) -> None:
    targets = two_cabinets()
    assert criterion(perfect(targets), targets, config).total.item() == pytest.approx(0.0, abs=1e-4)


def test_the_total_is_the_weighted_sum_of_the_terms() -> None:
    targets, config = two_cabinets(), LossConfig()
    terms = {k: float(v) for k, v in criterion(noisy(perfect(targets)), targets, config).by_name().items()}
    total = terms.pop("total")
    assert len(terms) == 20
    assert min(terms.values()) > 0
    assert total == pytest.approx(sum(getattr(config, name) * value for name, value in terms.items()), rel=1e-5)


def test_a_term_is_held_out_by_its_weight() -> None:
    targets = two_cabinets()
    answers = noisy(perfect(targets))
    whole = criterion(answers, targets, LossConfig())
    without = criterion(answers, targets, LossConfig(hinge_target=0.0))
    assert (whole.total - without.total).item() == pytest.approx(0.5 * whole.pairs.hinge_target.item(), rel=1e-4)


def test_every_answer_gets_a_gradient() -> None:
    targets = two_cabinets()
    answers = with_gradients(noisy(perfect(targets)))
    criterion(answers, targets, LossConfig()).total.backward()
    for field in fields(answers):
        if field.name not in ("mask", "padding"):
            gradient = getattr(answers, field.name).grad
            assert gradient is not None, field.name
            assert gradient.isfinite().all(), field.name
            assert gradient.abs().sum() > 0, field.name


def padded(predictions: Predictions, targets: TargetBatch, more: int) -> tuple[Predictions, TargetBatch]:
    """The same batch with more padding behind the input nodes and behind the targets, full of noise."""
    n, s = targets.anchors.shape[1], predictions.mask.shape[1]
    order = torch.tensor([*range(n), *([0] * more), *range(n, s)])
    values = {f.name: getattr(predictions, f.name) for f in fields(predictions) if f.name not in SINGLE}
    longer = {k: v[:, order] for k, v in values.items()}
    longer |= {k: longer[k][:, :, order] for k in PAIRS}
    longer["mask"][:, n : n + more] = False
    extra = torch.nn.functional.pad
    b, t = targets.mask.shape
    wide = {
        name: extra(getattr(targets, name), (0, more), value=fill)
        for name, fill in (("labels", 3), ("border", 1), ("sign", 1), ("slide", 1), ("anchors", -1), ("mask", False))
    }
    wide |= {name: extra(getattr(targets, name), (0, more), value=1) for name in ("bodies", "ajar")}
    square = (0, more, 0, more)
    wide |= {"edges": extra(targets.edges, square, value=1), "child": extra(targets.child, square, value=True)}
    wide |= {"boxes": extra(targets.boxes, (0, 0, 0, more), value=7.0)}
    assert wide["boxes"].shape == (b, t + more, 6)
    return replace(predictions, **longer), replace(targets, **wide)


@pytest.mark.parametrize("config", [LossConfig(), PAPER, OFFICIAL])
def test_padding_changes_nothing(config: LossConfig) -> None:
    targets = two_cabinets()
    answers = noisy(perfect(targets))
    same = criterion(*padded(answers, targets, 5), config).by_name()
    for name, value in criterion(answers, targets, config).by_name().items():
        assert same[name].item() == pytest.approx(value.item(), rel=1e-5), name


def test_the_order_of_targets_changes_nothing() -> None:
    targets = stack_targets([targets_of(cabinet(), ["knob_2", "door_1"])])
    answers = noisy(perfect(targets))
    order = torch.randperm(18, generator=torch.Generator().manual_seed(1))
    turned = {f.name: getattr(targets, f.name)[:, order] for f in fields(targets) if f.name not in ("anchors", "piece")}
    turned |= {name: turned[name][:, :, order] for name in ("edges", "child")}
    other = replace(targets, **turned, anchors=order.argsort()[targets.anchors])
    assert torch.allclose(
        criterion(answers, targets, LossConfig()).total, criterion(answers, other, LossConfig()).total
    )


def test_half_precision_answers_are_judged_in_full() -> None:
    targets = two_cabinets()
    answers = perfect(targets)
    values = {f.name: getattr(answers, f.name).bfloat16() for f in fields(answers) if f.name not in ("mask", "padding")}
    assert criterion(replace(answers, **values), targets, LossConfig()).total.dtype is torch.float32


def test_a_graph_without_nodes_costs_what_its_free_slots_do() -> None:
    targets = stack_targets([targets_of(FunctionalGraph("nothing", ()))])
    answers = with_gradients(perfect(targets))
    terms = criterion(answers, targets, LossConfig())
    terms.total.backward()
    assert terms.total.item() == pytest.approx(0.0, abs=1e-5)


def test_numbers_for_the_logbook_carry_no_gradient() -> None:
    targets = two_cabinets()
    assert not any(
        value.requires_grad for value in criterion(with_gradients(perfect(targets)), targets, PAPER).by_name().values()
    )
