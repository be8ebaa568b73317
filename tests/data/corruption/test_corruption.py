"""Every strategy keeps what all must keep, and does what its name states; draws come as often as their weights."""

from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.data.corruption.config import OFFICIAL, PAPER, STRATEGY_NAMES, CorruptionConfig
from grafu.data.corruption.corrupt import corrupt, corrupt_by
from grafu.data.corruption.strategies import STRATEGIES, probabilities
from grafu.data.pair import GraphPair
from grafu.errors import GraphError
from grafu.graph.edges import Attached, Contact, Slide, ends_of
from grafu.graph.edit import mirrored, with_edges
from grafu.graph.functional_graph import FunctionalGraph
from grafu.vocabulary import PartLabel
from graph_strategies import functional_graphs
from small_graphs import CONTACTS, FUNCTIONAL, LABELS, cabinet

UNCAPPED = CorruptionConfig(label_masking=0.0, max_dropped=None)
names = st.sampled_from(STRATEGY_NAMES)
seeds = st.integers(0, 2**32 - 1)
KEEP_KINDS = {n for n in STRATEGY_NAMES if STRATEGIES[n].is_boosted}


def by(name, seed=0, config=UNCAPPED, target=None) -> GraphPair:
    return corrupt_by(name, cabinet() if target is None else target, np.random.default_rng(seed), config)


def lost_labels(pair: GraphPair) -> Counter[PartLabel]:
    return Counter(pair.target.node(i).label for i in pair.missing)


@given(functional_graphs(), names, seeds, st.sampled_from([PAPER, OFFICIAL, UNCAPPED]))
def test_every_corruption_of_any_graph_keeps_the_rules(graph, name, seed, config):
    pair = by(name, seed, config, graph)
    assert pair.target is graph
    assert pair.input.nodes
    assert pair.strategy == name
    whole = {frozenset(ends_of(e)): e for e in graph.edges}
    for edge in pair.input.edges:
        origin = whole[frozenset(ends_of(edge))]
        assert edge == origin or isinstance(edge, Contact)
        if name not in KEEP_KINDS:
            assert isinstance(edge, Contact)
    for node in pair.input.nodes:
        origin_node = graph.node(node.id)
        assert node.points is origin_node.points
        assert node.label in (origin_node.label, PartLabel.UNKNOWN)
    if config.max_dropped:
        assert len(pair.missing) <= config.max_dropped


@given(functional_graphs(), seeds)
def test_edges_between_kept_nodes_stay_unless_edges_are_what_is_dropped(graph, seed):
    for name in set(STRATEGY_NAMES) - {"mask_random_edges_keep_types", "isolate_door"}:
        pair = by(name, seed, PAPER, graph)
        kept = [e for e in graph.edges if all(end in pair.input for end in ends_of(e))]
        assert len(pair.input.edges) == len(kept)


@pytest.mark.parametrize(
    ("name", "label"),
    [
        ("drop_handles", PartLabel.HANDLE),
        ("drop_top", PartLabel.TOP_PANEL),
        ("drop_bottom", PartLabel.BOTTOM_PANEL),
        ("drop_doors", PartLabel.DOOR),
        ("drop_drawers", PartLabel.DRAWER),
    ],
)
def test_a_category_goes_whole(name, label):
    pair = by(name)
    assert lost_labels(pair) == Counter({label: len(cabinet().labelled(label))})
    assert not pair.input.attachments


@given(seeds)
def test_two_or_three_categories_go_at_once(seed):
    for name in ("drop_multi_cat", "drop_completion"):
        lost = lost_labels(by(name, seed))
        assert len(lost) in (2, 3)
        assert all(count == len(cabinet().labelled(label)) for label, count in lost.items())
        assert (PartLabel.DOOR not in lost and PartLabel.DRAWER not in lost) or name == "drop_multi_cat"


@given(seeds)
def test_a_cap_spares_no_category(seed):
    lost = lost_labels(by("drop_multi_cat", seed, PAPER))
    assert len(lost) in (2, 3)
    assert sum(lost.values()) == 4


def test_both_two_and_three_categories_occur():
    assert {len(lost_labels(by("drop_multi_cat", seed))) for seed in range(40)} == {2, 3}


@given(seeds)
def test_a_handful_and_a_fraction_go(seed):
    assert 1 <= len(by("random", seed).missing) <= 4
    ratio = by("random_share", seed)
    assert 0.25 <= len(ratio.missing) / len(LABELS) <= 0.5
    assert not {PartLabel.DOOR, PartLabel.DRAWER} & set(lost_labels(ratio))
    nodes = by("drop_nodes_keep_edge_types", seed)
    assert 0.25 <= len(nodes.missing) / len(LABELS) <= 0.5
    assert set(nodes.input.edges) <= set(cabinet().edges)


def test_a_category_that_is_not_there_falls_back_on_a_fraction_of_still_parts():
    bare = FunctionalGraph("bare", tuple(n for n in cabinet().nodes if n.label is not PartLabel.TOP_PANEL))
    pair = by("drop_top", target=bare)
    assert pair.missing
    assert not {PartLabel.DOOR, PartLabel.DRAWER} & set(lost_labels(pair))


def test_labels_are_hidden():
    pair = by("fully_anonymized")
    assert {n.label for n in pair.input.nodes} == {PartLabel.UNKNOWN}
    assert len(pair.input.contacts) == len(cabinet().edges)


@given(seeds)
def test_some_labels_are_hidden_and_edges_kept(seed):
    pair = by("mask_materials_keep_edges", seed, PAPER)  # no further masking on top
    assert pair.input.edges == cabinet().edges
    assert 0.25 <= len(pair.input.labelled(PartLabel.UNKNOWN)) / len(LABELS) <= 0.62


@given(seeds)
def test_edges_go_and_nodes_stay(seed):
    pair = by("mask_random_edges_keep_types", seed)
    assert not pair.missing
    assert set(pair.input.edges) < set(cabinet().edges)
    assert 0.5 <= len(pair.input.edges) / len(cabinet().edges) <= 0.75


@given(seeds)
def test_all_that_functions_stays(seed):
    pair = by("fully_functional_drop", seed)
    assert pair.missing
    assert set(FUNCTIONAL) <= set(pair.input.edges)


def test_the_authors_may_drop_what_functions():
    lost = Counter[PartLabel]()
    for seed in range(60):
        lost += lost_labels(by("fully_functional_drop", seed, OFFICIAL))
    assert lost[PartLabel.SIDE_PANEL]
    assert lost[PartLabel.HANDLE]
    assert not lost[PartLabel.DOOR]


def test_a_graph_that_is_all_function_stays_whole():
    pair = by("fully_functional_drop", target=FunctionalGraph("m", cabinet().labelled(PartLabel.DOOR)))
    assert pair.input == pair.target


@given(seeds)
def test_a_door_is_alone(seed):
    pair = by("isolate_door", seed)
    alone = [n.id for n in pair.input.labelled(PartLabel.DOOR) if not pair.input.neighbours[n.id]]
    assert not pair.missing
    assert len(alone) == 1


def test_labels_are_masked_as_often_as_asked():
    config = CorruptionConfig(max_dropped=1)
    counts = [len(by("random", seed, config).input.labelled(PartLabel.UNKNOWN)) for seed in range(600)]
    ratio = np.mean(counts) / (len(LABELS) - 1)
    assert 0.13 < ratio < 0.17  # 15 % of 10,200 labels: four standard deviations are 1.4 %


def test_masking_leaves_functional_edges():
    always = CorruptionConfig(label_masking=1.0)
    pair = by("fully_functional_drop", 1, always)
    assert {n.label for n in pair.input.nodes} == {PartLabel.UNKNOWN}
    assert set(FUNCTIONAL) <= set(pair.input.edges)


def test_an_input_is_never_empty():
    for count in (1, 2):
        handles = FunctionalGraph("knobs", cabinet().labelled(PartLabel.HANDLE)[:count])
        for name in STRATEGY_NAMES:
            assert by(name, target=handles).input.nodes
    with pytest.raises(GraphError, match="`nothing` has none"):
        by("random", target=FunctionalGraph("nothing", ()))


@pytest.mark.parametrize("config", [PAPER, OFFICIAL, PAPER.reweighted({"isolate_door": 0.3, "drop_top": 0.0})])
def test_strategies_come_as_often_as_their_weights(config):
    rng, draws = np.random.default_rng(3), 4000
    target = FunctionalGraph("knobs", cabinet().labelled(PartLabel.HANDLE)[:2])  # what is drawn asks nothing of it
    found = Counter(corrupt(target, rng, config).strategy for _ in range(draws))
    wanted = {n: p * draws for n, p in zip(STRATEGY_NAMES, probabilities(config), strict=True) if p > 0}
    assert set(found) <= set(wanted)
    chi_square = sum((found[n] - count) ** 2 / count for n, count in wanted.items())
    assert chi_square < 40  # 14 degrees of freedom: one draw in 4,000 is above 37


def test_weights_are_the_papers():
    ratio = dict(zip(STRATEGY_NAMES, probabilities(PAPER), strict=True))
    assert ratio["fully_functional_drop"] == pytest.approx(0.20 / 1.15)
    assert ratio["isolate_door"] == 0
    families = Counter(STRATEGIES[n].family for n in STRATEGY_NAMES)
    assert families == {"category drop": 7, "label masking": 2, "edge-preserving": 3, "authors' code": 3}


def test_the_authors_boost_is_theirs():
    ratio = dict(zip(STRATEGY_NAMES, probabilities(OFFICIAL), strict=True))
    assert sum(ratio[n] for n in KEEP_KINDS) == pytest.approx(0.59, abs=0.005)
    assert ratio["fully_functional_drop"] == pytest.approx(0.60 / 1.98)


def test_half_of_the_pairs_are_mirror_images():
    images = [mirrored(cabinet(), 0), mirrored(cabinet(), 1)]
    rng = np.random.default_rng(5)
    found = Counter(images.index(t) if (t := corrupt(cabinet(), rng).target) in images else 2 for _ in range(600))
    assert 240 < found[2] < 360  # half, within five standard deviations
    assert min(found[0], found[1]) > 100
    only_x = {images.index(t) for _ in range(60) if (t := corrupt(cabinet(), rng, OFFICIAL).target) in images}
    assert only_x == {0}


@given(functional_graphs(), seeds)
def test_a_seed_says_all(graph, seed):
    first, second = (corrupt(graph, np.random.default_rng(seed)) for _ in range(2))
    assert first == second


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"weights": (("random", -1.0),)}, "must not be negative"),
        ({"edge_preserving_boost": -1.0}, "must not be negative"),
        ({"max_dropped": 0}, "`max_dropped` must be at least 1"),
        ({"label_masking": 1.5}, r"in 0\.\.1"),
        ({"mirror_axes": (2,)}, "`mirror_axes`"),
        ({"mirror_axes": ()}, "`mirror_axes`"),
    ],
)
def test_a_config_refuses(wrong, message):
    with pytest.raises(ValueError, match=message):
        CorruptionConfig(**wrong)


def test_some_strategy_must_be_left():
    with pytest.raises(ValueError, match="at least one strategy"):
        probabilities(PAPER.reweighted(dict.fromkeys(STRATEGY_NAMES, 0.0)))


def test_the_small_cabinet_is_as_the_tests_need_it():
    assert len(CONTACTS) + len(FUNCTIONAL) == len(cabinet().edges)
    assert all(isinstance(e, Attached) for e in FUNCTIONAL[4:])


@given(seeds)
def test_what_moves_without_being_a_door_or_drawer_is_no_still_part(seed):
    still = next(n.id for n in cabinet().nodes if n.label is PartLabel.SHELF)
    carrier = next(n.id for n in cabinet().nodes if n.label is PartLabel.SIDE_PANEL)
    sliding = with_edges(cabinet(), [Slide(carrier, still, 2)])
    assert still not in by("random_share", seed, target=sliding).missing


def test_what_ran_on_a_dropped_part_is_left_as_a_contact_or_alone():
    door = next(n.id for n in cabinet().nodes if n.label is PartLabel.DOOR)
    shelf = next(n.id for n in cabinet().nodes if n.label is PartLabel.SHELF)
    nested = with_edges(cabinet(), [Slide(door, shelf, 2)])
    pair = by("drop_doors", target=nested)
    assert door in pair.missing
    assert shelf not in pair.input.moving
