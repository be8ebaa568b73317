"""Carousels that are asked for are as large as turn freely, stop no door, and turn without end when all is built."""

from dataclasses import replace
from math import radians, sqrt

import numpy as np
import pytest
import trimesh

from front_scenes import cabinet, scene_of
from grafu.additions.config import AdditionConfig
from grafu.additions.interior.furnish import Furnished
from grafu.additions.interior.request import parse_interior
from grafu.additions.interior.turned import furnish_scene
from grafu.asset.edit import yawed
from grafu.asset.part import Asset, Part
from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import from_rotation, rotation_matrix, translation
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.scene.scene import Scene
from grafu.synth.cabinets.corner import CornerCabinet, InnerCorner, make_corner_cabinet, make_inner_corner
from grafu.synth.fronts.layout import Door, Drawer, OpenCell, Pair, Stack
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import JointType, PartLabel

ONE_DOOR = InnerCorner(shelves=0)
PIECES: dict[str, Asset] = {
    "L, one door": make_inner_corner(ONE_DOOR),
    "L, two doors": make_inner_corner(replace(ONE_DOOR, second=Door("left"))),
    "diagonal door": make_corner_cabinet(CornerCabinet(shelves=0)),
    "turned": yawed(make_corner_cabinet(CornerCabinet(shelves=0)), radians(20)),
    "pair": cabinet(Pair(), width=0.9),
    "open": cabinet(OpenCell(), width=0.6),
}


def furnished(asset: Asset, request: str = "carousel=2") -> Furnished:
    return furnish_scene(scene_of(asset), parse_interior(request))


def only(found: Furnished) -> Part:
    (addition,) = found.additions
    return addition.part


def axis_of(part: Part) -> np.ndarray:
    return part.mesh.box.center


def turned(mesh: TriangleMesh, at: np.ndarray, angle: float) -> trimesh.Trimesh:
    """A mesh turned about an upright line through a point."""
    T = translation(at) @ from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), angle)) @ translation(-at)
    return mesh.transformed(T).to_trimesh()


def met(part: Part, scene: Scene) -> set[str]:
    """What a carousel cuts in some turn, doors closed, and while each opens."""
    found: set[str] = set()
    everything = trimesh.collision.CollisionManager()
    for other in scene.parts.values():
        everything.add_object(other.id, other.mesh.to_trimesh())
    for angle in np.linspace(0.0, radians(15), 5):  # it repeats itself
        found |= everything.in_collision_single(turned(part.mesh, axis_of(part), float(angle)), return_names=True)[1]
    own = part.mesh.to_trimesh()
    for moving, motion in scene.joint_motions.items():
        swinging = trimesh.collision.CollisionManager()
        swinging.add_object(moving, scene.moving_mesh(moving).to_trimesh())
        for value in np.linspace(0.0, motion.upper, 40):
            swinging.set_transform(moving, motion.kind.transform(motion.axis, float(value)))
            found |= swinging.in_collision_single(own, return_names=True)[1]
    return found


@pytest.mark.parametrize("name", PIECES)
def test_a_carousel_turns_freely_and_stops_no_door(name: str) -> None:
    carousel = only(furnished(PIECES[name]))

    assert carousel.label is PartLabel.MISC
    assert met(carousel, scene_of(PIECES[name])) == set()
    radii = np.linalg.norm((carousel.mesh.vertices - axis_of(carousel))[:, :2], axis=1)
    assert radii.max() >= 0.2
    assert np.ptp(radii[radii > 0.9 * radii.max()]) < 0.01  # rims are round


@pytest.mark.parametrize("name", ["L, one door", "L, two doors"])
def test_in_an_l_it_fills_the_corner(name: str) -> None:
    carousel = only(furnished(PIECES[name]))

    clear = 0.008
    largest = (sqrt(2) * (ONE_DOOR.depth - 2 * ONE_DOOR.panel - clear) - clear) / (1 + sqrt(2))
    assert 0.97 * largest <= carousel.box.size[0] / 2 <= 1.01 * largest


def test_trays_stand_above_each_other_on_a_post_from_floor_to_top() -> None:
    two, three = (only(furnished(PIECES["pair"], f"carousel={count}")) for count in (2, 3))

    for part, count in ((two, 2), (three, 3)):
        wide = part.mesh.vertices[np.linalg.norm((part.mesh.vertices - axis_of(part))[:, :2], axis=1) > 0.1]
        heights = np.unique(wide[:, 2].round(4))
        assert len(heights) == 3 * count  # the underside, the floor and the rim of each
    assert two.box.size[2] == pytest.approx(float(three.box.size[2]), abs=1e-6)
    assert two.box.size[2] >= 0.6


def test_a_carousel_stands_in_the_middle_of_a_wide_room() -> None:
    assert abs(float(axis_of(only(furnished(PIECES["pair"])))[0])) < 0.01


@pytest.mark.parametrize(
    ("asset", "why"),
    [
        (cabinet(Door(), width=0.25), "radius"),
        (cabinet(Stack((Door(), Door(), Door(), Door(), Door())), width=0.6), "above each other"),
        (cabinet(Stack((Drawer(), Drawer())), width=0.6), "no compartment"),
    ],
)
def test_what_has_no_room_says_so(asset: Asset, why: str) -> None:
    found = furnished(asset, "carousel=3")

    assert found.additions == ()
    assert any(why in refusal.why for refusal in found.refused)


@pytest.mark.parametrize("name", ["L, one door", "diagonal door"])
@pytest.mark.parametrize("small", [None, False])
def test_it_turns_without_end_in_the_finished_piece_unless_small_parts_are_off(name: str, small: bool | None) -> None:
    wanted = Settings(additions=AdditionConfig(interior=parse_interior("carousel=2")), small_parts=small)
    made = functionalize(PIECES[name], MotionSource.RULE, builtin_gallery(), PipelineConfig(wanted))

    turning = {joint.child: joint for joint in made.object.joints if joint.type is JointType.CONTINUOUS}
    assert set(turning) == (set() if small is False else {"carousel"})
    visuals = {visual.name for link in made.object.links for visual in link.visuals}
    assert "carousel" in visuals
    if small is None:
        link = next(link for link in made.object.links if link.id == "carousel")
        assert [visual.name for visual in link.visuals] == ["carousel"]  # the corner post stays
        assert np.allclose(np.abs(turning["carousel"].axis.direction), [0.0, 0.0, 1.0])
    assert {joint.child for joint in made.object.joints} >= {"door"}
