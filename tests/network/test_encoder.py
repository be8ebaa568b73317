"""What nodes see of their boxes beside the object's."""

import pytest
import torch

from grafu.network.config import GraFuConfig, PointsFrame
from grafu.network.encoder import corners, face_scale, margins
from grafu.network.points import PointEncoder
from random_graphs import arrays

# A wall at the left, a plate 10 mm below the top, and padding that is farther out than both
BOXES = torch.tensor(
    [[[0.05, 0.0, 0.5, 0.05, 0.5, 0.5], [0.5, 0.0, 0.98, 0.4, 0.5, 0.01], [9.0, 9.0, 9.0, 1.0, 1.0, 1.0]]]
)
MASK = torch.tensor([[True, True, False]])


def test_margins_are_measured_from_the_boxes_that_there_are() -> None:
    plate = margins(BOXES, MASK)[0, 1]
    wanted = [0.1, 0.0, 0.97, 0.0, 0.0, 0.01, 0.8, 1.0, 0.02]
    assert plate.tolist() == pytest.approx(face_scale(torch.tensor(wanted)).tolist(), abs=1e-4)


def test_padding_has_no_margins() -> None:
    assert not margins(BOXES, MASK)[0, 2].any()


def test_padding_changes_no_margins() -> None:
    assert torch.equal(margins(BOXES, MASK)[:, :2], margins(BOXES[:, :2], MASK[:, :2]))


def test_of_no_boxes_there_are_no_margins() -> None:
    assert margins(BOXES[:, :0], MASK[:, :0]).shape == (1, 0, 9)


def test_corners_are_beside_the_middle() -> None:
    assert corners(BOXES)[0, 0].tolist() == pytest.approx([0.05, 0.0, 0.5, 0.0, -0.5, 0.0, 0.1, 0.5, 1.0])


def encoder(frame: PointsFrame = "part") -> PointEncoder:
    torch.manual_seed(0)
    return PointEncoder(GraFuConfig(points=8, points_frame=frame))


def test_the_order_of_points_and_groups_does_not_matter() -> None:
    one, order = arrays(3), torch.tensor([4, 2, 0, 1, 3])
    shuffled = encoder()(one["anchors"][:, order], one["groups"][:, order].flip(2))
    assert torch.allclose(shuffled, encoder()(one["anchors"], one["groups"]), atol=1e-6)


@pytest.mark.parametrize(("frame", "same"), [("part", True), ("object", False)])
def test_where_a_part_stands_counts_only_in_the_object_s_frame(frame: PointsFrame, same: bool) -> None:
    one, encode = arrays(3), encoder(frame)
    moved = encode(one["anchors"] + torch.tensor([0.3, -0.2, 0.1]), one["groups"])
    assert torch.allclose(moved, encode(one["anchors"], one["groups"]), atol=1e-5) is same


def test_size_counts() -> None:
    one = arrays(3)
    assert not torch.allclose(
        encoder()(one["anchors"] * 2, one["groups"] * 2), encoder()(one["anchors"], one["groups"]), atol=1e-3
    )


def test_no_parts_have_no_latents() -> None:
    one = arrays(0)
    assert encoder()(one["anchors"], one["groups"]).shape == (0, 8)
