"""The rates at which modelling noise is drawn, without building anything."""

from collections import Counter
from functools import cache

import numpy as np
import pytest

from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.fronts.layout import CellRow, Door, Drawer, Stack
from grafu.synth.noise.cutting import BODY, BODY_MASKING, FRONTS_ALONE
from grafu.synth.noise.distortion import TURNED
from grafu.synth.noise.modelling_noise import ModellingNoise
from grafu.synth.noise.modelling_styles import (
    AJAR,
    BOTH_SIDES,
    DENSITY,
    NO_BACK,
    NO_BOTTOM,
    NO_CASE_TOP,
    NO_HANDLES,
    NO_TOP,
    STYLES,
    draw_noise,
    is_storage,
)
from grafu.synth.samples import TIDY as KINDS
from grafu.vocabulary import PartLabel

TIDY = make_cabinet(Cabinet(layout=CellRow((Door(shelves=2), Stack((Drawer(), Drawer()))))))
HANDLES = {p.id for p in TIDY.parts if p.label is PartLabel.HANDLE}
NUMBER = 2000


@cache
def draws(family: str = "") -> tuple[ModellingNoise, ...]:
    rng = np.random.default_rng(5)
    return tuple(draw_noise(rng, TIDY, family) for _ in range(NUMBER))


def ratio(found: list[bool]) -> float:
    return sum(found) / len(found)


def test_styles_come_at_their_fractions() -> None:
    counts = Counter(u.style for u in draws())

    assert sum(h.ratio for h in STYLES.values()) == pytest.approx(1.0)
    for name, style in STYLES.items():
        assert counts[name] / NUMBER == pytest.approx(style.ratio, abs=0.04)


def test_maskings_are_distributions_and_labels_survive_in_about_half() -> None:
    assert all(sum(h.masking) == pytest.approx(1.0) for h in STYLES.values())
    whole = [(1 - BODY) * 0.53 + BODY * BODY_MASKING[0], (1 - BODY) * 0.10 + BODY * BODY_MASKING[3]]
    assert ratio([u.masked == 0 for u in draws()]) == pytest.approx(whole[0], abs=0.03)
    assert ratio([u.masked == 1 for u in draws()]) == pytest.approx(whole[1], abs=0.02)


def test_drawers_that_are_fronts_alone_stand_before_a_case_in_one_part_and_seldom_have_labels() -> None:
    alone = [u for u in draws() if any(cut.kind == "front alone" for cut in u.cuts)]
    still = {p.id for p in TIDY.parts if p.label.is_support}

    assert len(alone) / NUMBER == pytest.approx(BODY * FRONTS_ALONE, abs=0.02)
    assert all(set(u.joined[0].ids) == still - set(u.missing) for u in alone)
    assert ratio([u.masked == 1 for u in alone]) == pytest.approx(BODY_MASKING[3], abs=0.1)


@pytest.mark.parametrize(
    ("part", "rate"),
    [("back_panel", NO_BACK), ("bottom_panel", NO_BOTTOM), ("top_panel", NO_CASE_TOP), (HANDLES, NO_HANDLES)],
)
def test_parts_are_missing_at_their_rates(part: str | set[str], rate: float) -> None:
    wanted = {part} if isinstance(part, str) else part

    assert ratio([wanted <= set(u.missing) for u in draws()]) == pytest.approx(rate, abs=0.03)


@pytest.mark.parametrize("family", ["base cabinet", "sideboard", "desk"])
def test_tops_are_missing_where_nobody_sees_them(family: str) -> None:
    assert ratio(["top_panel" in u.missing for u in draws(family)]) == pytest.approx(NO_TOP[family], abs=0.04)


def test_faces_are_drawn_as_exporters_do() -> None:
    assert ratio([u.both_sides for u in draws()]) == pytest.approx(BOTH_SIDES, abs=0.07)
    assert ratio([u.density == "plain" for u in draws()]) == pytest.approx(DENSITY["plain"], abs=0.03)


def test_few_look_the_wrong_way() -> None:
    assert ratio([abs(u.yaw) > 1.0 for u in draws()]) == pytest.approx(TURNED, abs=0.015)
    assert ratio([0 < abs(u.yaw) < 1.0 for u in draws()]) < 0.03


def test_few_are_ajar_and_few_mislabelled() -> None:
    assert ratio([bool(u.ajar) for u in draws()]) == pytest.approx(AJAR, abs=0.015)
    assert ratio([u.mislabelled for u in draws()]) < 0.03


def test_sizes_are_off_by_no_more_than_people_are() -> None:
    factors = np.array([u.factors for u in draws()])

    assert ratio((factors[:, 0] < 0).tolist()) == pytest.approx(0.5, abs=0.04)
    assert np.all(factors[:, 1:] > 0)
    assert np.abs(factors).min() > 0.5
    assert np.abs(factors).max() < 2.0


def test_a_merging_modeller_merges_and_never_cuts_panels() -> None:
    merging = [u for u in draws() if u.style == "merged export"]
    exploding = [u for u in draws() if u.style == "exploded export"]

    assert all(u.joined for u in merging)
    assert not any(cut.kind != "front alone" for u in merging for cut in u.cuts)
    assert ratio([bool(u.cuts) for u in exploding]) > 0.6


def test_what_is_absent_is_missing() -> None:
    rng = np.random.default_rng(0)

    assert all("shelf_1" in draw_noise(rng, TIDY, absent=("shelf_1",)).missing for _ in range(20))


def test_nothing_stands_on_what_is_missing() -> None:
    assert not any("top_panel" in u.missing and "things on top" in u.loose_objects for u in draws())


def test_tables_are_no_storage() -> None:
    assert is_storage(TIDY)
    assert not is_storage(KINDS["table with hanging drawers"]())
