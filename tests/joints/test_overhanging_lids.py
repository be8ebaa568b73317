"""A lid that stands out behind its case turns on hinges in the corner under it; nothing else hangs there."""

from math import degrees

import pytest

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.joints.hinge.candidates import Tolerances, ruled_pins
from grafu.joints.hinge.survey import survey
from grafu.joints.hinge_config import PinConfig, SurveyConfig
from grafu.scene.border import border_frame
from grafu.vocabulary import MechanismClass
from judging import installed, realized, swept_collisions
from small_scenes import box, hinged, scene

HEIGHT, BACK = 0.5, 0.48
CASE = [
    box("left", (0.0, 0.0, 0.0), (0.018, BACK, HEIGHT)),
    box("right", (0.982, 0.0, 0.0), (1.0, BACK, HEIGHT)),
    box("front", (0.018, 0.0, 0.0), (0.982, 0.018, HEIGHT)),
    box("back", (0.018, BACK - 0.018, 0.0), (0.982, BACK, HEIGHT)),
    box("bottom", (0.018, 0.018, 0.02), (0.982, BACK - 0.018, 0.038)),
]


def lid(behind: float, rise: float = 0.0):
    return box("lid", (-0.02, -0.02, HEIGHT + rise), (1.02, BACK + behind, HEIGHT + rise + 0.025))


def turning(behind: float, rise: float = 0.0):
    axis = Axis(vec3(0.5, BACK + behind, HEIGHT + rise), vec3(-1.0, 0.0, 0.0))
    return lid(behind, rise), axis


@pytest.mark.parametrize("behind", [0.03, 0.045, 0.1])
def test_it_opens_past_upright_and_cuts_into_nothing(behind):
    part, axis = turning(behind)
    joint = hinged("lid", axis)
    result = realized(scene(part, *CASE, joints=(joint,)))
    (made,) = result.object.joints

    assert installed(result)["lid"].mechanism is MechanismClass.P
    assert degrees(made.limits.upper) > 93
    assert BACK < float(made.axis.point[1]) < BACK + 0.02
    assert max(swept_collisions(result.object, made, 20).values(), default=0.0) < 1e-4


def overhung(behind: float, rise: float = 0.0) -> bool:
    """Whether a pin in the corner under the lid is among those that the surroundings allow."""
    part, axis = turning(behind, rise)
    frame = border_frame(part.mesh, axis)
    rays = RayCaster(merge_meshes([p.mesh for p in CASE]))
    pins = ruled_pins(frame, survey(frame, rays, 0.03, SurveyConfig()), Tolerances(0.012, 0.002, 0.004), PinConfig())
    return any(pin.y < -frame.thickness for pin in pins if pin.mechanism is MechanismClass.P)


@pytest.mark.parametrize(
    ("behind", "rise", "is_allowed"), [(0.045, 0.0, True), (0.0, 0.0, False), (0.045, 0.06, False), (0.2, 0.0, False)]
)
def test_the_pin_is_there_where_the_lid_stands_out_and_lies_on_its_case(behind, rise, is_allowed):
    """Flush behind, far above the case, or standing out as far as a shelf: there is none."""
    assert overhung(behind, rise) is is_allowed


def test_its_leaves_touch_the_lid_and_the_case():
    part, axis = turning(0.045)
    result = realized(scene(part, *CASE, joints=(hinged("lid", axis),)))
    moving = [v.mesh.box for v in result.object.link("lid").visuals if v.name.startswith("hinge")]
    static = [v.mesh.box for v in result.object.link("body").visuals if v.name.startswith("hinge")]

    assert moving
    assert static
    assert all(float(one.high[2]) == pytest.approx(HEIGHT, abs=1e-3) for one in moving)
    assert all(float(one.low[1]) == pytest.approx(BACK, abs=1e-3) for one in static)
