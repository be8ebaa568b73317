"""What a report states of a piece that does not stand by itself, or that tips over."""

from dataclasses import replace

import pytest

from grafu.articulation.base import BaseKind
from grafu.articulation.physics import physics_of
from grafu.asset.part import Asset
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.report import report_of
from grafu.pipeline.report_schema import Report
from grafu.pipeline.report_standing import StabilityRecord
from grafu.pipeline.standing import stability_words, with_stability
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel
from sketches import board, sketch


def shelf(posts: float) -> Asset:
    """Shelves 0.3 m deep on two posts 30 mm deep, whose front is at `posts`."""
    made = [
        board(f"shelf_{k}", PartLabel.SHELF, (-0.4, -0.15, 0.3 * k), (0.4, 0.15, 0.3 * k + 0.02)) for k in (1, 2, 3)
    ]
    for side, x in enumerate((-0.42, 0.4)):
        made.append(board(f"post_{side}", PartLabel.BAR, (x, posts, 0.0), (x + 0.02, posts + 0.03, 1.0)))
    return sketch(*made)


def reported(asset: Asset, base: BaseKind | None = None) -> Report:
    made = functionalize(asset, MotionSource.RULE, builtin_gallery())
    made = replace(made, object=replace(made.object, base=base or made.object.base))
    physics_of(made.object)
    return with_stability(report_of(made), made.object)


def test_of_a_piece_that_falls_a_note_states_by_how_much_unless_it_is_held():
    falls = reported(shelf(0.12))
    assert falls.base is not None
    assert falls.base.stability is not None
    assert falls.base.stability.closed_margin == pytest.approx(-0.12, abs=0.01)
    (note,) = [note for note in falls.notes if "outside of what it stands on" in note]
    assert "kg more at the far side of its base, or a wall mount" in note
    assert [n for n in reported(shelf(0.12), BaseKind.FREE).notes if "outside of what it stands on" in n] == [note]
    assert not reported(shelf(0.12), BaseKind.FIXED).notes


def test_what_leans_on_a_wall_and_what_stands_get_no_note():
    leans, stands = reported(shelf(-0.15)), reported(shelf(-0.015))
    assert leans.base is not None
    assert leans.base.kind is BaseKind.WALL
    assert "leans on a wall" in leans.base.why
    assert leans.notes == () == stands.notes


@pytest.mark.parametrize(
    ("closed", "words"),
    [
        (-0.0726, "its centre of mass is 73 mm outside of what it stands on, and it tips over: it needs 7.5 kg more"),
        (0.1, "with everything open it tips over by itself: it needs 7.5 kg more"),
        (None, "closed or with everything open it tips over by itself: it needs 7.5 kg more"),
    ],
)
def test_whether_it_falls_closed_or_open_is_told_apart(closed, words):
    record = StabilityRecord(
        mass=50.0,
        margin=-0.08,
        closed_margin=closed,
        tipping_force=0.0,
        tipping_joint="",
        weight_needed=7.5,
        wall_force=30.0,
    )
    assert stability_words(record).startswith(words)
