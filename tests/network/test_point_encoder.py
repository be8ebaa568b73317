"""The point encoder: which changes of a part's points change its latent."""

import pytest
import torch
from random_graphs import arrays

from grafu.network.config import PointsFrame
from grafu.network.point_encoder import PointEncoder


def encoder(frame: PointsFrame = "part") -> PointEncoder:
    torch.manual_seed(0)
    return PointEncoder(8, frame)


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
