"""The answers laid out by slot."""

from perfect_answers import perfect, place, truth_of, two_cabinets

from grafu.graph.arrays import ATTACHED, HANDLE, NONE, NULL, UNKNOWN

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
