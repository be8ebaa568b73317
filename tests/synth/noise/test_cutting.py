"""Which parts are drawn to be joined or cut: only still ones, and handles only with what carries them."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.fronts.layout import CellRow, Door, Drawer, Stack
from grafu.synth.noise.cutting import (
    BODY,
    BODY_HANDLES,
    BODY_NAMELESS,
    FRONTS_ALONE,
    GROUPS,
    LEVEL,
    NAMELESS,
    ODD,
    draw_bare_drawers,
    draw_body,
    draw_cuts,
    draw_joined,
)
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


def test_a_case_in_one_part_is_all_that_is_still() -> None:
    rng = np.random.default_rng(4)
    bodies = [found for _ in range(3000) if (found := draw_body(rng, TIDY, TIDY.parts))]
    handles = {p.id for p in TIDY.parts if p.label is PartLabel.HANDLE}
    named = (1 - BODY_NAMELESS) * (1 - NAMELESS)

    assert len(bodies) / 3000 == pytest.approx(BODY, abs=0.02)
    assert all(set(body.ids) == STILL for body, *_ in bodies)
    assert all(set(joined.ids) == handles and joined.label is None for _, *rest in bodies for joined in rest)
    assert sum(len(found) == 2 for found in bodies) / len(bodies) == pytest.approx(BODY_HANDLES, abs=0.07)
    assert sum(body.named for body, *_ in bodies) / len(bodies) == pytest.approx(named, abs=0.07)


def test_nothing_that_stays_shut_is_one_part() -> None:
    still = replace(TIDY, joints=())

    assert not any(draw_body(np.random.default_rng(k), still, still.parts) for k in range(200))


def test_drawers_are_fronts_alone_all_or_none() -> None:
    rng = np.random.default_rng(5)
    drawn = [draw_bare_drawers(rng, TIDY, is_body=True) for _ in range(500)]

    drawers = {p.id for p in TIDY.parts if p.label is PartLabel.DRAWER}
    assert {cut.part for cuts in drawn for cut in cuts} == drawers  # a sliding door would lose what is behind its edge
    assert {len(cuts) for cuts in drawn} == {0, len(drawers)}
    assert sum(bool(cuts) for cuts in drawn) / 500 == pytest.approx(FRONTS_ALONE, abs=0.07)
    assert draw_bare_drawers(rng, TIDY, is_body=False) == ()


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
