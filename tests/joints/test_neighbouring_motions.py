"""Hardware keeps out of the way of the doors and drawers beside it: fronts over one another with a 2 mm seam."""

from itertools import pairwise

import pytest

from grafu.asset.part import Asset
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.metrics.collision import CollisionConfig, collision_shares, largest_gaps
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Drawer, Layout, Pair, Stack
from grafu.synth.noise import edits
from judging import hardware, installed, realized, realized_kind
from small_scenes import box, hinged, scene

DROP, LIFT, LEFT, RIGHT = Door("bottom"), Door("top"), Door("left"), Door("right")
STACKS: dict[str, tuple[Layout, ...]] = {  # from the lowest front up
    "door under a flap": (LEFT, DROP),
    "pair over a flap": (DROP, Pair()),
    "flap under a flap": (DROP, DROP),
    "lift-up door over a flap": (DROP, LIFT),
    "lift-up door under a lift-up door": (LIFT, LIFT),
    "lift-up door under a flap, back to back": (LIFT, DROP),
    "side-hung doors": (LEFT, RIGHT),
    "flap over a drawer": (Drawer(), DROP),
    "three flaps": (DROP, DROP, DROP),
}


def stacked(name: str, mount: str, panel: float = 0.018) -> Asset:
    """Fronts with nothing behind their seams: no panel, and no rail for a flap to hang on."""
    case = Case(0.6, 1.0, 0.4, panel=panel)
    asset = make_cabinet(Cabinet(case=case, layout=Stack(STACKS[name], (), "nothing"), mount=mount, gap=0.002))
    rails = tuple(part.id for part in asset.parts if part.id.startswith("hinge_rail"))
    return edits.without_parts(asset, rails) if rails else asset


BOTH_MOUNTS = ("flap under a flap", "lift-up door over a flap")
STACKED = [(name, ("inset", "overlay")[k % 2]) for k, name in enumerate(STACKS)]
STACKED += [(name, ("overlay", "inset")[k % 2]) for k, name in enumerate(STACKS) if name in BOTH_MOUNTS]


@pytest.mark.parametrize(("name", "mount"), STACKED)
def test_fronts_over_one_another_all_open_past_one_another(name, mount):
    asset = stacked(name, mount)
    result = realized(asset)
    assert set(installed(result)) == {joint.part for joint in asset.joints}
    assert not any(outcome.restricted or outcome.after for outcome in installed(result).values())
    assert max(largest_gaps(result.object).values()) <= 0.001 * asset.extent
    everything = CollisionConfig(poses=20, tolerance=0.0005, hardware=True, moving_bodies=True)
    assert collision_shares(result.object, everything) == {joint.id: 0.0 for joint in result.object.joints}


def test_the_report_says_which_template_was_left_out_for_whom():
    upper = installed(realized(stacked("flap under a flap", "overlay")))["door_2"]
    assert upper.template == "pivot"
    assert upper.left_out == ("butt or ball_tip or lift_off or piano would stand in the way of door_1",)


def test_an_overlay_flap_between_others_hangs_on_plates_beside_its_ends():
    asset = stacked("flap under a flap", "overlay", panel=0.008)
    result = realized(asset)
    door, outcome = asset.part("door_2").box, installed(result)["door_2"]
    assert (outcome.template, outcome.count) == ("pivot", 2)
    _, still = hardware(result, "door_2")
    plates = [visual.mesh.box for visual in still if visual.name.endswith("_plate")]
    assert sorted(bool(box.low[0] > door.high[0]) for box in plates) == [False, True]
    assert all(box.high[0] < door.low[0] or box.low[0] > door.high[0] for box in plates)
    assert all(box.high[1] > door.high[1] for box in plates)  # they reach back past the door


def test_where_nothing_is_in_the_way_nothing_is_noted():
    results = [realized_kind(kind) for kind in ("overlay pair", "half-overlay doors on one divider")]
    outcomes = [outcome for result in results for outcome in result.report.installed]
    assert [outcome.notes for outcome in outcomes] == [()] * len(outcomes)
    assert {outcome.template for outcome in outcomes} == {"butt"}


def test_no_hinge_of_a_flap_at_the_floor_reaches_below_it():
    """Behind its lower edge a barrel would hang below the floor: it goes before it, and a note states why."""
    result = realized_kind("drop-down flap")
    (flap,) = result.report.installed
    lowest = min(visual.mesh.box.low[2] for link in result.object.links for visual in link.visuals)

    assert lowest >= -5e-4
    assert any("would reach below the floor" in note for note in flap.left_out)


def test_the_hinges_of_a_short_door_keep_apart():
    door = box("door", (0.0, -0.02, 0.0), (0.3, 0.0, 0.1))
    side = box("side", (-0.02, -0.02, 0.0), (-0.002, 0.3, 0.1))
    bar = box("bar", (-0.02, -0.3, 0.0), (-0.002, -0.02, 0.05))  # takes the lower hinge's place in front
    result = realized(scene(door, side, bar, joints=(hinged(),)))
    moving, _ = hardware(result, "door")
    spans = sorted((v.mesh.box.low[2], v.mesh.box.high[2]) for v in moving if v.name.startswith("hinge"))
    assert all(one[1] <= other[0] + 1e-6 for one, other in pairwise(spans))


def test_a_block_beside_a_door_that_fills_its_opening_does_not_wedge_it():
    """Two doors in one rim, on both sides of a stile of 25 mm; the first hangs on it, the second on the other side."""
    rim = [
        box("left", (-0.32, 0.0, 0.0), (-0.2925, 0.001, 2.3)),
        box("stile", (0.2925, 0.0, 0.1), (0.3175, 0.001, 2.225)),
        box("right", (0.9025, 0.0, 0.0), (0.93, 0.001, 2.3)),
        box("low", (-0.2925, 0.0, 0.0), (0.9025, 0.001, 0.1)),
        box("high", (-0.2925, 0.0, 2.225), (0.9025, 0.001, 2.3)),
    ]
    rim.append(box("back", (-0.32, 0.58, 0.0), (0.93, 0.6, 2.3)))
    rim += [box(f"side_{x}", (x, 0.001, 0.0), (x + 0.02, 0.6, 2.3)) for x in (-0.34, 0.93)]
    doors = [
        box("door_1", (-0.2925, -0.025, 0.1), (0.2925, 0.009, 2.225)),
        box("door_2", (0.3175, -0.025, 0.1), (0.9025, 0.009, 2.225)),
    ]
    joints = tuple(
        hinged(part.id, Axis(vec3(float(part.box.high[0]), -0.025, 0.0), vec3(0.0, 0.0, 1.0))) for part in doors
    )
    found = realized(scene(*doors, *rim, joints=joints))
    assert set(installed(found)) == {"door_1", "door_2"}
