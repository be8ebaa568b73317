"""A window without names stands, also where the usual direction of its format would lay it on its face."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from grafu.asset.frame import settle_frame, whole_box
from grafu.asset.lying_windows import LyingWindowConfig, lies_as_a_window
from grafu.asset.options import LoadOptions
from grafu.asset.reading import Convention, Reading
from grafu.geometry.appearance import Surface
from grafu.geometry.mesh import TriangleMesh
from small_scenes import box

OBJ = Convention("OBJ", usual_up="+Y")


def ring(name, low, high, width):
    """Returns the four boards of an upright frame that faces -Y."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    return (
        box(f"{name}_left", low, (x0 + width, y1, z1)),
        box(f"{name}_right", (x1 - width, y0, z0), high),
        box(f"{name}_below", (x0 + width, y0, z0), (x1 - width, y1, z0 + width)),
        box(f"{name}_above", (x0 + width, y0, z1 - width), (x1 - width, y1, z1)),
    )


FRAME = ring("outer", (-0.6, -0.04, 0.0), (0.6, 0.04, 1.2), 0.06)
SASH = ring("sash", (-0.535, -0.045, 0.065), (0.535, 0.015, 1.135), 0.07)
PANE = (box("pane", (-0.47, -0.018, 0.13), (0.47, -0.012, 1.07)),)
HANDLE = (box("lever", (0.49, -0.09, 0.5), (0.51, -0.07, 0.62)), box("rose", (0.49, -0.07, 0.6), (0.51, -0.045, 0.62)))
WINDOW = (*FRAME, *SASH, *PANE, *HANDLE)
SLATS = tuple(box(f"slat{k}", (-0.54, -0.01, 0.07 + 0.075 * k), (0.54, 0.01, 0.12 + 0.075 * k)) for k in range(14))
FILLING = (box("slab", (-0.535, -0.038, 0.065), (0.535, 0.038, 1.135)),)


def lies(*parts, config=LyingWindowConfig()):
    return lies_as_a_window(parts, whole_box(parts), "+Y", config)


def test_a_window_in_a_file_that_has_z_up_stands():
    assert lies(*WINDOW)
    frame = settle_frame(Reading("mesh file", WINDOW, OBJ), LoadOptions())
    assert (frame.up, frame.front) == ("+Z", "-Y")
    assert "a window that lies on its face" in frame.assumed[0]


def test_only_a_usual_direction_gives_way():
    stated = Convention("glTF", up="+Y", front="+Z")
    assert "a window that" not in settle_frame(Reading("glb", WINDOW, stated), LoadOptions()).assumed[0]


def disc(name, radius, inner, depth):
    """A disc that faces -Y, with a round hole in it where its inner radius is above 0."""
    made = trimesh.creation.annulus(inner, radius, depth) if inner else trimesh.creation.cylinder(radius, depth)
    made.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, (1, 0, 0)))
    made.apply_translation((0.0, 0.0, radius))
    return replace(box(name, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=(Surface(TriangleMesh.from_trimesh(made)),))


def test_a_round_window_rests_on_little_and_stands_all_the_same():
    frame, pane = disc("ring", 0.45, 0.43, 0.15), replace(disc("pane", 0.44, 0.0, 0.01))
    stated = Convention("made", usual_up="+Z")
    assert settle_frame(Reading("mesh file", (frame, pane), stated), LoadOptions()).up == "+Z"
    stool = (disc("seat", 0.45, 0.0, 0.15),)
    assert settle_frame(Reading("mesh file", stool, stated), LoadOptions()).up != "+Z"


@pytest.mark.parametrize(
    "parts",
    [
        pytest.param((*FRAME, box("bottom", (-0.54, 0.035, 0.06), (0.54, 0.04, 1.14))), id="a tray"),
        pytest.param((*WINDOW, box("back", (-0.6, 0.04, 0.0), (0.6, 0.045, 1.2))), id="a picture with a back"),
        pytest.param((*FRAME, *SLATS), id="a bed with slats"),
        pytest.param(PANE, id="a pane alone"),
        pytest.param((*FRAME, *FILLING), id="a slab as thick as its frame"),
        pytest.param(
            (*ring("deep", (-0.6, -0.2, 0.0), (0.6, 0.2, 1.2), 0.06), *SASH, *PANE), id="a deep case with a glass shelf"
        ),
    ],
)
def test_what_else_is_flat_stays_as_it_lies(parts):
    assert not lies(*parts)


@pytest.mark.parametrize("field", ["shallow", "inside", "pane", "glazed", "thinner"])
def test_what_counts_as_a_window_can_be_chosen(field):
    strict = {"shallow": 0.05, "inside": 0.6, "pane": 0.9, "glazed": 0.9, "thinner": 0.05}
    assert not lies(*WINDOW, config=LyingWindowConfig(**{field: strict[field]}))
    with pytest.raises(ValueError, match=field):
        LyingWindowConfig(**{field: 1.5})
