"""Which parts count, and figures that follow from how the furniture was made."""

from dataclasses import replace
from math import pi, radians

import numpy as np
import pytest
from measured_cabinets import DOOR, DRAWER, cabinet, carcass, made, restated, sliding, turning

from grafu.asset.edit import moved, scaled
from grafu.evaluation.measures import PartMeasure, measure_parts
from grafu.evaluation.moving_parts import counted_parts, raw_object
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.joints.make_plan import plan_from_annotation
from grafu.joints.plan import RealizationPlan
from grafu.vocabulary import JointType, PartLabel
from sketches import board, door, sketch


def measured(asset, plan) -> dict[str, PartMeasure]:
    found = measure_parts(raw_object(asset, plan), counted_parts(asset), asset.extent)
    return {measure.part: measure for measure in found}


def test_doors_and_drawers_count_with_their_attached_parts() -> None:
    parts = {part.id: part for part in counted_parts(cabinet())}

    assert set(parts) == {DOOR, DRAWER}
    assert parts[DOOR].members == (DOOR, "handle")
    assert parts[DOOR].reference == pytest.approx(pi / 2)  # 95 degrees are stated, 90 asked for
    assert parts[DRAWER].reference == pytest.approx(0.75 * 0.4)  # 80 % of its depth are stated, 75 % asked for


def test_what_is_small_narrow_or_carried_does_not_count() -> None:
    knob = door("knob", (0.3, -0.30, 0.2), (0.37, -0.29, 0.27), "left")  # 7 % of the largest side
    rod = door("rod", (-0.4, -0.26, 0.6), (0.4, -0.25, 0.615), "left")
    flap = door("flap", (-0.3, -0.28, 0.1), (0.3, -0.272, 0.4), "left")
    asset = sketch(*carcass(), door(DOOR, (-0.5, -0.271, 0.0), (0.5, -0.251, 0.6), "left"), knob, rod, flap)
    carried = replace(asset, parts=tuple(replace(p, carried_by=DOOR) if p.id == "flap" else p for p in asset.parts))

    assert [part.id for part in counted_parts(asset)] == [DOOR, "flap"]
    assert [part.id for part in counted_parts(carried)] == [DOOR]


def test_the_annotation_agrees_with_itself_and_opens_fully() -> None:
    asset = cabinet()
    for measure in measured(asset, plan_from_annotation(asset)).values():
        assert measure.aligned
        assert measure.collision == 0.0
        assert measure.opening == 1.0


def test_raw_gaps_are_those_of_the_construction() -> None:
    asset = cabinet()
    found = measured(asset, turning(-0.5, -0.271, -1.0))[DOOR]
    # the pin is 21 mm before the carcass: wide open, the door's own edge stands there
    assert found.gap == pytest.approx(0.021, abs=1e-4)
    assert not found.connected
    held = measured(asset, turning(-0.5, -0.252, -1.0))[DOOR]
    assert held.gap == pytest.approx(0.002, abs=2e-3)
    assert held.connected


def test_a_drawer_pushed_inwards_collides_from_where_it_meets_the_back() -> None:
    asset = cabinet()
    found = measured(asset, sliding((0.0, 1.0, 0.0)))[DRAWER]
    # 80 mm free, then the back for 20 mm and its own depth more: out of 300 mm it cuts in for 220
    assert found.collision == pytest.approx(220 / 300, abs=0.03)
    assert not found.aligned
    assert not found.works


def test_a_part_that_is_static_is_neither_aligned_nor_connected_and_hits_nothing() -> None:
    asset = cabinet()
    found = measured(asset, RealizationPlan())
    assert {m.found for m in found.values()} == {None}
    assert {(m.aligned, m.collision, m.connected, m.opening, m.works) for m in found.values()} == {
        (False, None, False, 0.0, False)
    }


@pytest.mark.parametrize("factor", [0.1, 10.0])
def test_figures_are_fractions_of_the_object(factor: float) -> None:
    asset = cabinet()
    plain = measured(asset, plan_from_annotation(asset))
    large = scaled(asset, factor)
    for part, measure in measured(large, plan_from_annotation(large)).items():
        assert measure.gap == pytest.approx(plain[part].gap, abs=1e-6)
        assert (measure.collision, measure.connected) == (plain[part].collision, plain[part].connected)


def test_what_was_built_works() -> None:
    asset = cabinet()
    result = made(asset)
    for measure in measure_parts(result.object, counted_parts(asset), asset.extent):
        assert measure.works, measure


def test_a_joint_that_is_stated_both_ways_takes_either_sense() -> None:
    asset = restated(cabinet(), DOOR, lower=-0.3, upper=0.3)
    (part,) = [p for p in counted_parts(asset) if p.id == DOOR]
    assert part.motion.both_ways
    assert part.reference == pytest.approx(0.6)
    assert part.drawn_at == pytest.approx(0.3)
    for sense in (1.0, -1.0):
        assert measured(asset, turning(-0.5, -0.271, sense))[DOOR].aligned
    assert not measured(cabinet(), turning(-0.5, -0.271, 1.0))[DOOR].aligned


def test_a_part_drawn_ajar_starts_closed() -> None:
    asset = cabinet()
    joint = next(j for j in asset.joints if j.part == DOOR)
    T = joint.axis.rotation(radians(30))
    parts = tuple(
        replace(p, surfaces=tuple(s.transformed(T) for s in p.surfaces)) if p.id in (DOOR, "handle") else p
        for p in asset.parts
    )
    ajar = restated(replace(asset, parts=parts), DOOR, lower=-radians(30), upper=radians(60))
    rest = raw_object(ajar, plan_from_annotation(ajar)).link(DOOR).body_mesh.box
    closed = raw_object(asset, plan_from_annotation(asset)).link(DOOR).body_mesh.box
    assert np.allclose(rest.low, closed.low, atol=1e-9)
    assert np.allclose(rest.high, closed.high, atol=1e-9)


def test_ranges_are_swung_as_stated_and_filled_in_where_none_is() -> None:
    asset = cabinet()
    stated = raw_object(asset, turning(-0.5, -0.271, -1.0, reference=radians(170)))
    assert stated.joints[0].limits.upper == pytest.approx(radians(170))
    plan = turning(-0.5, -0.271, -1.0)
    silent = replace(plan, joints=(replace(plan.joints[0], reference=None),))
    assert raw_object(asset, silent).joints[0].limits.upper == pytest.approx(pi / 2)


def test_the_root_is_never_called_like_a_part() -> None:
    pieces = (*carcass(), board("body", PartLabel.SHELF, (-0.48, -0.2, 0.3), (0.48, 0.2, 0.32)))
    asset = sketch(*pieces, door(DOOR, (-0.5, -0.271, 0.0), (0.5, -0.251, 0.6), "left"))
    raw = raw_object(asset, plan_from_annotation(asset))
    assert raw.root not in {part.id for part in asset.parts}


def test_a_slide_where_a_hinge_belongs_has_opened_nothing() -> None:
    asset = cabinet()
    plan = sliding((0.0, -1.0, 0.0), DOOR)
    found = measured(asset, plan)[DOOR]
    assert (found.aligned, found.opening) == (False, 0.0)


def test_where_the_object_stands_changes_nothing() -> None:
    asset = cabinet()
    T = np.eye(4)
    T[:3, 3] = (3.0, -2.0, 0.5)
    away = moved(asset, T)
    for part, measure in measured(away, plan_from_annotation(away)).items():
        assert measure.collision == measured(asset, plan_from_annotation(asset))[part].collision


def test_an_axis_on_the_other_border_is_not_aligned() -> None:
    asset = cabinet("left")
    right = measured(asset, turning(0.5, -0.271, 1.0))[DOOR]
    assert right.found is not None
    assert right.found.type is JointType.REVOLUTE
    assert not right.aligned
    assert Axis(vec3(0.5, -0.271, 0.0), vec3(0.0, 0.0, 1.0)).angle_to(right.found.axis) < 1e-9


def test_touches_are_counted_on_request() -> None:
    asset = cabinet()
    raw, truth = raw_object(asset, plan_from_annotation(asset)), counted_parts(asset)
    with_touch, without = (measure_parts(raw, truth, asset.extent, with_touch=wanted) for wanted in (True, False))
    assert {m.touch for m in without} == {None}
    assert all(m.touch is not None for m in with_touch)
    assert tuple(replace(m, touch=None) for m in with_touch) == without


def test_hinges_that_a_door_was_drawn_with_are_its_hardware() -> None:
    asset = cabinet()
    knuckle = board("knuckle", PartLabel.MISC, (-0.5, -0.26, 0.2), (-0.45, -0.2, 0.3))
    drawn = knuckle.part.surfaces[0]

    def drawn_with(name: str) -> dict[str, PartMeasure]:
        surfaces = (replace(drawn, name=name),)
        parts = (replace(p, surfaces=p.surfaces + surfaces) if p.id == DOOR else p for p in asset.parts)
        changed = replace(asset, parts=tuple(parts))
        return measured(changed, plan_from_annotation(changed))

    assert drawn_with("hinge-12")[DOOR].collision == measured(asset, plan_from_annotation(asset))[DOOR].collision
    assert drawn_with("Door Hinges 3")[DOOR].collision == drawn_with("hinge-12")[DOOR].collision
    assert drawn_with("hinge_panel-12")[DOOR].collision == pytest.approx(0.44, abs=0.02)  # until it is out of the side
