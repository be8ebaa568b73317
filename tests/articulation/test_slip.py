import numpy as np
import pytest

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link
from grafu.articulation.kinematics import link_poses
from grafu.articulation.slip import Slip
from grafu.errors import ArticulationError
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.vocabulary import JointType

SLIP = Slip(np.array([0.0, 1.0, 2.0]), np.array([[0.0, 0.0, 0.0], [0.01, 0.0, 0.0], [0.01, 0.02, 0.0]]))


def test_shifts_are_interpolated_and_stay_beyond_the_last():
    assert SLIP.shift(0.5) == pytest.approx([0.005, 0.0, 0.0])
    assert np.allclose(SLIP.shifts_at(np.array([1.5, 9.0])), [[0.01, 0.01, 0.0], [0.01, 0.02, 0.0]])
    assert SLIP.largest(1.0) == pytest.approx(0.01)
    assert SLIP.largest(1.5) == pytest.approx(np.hypot(0.01, 0.01))


def test_only_what_is_shown_slips():
    axis = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0))
    joint = Joint("j", JointType.REVOLUTE, "body", "door", axis, JointLimits(0.0, 2.0), slip=SLIP)
    made = ArticulatedObject("o", "body", (Link("body", ()), Link("door", ())), (joint,))

    assert np.allclose(link_poses(made, {"j": 1.0})["door"], joint.motion(1.0))
    shown = link_poses(made, {"j": 1.0}, shown=True)["door"]
    assert np.allclose(shown[:3, 3], [0.01, 0.0, 0.0])
    assert np.allclose(shown[:3, :3], joint.motion(1.0)[:3, :3])


@pytest.mark.parametrize(
    ("values", "first"), [([0.0], 0.0), ([0.1, 1.0], 0.0), ([0.0, 0.0], 0.0), ([0.0, 1.0], 0.1), ([0.0, 1.0], np.nan)]
)
def test_a_table_that_is_none_is_refused(values, first):
    with pytest.raises(ArticulationError, match="a slip"):
        Slip(np.array(values), np.full((len(values), 3), first))
