"""Hands of lessons: each model so many times, alike in size, the same wherever the stream begins."""

from collections import Counter
from itertools import islice

import pytest
from little_runs import FewModels

from grafu.completion.features import FeatureConfig
from grafu.training.config import TINY
from grafu.training.lesson import DealConfig, Syllabus, stream_hands

FEATURES = FeatureConfig(points=8, anchors=2, neighbours=2)
DEAL = DealConfig(models=2, copies=1, reuse=3, spread=6)


def dealt(count: int, start: int = 0, deal: DealConfig = DEAL, part: tuple[int, int] = (0, 1)) -> list[list[tuple]]:
    hands = stream_hands(Syllabus(FewModels(), TINY.mix, FEATURES, 7, part), deal, start)
    found = [[(*lesson_key(lesson), visit) for lesson, visit in hand] for hand in islice(hands, count)]
    hands.close()
    return found


def lesson_key(lesson: object) -> tuple:
    return lesson.model_id, tuple(copy.strategy for copy in lesson.copies)  # type: ignore[attr-defined]


@pytest.mark.parametrize("start", [0, 1, 3, 8, 14])
def test_a_stream_that_begins_later_deals_the_same_hands(start: int) -> None:
    assert dealt(6, start) == dealt(start + 6)[start:]


def test_visits_are_the_first_to_the_last_each_as_often() -> None:
    steady = [visit for hand in dealt(30)[6:24] for *_, visit in hand]
    assert Counter(steady) == {0: 12, 1: 12, 2: 12}


def test_without_reuse_every_lesson_is_seen_once() -> None:
    deal = DealConfig(models=2, copies=1, reuse=1, spread=4)
    assert {visit for hand in dealt(8, 0, deal) for *_, visit in hand} == {0}


@pytest.mark.parametrize("deal", [DEAL, DealConfig(reuse=1), DealConfig(models=3, reuse=4, spread=8)])
def test_hands_are_numbered_through_the_rounds(deal: DealConfig) -> None:
    places = [(turn, hand) for turn in range(9) for hand in range(deal.hands_in(turn))]
    assert [deal.round_of(number) for number in range(len(places))] == places


def test_parts_of_a_stream_share_no_model() -> None:
    assert dealt(4, 0, DEAL, (0, 2)) != dealt(4, 0, DEAL, (1, 2))


def test_numbers_below_one_are_refused() -> None:
    with pytest.raises(ValueError, match="at least 1"):
        DealConfig(reuse=0)
