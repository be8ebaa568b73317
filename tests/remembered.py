"""Specimens that several tests ask for, made once: with shapes checked, making one takes a tenth of a second."""

from functools import cache

import pytest

from grafu.data import stream, write, write_plan
from grafu.synth.generate import make_specimen
from grafu.synth.specimen import Specimen
from grafu.training import source


@cache
def specimen(seed: int, index: int, points: int) -> Specimen:
    """Returns the specimen, made now or before."""
    return make_specimen(seed, index, points)


def remember(patch: pytest.MonkeyPatch) -> None:
    """Lets streams, writers and training take their specimens from here; other processes still make theirs."""
    for module in (stream, write, write_plan, source):
        patch.setattr(module, "make_specimen", specimen)
