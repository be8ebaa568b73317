"""The front of a nameless robot description is where a body of its own alone closes it, and across its broad side."""

import numpy as np
import pytest
import trimesh

from grafu.asset.closed_side import faces_across, side_of_door
from grafu.asset.load import load_asset
from grafu.geometry.box import Box

SIDES = {
    "left": [(0, 0, 0), (0.02, 0.6, 1.0)],
    "right": [(0.58, 0, 0), (0.6, 0.6, 1.0)],
    "top": [(0.02, 0, 0.98), (0.58, 0.6, 1.0)],
    "bottom": [(0.02, 0, 0), (0.58, 0.6, 0.02)],
}
BACK = [(0.02, 0.58, 0.02), (0.58, 0.6, 0.98)]
DOOR = [(0, -0.04, 0), (0.6, -0.001, 1.0)]


def robot(tmp_path, *links):
    """A URDF of links, each of some boxes."""
    text = ""
    for k, boxes in enumerate(links):
        shapes = [trimesh.creation.box(bounds=bounds) for bounds in boxes]
        trimesh.util.concatenate(shapes).export(tmp_path / f"{k}.obj")
        mesh = f'<visual><geometry><mesh filename="{k}.obj"/></geometry></visual>'
        text += f'<link name="link_{k}">{mesh}</link>'
        text += f'<joint name="j{k}" type="fixed"><parent link="link_0"/><child link="link_{k}"/></joint>' if k else ""
    (tmp_path / "piece.urdf").write_text(f'<robot name="piece">{text}</robot>')
    return load_asset(tmp_path / "piece.urdf")


def test_a_body_that_alone_closes_a_side_is_the_door(tmp_path):
    asset = robot(tmp_path, [*SIDES.values(), BACK], [DOOR])
    assert asset.frame.front == "-Y"
    assert "closes this side alone" in asset.frame.assumed[1]


@pytest.mark.parametrize(
    "links",
    [
        [[*SIDES.values()], [BACK]],  # the back of an open bookcase
        [[*SIDES.values()], [BACK], [DOOR]],  # which of both is the door is not clear
        [[*SIDES.values(), BACK], [[(0.2, -0.04, 0.2), (0.4, -0.001, 0.5)]]],  # it is small
    ],
    ids=["a back", "two", "small"],
)
def test_others_are_none(tmp_path, links):
    asset = robot(tmp_path, *links)
    assert side_of_door(asset.parts, asset.box, "+Z") is None


@pytest.mark.parametrize(("depth", "across"), [(0.5, False), (2.9, False), (3.2, True)])
def test_what_would_be_much_deeper_than_wide_faces_the_other_way(depth, across):
    assert faces_across("+X", Box(np.zeros(3), np.array([depth, 1.0, 2.0])), "+Z") is across
    assert not faces_across("-Y", Box(np.zeros(3), np.array([depth, 1.0, 2.0])), "+Z")
