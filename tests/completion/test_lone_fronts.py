"""A guessed drawer that is a front alone, and can be none, turns; fronts of drawers, and what a label states, stay."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.part import Asset
from grafu.completion.boards_behind import BoardBehindConfig
from grafu.completion.lone_fronts import LoneFrontConfig, with_lone_fronts
from grafu.graph.completion import BY_BOTH, Decision, GraphCompletion
from grafu.graph.edges import Attached, Hinge, Rail
from grafu.graph.edit import with_edges
from grafu.graph.motion import border_to_face, opening_face
from grafu.graph.parse import parse_graph
from grafu.vocabulary import PartLabel
from small_scenes import box

FRONT = 2  # the face that looks to -Y
BODY = replace(box("body", (-0.5, 0.38, 0.0), (0.5, 0.4, 1.0)), label=PartLabel.BACK_PANEL)
PLATE = box("front", (-0.48, -0.02, 0.4), (0.48, 0.0, 0.8))
SHELF = box("shelf", (-0.48, 0.1, 0.6), (0.48, 0.38, 0.62))
DIVIDER = box("divider", (-0.01, 0.1, 0.42), (0.01, 0.38, 0.78))
BELOW, MIDDLE, ABOVE, RIGHT = (-0.05, 0.45), (-0.05, 0.59), (-0.05, 0.74), (0.38, 0.59)
BOTTOM_FACE, TOP_FACE, LEFT_FACE, RIGHT_FACE = 4, 5, 0, 1
NONE: dict[str, float] = {}


def turned(*others, front=PLATE, handle=MIDDLE, guessed=True, axis=FRONT, board=NONE, drawn=True, **changes):
    """Returns the face of the border on which the front hangs, and what was decided; None: it is a drawer still."""
    parts = [BODY, replace(front, label=PartLabel.DRAWER), *others]
    known = parse_graph(Asset("made", "", "made", tuple(parts)))
    edges = [Rail("body", "front", axis)]
    if handle is not None:
        x, z = handle
        parts.append(replace(box("bar", (x, -0.05, z), (x + 0.1, -0.02, z + 0.02)), label=PartLabel.HANDLE))
        edges.append(Attached("front", "bar"))
    asset = Asset("made", "", "made", tuple(parts))
    graph = parse_graph(asset)
    edges += [Attached("front", part.id) for part in others if part.id.startswith("box")]
    label = (Decision("front", "label", "drawer", 0.9, "door", 0.1),) if guessed else ()
    decisions = (*label, Decision("front", "slide", str(FRONT), 0.8), Decision("front", "mount", "body", 0.7))
    before = GraphCompletion(
        graph if drawn else known,
        with_edges(graph, edges),
        "network",
        added=() if drawn else ("bar",),
        decisions=decisions,
    )
    after = with_lone_fronts(
        before, asset, replace(LoneFrontConfig(), **changes), replace(BoardBehindConfig(), **board)
    )
    (motion,) = after.completed.motions
    if isinstance(motion, Rail):
        assert after is before
        return None
    assert isinstance(motion, Hinge)
    assert motion.parent == "body"
    assert opening_face(1, motion.border, motion.sign) == FRONT
    assert after.completed.node("front").label is PartLabel.DOOR
    assert after.decisions == (
        Decision("front", "label", "door", 0.1, "drawer", 0.9, BY_BOTH),
        Decision("front", "border", str(motion.border), 0.8, by=BY_BOTH),
        Decision("front", "sign", str(motion.sign), 0.8, by=BY_BOTH),
        Decision("front", "mount", "body", 0.7),
    )
    return border_to_face(1, motion.border)


@pytest.mark.parametrize("board", [SHELF, DIVIDER], ids=lambda part: part.id)
@pytest.mark.parametrize(
    ("handle", "face"), [(MIDDLE, BOTTOM_FACE), (ABOVE, BOTTOM_FACE), (BELOW, TOP_FACE), (RIGHT, LEFT_FACE)]
)
def test_a_front_right_before_a_shelf_or_divider_hangs_away_from_its_handle(board, handle, face):
    assert turned(board, handle=handle) == face


def test_a_front_that_is_not_wide_and_has_no_handle_hangs_on_its_left():
    high = box("front", (-0.2, -0.02, 0.4), (0.2, 0.0, 0.8))
    assert turned(SHELF, handle=None) == BOTTOM_FACE
    assert turned(SHELF, front=high, handle=None) == LEFT_FACE


@pytest.mark.parametrize("handle", [BELOW, MIDDLE, ABOVE])
def test_a_handle_alone_shows_no_flap(handle):
    assert turned(handle=handle) is None  # drawers are pulled at any height


@pytest.mark.parametrize(
    ("handle", "changed", "face"),
    [
        pytest.param(RIGHT, {}, LEFT_FACE, id="at the right"),
        pytest.param((-0.46, 0.59), {}, RIGHT_FACE, id="at the left"),
        pytest.param((0.1, 0.59), {}, None, id="near the middle"),
        pytest.param(RIGHT, {"drawn": False}, None, id="a handle that was only predicted"),
        pytest.param(RIGHT, {"front": box("front", (-0.48, -0.02, 0.5), (0.48, 0.0, 0.7))}, None, id="a low front"),
    ],
)
def test_a_front_whose_handle_is_at_a_side_is_a_door_that_hangs_on_the_other(handle, changed, face):
    assert turned(handle=handle, **changed) == face


@pytest.mark.parametrize(
    "others",
    [
        [],
        [box("shelf", (-0.48, 0.0, 0.79), (0.48, 0.38, 0.81))],  # above the front
        [box("shelf", (-0.48, 0.3, 0.6), (0.48, 0.38, 0.62))],  # far behind it
        [box("bottom", (-0.48, 0.0, 0.48), (0.48, 0.36, 0.49))],  # the bottom of a drawer's box
        [box("shelf", (-0.48, 0.1, 0.6), (-0.2, 0.38, 0.62))],  # beside most of it
        [box("block", (-0.48, 0.1, 0.5), (0.48, 0.38, 0.7))],  # no board
        [SHELF, box("box_1", (-0.47, 0.0, 0.42), (-0.46, 0.3, 0.7))],  # a box of its own rides on it
        [SHELF, box("box_2", (-0.4, 0.0, 0.42), (0.4, 0.3, 0.43))],
    ],
)
def test_what_may_be_a_drawer_stays_one(others):
    assert turned(*others) is None


TALL = box("front", (-0.15, -0.02, 0.1), (0.15, 0.0, 0.9))


@pytest.mark.parametrize(
    ("handle", "drawn", "face"),
    [
        (None, True, LEFT_FACE),
        ((0.04, 0.5), True, LEFT_FACE),
        ((-0.14, 0.5), True, RIGHT_FACE),
        ((-0.05, 0.5), True, None),  # in the middle of its width: a pull-out
        ((-0.05, 0.5), False, LEFT_FACE),  # a handle that is only predicted
    ],
)
def test_a_front_that_is_far_higher_than_wide_is_a_door(handle, drawn, face):
    assert turned(front=TALL, handle=handle, drawn=drawn) == face


@pytest.mark.parametrize(
    ("low", "width", "handle", "face"),
    [
        (1.5, 0.9, None, TOP_FACE),
        (1.5, 0.4, None, LEFT_FACE),
        (1.5, 0.9, (-0.05, 1.52), TOP_FACE),
        (1.5, 0.4, (0.05, 1.7), LEFT_FACE),
        (1.3, 0.9, None, None),  # its inside can be seen
    ],
)
def test_a_front_above_the_eyes_is_a_door(low, width, handle, face):
    front = box("front", (-width / 2, -0.02, low), (width / 2, 0.0, low + 0.4))
    assert turned(front=front, handle=handle) == face


def test_a_high_front_with_a_box_or_a_narrow_one_stays_a_drawer():
    assert turned(box("box_1", (-0.14, 0.0, 0.12), (-0.13, 0.3, 0.5)), front=TALL, handle=None) is None
    assert turned(front=box("front", (-0.1, -0.02, 0.1), (0.1, 0.0, 0.9)), handle=None) is None
    assert turned(front=TALL, handle=None, tall=3.0) is None


def test_what_is_labelled_thick_or_slides_elsewhere_stays():
    assert turned(SHELF, guessed=False) is None
    assert turned(SHELF, front=box("front", (-0.48, -0.02, 0.4), (0.48, 0.09, 0.8))) is None
    assert turned(SHELF, axis=1) is None


@pytest.mark.parametrize(("change", "limit"), [("near", 0.1), ("thick", 0.01), ("inside", 0.6), ("along", 0.99)])
def test_each_threshold_of_a_board_decides(change, limit):
    narrow = box("shelf", (-0.4, 0.1, 0.6), (0.25, 0.38, 0.62))
    assert turned(narrow) == BOTTOM_FACE
    assert turned(narrow, board={change: limit}) is None


def test_a_shelf_in_one_surface_with_the_case_is_found_as_well():
    sides = [box("side", (x, 0.0, 0.0), (x + 0.02, 0.4, 1.0)) for x in (-0.5, 0.48)]
    surfaces = tuple(surface for part in (*sides, SHELF) for surface in part.surfaces)
    assert turned(replace(sides[0], surfaces=surfaces)) == BOTTOM_FACE
    assert turned(replace(sides[0], surfaces=surfaces[:2])) is None, "nothing is behind its middle"


def test_thresholds_of_handles_and_boxes_decide():
    assert turned(SHELF, box("box_1", (-0.47, 0.0, 0.42), (-0.46, 0.3, 0.7)), box=0.9) == BOTTOM_FACE
    assert turned(SHELF, handle=BELOW, edge=0.01) == BOTTOM_FACE
    assert turned(SHELF, handle=RIGHT, off=0.49) == BOTTOM_FACE
    assert turned(SHELF, wide=3.0) == LEFT_FACE
    assert np.isclose(PLATE.box.size[0] / PLATE.box.size[2], 2.4)


BROAD = box("front", (-0.48, -0.02, 0.3), (0.48, 0.0, 0.85))


@pytest.mark.parametrize(
    ("front", "handle", "face"),
    [
        pytest.param(BROAD, (-0.05, 0.8), BOTTOM_FACE, id="its handle above"),
        pytest.param(BROAD, (-0.05, 0.33), TOP_FACE, id="its handle below"),
        pytest.param(box("front", (-0.48, -0.02, 0.3), (0.48, 0.0, 0.7)), (-0.05, 0.66), None, id="as high as deep"),
        pytest.param(box("front", (-0.2, -0.02, 0.3), (0.2, 0.0, 0.85)), (-0.05, 0.8), None, id="a narrow pull-out"),
    ],
)
def test_a_broad_front_that_is_higher_than_what_is_behind_it_is_deep_drops_or_lifts(front, handle, face):
    """The whole is 0.4 m deep behind it: a dishwasher, a cabinet for shoes."""
    assert turned(front=front, handle=handle) == face


@pytest.mark.parametrize(
    ("kind", "depth", "turns"), [("urdf", 0.35, True), ("glb", 0.35, False), ("urdf", 0.02, False)]
)
def test_a_front_alone_is_no_drawer_where_another_link_has_the_box_of_one(kind, depth, turns):
    other = replace(box("other", (-0.48, -0.02, 0.1), (0.48, depth, 0.38)), label=PartLabel.DRAWER)
    asset = Asset("made", "", kind, (BODY, replace(PLATE, label=PartLabel.DRAWER), other))
    graph = parse_graph(asset)
    edges = [Rail("body", name, FRONT) for name in ("front", "other")]
    told = (Decision("front", "label", "drawer", 0.9, "door", 0.1), Decision("front", "slide", str(FRONT), 0.8))
    after = with_lone_fronts(GraphCompletion(graph, with_edges(graph, edges), "network", decisions=told), asset)
    assert (after.completed.node("front").label is PartLabel.DOOR) is turns
