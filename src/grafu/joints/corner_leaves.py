"""Two leaves in a corner, one on the other, which move by themselves: how far the first opens past the case."""

from itertools import pairwise

import numpy as np

from grafu.geometry.budget import require_time
from grafu.geometry.swept_body import SweptBody
from grafu.joints.build import Built
from grafu.joints.config import RealizationConfig
from grafu.joints.limits import in_the_way, opening_values, swept_box
from grafu.scene.border import part_axes
from grafu.scene.scene import Scene

_OF_SECOND = 7  # poses of the second leaf in which the first is swept


def room_in_corner(
    scene: Scene, leaves: tuple[Built, Built], uppers: tuple[float, float], config: RealizationConfig
) -> float:
    """Returns how far the first leaf opens, radians, while the second clears the static body in whichever pose it is.

    What meets it while the first is closed counts as free: that cannot be avoided by opening less.
    """
    first, second = (leaf.placement.axis for leaf in leaves)
    moving = leaves[1].request.moving
    mesh, axes = scene.moving_mesh(moving), part_axes(scene.parts[moving].mesh)
    body, upper = SweptBody(mesh, config.depth * scene.extent, np.asarray(axes)), uppers[0]
    for turned in np.linspace(0.0, uppers[1], _OF_SECOND)[1:]:
        T = second.rotation(float(turned))
        box = swept_box(mesh.transformed(T).box, first.rotation, upper)
        near = [obstacle.collider for obstacle in in_the_way(scene.static_obstacles, box)]
        body.place(T)
        at_rest = set(body.penetrated(near))
        apart = [collider for k, collider in enumerate(near) if k not in at_rest]
        values = opening_values(upper, config.coarse_poses)
        for before, value in pairwise(values):
            require_time()
            body.place(first.rotation(float(value)) @ T)
            if body.penetrated(apart):
                upper = float(before)
                break
    return upper
