"""Flaps along the rim of an open box turn about its walls; what stands or hangs there otherwise does not."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.part import Asset, Part
from grafu.geometry.arrays import vec3
from grafu.geometry.transform import rotation_about
from grafu.joints.box_flaps import box_flaps, with_box_flaps, with_flap_labels
from grafu.joints.plan import RealizationPlan
from grafu.vocabulary import PartLabel
from small_scenes import box as float_box

W, D, H, T = 0.5, 0.4, 0.3, 0.004


def box(name: str, low: tuple[float, ...], high: tuple[float, ...]) -> Part:
    return float_box(name, tuple(map(float, low)), tuple(map(float, high)))


def carton(name: str = "carton", height: float = H, lidded: bool = False) -> Part:
    walls = [
        box(name, (0, 0, 0), (W, T, height)),
        box(name, (0, D - T, 0), (W, D, height)),
        box(name, (0, 0, 0), (T, D, height)),
        box(name, (W - T, 0, 0), (W, D, height)),
        box(name, (0, 0, 0), (W, D, T)),
        *([box(name, (0, 0, height - T), (W, D, height))] if lidded else []),
    ]
    return replace(walls[0], surfaces=tuple(surface for wall in walls for surface in wall.surfaces))


def flap(name: str, opened: float, label: PartLabel = PartLabel.UNKNOWN, height: float = H) -> Part:
    """One of the four flaps (`front`, `back`, `left`, `right`), opened by degrees from lying level over the box."""
    _, closed, pin, about = {
        "front": (W, ((0, 0, height), (W, D / 2, height + T)), (0, 0, height), (1.0, 0.0, 0.0)),
        "back": (W, ((0, D / 2, height), (W, D, height + T)), (0, D, height), (-1.0, 0.0, 0.0)),
        "left": (D, ((0, 0, height), (D / 2, D, height + T)), (0, 0, height), (0.0, -1.0, 0.0)),
        "right": (D, ((W - D / 2, 0, height), (W, D, height + T)), (W, 0, height), (0.0, 1.0, 0.0)),
    }[name]
    made = box(name, *closed)
    T4 = rotation_about(np.array(pin, float), vec3(*about), np.radians(opened))
    return replace(made, label=label, surfaces=tuple(surface.transformed(T4) for surface in made.surfaces))


ALL = ("front", "back", "left", "right")


def found(*parts: Part) -> dict[str, np.ndarray]:
    flaps = box_flaps(Asset("made", "", "made", parts))
    return {} if flaps is None else {part.id: axis.direction for part, axis in flaps.flaps}


@pytest.mark.parametrize("opened", [0.0, 60.0, 110.0, 200.0])
@pytest.mark.parametrize("label", [PartLabel.UNKNOWN, PartLabel.DOOR])
def test_the_flaps_of_a_carton_open_upwards_and_outwards_at_any_angle(opened, label):
    axes = found(carton(), *(flap(name, opened, label) for name in ALL))
    assert axes.keys() == set(ALL)
    for name, outwards in (("front", (0, -1)), ("back", (0, 1)), ("left", (-1, 0)), ("right", (1, 0))):
        assert np.allclose(np.cross(axes[name], [-outwards[0], -outwards[1], 0]), (0, 0, 1))


def test_a_box_may_have_two_flaps_that_meet_in_the_middle():
    assert found(carton(), flap("front", 0.0), flap("back", 0.0)).keys() == {"front", "back"}


@pytest.mark.parametrize(
    "parts",
    [
        (carton(), flap("back", 0.0)),
        (carton(lidded=True), flap("front", 90.0), flap("back", 90.0)),
        (carton(height=0.05), flap("front", 100.0, height=0.05), flap("back", 100.0, height=0.05)),
        (carton(), flap("front", 90.0), flap("back", 90.0), box("shelf", (0, 0, H + 0.2), (W, D, H + 0.22))),
        (carton(), *(replace(flap(n, 90.0), label=PartLabel.SIDE_PANEL) for n in ("front", "back"))),
        (carton(), box("lid", (0, 0, H), (W, D, H + T))),
    ],
    ids=["one lid", "boards on a case", "a tray", "a shelf above", "named boards", "a lid over all of it"],
)
def test_other_plates_at_a_rim_are_no_flaps(parts):
    assert found(*parts) == {}


def test_flaps_are_doors_each_of_its_own_and_the_box_none():
    asset = with_flap_labels(Asset("made", "", "made", (carton(), *(flap(name, 100.0) for name in ALL))))
    assert {part.id: part.label for part in asset.parts if part.label is not PartLabel.DOOR} == {
        "carton": PartLabel.SIDE_PANEL
    }
    plan = with_box_flaps(RealizationPlan(), asset)
    assert {request.moving: request.attached for request in plan.joints} == dict.fromkeys(ALL, ())
    assert with_box_flaps(RealizationPlan(), asset, settled=("left",)).joints == plan.joints[:2] + plan.joints[3:]
