"""Presses the edge of a leaf or of a drawer's front back from another moving body that it is drawn a little into.

Two fronts that are drawn one into the other by a few millimetres leave neither of them a way: whichever opens cuts into
the other at rest.
"""

from grafu.joints.clearance.carve import Path
from grafu.joints.clearance.trim import trim
from grafu.joints.config import RealizationConfig
from grafu.joints.limits import in_the_way, sweep
from grafu.joints.report import Clearance
from grafu.scene.scene import Scene


def trimmed_at_rest(scene: Scene, path: Path, config: RealizationConfig) -> tuple[Scene, tuple[Clearance, ...]]:
    """Returns the scene with a moving part pressed back from those that it cuts into at rest, and a record of that.

    The first of the two gives way, by at most `config.max_trim` of its side; it stays as it is where that does not
    free it of any of them.
    """
    met = _met_at_rest(scene, path, config)
    if not met:
        return scene, ()
    pressed, clearances = trim(scene, path, met, config)
    return (pressed, tuple(clearances)) if len(_met_at_rest(pressed, path, config)) < len(met) else (scene, ())


def _met_at_rest(scene: Scene, path: Path, config: RealizationConfig) -> tuple[str, ...]:
    """Returns the other moving bodies that a moving part cuts into before it has moved at all."""
    body = scene.swept_body(path.moving, config.depth * scene.extent, path.axes)
    near = in_the_way(scene.other_bodies(path.moving), scene.moving_mesh(path.moving).box)
    return sweep(body, path.motion, 0.0, near, 1).blockers
