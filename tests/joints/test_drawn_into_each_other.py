"""Closed bodies that are drawn into each other by little get a channel; what reaches far into a way stays whole."""

from dataclasses import replace

import manifold3d
import numpy as np
import pytest

from grafu.asset.part import Part
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.clearance.carve import Path, obstruction
from grafu.joints.clearance.channel import carve_channel, channel_boxes
from grafu.joints.config import RealizationConfig
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.nesting import bodies_of
from grafu.scene.scene import Scene
from grafu.vocabulary import PartLabel
from judging import installed, realized
from small_scenes import box, hinged, scene, sliding
from solids import as_mesh, solid

CONFIG = RealizationConfig()
OUT = (0.0, -1.0, 0.0)


def wavy(name: str, body: manifold3d.Manifold, phase: float, high: float = 0.004, label=PartLabel.SIDE_PANEL) -> Part:
    """A body whose surface is off by `high` metres in waves of 0.2 m, as a generated mesh is."""

    def waved(points: np.ndarray) -> np.ndarray:
        turned = np.roll(points, 1, axis=1) + np.roll(points, 2, axis=1)
        return points + high * np.sin(2 * np.pi * turned / 0.2 + phase)

    mesh = as_mesh(body.refine_to_length(0.025).warp_batch(waved))
    return replace(box(name, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), surfaces=(Surface(mesh),), label=label)


def case_of_one_piece() -> manifold3d.Manifold:
    """A case of 0.5 x 0.45 x 0.4 m, open at its front (y = 0), with walls of 30 mm."""
    return solid((0.0, 0.0, 0.0), (0.5, 0.45, 0.4)) - solid((0.03, -0.01, 0.03), (0.47, 0.42, 0.37))


def block() -> manifold3d.Manifold:
    """A drawer drawn as a block that fills the room of the case, with a front that laps it."""
    return solid((0.03, 0.0, 0.03), (0.47, 0.42, 0.37)) + solid((0.005, -0.02, 0.005), (0.495, 0.0, 0.395))


def way(*parts: Part, reach: float = 0.3) -> tuple[Scene, Path]:
    made = scene(*parts, joints=(sliding("drawer", OUT),))
    (request,) = plan_from_annotation(made).joints
    shift = request.kind.along(request.axis)
    there = Scene({p.id: p for p in made.parts}, bodies_of([request]), made.extent)
    return there, Path("drawer", shift, reach, np.eye(3), is_turn=False)


@pytest.mark.parametrize("phase", [1.0, 2.5])
def test_a_wavy_drawer_in_a_wavy_case_of_one_piece_gets_a_channel(phase):
    case = wavy("case", case_of_one_piece(), 0.0)
    there, path = way(case, wavy("drawer", block(), phase, label=PartLabel.DRAWER))
    assert obstruction(there, path, CONFIG).blockers == ("case",)

    freed, done = carve_channel(there, path, ["case"], CONFIG)

    assert obstruction(freed, path, CONFIG).blockers == ()
    assert [change.part.id for change in done] == ["case"]
    assert freed.parts["case"].mesh.box.size == pytest.approx(case.mesh.box.size, abs=0.005), "it stays from outside"
    parts = case, wavy("drawer", block(), phase, label=PartLabel.DRAWER)
    outcome = installed(realized(scene(*parts, joints=(sliding("drawer", OUT),)), CONFIG))["drawer"]
    assert outcome.opening >= 0.2
    assert outcome.collision_share == 0.0


def test_what_reaches_far_into_the_way_of_a_drawer_stays():
    """A divider in the middle of the case goes through the drawer: that is no drawer of this case."""
    case = case_of_one_piece() + solid((0.2, 0.02, 0.03), (0.24, 0.45, 0.37))
    there, path = way(wavy("case", case, 0.0), wavy("drawer", block(), 1.0, label=PartLabel.DRAWER))

    assert not carve_channel(there, path, ["case"], CONFIG)[1]


def test_open_surfaces_stay():
    case = wavy("case", case_of_one_piece(), 0.0)
    open_case = replace(case, surfaces=(Surface(case.mesh.with_faces(np.arange(len(case.mesh.faces) - 40))),))
    there, path = way(open_case, wavy("drawer", block(), 1.0, label=PartLabel.DRAWER))

    assert not carve_channel(there, path, ["case"], CONFIG)[1]


def hung(back: float) -> tuple[Scene, Path]:
    """A wavy door whose back is drawn `back` metres into its wavy case, and how it turns about its left edge."""
    case = wavy("case", solid((0.0, 0.0, 0.0), (0.4, 0.4, 0.6)) - solid((0.02, -0.1, 0.02), (0.38, 0.38, 0.58)), 0.0)
    leaf = wavy("door", solid((0.002, -0.018, 0.002), (0.398, back, 0.598)), 1.0, 0.002, PartLabel.DOOR)
    made = scene(case, leaf, joints=(hinged(),))
    (request,) = plan_from_annotation(made).joints
    turn = request.kind.along(request.axis)
    there = Scene({p.id: p for p in made.parts}, bodies_of([request]), made.extent)
    return there, Path("door", turn, 1.5, np.eye(3), is_turn=True)


def test_a_wavy_case_makes_room_for_the_back_of_a_wavy_door():
    there, path = hung(0.006)
    assert obstruction(there, path, CONFIG).blockers == ("case",)

    freed, done = carve_channel(there, path, ["case"], CONFIG)

    assert obstruction(freed, path, CONFIG).blockers == ()
    assert [change.part.id for change in done] == ["case"]


def test_a_block_that_fills_the_whole_case_is_no_door_of_it():
    there, path = hung(0.3)

    assert not carve_channel(there, path, ["case"], CONFIG)[1]


def test_the_way_of_a_drawer_is_as_wide_as_each_of_its_sections():
    path = Path("drawer", Axis(vec3(0.0, 0.0, 0.0), vec3(*OUT)).shift, 0.3, np.eye(3), is_turn=False)

    found = list(channel_boxes(TriangleMesh.box_mesh(Box(np.zeros(3), np.ones(3))), path, 0.01, 8))

    assert len(found) == 1
    assert found[0].low == pytest.approx([-0.01, -0.3, -0.01])
    assert found[0].high == pytest.approx([1.01, 1.0, 1.01])
    two = list(channel_boxes(as_mesh(block()), path, 0.001, 64))
    assert len(two) == 2, "the box, and the front that is wider"
    assert two[1].size[0] == pytest.approx(0.492, abs=1e-3)
    assert two[1].high[1] < 0.01
