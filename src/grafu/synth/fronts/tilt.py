"""The tray behind a tilting front, as in shoe cabinets. It knows neither fronts nor cases.

A front that tilts about its lower front edge lifts what lies behind it. Whatever stays within a circle about that pin
that reaches the opening's top clears it at every angle.
"""

from math import sqrt

from grafu.geometry.mesh import TriangleMesh
from grafu.synth.fronts.layout import Rect
from grafu.synth.pieces.shapes import prism_along_x

WALL = 0.006  # metres
REACH = 0.28  # metres: as deep as a shoe needs
CLEARANCE = 0.008  # metres below the opening's top


def tray_meshes(inner: Rect, pin: tuple[float, float], behind: float, back: float) -> tuple[TriangleMesh, ...]:
    """Returns two cheeks and an inclined floor between them.

    `inner` is the clear opening in x and z; `pin` the (y, z) that the front turns about; the tray begins at the y
    `behind` the front and stays before `back`.
    """
    low = inner.z0 + 0.01
    radius = inner.z1 - CLEARANCE - pin[1]
    high = low + 0.7 * (inner.z1 - low)
    rise = 0.3 * (high - low)
    reach = min(sqrt(max(radius**2 - (low + rise + WALL - pin[1]) ** 2, 0.0)), REACH)
    end = min(pin[0] + reach, back - 0.01)
    high = min(high, pin[1] + sqrt(max(radius**2 - (behind - pin[0]) ** 2, 0.0)))
    cheek = ((behind, low), (end, low + rise), (end, low + rise + WALL), (behind, high))
    floor = ((behind, low), (end, low + rise), (end, low + rise + WALL), (behind, low + WALL))
    return (
        prism_along_x(cheek, inner.x0, inner.x0 + WALL),
        prism_along_x(cheek, inner.x1 - WALL, inner.x1),
        prism_along_x(floor, inner.x0 + WALL, inner.x1 - WALL),
    )
