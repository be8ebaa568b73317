"""Furniture out of shape: stretched along its axes, turned to a wrong side, bent as scans are, fronts left ajar.

Joints follow: axes stay on their lines, slides scale with the axis they run along, angles stay. Positive still opens
and 0 is the pose as modelled, so that what is ajar has that much less to go.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import AnnotatedJoint, Asset, Part
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mat4, Points, Vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import from_rotation
from grafu.synth.pieces.riding import bodies_of, carriers_of, led_by, poses_at
from grafu.synth.sampling.chance import between, chance, count

YAWED, TURNED = 0.015, 0.03  # of models: askew by up to four degrees; front mistaken by quarter turns
STRETCHED, WIDELY = 0.6, 0.15  # of models whose proportions are off a little, and by up to a quarter
MIS_SCALED = 0.35  # of models: normalised data gets its size from an estimate
STRAIGHT = 0.93  # mean largest component of a face normal: 1 for boards along the axes, 0.87 for a door at 30 degrees


def stretched(asset: Asset, factors: Vec3) -> Asset:
    """Returns the asset scaled by its own factor along each axis, centred and standing on z = 0 again.

    A negative factor mirrors. Where a door or drawer stands at an angle (a corner cabinet), x and y share their mean
    factor: it stays square.

    Raises:
        ValueError: if a factor is 0.
    """
    if np.any(factors == 0):
        raise ValueError(f"`factors` must not be 0: got {factors.tolist()}")
    if abs(factors[0]) != abs(factors[1]) and not all(_is_straight(asset.part(j.part)) for j in asset.joints):
        mean = float(np.abs(factors[:2]).mean())
        factors = np.sign(factors) * np.array([mean, mean, abs(factors[2])])
    box = asset.box
    foot = np.array([box.center[0], box.center[1], box.low[2] if factors[2] > 0 else box.high[2]])
    T = from_rotation(np.diag(factors), -factors * foot)
    return replace(
        asset,
        parts=tuple(_moved(p, T) for p in asset.parts),
        joints=_stretched_joints(asset.joints, T),
        small_joints=_stretched_joints(asset.small_joints, T),
    )


def ajar(asset: Asset, part_id: str, ratio: float) -> Asset:
    """Returns the asset with a moving part, what rides on it and what follows it opened by a fraction of its range.

    Raises:
        ValueError: if the fraction is not in 0..1, or the part follows another.
    """
    if not 0.0 <= ratio <= 1.0:
        raise ValueError(f"`ratio` must be in 0..1: got {ratio}")
    joints = {joint.part: joint for joint in asset.joints}
    if joints[part_id].coupling is not None:
        raise ValueError(f"what opens must move by itself: got {part_id}")
    amount = ratio * joints[part_id].upper
    amounts = {part_id: amount} | {part: value(amount) for part, value in led_by(asset.joints, part_id).items()}
    carriers, bodies = carriers_of(asset), bodies_of(asset)
    poses = poses_at(joints, carriers, amounts)

    def opened(joint: AnnotatedJoint, carrier: str) -> AnnotatedJoint:
        T, left = poses.get(carrier), joint.upper - amounts.get(joint.part, 0.0)
        axis = joint.axis if T is None else motion_kind(joint.type).mapped_axis(joint.axis, T)
        return replace(joint, axis=axis, upper=left)

    return replace(
        asset,
        parts=tuple(_moved(p, poses[bodies[p.id]]) if bodies[p.id] in poses else p for p in asset.parts),
        joints=tuple(opened(joint, carriers[joint.part]) for joint in asset.joints),
        small_joints=tuple(opened(joint, bodies[joint.part]) for joint in asset.small_joints),
    )


def bent(asset: Asset, amplitude: float, rng: np.random.Generator) -> Asset:
    """Returns the asset with its vertices shifted by a smooth random field of at most `amplitude` metres per axis.

    Neighbours shift almost alike, so that gaps stay; joints stay where they were.
    """
    waves = rng.normal(size=(3, 3)) * 2 * np.pi / max(asset.extent, 1e-6)
    phases = rng.uniform(0, 2 * np.pi, 3)

    def field(points: Points) -> Points:
        return np.asarray(points + amplitude * np.sin(points @ waves.T + phases))

    return _with_points(asset, field)


def _with_points(asset: Asset, move: Callable[[Points], Points]) -> Asset:
    def moved(surface: Surface) -> Surface:
        mesh = TriangleMesh(move(surface.mesh.vertices), surface.mesh.faces)
        return Surface(mesh, surface.material, surface.uv)

    return replace(asset, parts=tuple(replace(p, surfaces=tuple(moved(s) for s in p.surfaces)) for p in asset.parts))


def _moved(part: Part, T: Mat4) -> Part:
    return replace(part, surfaces=tuple(s.transformed(T) for s in part.surfaces))


def _stretched_joints(joints: tuple[AnnotatedJoint, ...], T: Mat4) -> tuple[AnnotatedJoint, ...]:
    """Returns joints mapped by a stretch; what follows still goes as far as its leader lets it."""
    kinds = {j.part: motion_kind(j.type) for j in joints}
    growths = {j.part: kinds[j.part].length_scale(float(np.linalg.norm(T[:3, :3] @ j.axis.direction))) for j in joints}

    def mapped(joint: AnnotatedJoint) -> AnnotatedJoint:
        growth, coupling = growths[joint.part], joint.coupling
        if coupling is not None:
            ratio = growth / growths[coupling.leader]
            coupling = replace(coupling, multiplier=coupling.multiplier * ratio, offset=coupling.offset * growth)
        axis = kinds[joint.part].mapped_axis(joint.axis, T)
        return replace(joint, axis=axis, lower=joint.lower * growth, upper=joint.upper * growth, coupling=coupling)

    return tuple(map(mapped, joints))


def _is_straight(part: Part) -> bool:
    largest = np.abs(part.mesh.face_normals).max(axis=1)
    areas = part.mesh.face_areas
    return float((largest * areas).sum()) >= STRAIGHT * float(areas.sum())


def draw_factors(rng: np.random.Generator) -> tuple[float, float, float]:
    """Returns the scale along each axis; a negative one along x mirrors the model."""
    factors = np.ones(3)
    if chance(rng, STRETCHED):
        widest = 0.22 if chance(rng, WIDELY) else 0.1
        factors *= np.exp(rng.uniform(-widest, widest, 3))
    if chance(rng, MIS_SCALED):
        factors *= float(np.exp(np.clip(rng.normal(0.0, 0.22), -0.45, 0.45)))
    factors[0] *= -1.0 if chance(rng, 0.5) else 1.0
    return float(factors[0]), float(factors[1]), float(factors[2])


def draw_yaw(rng: np.random.Generator) -> float:
    """Returns by how much a model is turned about the vertical, radians: mostly not at all."""
    if chance(rng, TURNED):
        return float(np.pi / 2) * count(rng, 1, 3)
    return float(np.radians(between(rng, (-4.0, 4.0)))) if chance(rng, YAWED) else 0.0
