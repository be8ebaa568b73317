"""The batches of a run: from a source's models to tensors, a function of the config and the batch's number alone."""

from collections.abc import Generator
from contextlib import closing

import numpy as np

from grafu.training.batching import Showing, TrainingBatch, stack_showings
from grafu.training.config import TrainingConfig
from grafu.training.lesson_stream import Hand, Syllabus, stream_hands
from grafu.training.source import Source


def stream_batches(
    source: Source, config: TrainingConfig, start: int = 0, jobs: int = 1, part: tuple[int, int] = (0, 1)
) -> Generator[TrainingBatch, None, None]:
    """Yields the batches from number `start` on, without end; `jobs` as in `stream_hands`, `part` as in `Syllabus`."""
    syllabus = Syllabus(source, config.mix, config.features, config.seed, part)
    with closing(stream_hands(syllabus, config.deal, start, jobs)) as hands:
        for number, hand in enumerate(hands, start=start):
            rng = np.random.default_rng([config.seed, number, *part])
            yield stack_showings(_shown(hand, config, rng), config.network.points_frame == "part")


def _shown(hand: Hand, config: TrainingConfig, rng: np.random.Generator) -> list[Showing]:
    """Returns what is shown of each model this time: the copies of this visit, perhaps mirrored."""
    count = config.deal.copies
    showings = []
    for lesson, visit in hand:
        across = int(rng.choice(config.mirror_axes)) if rng.random() < config.mirror else None
        showings.append(Showing(lesson, lesson.copies[visit * count : (visit + 1) * count], across))
    return showings
