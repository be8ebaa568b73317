"""Which parts are drawn to be joined or cut: only still ones, and handles only with what carries them."""

import numpy as np
import pytest

from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.fronts.layout import CellRow, Door, Drawer, Stack
from grafu.synth.noise.cutting import GROUPS, LEVEL, NAMELESS, ODD, draw_cuts, draw_joined
from grafu.vocabulary import PartLabel
from sketches import board, sketch

TIDY = make_cabinet(Cabinet(layout=CellRow((Door(shelves=2), Stack((Drawer(), Drawer()))))))
STILL = {p.id for p in TIDY.parts if p.label.is_support}


def test_groups_join_still_parts_under_one_of_their_names() -> None:
    rng = np.random.default_rng(0)
    names = {label for _, labels in GROUPS.values() for label in labels} | {PartLabel.MISC}
    for _ in range(100):
        [group] = draw_joined(rng, TIDY, TIDY.parts, 1.0, 0.0)
        assert len(group.ids) > 1
        assert set(group.ids) <= STILL
        assert group.label in names
        assert group.label is not PartLabel.BAR


def test_what_is_joined_is_called_after_its_largest_wall_or_not_at_all() -> None:
    rng = np.random.default_rng(3)
    groups = [draw_joined(rng, TIDY, TIDY.parts, 1.0, 0.0)[0] for _ in range(300)]
    mixed = [g for g in groups if len({TIDY.part(i).label for i in g.ids}) > 1]

    assert sum(g.label is PartLabel.MISC for g in mixed) / len(mixed) == pytest.approx(ODD, abs=0.06)
    assert sum(not g.named for g in mixed) / len(mixed) == pytest.approx(NAMELESS, abs=0.06)
    assert not {g.label for g in mixed} & set(LEVEL)
    assert all(g.named for g in groups if g not in mixed)


def test_handles_join_all_or_none() -> None:
    [group] = draw_joined(np.random.default_rng(0), TIDY, TIDY.parts, 0.0, 1.0)

    assert group.label is None
    assert set(group.ids) == {p.id for p in TIDY.parts if p.label is PartLabel.HANDLE}


def test_nothing_is_joined_where_there_is_one_part() -> None:
    alone = sketch(board("side", PartLabel.SIDE_PANEL, (0.0, 0.0, 0.0), (0.02, 0.5, 0.8)))

    assert draw_joined(np.random.default_rng(0), alone, alone.parts, 1.0, 1.0) == ()


def test_cuts_name_still_parts_or_drawers() -> None:
    rng = np.random.default_rng(1)
    moving_bodies = {joint.part for joint in TIDY.joints}
    for _ in range(200):
        for cut in draw_cuts(rng, TIDY, TIDY.parts, 1.0):
            assert cut.part in (moving_bodies if cut.kind == "box apart" else STILL)
            assert 2 <= cut.count <= 5


def test_tidy_modellers_cut_nothing_but_frames() -> None:
    assert draw_cuts(np.random.default_rng(2), TIDY, TIDY.parts, 0.0) == ()
