"""Pure edits of an asset: moved, turned, scaled and mirrored with its joints; and as one rigid link.

It decides nothing about the input's frame; that is `frame.py`'s.
"""

from dataclasses import replace
from typing import Literal

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Link, Visual
from grafu.asset.part import Annotation, Asset, Frame, Part, Standing, moved_joints
from grafu.geometry.arrays import Mat4, vec3
from grafu.geometry.transform import from_rotation, reflection, rotation_matrix, scale_of, translation


def moved(asset: Asset, T: Mat4) -> Asset:
    """Returns the asset mapped by a similarity T: parts, joints (lengths scaled) and the transform back to the input.

    A rotation axis is a pseudovector: a mirror image reverses its sense, so that positive still opens.

    Raises:
        ValueError: if T is not a similarity (or is flat).
    """
    linear, scale = T[:3, :3], scale_of(T)
    if scale < 1e-12 or not np.allclose(linear @ linear.T, scale**2 * np.eye(3), atol=1e-9 * scale**2):
        raise ValueError(f"`T` must be a similarity (rotation, mirror image, uniform scale): got {linear.tolist()}")
    frame = asset.frame
    return replace(
        asset,
        parts=tuple(_moved_part(part, T) for part in asset.parts),
        joints=moved_joints(asset.joints, T, scale),
        small_joints=moved_joints(asset.small_joints, T, scale),
        annotation=asset.annotation and _moved_annotation(asset.annotation, T, scale),
        frame=Frame(T @ frame.input_to_output, frame.up, frame.front, frame.scale * scale, frame.assumed),
        standings=tuple(_standing_in(standing, T, scale) for standing in asset.standings),
    )


def _standing_in(standing: Standing, T: Mat4, scale: float) -> Standing:
    """Returns how a piece stands in a scene that is mapped by T; lengths in its own frame are `scale` times as long."""
    grown = from_rotation(np.eye(3) * scale)
    return Standing(standing.parts, grown @ standing.T_piece_object @ np.linalg.inv(T), standing.frame)


def yawed(asset: Asset, angle: float) -> Asset:
    """Returns the asset turned about Z through the origin, radians, counter-clockwise seen from above."""
    return moved(asset, from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), angle)))


def scaled(asset: Asset, factor: float) -> Asset:
    """Returns the asset `factor` times as large, about the origin.

    Raises:
        ValueError: if `factor` is not above 0.
    """
    if not factor > 0:
        raise ValueError(f"`factor` must be above 0 (use `mirrored` for a mirror image): got {factor}")
    return moved(asset, from_rotation(np.eye(3) * factor))


def mirrored(asset: Asset, axis: Literal["x", "y"] = "x") -> Asset:
    """Returns the mirror image across the plane through the origin that is square to x (or y)."""
    return moved(asset, reflection(np.zeros(3), np.eye(3)["xy".index(axis)]))


def centred(asset: Asset) -> Asset:
    """Returns the asset shifted to stand on z = 0, the middle of its box at x = y = 0."""
    box = asset.box
    return moved(asset, translation(vec3(-box.center[0], -box.center[1], -box.low[2])))


def as_static_object(asset: Asset) -> ArticulatedObject:
    """Returns the asset as one rigid link with a visual per part: what an artist's unarticulated file holds."""
    visuals = tuple(Visual(part.id, part.surfaces, label=part.label) for part in asset.parts)
    return ArticulatedObject(asset.name, "body", (Link("body", visuals),))


def _moved_annotation(annotation: Annotation, T: Mat4, scale: float) -> Annotation:
    parts = tuple(_moved_part(part, T) for part in annotation.parts)
    joints, small = (moved_joints(given, T, scale) for given in (annotation.joints, annotation.small_joints))
    return replace(annotation, parts=parts, joints=joints, small_joints=small)


def _moved_part(part: Part, T: Mat4) -> Part:
    return replace(part, surfaces=tuple(s.transformed(T) for s in part.surfaces))
