"""What Sweet Home 3D numbers as one opening is one leaf: its faces, bars and panes; its handles ride on it."""

import numpy as np
import pytest

from grafu.asset.drafts import PartDraft, parts_of_drafts
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel


def draft(name: str, at: float = 0.0) -> PartDraft:
    mesh = TriangleMesh.box_mesh(Box(np.array([at, 0.0, 0.0]), np.array([at + 0.5, 0.02, 1.0])))
    return PartDraft(name, (Surface(mesh),))


def parts(*names: str) -> dict[str, tuple[str, int, str | None]]:
    made = parts_of_drafts([draft(name, k) for k, name in enumerate(names)])
    return {p.id: (p.label.value, len(p.surfaces), p.carried_by) for p in made}


PREFIX = "sweethome3d_opening_on_hinge_1"


@pytest.mark.parametrize(
    ("names", "expected"),
    [
        (
            (f"{PREFIX}_door", f"{PREFIX}_doorOutside", "frame"),
            {f"{PREFIX}_door": ("door", 2, None), "frame": ("face frame", 1, None)},
        ),
        (
            (f"{PREFIX}_in", f"{PREFIX}_out", "sweethome3d_window_pane_on_hinge_1"),
            {f"{PREFIX}_door": ("door", 3, None)},
        ),
        (
            (f"{PREFIX}_door", "sweethome3d_opening_on_hinge_2_door"),
            {f"{PREFIX}_door": ("door", 1, None), "sweethome3d_opening_on_hinge_2_door": ("door", 1, None)},
        ),
        (
            ("sweethome3d_opening_on_rail_1", "sweethome3d_window_pane_on_rail_1"),
            {"sweethome3d_opening_on_rail_1_door": ("door", 2, None)},
        ),
        (
            ("sweethome3d_opening_on_rail_1", "sweethome3d_opening_on_rail_1_edge"),
            {"sweethome3d_opening_on_rail_1": ("misc", 2, None)},
        ),
        (
            ("sweethome3d_opening_on_rail_1_drawer", "sweethome3d_opening_on_rail_1_edge"),
            {"sweethome3d_opening_on_rail_1_drawer": ("drawer", 2, None)},
        ),
    ],
    ids=["two faces", "by their sides", "two leaves", "a sash", "a box", "a drawer"],
)
def test_one_number_is_one_leaf(names, expected):
    assert parts(*names) == expected


def test_its_handle_is_a_part_that_rides_on_it():
    made = parts_of_drafts([draft(f"{PREFIX}_door"), draft(f"{PREFIX}_bars"), draft(f"{PREFIX}_handle", 2.0)])
    assert [(p.label, p.carried_by) for p in made] == [
        (PartLabel.DOOR, None),
        (PartLabel.HANDLE, f"{PREFIX}_door"),
    ]
