"""Shelves that slope down to the front end at the walls on both sides, float nowhere and stop nothing."""

from math import cos, degrees, radians, tan

import numpy as np
import pytest
from interior_judge import faults_of_panels

from front_scenes import cabinet, scene_of
from grafu.additions.interior.request import parse_interior
from grafu.additions.interior.turned import furnish_scene
from grafu.asset.edit import yawed
from grafu.asset.part import Asset, Part
from grafu.synth.cabinets.corner import InnerCorner, make_inner_corner
from grafu.synth.fronts.layout import Door, Drawer, OpenCell, Pair, Stack
from grafu.synth.noise.edits import with_merged
from grafu.vocabulary import PartLabel

BOARDS = ("side panel", "back panel", "top panel", "bottom panel")
PIECES: dict[str, Asset] = {
    "pair": cabinet(Pair(), width=0.9),
    "door over a drawer": cabinet(Stack((Door(), Drawer()), (6.0, 1.0)), width=0.6),
    "open": cabinet(OpenCell(), width=0.8),
    "boards in one part": with_merged(cabinet(Pair(), width=0.9), BOARDS),
    "turned": yawed(cabinet(Pair(), width=0.9), radians(30)),
    "wing of a corner cabinet": make_inner_corner(InnerCorner(shelves=0)),
}


def shelves_of(asset: Asset, request: str) -> list[Part]:
    scene = scene_of(asset)
    found = furnish_scene(scene, parse_interior(request))
    assert faults_of_panels(found.additions, scene) == []
    shelves = [addition.part for addition in found.additions if addition.part.label is PartLabel.SHELF]
    return sorted(shelves, key=lambda part: float(part.box.center[2]))


def slope_of(shelf: Part) -> float:
    """The angle between the larger faces of a shelf and the floor, degrees."""
    return degrees(np.arccos(abs(float(shelf.mesh.face_normals[int(np.argmax(face_areas(shelf))), 2]))))


def face_areas(shelf: Part) -> np.ndarray:
    one, other = np.diff(shelf.mesh.triangles, axis=1).swapaxes(0, 1)
    return np.asarray(np.linalg.norm(np.cross(one, other), axis=1)) / 2


@pytest.mark.parametrize("name", PIECES)
@pytest.mark.parametrize("angle", [8, 20])
def test_shelves_slope_as_asked_and_rest_on_both_sides(name: str, angle: int) -> None:
    shelves = shelves_of(PIECES[name], f"shelves=2,angle={angle}deg")

    assert len(shelves) == 2
    for shelf in shelves:
        assert slope_of(shelf) == pytest.approx(angle, abs=0.01)
        spread = shelf.mesh.vertices[:, 2]
        assert float(np.ptp(spread)) > 0.2 * tan(radians(angle))


def test_the_front_edge_lies_lower_and_the_rear_edge_at_the_back() -> None:
    plain = shelves_of(PIECES["pair"], "shelves=1")[0]
    (shelf,) = shelves_of(PIECES["pair"], "shelves=1,angle=20deg")

    front = shelf.mesh.vertices[shelf.mesh.vertices[:, 1] < shelf.box.center[1]]
    assert front[:, 2].max() < shelf.box.center[2]
    assert shelf.box.high[1] == pytest.approx(float(plain.box.high[1]), abs=0.003)
    assert shelf.box.low[1] == pytest.approx(float(plain.box.low[1]), abs=0.008)
    assert np.allclose([shelf.box.low[0], shelf.box.high[0]], [plain.box.low[0], plain.box.high[0]], atol=0.001)


def test_sloping_shelves_stand_between_dividers() -> None:
    shelves = shelves_of(PIECES["pair"], "shelves=1,dividers=1,angle=15deg")

    assert len(shelves) == 2
    assert all(shelf.box.size[0] < 0.45 for shelf in shelves)


def test_what_is_too_steep_for_the_room_is_refused() -> None:
    low = cabinet(Stack((OpenCell(), OpenCell(), OpenCell(), OpenCell())), width=0.9)
    scene = scene_of(low)

    found = furnish_scene(scene, parse_interior("shelves=4,angle=45deg"))

    assert found.additions == ()
    assert found.refused


def test_an_angle_of_zero_is_none() -> None:
    one, other = (shelves_of(PIECES["pair"], words) for words in ("shelves=2", "shelves=2,angle=0deg"))

    assert all(np.array_equal(a.mesh.vertices, b.mesh.vertices) for a, b in zip(one, other, strict=True))


def test_a_steeper_shelf_is_longer() -> None:
    flat, steep = (shelves_of(PIECES["open"], f"shelves=1,angle={angle}deg")[0] for angle in (1, 30))

    assert face_areas(steep).max() * cos(radians(30)) == pytest.approx(face_areas(flat).max(), rel=0.05)
