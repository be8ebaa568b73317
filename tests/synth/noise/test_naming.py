"""What makers call things, what is lost, what is wrong."""

import numpy as np
import pytest

from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Base
from grafu.synth.fronts.layout import CellRow, Door
from grafu.synth.noise.naming import MISTAKES, STYLES, draw_wording, mistaken, with_labels_masked, worded
from grafu.vocabulary import PartLabel
from sketches import board, door, sketch

TIDY = make_cabinet(Cabinet(case=Case(base=Base("plinth")), layout=CellRow((Door(shelves=1), Door()))))


def test_inner_uprights_are_side_panels_where_the_maker_says_so() -> None:
    asset = worded(TIDY, ("inner uprights are side panels",))

    assert asset.part("divider").label is PartLabel.SIDE_PANEL
    assert TIDY.part("divider").label is PartLabel.DIVIDER


def test_toe_kicks_are_side_panels_where_the_maker_says_so() -> None:
    asset = sketch(
        board("kick", PartLabel.BAR, (0.0, 0.0, 0.0), (0.6, 0.02, 0.1)),
        board("rail", PartLabel.BAR, (0.0, 0.0, 0.7), (0.6, 0.02, 0.8)),
    )

    found = worded(asset, ("toe kicks are side panels",))

    assert [p.label for p in found.parts] == [PartLabel.SIDE_PANEL, PartLabel.BAR]


def test_false_fronts_stay_face_frame() -> None:
    asset = sketch(
        board("stile", PartLabel.FACE_FRAME, (0.0, 0.0, 0.0), (0.04, 0.02, 0.8)),
        board("front", PartLabel.FACE_FRAME, (0.0, -0.02, 0.6), (0.6, 0.0, 0.8)),
    )

    found = worded(asset, ("frame members are bars",))

    assert [p.label for p in found.parts] == [PartLabel.BAR, PartLabel.FACE_FRAME]


@pytest.mark.parametrize("style", sorted(STYLES))
def test_no_wording_touches_what_moves_or_is_held(style: str) -> None:
    fixed = (PartLabel.DOOR, PartLabel.DRAWER, PartLabel.HANDLE)
    asset = worded(TIDY, (style,))

    for before, after in zip(TIDY.parts, asset.parts, strict=True):
        assert (before.label in fixed) == (after.label in fixed)
        if before.label in fixed:
            assert after == before


def test_wordings_come_at_their_rates() -> None:
    rng = np.random.default_rng(3)
    drawn = [draw_wording(rng) for _ in range(1500)]

    for name, (_, ratio) in STYLES.items():
        assert sum(name in d for d in drawn) / len(drawn) == pytest.approx(ratio, abs=0.05)


def test_masked_parts_have_names_that_say_nothing() -> None:
    asset = with_labels_masked(TIDY, ("door_1",))

    assert asset.part("door_1").label is PartLabel.UNKNOWN
    assert asset.part("door_1").source.name.startswith("Cube.")
    assert asset.part("door_2") == TIDY.part("door_2")


def test_doors_and_drawers_are_never_taken_for_each_other() -> None:
    assert not {PartLabel.DOOR, PartLabel.DRAWER} & set(MISTAKES)
    assert not any(label.is_movable for labels in MISTAKES.values() for label in labels)
    part = sketch(door("door", (0.0, 0.0, 0.0), (0.4, 0.02, 0.4), "left")).parts[0]
    assert mistaken(part, np.random.default_rng(0)) is PartLabel.DOOR


def test_a_mistake_is_something_else() -> None:
    rng = np.random.default_rng(0)

    assert {mistaken(TIDY.part("shelf"), rng) for _ in range(20)} == set(MISTAKES[PartLabel.SHELF])
