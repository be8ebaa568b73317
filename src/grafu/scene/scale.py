"""How large a piece is, and on what it stands: the scale of what is added to it, and the floor."""

from collections.abc import Iterable

from grafu.geometry.mesh import TriangleMesh

_COMMON = (0.5, 4.0)  # metres: the largest side of furniture whose stated size is believed


def metre_on(extent: float) -> float:
    """Returns how long one metre of real furniture is on an object whose largest side is `extent` metres.

    It is 1 for furniture between half a metre and four metres; what is smaller or larger was modelled in another scale,
    and all that is added to it is smaller or larger, too. It is 1 for an object without extent.
    """
    low, high = _COMMON
    if extent <= 0:
        return 1.0
    return min(extent / low, 1.0) if extent < high else extent / high


def floor_under(meshes: Iterable[TriangleMesh]) -> float:
    """Returns the height of the floor, metres: z = 0 in the object frame, or less where a mesh reaches below that."""
    return min([0.0, *(float(mesh.box.low[2]) for mesh in meshes if len(mesh.faces))])
