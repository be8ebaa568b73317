"""What doors and windows of buildings are made of: closed frames, panes, levers, and the true motions of leaves."""

from collections.abc import Sequence
from math import pi, radians
from typing import Literal

import numpy as np

from grafu.geometry.appearance import Material
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.graph.edges import Hinge, Slide
from grafu.shapes import Float
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, Span, plank
from grafu.vocabulary import PartLabel

Edge = Literal["left", "right", "top", "bottom"]
_TOWARDS: dict[Edge, tuple[float, float]] = {
    "left": (-1.0, 0.0),
    "right": (1.0, 0.0),
    "top": (0.0, 1.0),
    "bottom": (0.0, -1.0),
}
_TURN = radians(45)  # of a lever


def ring(label: PartLabel, stem: str, material: Material, span: Span, bar: float, sill: bool = True) -> PieceDraft:
    """Returns a frame of four boards of a width `bar`, metres; without `sill` it is open below."""
    (x0, y0, z0), (x1, y1, z1) = span
    low = z0 + bar if sill else z0
    boards = [((x0, y0, z0), (x0 + bar, y1, z1)), ((x1 - bar, y0, z0), (x1, y1, z1))]
    boards += [((x0 + bar, y0, z1 - bar), (x1 - bar, y1, z1))]
    boards += [((x0 + bar, y0, z0), (x1 - bar, y1, low))] if sill else []
    return plank(label, stem, material, *boards)


def turning(span: Span, edge: Edge, backwards: bool, opening: float = pi / 2) -> PieceMotion:
    """Returns how a leaf turns about the edge of its box on the side that it opens to, the back if `backwards`."""
    low, high = (np.array(corner) for corner in span)
    x, z = _TOWARDS[edge]
    towards, opens = vec3(x, 0.0, z), vec3(0.0, 1.0 if backwards else -1.0, 0.0)
    center, half = (low + high) / 2, (high - low) / 2
    return PieceMotion(Hinge.joint_type, Axis(center + half * (towards + opens), np.cross(-towards, opens)), opening)


def sliding(span: Span, direction: Float[np.ndarray, " 3"], travel: float, small: bool = False) -> PieceMotion:
    """Returns how a leaf, or a bolt on one (`small`), slides, by `travel` metres."""
    return PieceMotion(
        Slide.joint_type, Axis((np.array(span[0]) + np.array(span[1])) / 2, direction), travel, small=small
    )


def lever(
    material: Material, x: float, z: float, towards: float, faces: Sequence[tuple[float, float]], long: float
) -> PieceDraft:
    """Returns a lever with its stem at (x, z) and its bar `towards` -X or +X, metres, on each of the `faces`.

    A face is its place in depth and the direction out of it, -1 or 1.
    """
    boards: list[Span] = []
    for y, out in faces:
        near, far = sorted((y, y + 0.045 * out))
        boards.append(((x - 0.009, near, z - 0.009), (x + 0.009, far, z + 0.009)))
        near, far = sorted((y + 0.035 * out, y + 0.05 * out))
        left, right = sorted((x - 0.01 * towards, x + towards * (long - 0.01)))
        boards.append(((left, near, z - 0.01), (right, far, z + 0.01)))
    motion = PieceMotion(Hinge.joint_type, Axis(vec3(x, faces[0][0], z), vec3(0.0, towards, 0.0)), _TURN, small=True)
    return PieceDraft(PartLabel.HANDLE, "lever", plank(PartLabel.HANDLE, "lever", material, *boards).surfaces, motion)
