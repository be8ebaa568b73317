"""Names of parts: what is read from them is their label, a lost label has no name that gives it, few are wrong."""

import numpy as np
import pytest

from grafu.asset.labels import label_of
from grafu.asset.part import Asset
from grafu.synth.noise.part_names import DATA_SET, SCHEMES, english_phrases, foreign_words, named
from grafu.synth.samples import dresser, kitchen_base
from grafu.vocabulary import PartLabel

LABELS = [label for label in PartLabel if label is not PartLabel.UNKNOWN]


def call(asset: Asset, scheme: str, seed: int = 0, misnamed: bool = False) -> tuple[Asset, tuple[str, ...]]:
    true = {part.id: part.label for part in asset.parts}
    return named(asset, true, scheme, misnamed, np.random.default_rng(seed))  # type: ignore[arg-type]


@pytest.mark.parametrize("scheme", list(SCHEMES))
@pytest.mark.parametrize("seed", range(4))
def test_a_part_has_the_label_that_its_name_gives_or_none(scheme: str, seed: int) -> None:
    plain = kitchen_base()
    found, wrong = call(plain, scheme, seed)
    assert wrong == ()
    assert [part.id for part in found.parts] == [part.id for part in plain.parts]
    for part, before in zip(found.parts, plain.parts, strict=True):
        assert part.label in (before.label, PartLabel.UNKNOWN)
        if scheme in ("data set", "English", "foreign", "short"):
            assert (part.label is PartLabel.UNKNOWN) == (label_of(part.source.name) is PartLabel.UNKNOWN)
        if scheme in ("ids", "program"):
            assert part.label is before.label


def test_short_names_are_mostly_read_by_nobody_and_words_of_data_sets_by_everybody() -> None:
    found = [part for seed in range(20) for part in call(dresser(), "short", seed)[0].parts]
    assert sum(part.label is PartLabel.UNKNOWN for part in found) > 0.5 * len(found)
    found = [part for seed in range(5) for part in call(dresser(), "data set", seed)[0].parts]
    assert all(part.label is not PartLabel.UNKNOWN for part in found)


def test_a_lost_label_is_not_told_by_the_name() -> None:
    plain = dresser()
    bare = plain.with_labels({part.id: PartLabel.UNKNOWN for part in plain.parts})
    for seed in range(10):
        found, _ = named(
            bare, {part.id: part.label for part in plain.parts}, "program", False, np.random.default_rng(seed)
        )
        assert {label_of(part.source.name) for part in found.parts} == {PartLabel.UNKNOWN}
        assert {part.label for part in found.parts} == {PartLabel.UNKNOWN}


def test_misnamed_parts_are_stated_and_few() -> None:
    plain, wrong, parts = dresser(), 0, 0
    for seed in range(40):
        found, ids = call(plain, "English", seed, misnamed=True)
        differ = {
            p.id for p, q in zip(found.parts, plain.parts, strict=True) if p.label not in (q.label, PartLabel.UNKNOWN)
        }
        assert differ <= set(ids)
        wrong, parts = wrong + len(ids), parts + len(found.parts)
    assert 0.04 < wrong / parts < 0.16


def test_there_are_words_for_each_label() -> None:
    for label in LABELS:
        assert english_phrases()[label], label
        assert all(label_of(phrase) is label for phrase in english_phrases()[label])
        assert DATA_SET[label]
    assert all(len(foreign_words()[label]) > 5 for label in (PartLabel.DOOR, PartLabel.DRAWER, PartLabel.HANDLE))
