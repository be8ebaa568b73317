"""Numbers of every config of realization check themselves when they are made."""

from dataclasses import fields
from math import nan

import pytest

from grafu.additions.carcass.config import CarcassConfig
from grafu.additions.drawer_box.config import DrawerBoxConfig
from grafu.additions.grip.config import GripConfig, GripSize
from grafu.additions.handle.config import GraspConfig, HandleConfig
from grafu.additions.interior.config import InteriorConfig
from grafu.additions.top.config import TopConfig
from grafu.joints.config import HingeConfig, RailConfig, RealizationConfig

CONFIGS = (
    CarcassConfig, DrawerBoxConfig, GraspConfig, GripConfig, HandleConfig, HingeConfig, InteriorConfig, RailConfig,
    RealizationConfig, TopConfig,
)  # fmt: skip
NUMBERS = [(made, field.name) for made in CONFIGS for field in fields(made) if field.type is float]
COUNTS = [(made, field.name) for made in CONFIGS for field in fields(made) if field.type is int]
POSITIVE = [
    (CarcassConfig, "back"),
    (DrawerBoxConfig, "wall"),
    (GraspConfig, "gap"),
    (GripConfig, "margin"),
    (GripSize, "length"),
    (GripConfig, "finger_width"),
    (HandleConfig, "inset"),
    (HandleConfig, "least"),
    (HingeConfig, "plate"),
    (InteriorConfig, "touch"),
    (RailConfig, "divider"),
    (RealizationConfig, "depth"),
    (TopConfig, "thickness"),
]
RATIOS = [
    (GraspConfig, "lever"),
    (GraspConfig, "small"),
    (GripConfig, "depth_ratio"),
    (GripConfig, "shown"),
    (HandleConfig, "both"),
    (HingeConfig, "slim"),
    (InteriorConfig, "carried"),
    (RailConfig, "most_inset"),
    (RealizationConfig, "least_opening"),
    (RealizationConfig, "max_carve"),
    (RealizationConfig, "max_carve_fitting"),
    (TopConfig, "coverage"),
]


@pytest.mark.parametrize(("made", "name"), NUMBERS)
@pytest.mark.parametrize("wrong", [-1.0, nan])
def test_no_number_is_negative_or_none_at_all(made: type, name: str, wrong: float) -> None:
    with pytest.raises(ValueError, match=f"`{made.__name__}.{name}` must .*: got {wrong}"):
        made(**{name: wrong})


@pytest.mark.parametrize(("made", "name"), POSITIVE)
def test_what_is_there_has_a_size(made: type, name: str) -> None:
    sizes = {"length": 0.1, "width": 0.1} if made is GripSize else {}
    with pytest.raises(ValueError, match=rf"`{made.__name__}.{name}` must be .*: got 0\.0"):
        made(**{**sizes, name: 0.0})


@pytest.mark.parametrize(("made", "name"), COUNTS)
def test_no_count_is_negative(made: type, name: str) -> None:
    with pytest.raises(ValueError, match=r"must .*: got .*-1"):
        made(**{name: -1})


@pytest.mark.parametrize(("made", "name"), RATIOS)
def test_a_fraction_is_less_than_the_whole(made: type, name: str) -> None:
    with pytest.raises(ValueError, match=f"`{made.__name__}.{name}` must be"):
        made(**{name: 1.5})


@pytest.mark.parametrize("wrong", [{"size": (0.0, 0.1)}, {"depth": 0.0}, {"depth": nan}, {"size": (0.1, nan)}], ids=str)
def test_a_grips_own_size_is_above_0(wrong: dict[str, object]) -> None:
    with pytest.raises(ValueError, match="own size and depth must be above 0: got"):
        GripConfig(**wrong)
