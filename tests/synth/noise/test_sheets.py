"""Boards as sheets: on their outer faces, unless something would come loose."""

from grafu.graph.parse import parse_graph
from grafu.synth.noise.sheets import with_anchored_sheets
from grafu.vocabulary import PartLabel
from sketches import board, sketch

# A back let in between two sides, which ends flush with them: its outer face touches them, its inner one, too
SIDES = (
    board("left", PartLabel.SIDE_PANEL, (-0.5, -0.3, 0.0), (-0.48, 0.3, 0.8)),
    board("right", PartLabel.SIDE_PANEL, (0.48, -0.3, 0.0), (0.5, 0.3, 0.8)),
    board("bottom", PartLabel.BOTTOM_PANEL, (-0.48, -0.3, 0.0), (0.48, 0.3, 0.02)),
)
PLANTED = board("back", PartLabel.BACK_PANEL, (-0.5, 0.3, 0.0), (0.5, 0.32, 0.8))


def test_a_sheet_lies_on_the_outer_face_where_nothing_comes_loose() -> None:
    made = with_anchored_sheets(sketch(*SIDES, PLANTED), ("left",))

    box = made.part("left").box
    assert box.size[0] == 0.0
    assert box.low[0] == -0.5


def test_a_planted_back_as_a_sheet_stays_with_its_case() -> None:
    made = with_anchored_sheets(sketch(*SIDES, PLANTED), ("back",))

    assert made.part("back").box.low[1] == made.part("back").box.high[1] == 0.3
    assert len(parse_graph(made).neighbours["back"]) == 3


def test_what_would_come_loose_either_way_stays_a_board() -> None:
    post = board("post", PartLabel.BAR, (-0.01, -0.3, 0.02), (0.01, -0.28, 0.5))
    top = board("top", PartLabel.TOP_PANEL, (-0.1, -0.3, 0.5), (0.1, 0.3, 0.53))
    lamp = board("lamp", PartLabel.MISC, (-0.02, 0.0, 0.53), (0.02, 0.05, 0.6))

    made = with_anchored_sheets(sketch(*SIDES, post, top, lamp), ("top",))

    assert made.part("top").box.size[2] > 0.02
