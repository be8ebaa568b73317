"""Batches of samples: each model so many times, alike in size, the same wherever the stream begins."""

from collections import Counter
from itertools import islice

import pytest
from little_runs import FewModels

from grafu.completion.features import FeatureConfig
from grafu.training.config import TINY
from grafu.training.sample import Sampler, SamplerConfig, stream_samples

FEATURES = FeatureConfig(points=8, anchors=2, neighbours=2)
SAMPLING = SamplerConfig(models=2, copies=1, reuse=3, spread=6)


def streamed(
    count: int, start: int = 0, sampling: SamplerConfig = SAMPLING, part: tuple[int, int] = (0, 1)
) -> list[list[tuple]]:
    batches = stream_samples(Sampler(FewModels(), TINY.mix, FEATURES, 7, part), sampling, start)
    found = [[(*sample_key(sample), visit) for sample, visit in batch] for batch in islice(batches, count)]
    batches.close()
    return found


def sample_key(sample: object) -> tuple:
    return sample.model_id, tuple(copy.strategy for copy in sample.copies)  # type: ignore[attr-defined]


@pytest.mark.parametrize("start", [0, 1, 3, 8, 14])
def test_a_stream_that_begins_later_gives_the_same_batches(start: int) -> None:
    assert streamed(6, start) == streamed(start + 6)[start:]


def test_visits_are_the_first_to_the_last_each_as_often() -> None:
    steady = [visit for batch in streamed(30)[6:24] for *_, visit in batch]
    assert Counter(steady) == {0: 12, 1: 12, 2: 12}


def test_without_reuse_every_sample_is_seen_once() -> None:
    sampling = SamplerConfig(models=2, copies=1, reuse=1, spread=4)
    assert {visit for batch in streamed(8, 0, sampling) for *_, visit in batch} == {0}


@pytest.mark.parametrize("sampling", [SAMPLING, SamplerConfig(reuse=1), SamplerConfig(models=3, reuse=4, spread=8)])
def test_batches_are_numbered_through_the_rounds(sampling: SamplerConfig) -> None:
    places = [(turn, batch) for turn in range(9) for batch in range(sampling.batches_in(turn))]
    assert [sampling.round_of(number) for number in range(len(places))] == places


def test_parts_of_a_stream_share_no_model() -> None:
    assert streamed(4, 0, SAMPLING, (0, 2)) != streamed(4, 0, SAMPLING, (1, 2))


def test_numbers_below_one_are_refused() -> None:
    with pytest.raises(ValueError, match="at least 1"):
        SamplerConfig(reuse=0)
