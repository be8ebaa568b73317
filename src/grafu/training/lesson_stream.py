"""Lessons without end, made by several processes, and dealt out in hands of similar size, each lesson several times.

Everything is a function of seeds and numbers: the number of processes changes nothing, and a run that was cut goes on
with the very hands that it would have had.
"""

from collections.abc import Generator, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from itertools import count, islice
from typing import final

import numpy as np

from grafu.completion.features import FeatureConfig
from grafu.data.stream import ordered_map
from grafu.training.lesson import CopyMix, Lesson, draw_pairs, make_lesson
from grafu.training.source import Source

Hand = list[tuple[Lesson, int]]
"""The models of one batch, and which visit (0, 1, ...) each of them gets."""


@final
@dataclass(frozen=True)
class DealConfig:
    """How lessons are dealt.

    Each hand holds `models`, and of each model `copies` that share its points. A model is visited `reuse` times, with
    other copies: making it and grouping its points is most of the work of a lesson. Between two visits lie about
    `spread` hands. Hands are of models of similar size, so that little is padding.

    Raises:
        ValueError: if a number is less than 1.
    """

    models: int = 4
    copies: int = 4
    reuse: int = 4
    spread: int = 64

    def __post_init__(self) -> None:
        if min(self.models, self.copies, self.reuse, self.spread) < 1:
            raise ValueError(f"the numbers of `DealConfig` must be at least 1: got {self}")

    @property
    def fresh(self) -> int:
        """How many new models come in one round."""
        return max(1, self.spread // self.reuse) * self.models

    def hands_in(self, turn: int) -> int:
        """How many hands round `turn` (0, 1, ...) has: the first ones have fewer models to deal from."""
        return min(turn + 1, self.reuse) * self.fresh // self.models

    def round_of(self, hand: int) -> tuple[int, int]:
        """Returns the round that hand `hand` (0, 1, ...) belongs to, and which one it is there."""
        turn = 0
        while turn < self.reuse - 1 and hand >= self.hands_in(turn):
            hand -= self.hands_in(turn)
            turn += 1
        return (
            (turn, hand) if turn < self.reuse - 1 else (turn + hand // self.hands_in(turn), hand % self.hands_in(turn))
        )


@final
@dataclass(frozen=True)
class Syllabus:
    """The lessons of a source, by number; their copies are drawn with `seed`.

    `part` (k, n) takes every n-th model, from the k-th on: n readers share a source without a double.
    """

    source: Source
    mix: CopyMix
    features: FeatureConfig
    seed: int
    part: tuple[int, int] = (0, 1)

    def lesson(self, copies: int, number: int) -> Lesson:
        """Returns lesson `number` (0, 1, ...), with so many copies."""
        model = number * self.part[1] + self.part[0]
        rng = np.random.default_rng([self.seed, model])
        return make_lesson(draw_pairs(self.source.pair(model), copies, self.mix, rng), self.features)


def stream_hands(syllabus: Syllabus, deal: DealConfig, start: int = 0, jobs: int = 1) -> Generator[Hand, None, None]:
    """Yields the hands from number `start` on, without end.

    The lessons are made by `jobs` processes (1: by this one), as in `ordered_map`.
    """
    make = partial(syllabus.lesson, deal.copies * deal.reuse)
    turn, skipped = deal.round_of(start)
    first = max(0, turn - deal.reuse + 1)
    with closing(ordered_map(make, first * deal.fresh, None, jobs)) as lessons:
        yield from islice(_dealt(lessons, deal, (syllabus.seed, *syllabus.part), first, turn), skipped, None)


def _dealt(lessons: Iterator[Lesson], deal: DealConfig, seed: Sequence[int], first: int, turn: int) -> Iterator[Hand]:
    """Yields the hands of round `turn` and all later ones; the lessons begin with those of round `first`.

    While a round is dealt the lessons of the next are taken in, some after each hand, so that nobody waits for all.
    """
    kept: list[list[Lesson]] = [list(islice(lessons, deal.fresh)) for _ in range(first, turn + 1)]
    for now in count(turn):
        hands = _hands(kept, deal, np.random.default_rng([*seed, now]))
        coming: list[Lesson] = []
        for number, hand in enumerate(hands, start=1):
            yield hand
            coming.extend(islice(lessons, number * deal.fresh // len(hands) - len(coming)))
        kept = [*kept[-deal.reuse + 1 :], coming] if deal.reuse > 1 else [coming]


def _hands(kept: Sequence[Sequence[Lesson]], deal: DealConfig, rng: np.random.Generator) -> list[Hand]:
    """Returns all kept lessons as hands of similar sizes in a drawn order; the newest get their first visit."""
    deck = [(lesson, visit) for visit, lessons in enumerate(reversed(kept)) for lesson in lessons]
    deck = [deck[int(k)] for k in rng.permutation(len(deck))]
    deck.sort(key=lambda one: len(one[0].anchors))
    hands = [deck[k : k + deal.models] for k in range(0, len(deck), deal.models)]
    return [hands[int(k)] for k in rng.permutation(len(hands))]
