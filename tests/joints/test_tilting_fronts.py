"""Fronts of shoe cabinets tilt about their lower edges with the bins behind them, and stop before these are level."""

from dataclasses import replace
from math import degrees, radians

import numpy as np
import pytest

import grafu
from fold_judge import cuts, cutting_over_sweep, loose, opened
from grafu.asset.part import Asset, PartSource
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.graph.parse import parse_graph
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.motion_choice import MotionChoice, Moves, Side
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.joints.tilting_fronts import with_shown_tilts, with_tilts
from grafu.synth.cabinets.tilting import TiltingFronts, make_tilting_fronts
from grafu.synth.case.case import Case
from grafu.vocabulary import JointType, PartLabel
from small_scenes import LEFT_EDGE, box, hinged, scene

CABINET = TiltingFronts(in_parts=True)
IN_ONE_MESH = replace(CABINET, rows=1, case=Case(0.5, 0.5, 0.3), in_parts=False)


def unstated(asset: Asset) -> Asset:
    """The same cabinet, whose input states no joints, nor which front a bin rides on; bins may be shelves."""
    free = (
        replace(part, carried_by=None, label=PartLabel.SHELF) if part.id.startswith("bin") else part
        for part in asset.parts
    )
    return replace(asset, parts=tuple(free), joints=())


def require_tilting(result: grafu.Result, low: float, high: float) -> None:
    """Raises AssertionError unless each door opens within these degrees with its bin, and nothing collides."""
    made = result.object
    doors = [joint for joint in made.joints if joint.child.startswith("door")]

    assert doors
    assert all(low <= degrees(joint.limits.upper) <= high for joint in doors)
    assert all(float(joint.axis.direction[0]) > 0.99 for joint in doors)
    assert [v.name for v in made.link("body").visuals if v.name.startswith("bin")] == []
    assert cuts(made, opened(made, 0.0)) | cutting_over_sweep(made) == set()
    assert loose(result) == set()


def test_predicted_fronts_take_their_bins_along_and_stop():
    require_tilting(grafu.functionalize(unstated(make_tilting_fronts(CABINET))), 40, 46)


@pytest.mark.parametrize("spec", [CABINET, IN_ONE_MESH], ids=["in parts", "in one mesh"])
def test_a_front_that_the_user_states_to_tilt_takes_its_bin_along(spec):
    asset = unstated(make_tilting_fronts(spec))
    doors = [part.id for part in asset.parts if part.label is PartLabel.DOOR]

    require_tilting(grafu.functionalize(asset, motion="rule", motions=dict.fromkeys(doors, "tilt")), 40, 46)


def test_stated_joints_open_as_far_as_they_are_stated():
    spec = replace(IN_ONE_MESH, opening=radians(38))

    require_tilting(grafu.functionalize(make_tilting_fronts(spec), motion="annotation"), 37, 38.5)


def test_an_opening_that_the_user_chose_wins():
    asset = make_tilting_fronts(IN_ONE_MESH)
    result = grafu.functionalize(asset, motion="rule", motions={"door": "tilt"})

    assert degrees(result.with_hinge("door", opening=radians(60)).joint("door").upper) == pytest.approx(60, abs=1)


FLAP = (
    box("side_left", (-0.32, -0.2, 0.0), (-0.3, 0.2, 0.6)),
    box("side_right", (0.3, -0.2, 0.0), (0.32, 0.2, 0.6)),
    box("floor", (-0.3, -0.2, 0.0), (0.3, 0.2, 0.02)),
    box("back", (-0.3, 0.18, 0.02), (0.3, 0.2, 0.6)),
)


def test_a_flap_without_a_bin_drops_until_it_is_level():
    asset = scene(*FLAP, box("door", (-0.319, -0.22, 0.003), (0.319, -0.202, 0.597)))
    result = grafu.functionalize(asset, motion="rule", motions={"door": "drop"})

    assert degrees(result.joint("door").upper) > 85


@pytest.mark.parametrize(("name", "opens"), [("tilt_door", 45), ("door", 110)])
def test_a_name_shows_that_a_front_tilts(name, opens):
    door = replace(box("door", (-0.319, -0.22, 0.003), (0.319, -0.202, 0.597)), source=PartSource(name))
    upper = degrees(grafu.functionalize(scene(*FLAP, door), motion="rule").joint("door").upper)

    assert upper == pytest.approx(opens, abs=1.0)


def test_a_board_that_the_case_holds_is_no_bin():
    shelf = box("shelf", (-0.3, -0.19, 0.3), (0.3, 0.18, 0.32))
    asset = scene(*FLAP, shelf, box("door", (-0.319, -0.22, 0.003), (0.319, -0.202, 0.597)))
    made = grafu.functionalize(asset, motion="rule", motions={"door": "tilt"}).object

    assert "shelf" in [visual.name for visual in made.link("body").visuals]


def test_what_cannot_tilt_is_refused():
    with pytest.raises(ValueError, match="must be bottom"):
        MotionChoice(Moves.TILTS, Side.LEFT)
    with pytest.raises(ValueError, match="stop"):
        JointRequest("door", JointType.REVOLUTE, LEFT_EDGE, "rule", stop=0.0)
    with pytest.raises(ValueError, match="a row and a column"):
        TiltingFronts(rows=0)


@pytest.mark.parametrize("height", [0.012, 0.03])
def test_a_lid_that_turns_about_its_lower_back_edge_is_no_front_with_a_bin(height):
    """It lies flat and reaches far from its axis, as a bin does, but opens past upright."""
    lid = box("door_lid", (-0.32, -0.2, 0.6), (0.32, 0.2, 0.6 + height))
    hinge = replace(LEFT_EDGE, point=vec3(0.0, 0.2, 0.6), direction=vec3(-1.0, 0.0, 0.0))
    stated = scene(*FLAP, lid, joints=(hinged("door_lid", hinge),))
    (request,) = (r for r in plan_from_annotation(stated).joints if r.moving == "door_lid")
    plan = RealizationPlan((replace(request, reference=None, source="network"),), ())
    assert with_tilts(plan, stated, parse_graph(stated)).joints == plan.joints


@pytest.mark.parametrize(("thick", "stops"), [(0.018, False), (0.25, True)], ids=["a plate", "a bin"])
def test_a_plate_that_leans_is_no_bin(thick, stops):
    """The box around a flap that stands half open, with a pane on it, is as deep as that of a bin."""
    hinge = Axis(vec3(0.0, -0.22, 0.003), vec3(1.0, 0.0, 0.0))
    leaf = box("door", (-0.319, -0.22, 0.003), (0.319, -0.22 + thick, 0.597))
    pane = box("pane", (-0.2, -0.215, 0.1), (0.2, -0.21, 0.5), carried_by="door")
    lean = hinge.rotation(radians(40))
    leaning = [replace(p, surfaces=tuple(surface.transformed(lean) for surface in p.surfaces)) for p in (leaf, pane)]
    asset = scene(*FLAP, *leaning, joints=(hinged("door", hinge),))
    (request,) = (r for r in plan_from_annotation(asset).joints if r.moving == "door")
    before = vec3(0.0, float(asset.part("door").box.low[1]), 0.003)  # where the box around it ends
    asked = replace(request, reference=None, source="network", axis=replace(hinge, point=before))
    (made,) = with_tilts(RealizationPlan((asked,), ()), asset, parse_graph(asset)).joints

    assert (made.stop is not None) == stops


@pytest.mark.parametrize(("degrees_back", "most"), [(38, 180), (0, 110)])
def test_the_fall_of_a_bureau_holds_no_bin_however_deep_its_box_is(degrees_back, most):
    """It leans back and drops until it is level, not only as far as a bin may tilt."""
    plate = box("door", (-0.29, -0.2, 0.03), (0.29, -0.182, 0.43))
    pin = from_rotation(np.eye(3), np.array([0.0, -0.2, 0.03]))
    T = pin @ from_rotation(rotation_matrix(np.array([1.0, 0.0, 0.0]), -radians(degrees_back))) @ np.linalg.inv(pin)
    fall = replace(plate, surfaces=tuple(surface.transformed(T) for surface in plate.surfaces))
    asset = scene(*FLAP, fall)
    result = grafu.functionalize(asset, motion="rule", motions={"door": "drop"})

    assert 70 < degrees(result.joint("door").upper) < most


def before_basin(*more, deep=0.08, high=0.12):
    """How a front above two doors moves, with a wall `deep` behind it, and how far: type, stop."""
    front = box("front", (-0.39, -0.3, 0.7), (0.39, -0.281, 0.7 + high))
    basin = box("wall_of_it", (-0.3, -0.281 + deep, 0.66), (0.3, -0.281 + deep + 0.3, 0.86))
    asset = scene(front, *more, basin, box("side", (-0.4, -0.28, 0.0), (-0.382, 0.3, 0.86)))
    slide = JointRequest("front", JointType.PRISMATIC, Axis(front.box.center, vec3(0.0, -1.0, 0.0)), "network")
    plan = RealizationPlan((replace(slide, attached=tuple(part.id for part in more)),), ())
    (made,) = with_shown_tilts(plan, asset, parse_graph(asset)).joints
    return made.type, made.stop


def test_a_front_with_a_handle_right_before_a_basin_tilts_and_others_do_not():
    handle = replace(box("handle", (-0.06, -0.33, 0.75), (0.06, -0.3, 0.76)), label=PartLabel.HANDLE)
    walls = box("walls", (-0.35, -0.281, 0.71), (0.35, -0.22, 0.76))

    assert before_basin(handle) == (JointType.REVOLUTE, pytest.approx(radians(45)))
    others = [before_basin(handle, deep=deep) for deep in (0.001, 0.4)]
    for what in (before_basin(), before_basin(handle, walls), *others):
        assert what == (JointType.PRISMATIC, None)
    assert before_basin(handle, high=0.4)[0] is JointType.PRISMATIC


def test_a_front_without_a_label_that_is_called_tilting_tilts():
    front = replace(box("tilt_front", (-0.39, -0.3, 0.2), (0.39, -0.281, 0.6)), label=PartLabel.UNKNOWN)
    asset = scene(front, box("side", (-0.4, -0.28, 0.0), (-0.382, 0.3, 0.86)))
    slide = JointRequest("tilt_front", JointType.PRISMATIC, Axis(front.box.center, vec3(0.0, -1.0, 0.0)), "network")
    (made,) = with_shown_tilts(RealizationPlan((slide,), ()), asset, parse_graph(asset)).joints
    assert (made.type, float(made.axis.direction[0])) == (JointType.REVOLUTE, pytest.approx(1.0))


@pytest.mark.parametrize(
    ("piece", "depth", "tilts"), [("shoe_rack_3", 0.17, True), ("cabinet", 0.17, False), ("shoe_rack_3", 0.38, False)]
)
def test_what_is_higher_than_deep_in_a_shoe_cabinet_tilts(piece, depth, tilts):
    front = replace(box("compartment", (-0.39, -0.3, 0.2), (0.39, -0.3 + depth, 0.6)), label=PartLabel.UNKNOWN)
    asset = replace(scene(front, box("side", (-0.4, -0.28, 0.0), (-0.391, 0.1, 0.86))), name=piece)
    slide = JointRequest("compartment", JointType.PRISMATIC, Axis(front.box.center, vec3(0.0, -1.0, 0.0)), "network")
    (made,) = with_shown_tilts(RealizationPlan((slide,), ()), asset, parse_graph(asset)).joints
    assert (made.type is JointType.REVOLUTE) is tilts
