"""How well predicted parts agree with an asset's in a frame: which covers which, how far their boxes lie apart.

Bodies are compared, not parts: what a prediction moves as one, and all that it leaves still. It chooses no frame.
"""

from functools import cached_property
from typing import final

import numpy as np
from scipy.spatial import ConvexHull, QhullError, cKDTree

from grafu.asset.foreign.motions import ForeignMotions, ForeignPart
from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4, Points, Scalars
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.sampling import sample_surface
from grafu.geometry.transform import invert, scale_of, transform_points
from grafu.shapes import Float
from grafu.vocabulary import PartLabel

Boxes = Float[np.ndarray, "_ 2 3"]  # low and high corners


@final
@dataclass(frozen=True, slots=True)
class AgreementConfig:
    """How predicted parts are compared with an asset's.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    asked: int = 64
    """Points of each of the asset's parts."""
    drawn: int = 30_000
    """Points of the whole prediction, spread evenly: a part is as finely drawn as any other ..."""
    least_drawn: int = 100
    """... but at least so many points of each ..."""
    most_corners: int = 5_000
    """... and at most so many of its own corners."""
    far: float = 0.05
    """Beyond this a point is simply elsewhere (fraction of the object's largest side)."""
    loose_box: float = 0.02
    """Weight of a part's likeness to the whole predicted part where that is a box (fraction of the largest side) ..."""
    loose_mesh: float = 1e-4
    """... and where it is a mesh (fraction of the largest side)."""
    slack: float = 0.005
    """By how much boxes are grown before they are compared: sheets have volume then (fraction of the largest side)."""
    regressed: float = 0.1
    """Boxes up to this far apart are still taken in order: regressed ones err by 0.06 to 0.08 (fraction of the largest
    side)."""
    tried: int = 100
    """Predicted parts that are compared with one of the asset's: those that may be likest, by their boxes."""
    unmatched: float = 0.25
    """What a predicted body that covers no part adds to the residual (fraction of the largest side)."""
    least_overlap: float = 0.3
    """Mean overlap of bodies below which a prediction is held to be that of another object (fraction)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "far", "loose_box", "loose_mesh", "slack", "regressed", "unmatched", "least_overlap")


_FEW = 100  # points that are as quickly taken all


@final
@dataclass(frozen=True)
class Agreement:
    """What comes of a frame.

    `part_of` states for each of the asset's parts which predicted part covers it (None: not to be said); `residual` is
    how far the faces of the bodies' boxes lie apart, the mean as a fraction of the object's largest side; `overlap` is
    the bodies' mean intersection over union.
    """

    part_of: tuple[str | None, ...]
    residual: float
    overlap: float


def label_disagrees(label: PartLabel, foreign: PartLabel, moves: bool) -> bool:
    """Whether a part's label contradicts that of the predicted part, or what does not move is predicted to."""
    if foreign is not PartLabel.UNKNOWN:
        return label is not foreign
    return moves != (label.is_movable or label is PartLabel.HANDLE)


class Comparison:
    """An asset and a prediction, sampled once, to be compared in many frames."""

    def __init__(self, asset: Asset, foreign: ForeignMotions, config: AgreementConfig = AgreementConfig()) -> None:
        self.asset, self.foreign, self.config = asset, foreign, config
        self._outlines = {part.name: _outline(part.mesh) for part in foreign.parts}
        self.points = np.vstack(list(self._outlines.values()))
        self._asked = [_points_of(part.mesh, config.asked) for part in asset.parts]
        self._boxes = [part.box for part in asset.parts]
        area = sum((part.mesh.area for part in foreign.parts if not part.is_box), start=0.0)
        self._shapes = [_Shape(part, area, config) for part in foreign.parts]
        self._theirs = np.array([[part.mesh.box.low, part.mesh.box.high] for part in foreign.parts])
        looseness = (config.loose_box if part.is_box else config.loose_mesh for part in foreign.parts)
        self._looseness = np.array([*looseness])
        self._contradicted = np.array([[self._disagrees(mine, part) for part in foreign.parts] for mine in asset.parts])

    def agreement(self, T_object_foreign: Mat4) -> Agreement:
        """Returns how well the parts agree where the prediction is drawn in this frame."""
        return self._in_order(T_object_foreign) or self._compared(self._covering(T_object_foreign), T_object_foreign)

    def _compared(self, part_of: tuple[str | None, ...], T_object_foreign: Mat4) -> Agreement:
        """Returns how well the bodies agree where each part is covered so."""
        residuals, overlaps = [], []
        covered = self._covered(part_of)
        for body in self._bodies:
            mine, theirs = covered.get(body), self._foreign_box(body, T_object_foreign)
            residuals.append(_faces_apart(mine, theirs) / self.asset.extent if mine else self.config.unmatched)
            overlaps.append(
                mine.intersection_over_union(theirs, self.config.slack * self.asset.extent) if mine else 0.0
            )
        return Agreement(part_of, float(np.mean(residuals)), float(np.mean(overlaps)))

    def matched_boxes(self, agreed: Agreement, T_object_foreign: Mat4) -> list[tuple[Box, Box]]:
        """Returns boxes of the asset with those of the prediction in this frame: of parts in order, else of bodies."""
        if self._order:
            return self._ordered_boxes(T_object_foreign)
        covered = self._covered(agreed.part_of)
        return [(covered[body], self._foreign_box(body, T_object_foreign)) for body in self._bodies if body in covered]

    @cached_property
    def _bodies(self) -> dict[str | None, np.ndarray]:
        """The predicted bodies, each with the corners of its parts' hulls."""
        parts: dict[str | None, list[np.ndarray]] = {}
        for name, body in self.foreign.body_of.items():
            parts.setdefault(body, []).append(self._outlines[name])
        return {body: np.vstack(outlines) for body, outlines in parts.items()}

    def whole_overlap(self, T_object_foreign: Mat4) -> float:
        """Returns the intersection over union of the two as a whole."""
        whole = Box.around(transform_points(T_object_foreign, self.points))
        return whole.intersection_over_union(self.asset.box, self.config.slack * self.asset.extent)

    def _disagrees(self, mine: Part, theirs: ForeignPart) -> bool:
        moves = self.foreign.body_of[theirs.name] is not None
        return mine.label is not PartLabel.UNKNOWN and label_disagrees(mine.label, theirs.label, moves)

    @cached_property
    def _order(self) -> dict[int, ForeignPart]:
        """The predicted part for each of the asset's parts by its number; empty where the format has no order."""
        slots = {part.slot: part for part in self.foreign.parts if part.slot is not None}
        ordered = len(slots) == len(self.foreign.parts)
        return {k: slots[k] for k in range(len(self._boxes)) if k in slots} if ordered else {}

    def _ordered_boxes(self, T: Mat4) -> list[tuple[Box, Box]]:
        pairs = ((self._boxes[k], part.mesh.box.corners()) for k, part in self._order.items())
        return [(mine, Box.around(transform_points(T, corners))) for mine, corners in pairs]

    def _in_order(self, T: Mat4) -> Agreement | None:
        """Returns what comes of taking predicted parts for the asset's in order, or None where that fits nothing."""
        pairs = self._ordered_boxes(T)
        residual = float(np.mean([_faces_apart(a, b) for a, b in pairs])) / self.asset.extent if pairs else 1.0
        if residual > self.config.regressed:
            return None
        slack = self.config.slack * self.asset.extent
        overlap = float(np.mean([a.intersection_over_union(b, slack) for a, b in pairs]))
        part_of = tuple(self._order[k].name if k in self._order else None for k in range(len(self._boxes)))
        return Agreement(part_of, residual, max(overlap, self.config.least_overlap))

    def _covering(self, T: Mat4) -> tuple[str, ...]:
        T_foreign_object, extent = invert(T), self.asset.extent / scale_of(T)
        corners = [transform_points(T_foreign_object, box.corners()) for box in self._boxes]
        mine = np.array([[c.min(axis=0), c.max(axis=0)] for c in corners])
        gaps, unlike = _gaps(mine, self._theirs), 1.0 - _overlaps(mine, self._theirs, self.config.slack * extent)
        small = extent * self._looseness * (unlike + self._contradicted)
        found = []
        for k, points in enumerate(self._asked):
            there = transform_points(T_foreign_object, points)
            best, cost = 0, np.inf
            for f in np.argsort(gaps[k] + small[k], kind="stable")[: self.config.tried].tolist():
                if gaps[k, f] + small[k, f] >= cost:  # no point is nearer than the boxes are
                    continue
                own = float(self._shapes[f].distances(there, self.config.far * extent).mean()) + small[k, f]
                best, cost = (f, own) if own < cost else (best, cost)
            found.append(self.foreign.parts[best].name)
        return tuple(found)

    def _covered(self, part_of: tuple[str | None, ...]) -> dict[str | None, Box]:
        """Returns the boxes of what predicted bodies cover; of those that cover nothing there is none."""
        boxes: dict[str | None, list[Box]] = {}
        for box, name in zip(self._boxes, part_of, strict=True):
            if name is not None:
                boxes.setdefault(self.foreign.body_of[name], []).append(box)
        return {body: Box.enclosing(found) for body, found in boxes.items()}

    def _foreign_box(self, body: str | None, T: Mat4) -> Box:
        return Box.around(transform_points(T, self._bodies[body]))


class _Shape:
    """A predicted part as something that points lie on, or in."""

    def __init__(self, part: ForeignPart, area: float, config: AgreementConfig) -> None:
        self._box = part.mesh.box
        least = config.least_drawn
        count = max(least, int(config.drawn * part.mesh.area / area)) if area > 0 else least
        self._tree = None if part.is_box else cKDTree(_points_of(part.mesh, count, config.most_corners))

    def distances(self, points: Points, far: float) -> Scalars:
        """Returns how far points lie from the part, at most `far`."""
        if self._tree is None:
            gaps = np.linalg.norm(np.maximum(np.abs(points - self._box.center) - self._box.half, 0.0), axis=1)
        else:
            gaps, _ = self._tree.query(points, distance_upper_bound=far)
        return np.minimum(gaps, far)


def _gaps(a: Boxes, b: Boxes) -> np.ndarray:
    """Returns how far each box of `a` is from each of `b`."""
    apart = np.maximum(a[:, None, 0] - b[None, :, 1], b[None, :, 0] - a[:, None, 1])
    return np.linalg.norm(np.maximum(apart, 0.0), axis=2)


def _overlaps(a: Boxes, b: Boxes, margin: float) -> np.ndarray:
    """Returns the shared over the joint volume of each box of `a` with each of `b`, all grown by `margin`."""
    grow = np.array([[-margin], [margin]])
    a, b = a + grow, b + grow
    shared = np.minimum(a[:, None, 1], b[None, :, 1]) - np.maximum(a[:, None, 0], b[None, :, 0])
    common = np.prod(np.maximum(shared, 0.0), axis=2)
    volumes = [np.prod(boxes[:, 1] - boxes[:, 0], axis=1) for boxes in (a, b)]
    return common / np.maximum(volumes[0][:, None] + volumes[1][None] - common, 1e-300)


def _used(mesh: TriangleMesh) -> Points:
    """Returns the vertices that faces name."""
    return mesh.vertices[np.unique(mesh.faces)] if len(mesh.faces) else mesh.vertices


def _outline(mesh: TriangleMesh) -> Points:
    """Returns the corners of the convex hull: all that boxes in turned frames depend on."""
    points = _used(mesh)
    if len(points) < _FEW:
        return points
    try:
        return points[ConvexHull(points).vertices]
    except (QhullError, ValueError):  # a flat sheet, or a line
        return points


def _points_of(mesh: TriangleMesh, count: int, corners: int | None = None) -> Points:
    """Returns points on a surface: some drawn evenly, and its own corners and the middles of its faces."""
    own = np.vstack([_used(mesh), mesh.triangles.mean(axis=1)])
    most = count if corners is None else corners
    own = own if len(own) <= most else own[np.random.default_rng(0).permutation(len(own))[:most]]
    return np.vstack([sample_surface(mesh, count).points, own])


def _faces_apart(a: Box, b: Box) -> float:
    return float(np.mean(np.abs(np.concatenate([a.low - b.low, a.high - b.high]))))
