"""What nodes see of their boxes beside the object's."""

import pytest
import torch

from grafu.network.node_encoder import corners, margins
from grafu.network.pair_terms import face_scale

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
