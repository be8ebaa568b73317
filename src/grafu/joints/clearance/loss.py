"""How much of a part goes when solids are cut out of it: of what is seen of it, and of its volume."""

from collections.abc import Sequence
from typing import final

import manifold3d
import numpy as np

from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Scalars
from grafu.geometry.budget import require_time
from grafu.geometry.components import connected_parts
from grafu.geometry.raycast import outer_faces
from grafu.geometry.solids import ConvexSolid, in_any


@final
@dataclass(frozen=True, slots=True)
class Loss:
    """What goes of a part: fractions of its outer surface, and of the volume of its pieces' convex hulls."""

    surface: float
    volume: float

    @property
    def ratio(self) -> float:
        """The larger of the two: a hollow part loses much of its surface with little of the volume around it."""
        return max(self.surface, self.volume)


def measured_loss(part: Part, solids: Sequence[ConvexSolid], lost: Scalars) -> Loss:
    """Returns what of a part lies in the solids; `lost` is the area of it of each face, surface after surface."""
    return Loss(_lost_surface(part, lost), lost_volume(part, solids))


def _lost_surface(part: Part, lost: Scalars) -> float:
    """Returns the fraction of the part's outer surface that goes, 0..1, from what goes of the area of each face.

    Outer is what can be seen from outside the part, so cut faces and hidden walls do not count.
    """
    if not lost.any():
        return 0.0
    seen = outer_faces(part.mesh)
    whole = float(part.mesh.face_areas[seen].sum())
    return min(max(float(lost[seen].sum()) / whole, 0.0), 1.0) if whole > 0 else 0.0


def lost_volume(part: Part, solids: Sequence[ConvexSolid], limits: Sequence[float] = ()) -> float:
    """Returns the fraction of the volume of the part's pieces' convex hulls that lies in the solids, 0..1.

    Volumes are those of hulls because real parts are rarely closed; 1 where all pieces are flat. It is exact to single
    precision; where many solids meet a piece, it is counted on points, to about a thousandth of the piece, with
    `limits` to about a hundredth where it is far from each of them.
    """
    if not solids:
        return 0.0
    if limits and len(solids) > _FEW_EXACT:
        rough = _lost_volume(part, solids, _FEW_POINTS, _FEW_EXACT)
        if min(abs(rough - limit) for limit in limits) > _FAR:
            return rough
    return _lost_volume(part, solids, _POINTS, _MOST_EXACT)


def _lost_volume(part: Part, solids: Sequence[ConvexSolid], points: int, most_exact: int) -> float:
    """Returns the fraction that is lost, counted on points in pieces that more than `most_exact` solids meet."""
    whole = lost = 0.0
    low, high = (np.array([getattr(solid.box, end) for solid in solids]) for end in ("low", "high"))
    for piece in connected_parts(part.mesh):
        require_time()
        hull = ConvexSolid.around(piece.vertices)
        if hull is None:
            continue
        body = _manifold(hull)
        whole += body.volume()
        meets = np.all((low <= hull.box.high) & (high >= hull.box.low), axis=1)
        near = [solids[k] for k in np.flatnonzero(meets).tolist()]
        many = len(near) > most_exact
        lost += _counted_volume(hull, near, points) * body.volume() if many else _cut_volume(body, near)
    return min(lost / whole, 1.0) if whole > 0 else 1.0


def _cut_volume(body: manifold3d.Manifold, solids: Sequence[ConvexSolid]) -> float:
    if not solids:
        return 0.0
    cutter = manifold3d.Manifold.batch_boolean([_manifold(solid) for solid in solids], manifold3d.OpType.Add)
    return float((body ^ cutter).volume())


def _counted_volume(hull: ConvexSolid, solids: Sequence[ConvexSolid], count: int) -> float:
    """Returns the fraction of a convex hull that lies in the solids, counted on points spread evenly over it."""
    ratios = (0.5 + np.arange(count)[:, None] / _PLASTIC ** np.arange(1, 4)) % 1.0
    points = hull.box.low + ratios * hull.box.size
    points = points[hull.contains(points)]
    return float(in_any(solids, points).mean()) if len(points) else 1.0


def _manifold(solid: ConvexSolid) -> manifold3d.Manifold:
    return manifold3d.Manifold(manifold3d.Mesh(solid.vertices.astype(np.float32), solid.faces.astype(np.uint32)))


_MOST_EXACT = 60  # solids whose union is built
_FEW_EXACT = 8  # the same, for a first look: to count on points is quicker
_POINTS = 20_000  # in the box of a hull
_FEW_POINTS = 1_000  # the same, for a first look
_FAR = 0.05  # from a limit: the first look tells on which side of it the fraction is
_PLASTIC = 1.2207440846057596  # the root of x**4 = x + 1: multiples of its powers are spread evenly in three dimensions
