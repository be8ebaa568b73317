"""Hinges lie on material: behind handles, beside profiled edges, on frames and fillers, however wide the seam is."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.joints.config import RealizationConfig
from grafu.joints.hinge import place
from grafu.joints.hinge.candidates import Tolerances, heights_to_try, ruled_pins
from grafu.joints.hinge.hardware import install
from grafu.joints.hinge.search import door_search
from grafu.joints.hinge.survey import BorderSurvey
from grafu.joints.hinge_config import PinConfig
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.nesting import bodies_of
from grafu.scene.border import border_frame, without_handle
from grafu.scene.scene import Scene
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import MechanismClass
from judging import hardware, installed, realized
from small_scenes import DOOR, LEFT_EDGE, box, hinged, scene

BESIDE = box("side", (-0.02, -0.02, 0.0), (-0.002, 0.4, 0.6))
RADIUS = 0.0036
RIGHT_EDGE = Axis(vec3(0.4, 0.0, 0.0), vec3(0.0, 0.0, 1.0))


def with_shapes(part, *meshes):
    return replace(part, surfaces=(Surface(merge_meshes([part.mesh, *meshes])),))


def blocks(result, door="door"):
    return [v for side in hardware(result, door) for v in side if v.name.startswith("support")]


def classes(found: BorderSurvey) -> list[MechanismClass]:
    config = RealizationConfig()
    tolerances = Tolerances(config.contact, config.flush, RADIUS)
    return [pin.mechanism for pin in ruled_pins(border_frame(DOOR.mesh, LEFT_EDGE), found, tolerances, PinConfig())]


def test_a_bulky_handle_of_the_doors_own_mesh_is_no_front():
    handle = TriangleMesh.box_mesh(Box(vec3(0.3, -0.08, 0.2), vec3(0.35, -0.02, 0.4)))
    plain = realized(scene(DOOR, BESIDE, joints=(hinged(),)))
    pulled = realized(scene(with_shapes(DOOR, handle), BESIDE, joints=(hinged(),)))

    assert blocks(pulled) == []
    assert installed(pulled)["door"].axis.point == pytest.approx(installed(plain)["door"].axis.point, abs=1e-4)
    assert installed(pulled)["door"].mechanism is installed(plain)["door"].mechanism


@pytest.mark.parametrize(("height", "front"), [(0.06, 0.02), (0.5, 0.08)], ids=["a handle", "a raised panel"])
def test_the_front_is_where_a_tenth_of_the_outline_faces_forwards(height, front):
    raised = TriangleMesh.box_mesh(Box(vec3(0.05, -0.08, 0.05), vec3(0.35, -0.02, 0.05 + height)))
    mesh = with_shapes(DOOR, raised).mesh
    frame = without_handle(border_frame(mesh, LEFT_EDGE), mesh, ratio=0.1, play=1e-4)

    assert frame.origin[1] == pytest.approx(-front, abs=1e-6)
    assert frame.thickness == pytest.approx(front, abs=1e-6)


@pytest.mark.parametrize(("gap", "contact"), [(0.0105, True), (0.0115, False)])
def test_leaves_lie_in_a_seam_of_up_to_three_barrel_radii(gap, contact):
    beside = BorderSurvey(gap, 0.0, 0.02, float("inf"), 0.0, float("-inf"), 0.0)

    assert (MechanismClass.C in classes(beside)) is contact
    assert MechanismClass.F in classes(beside)


def test_a_door_on_a_wider_side_turns_beside_its_edge_not_outside_the_cabinet():
    wider = box("side", (-0.03, 0.0, 0.0), (0.02, 0.4, 0.6))
    outcome = installed(realized(scene(DOOR, wider, joints=(hinged(),))))["door"]

    assert outcome.mechanism is MechanismClass.P
    assert outcome.axis.point[0] > -2 * RADIUS


def test_a_door_on_a_wide_filler_hangs_in_the_corner_with_nothing_let_in():
    """Blind corner units: the filler goes on farther than rays from beside it look."""
    filler = box("filler", (-0.6, 0.0, 0.0), (0.05, 0.02, 0.6))
    result = realized(scene(DOOR, filler, joints=(hinged(),)))

    assert installed(result)["door"].mechanism is MechanismClass.P
    assert blocks(result) == []


def test_a_leaf_on_a_bevelled_edge_is_as_wide_as_the_flat_part():
    flat = 0.013  # of an edge 20 mm deep; the rest is bevelled
    outline = [(0.0, 0.0), (0.0, -flat), (0.02, -0.02), (0.4, -0.02), (0.4, 0.0)]
    corners = np.array([(x, y, z) for x, y in outline for z in (0.0, 0.6)])
    hull = TriangleMesh.from_trimesh(trimesh.convex.convex_hull(corners))
    filler = box("filler", (-0.6, 0.0, 0.0), (0.05, 0.02, 0.6))
    result = realized(scene(replace(DOOR, surfaces=(Surface(hull),)), filler, joints=(hinged(),)))
    leaves = [v.mesh.box for v in hardware(result, "door")[0] if v.name.startswith("hinge")]

    assert installed(result)["door"].mechanism is MechanismClass.P
    assert min(leaf.low[1] for leaf in leaves) > -flat - 0.0025
    assert min(leaf.low[1] for leaf in leaves) < -0.008


@pytest.mark.parametrize(("step", "flush"), [(0.001, True), (0.0055, False)])
def test_what_counts_as_flush_is_millimetres_however_large_the_furniture_is(step, flush):
    beside = BorderSurvey(0.001, -step, 0.02, float("inf"), 0.0, float("-inf"), 0.0)

    assert (MechanismClass.F in classes(beside)) is flush


def test_no_block_where_a_pivot_carries_the_door():
    """Its side stands 15 mm behind the door; the boards above and below hold pivots."""
    behind = box("side", (-0.02, 0.015, 0.0), (0.0, 0.4, 0.6))
    boards = [box(f"board_{z}", (-0.02, -0.02, z), (0.4, 0.4, z + 0.018)) for z in (-0.02, 0.602)]
    result = realized(scene(DOOR, behind, *boards, joints=(hinged(),)))

    assert installed(result)["door"].template == "pivot"
    assert blocks(result) == []


@pytest.mark.parametrize(("behind", "expected"), [(True, 2), (False, 1)], ids=["a side behind", "nothing else"])
def test_a_pivot_at_one_end_alone_carries_a_door_only_where_nothing_else_does(behind, expected):
    """A board above would hold a pivot, nothing stands below; a side behind takes hinges on blocks."""
    side = [box("side", (-0.02, 0.015, 0.0), (0.0, 0.4, 0.6))] if behind else []
    above = box("board", (-0.02, -0.02, 0.602), (0.4, 0.4, 0.62))
    result = realized(scene(DOOR, *side, above, joints=(hinged(),)))

    assert installed(result)["door"].count == expected
    assert (installed(result)["door"].template == "pivot") is not behind


def test_a_pair_of_doors_tries_the_same_heights_in_the_same_order():
    left, right = (border_frame(DOOR.mesh, axis) for axis in (LEFT_EDGE, RIGHT_EDGE))
    heights = [
        [[float(frame.to_object(vec3(0.0, 0.0, z)[None])[0, 2]) for z in levels] for levels in heights_to_try(frame, 2)]
        for frame in (left, right)
    ]

    assert left.rotation[2, 2] * right.rotation[2, 2] < 0
    assert np.allclose(heights[0], heights[1])


def test_hinges_of_a_door_are_out_of_the_way_only_all_together():
    """Stops that end within leaves: each hinge alone would be free once it is shifted along the pin, both are not."""
    plain = realized(scene(DOOR, BESIDE, joints=(hinged(),)))
    leaves = sorted((v.mesh.box for v in hardware(plain, "door")[0]), key=lambda leaf: leaf.low[2])
    deep = 1.5 * 0.0004 * 0.6
    stops = [
        _stop("low stop", leaves[0], leaves[0].low[2] - 0.004, leaves[0].low[2] + deep),
        _stop("high stop", leaves[-1], leaves[-1].high[2] - deep, leaves[-1].high[2] + 0.004),
    ]
    found = realized(scene(DOOR, BESIDE, *stops, joints=(hinged(),)))
    beside = sorted((v.mesh.box for v in hardware(found, "door")[0]), key=lambda leaf: leaf.low[2])

    assert len(leaves) == len(beside) == 2
    assert beside[0].low[2] == pytest.approx(leaves[0].low[2], abs=1e-4)
    assert beside[1].high[2] < leaves[1].high[2] or beside[1].low[2] > stops[1].box.high[2]


def _stop(name, leaf, low, high):
    return box(name, (leaf.low[0], leaf.low[1], low), (-1e-4, leaf.high[1], high))


def test_a_hinge_is_installed_once_at_one_place(monkeypatch):
    """Fewer hinges, and a thorough search, come back to places that were tried; what was found there holds."""
    installs = []
    monkeypatch.setattr(place, "install", lambda *given: installs.append(given) or install(*given))
    asset = scene(DOOR, BESIDE, joints=(hinged(),))
    (request,) = plan_from_annotation(asset).joints
    built = Scene({part.id: part for part in asset.parts}, bodies_of([request]), asset.extent)
    search = door_search(request, built, RealizationConfig())
    first = place.place_hinges(search, builtin_gallery())
    once = len(installs)
    again = place.place_hinges(search, builtin_gallery())
    assert once == len(installs) > 0
    assert [visual.mesh for visual in again.static] == [visual.mesh for visual in first.static]
