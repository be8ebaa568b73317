"""Barrels of hinges that are drawn: on the pin's side of each door, before its face, riding on it."""

import numpy as np
import pytest

from grafu.synth.noise.loose_objects import with_loose_objects
from grafu.synth.samples import dresser, wardrobe
from grafu.vocabulary import PartLabel


@pytest.mark.parametrize("seed", range(6))
def test_each_door_has_two_or_three_on_the_side_of_its_pin(seed: int) -> None:
    plain = wardrobe()
    made = with_loose_objects(plain, "hinges", np.random.default_rng(seed))
    added = made.parts[len(plain.parts) :]
    turning = [joint for joint in plain.joints if plain.part(joint.part).label is PartLabel.DOOR]
    assert {part.carried_by for part in added} == {joint.part for joint in turning}
    for joint in turning:
        own = [part for part in added if part.carried_by == joint.part]
        door = plain.part(joint.part).box
        assert len(own) in (2, 3)
        for part in own:
            assert part.label is PartLabel.MISC
            side = np.sign(joint.axis.point[0] - door.center[0])
            assert side * (part.box.center[0] - door.center[0]) > 0.3 * door.size[0]
            assert part.box.low[1] < door.low[1]
            assert door.low[2] < part.box.low[2] < part.box.high[2] < door.high[2]


def test_drawers_have_none() -> None:
    assert with_loose_objects(dresser(), "hinges", np.random.default_rng(1)).parts == dresser().parts
