"""Shapes of a robot description are called as they are, as their link, or as their file: what tells more."""

import pytest

from grafu.asset.visual_names import visual_name


@pytest.mark.parametrize(
    ("visual", "link", "stem", "name"),
    [
        ("", "link_0", "refrigerator_body_0", "refrigerator_body_0"),  # a number tells nothing
        ("", "link_0", "mesh_7", "link_0"),
        ("", "carcass", "fridge_3", "carcass"),
        ("", "link_2", "door_4", "door_4"),
        ("panel_x", "link_2", "fridge_3", "panel_x"),
        ("visual_1", "left_door", "part", "left_door"),
        ("bar", "door_handle", "part", "door_handle"),
    ],
)
def test_a_shape_has_the_name_that_tells_most(visual, link, stem, name):
    assert visual_name(visual, link, stem, is_root=False) == name


def test_the_name_of_the_root_is_that_of_the_whole():
    assert visual_name("shape_1", "left_door", "side_panel", is_root=True) == "side_panel"
