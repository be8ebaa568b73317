"""Network and rule-based baseline compared: the angles between their axes, initial and rectified."""

from math import acos, degrees

import grafu

asset = grafu.load("samples/sideboard.glb")
by_network = grafu.functionalize(asset, motion="network")
by_rule = grafu.functionalize(asset, motion="rule")


def angle(a: tuple[float, ...], b: tuple[float, ...]) -> float:
    """Returns the angle between two unit vectors, degrees."""
    return degrees(acos(max(-1.0, min(1.0, sum(x * y for x, y in zip(a, b, strict=True))))))


for joint in by_network.joints:
    try:
        other = by_rule.joint(joint.part)
    except grafu.FunctionalizationError:
        print(f"{joint.part}: the rules do not move it")
        continue
    stated = angle(joint.initial_axis.direction, other.initial_axis.direction)
    print(f"{joint.part}: stated axes {stated:.1f} degrees apart, built {angle(joint.axis, other.axis):.1f}")
