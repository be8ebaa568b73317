"""Specimens drawn at random: reproducible, sound, and noisy at the stated rates."""

from functools import cache

import pytest

from grafu.asset.labels import label_of
from grafu.graph.edges import Contact, ends_of
from grafu.graph.parse import parse_graph
from grafu.synth.generate import MOST_PARTS, make_specimen
from grafu.synth.noise.loose_objects import LOOSE_OBJECTS
from grafu.synth.noise.modelling_styles import is_storage
from grafu.synth.specimen import Specimen
from grafu.synth.truth.check import faults_in
from grafu.vocabulary import PartLabel

pytestmark = pytest.mark.slow  # the specimens are made once per process

NUMBER = 150


@cache
def specimens() -> tuple[Specimen, ...]:
    return tuple(make_specimen(8, index, 4) for index in range(NUMBER))


def ratio(of: list[bool]) -> float:
    return sum(of) / len(of)


def test_the_same_seed_and_index_give_the_same_bytes() -> None:
    first, again = make_specimen(1, 2, 16), make_specimen(1, 2, 16)

    assert [p.mesh for p in first.whole.parts] == [p.mesh for p in again.whole.parts]
    assert first.asset.parts == again.asset.parts
    assert first.truth == again.truth
    assert first.defects == again.defects


def test_another_index_or_seed_gives_another_model() -> None:
    meshes = {tuple(p.mesh for p in make_specimen(s, i, 1).whole.parts) for s, i in ((1, 2), (1, 3), (2, 2))}

    assert len(meshes) == 3


@pytest.mark.parametrize(("seed", "index"), [(-1, 0), (0, -1)])
def test_numbers_are_not_negative(seed: int, index: int) -> None:
    with pytest.raises(ValueError, match="must not be negative"):
        make_specimen(seed, index)


def test_specimens_are_sound() -> None:
    judged = specimens()[::5]  # as exported: before that, no specimen with a fault is kept
    found = {s.id: faults for s in judged if (faults := faults_in(s))}

    assert found == {}


def test_specimens_keep_their_promises() -> None:
    for s in specimens():
        label = {p.id: p.label for p in s.whole.parts}
        assert PartLabel.UNKNOWN not in label.values()
        assert 3 <= len(s.asset.parts) <= len(s.whole.parts) <= MOST_PARTS
        assert set(s.missing) <= s.removable
        assert not s.asset.joints
        assert all(isinstance(edge, Contact) for edge in s.given.edges)
        levers = {j.part for j in s.whole.small_joints if label[j.part] is PartLabel.HANDLE}
        assert s.truth.moving == {j.part for j in (*s.whole.joints, *s.whole.small_joints)} - levers
        assert {i for i, x in label.items() if x.is_movable} <= s.truth.moving
        assert levers <= {edge.child for edge in s.truth.attachments}
        assert all(j.lower == 0.0 < j.upper for j in s.whole.joints)


def test_what_is_given_touches_as_its_meshes_do_whatever_the_truth_joins() -> None:
    specimens = [make_specimen(2, index, 0) for index in range(12)]
    assert any(s.apart for s in specimens)  # drawers beside their walls
    for s in specimens:
        parsed = {frozenset(ends_of(e)) for e in parse_graph(s.whole).edges}
        given = {frozenset(ends_of(e)) for e in s.given.edges}
        assert given == {pair for pair in parsed if pair <= {p.id for p in s.asset.parts}}


def test_where_a_label_is_lost_no_name_says_it() -> None:
    lost = 0
    for s in specimens():
        for part, node in zip(s.asset.parts, s.given.nodes, strict=True):
            if part.label is PartLabel.UNKNOWN:
                lost += 1
                assert label_of(part.source.name) is PartLabel.UNKNOWN
                assert part.labelled_by == "none"
                assert (part.source.file, part.source.link) == ("", "")
                assert node.label is PartLabel.UNKNOWN
                assert node.source_name == part.source.name
                assert s.truth.node(node.id).source_name == part.source.name
    assert lost > 75


def test_defects_name_parts_of_the_whole_and_what_is_missing() -> None:
    for s in specimens():
        ids = {p.id for p in s.whole.parts}
        assert all(set(d.parts) <= ids for d in s.defects)
        assert {i for d in s.defects if d.kind == "missing" for i in d.parts} == set(s.missing)


def without(label: PartLabel) -> list[bool]:
    return [not any(p.label is label and p.id not in s.missing for p in s.whole.parts) for s in specimens()]


def test_tops_are_missing_from_storage_as_in_real_life_and_never_from_tables() -> None:
    storage = [s for s in specimens() if is_storage(s.whole)]
    gone = [not any(p.label is PartLabel.TOP_PANEL and p.id not in s.missing for p in s.whole.parts) for s in storage]

    assert 0.25 <= ratio(gone) <= 0.5
    tables = [s for s in specimens() if s.family in ("table with drawers", "writing desk")]
    assert ratio([any(s.whole.part(i).label is PartLabel.TOP_PANEL for i in s.missing) for s in tables]) < 0.1


def test_patterns_come_at_their_rates() -> None:
    parts = [s.asset.parts for s in specimens()]
    unknown = [ratio([p.label is PartLabel.UNKNOWN for p in given]) for given in parts]
    rates = {
        "labels all there": (ratio([u == 0 for u in unknown]), 0.34, 0.6),
        "labels all lost": (ratio([u == 1 for u in unknown]), 0.03, 0.19),
        "sheets": (ratio([any(p.box.size.min() < 1e-6 for p in given) for given in parts]), 0.25, 0.6),
        "joined": (ratio([any(p.id.startswith("joined") for p in given) for given in parts]), 0.15, 0.42),
        "pieces": (ratio([any("_piece_" in p.id for p in given) for given in parts]), 0.12, 0.4),
        "no handle": (ratio(without(PartLabel.HANDLE)), 0.15, 0.45),
        "out of place": (
            ratio([any(d.kind in ("interpenetrating", "floating") for d in s.defects) for s in specimens()]),
            0.12,
            0.45,
        ),
        "missing": (ratio([bool(s.missing) for s in specimens()]), 0.4, 0.75),
    }
    assert {name: rate for name, (rate, low, high) in rates.items() if not low <= rate <= high} == {}


def test_every_kind_of_loose_object_and_defect_occurs() -> None:
    stems = {"object", "basket", "drawer_runner", "corner_plate", "nailer", "edge", "pad", "plate", "post", "hinge"}
    found = {stem for s in specimens() for p in s.whole.parts for stem in stems if p.id.startswith(f"{stem}_")}

    assert len(LOOSE_OBJECTS) == len(stems) + 1  # things stand on tops and on shelves
    assert found >= stems - {"basket"}
    assert {d.kind for s in specimens() for d in s.defects} >= {"missing", "interpenetrating", "floating"}
