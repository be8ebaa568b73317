"""What stands, hangs and is screwed on besides the furniture itself: table from kind to maker of extra parts.

Nothing here is in the path of a door or a drawer: what would be, is left out (`with_loose_objects`). Seen on the
development models: corner plates (45001), nailers behind backs (41003), front edges as sheets of their own (41003),
runners and sliders beside drawers (22692, 26608), posts (22692), feet of four millimetres (45963), things on shelves
(47315).
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Final

import numpy as np

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import Asset, Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.transform import transform_points
from grafu.shapes import Float
from grafu.synth.noise.addition import LooseObject, block, knuckles, runners, sheet_of
from grafu.synth.noise.segmentation import fresh_ids
from grafu.synth.pieces.finish import BIRCH, STEEL
from grafu.synth.pieces.riding import bodies_of, carriers_of, led_by, moving_with, poses_at
from grafu.synth.pieces.shapes import turned
from grafu.synth.sampling.chance import between, chance, count
from grafu.vocabulary import PartLabel

Boxes = Float[np.ndarray, "_ 2 3"]  # lows and highs
SAME = 0.0002  # metres within which two boxes are one: what is there already is not put there again
STEPS = 5  # poses of what turns
CLEAR = 0.0005  # metres that must stay free between what is added and what moves


def with_loose_objects(asset: Asset, kind: str, rng: np.random.Generator) -> Asset:
    """Returns the asset with the parts of one kind of loose objects added, those that obstruct nothing.

    Pads below and nailers behind may leave it off its middle and its floor.

    Raises:
        KeyError: if there is no such kind.
    """
    swept = _swept_boxes(asset)
    still = np.array([(p.box.low, p.box.high) for p in asset.parts])
    parts = list(asset.parts)
    for addition in LOOSE_OBJECTS[kind](asset, rng):
        if addition.carried_by is None and not _is_free(addition, swept, still):
            continue
        name = fresh_ids(replace(asset, parts=tuple(parts)), addition.stem, 1)[0]
        material = STEEL if addition.label is PartLabel.MISC else BIRCH
        surface = Surface(addition.mesh, material)
        parts.append(Part(name, addition.label, (surface,), PartSource(name), "annotation", addition.carried_by))
    return replace(asset, parts=tuple(parts))


def _swept_boxes(asset: Asset) -> Boxes:
    """Returns boxes around the paths of all boards of what moves, and of what rides on it."""
    found = [np.zeros((0, 2, 3))]
    joints, carriers, bodies = {j.part: j for j in asset.joints}, carriers_of(asset), bodies_of(asset)
    for joint in asset.joints:
        led = led_by(asset.joints, joint.part)
        moving = moving_with(asset, joint.part)
        boxes = [s.mesh.box for part in asset.parts if part.id in moving for s in part.surfaces]
        if motion_kind(joint.type).slides and not led:
            ends = np.array([(b.low, b.high) for b in boxes])
            shift = joint.axis.direction * joint.upper
            found.append(
                np.stack([np.minimum(ends[:, 0], ends[:, 0] + shift), np.maximum(ends[:, 1], ends[:, 1] + shift)], 1)
            )
            continue
        low, high = np.full(3, np.inf), np.full(3, -np.inf)
        for value in np.linspace(0.0, joint.upper, STEPS).tolist():
            values = {joint.part: value} | {part: follow(value) for part, follow in led.items()}
            poses = poses_at(joints, carriers, values)
            for part in asset.parts:
                if part.id in moving:
                    corners = transform_points(poses[bodies[part.id]], part.box.corners())
                    low, high = np.minimum(low, corners.min(axis=0)), np.maximum(high, corners.max(axis=0))
        found.append(np.stack([low, high])[None])
    return np.concatenate(found)


def _is_free(addition: LooseObject, swept: Boxes, still: Boxes) -> bool:
    box = addition.mesh.box
    twins = np.abs(still - np.stack([box.low, box.high])).max(axis=(1, 2)) < SAME
    if _overlap(box, swept, CLEAR) or bool(twins.any()):
        return False
    return not addition.fits or not _overlap(box, still, -0.001)


def _overlap(box: Box, others: Boxes, margin: float) -> bool:
    gaps = np.maximum(box.low - others[:, 1], others[:, 0] - box.high)
    return bool(np.any(np.all(gaps <= margin, axis=1)))


def _thing(rng: np.random.Generator, foot: tuple[float, float, float]) -> TriangleMesh:
    """Returns a thing that people put on furniture: books, a box, a vase, a bowl, a screen."""
    x, y, z = foot
    size, height = between(rng, (0.04, 0.12)), between(rng, (0.03, 0.3))
    if chance(rng, 0.45):
        radii = rng.uniform(0.35, 1.0, 4) * size * 0.6
        profile = tuple(zip((0.0, 0.3, 0.75, 1.0), radii.tolist(), strict=True))
        return turned(vec3(x, y, z), vec3(x, y, z + height), profile, 10)
    w, d = size * between(rng, (0.5, 3.0)), size * between(rng, (0.3, 0.9))
    return block((x - w / 2, y - d / 2, z), (x + w / 2, y + d / 2, z + height * 0.7))


def _on(rng: np.random.Generator, panel: Part, number: int) -> Iterator[LooseObject]:
    box = panel.box
    for _ in range(number):
        ratio = rng.uniform(0.2, 0.8, 2)
        x, y = (box.low[:2] + ratio * box.size[:2]).tolist()
        yield LooseObject(PartLabel.MISC, "object", _thing(rng, (x, y, float(box.high[2]))), fits=True)


def _things_on_top(asset: Asset, rng: np.random.Generator) -> Iterator[LooseObject]:
    tops = [p for p in asset.parts if p.label is PartLabel.TOP_PANEL]
    if tops:
        yield from _on(rng, max(tops, key=lambda p: p.box.high[2]), count(rng, 1, 3))


def _things_on_shelves(asset: Asset, rng: np.random.Generator) -> Iterator[LooseObject]:
    boards = [p for p in asset.parts if p.label in (PartLabel.SHELF, PartLabel.BOTTOM_PANEL)]
    for board in boards[: count(rng, 1, 3)]:
        yield from _on(rng, board, count(rng, 1, 2))


def _basket(asset: Asset, rng: np.random.Generator) -> Iterator[LooseObject]:
    boards = [p for p in asset.parts if p.label in (PartLabel.SHELF, PartLabel.BOTTOM_PANEL)]
    if not boards:
        return
    box = boards[int(rng.integers(len(boards)))].box
    (x0, y0), (x1, y1) = (
        (box.center[:2] - 0.35 * box.size[:2]).tolist(),
        (box.center[:2] + 0.35 * box.size[:2]).tolist(),
    )
    z, h, r = float(box.high[2]), between(rng, (0.05, 0.12)), 0.002
    bars = [block((x, y0, z), (x + 2 * r, y1, z + 2 * r)) for x in np.linspace(x0, x1, 8).tolist()]
    bars += [block((x0, y, z + k), (x1, y + 2 * r, z + k + 2 * r)) for y in (y0, y1) for k in (0.0, h)]
    bars += [block((x, y, z), (x + 2 * r, y + 2 * r, z + h)) for x in (x0, x1) for y in (y0, y1)]
    yield LooseObject(PartLabel.MISC, "basket", merge_meshes(bars), fits=True)


def _inside(asset: Asset) -> Box | None:
    """Returns the room between the outer two upright side panels, or None where there are no two."""
    sides = [p.box for p in asset.parts if p.label is PartLabel.SIDE_PANEL and p.box.thin_axis == 0]
    tall = [b for b in sides if b.size[2] > 0.4 * asset.box.size[2]]
    if len(tall) < 2:
        return None
    left, right = min(tall, key=lambda b: float(b.low[0])), max(tall, key=lambda b: float(b.high[0]))
    if right.low[0] - left.high[0] < 0.15:
        return None
    low, high = np.maximum(left.low, right.low), np.minimum(left.high, right.high)
    return Box(vec3(left.high[0], low[1], low[2]), vec3(right.low[0], max(low[1], high[1]), max(low[2], high[2])))


def _corner_plates(asset: Asset, rng: np.random.Generator) -> Iterator[LooseObject]:
    room = _inside(asset)
    if room is None:
        return
    w, t = between(rng, (0.05, 0.09)), between(rng, (0.008, 0.014))
    tops = [float(p.box.low[2]) for p in asset.parts if p.label is PartLabel.TOP_PANEL]
    z = min([float(room.high[2]), *(top for top in tops if top > room.center[2])])
    label = PartLabel.BAR if chance(rng, 0.4) else PartLabel.MISC
    full = chance(rng, 0.4)  # bars from front to back instead of plates in the corners
    (x0, y0, _), (x1, y1, _) = room.low.tolist(), room.high.tolist()
    for x, inward in ((x0, w), (x1, -w)):
        for y, back in ((y0 + 0.02, w), (y1 - 0.02, -w)):
            if not full or back > 0:
                end = y1 - 0.02 if full else y + back
                yield LooseObject(label, "corner_plate", block((x, y, z - t), (x + inward, end, z)))


def _nailers(asset: Asset, rng: np.random.Generator) -> Iterator[LooseObject]:
    backs = [p.box for p in asset.parts if p.label is PartLabel.BACK_PANEL and p.box.thin_axis == 1]
    if not backs:
        return
    back = max(backs, key=lambda b: b.volume)
    (x0, _, z0), (x1, y, z1) = back.low.tolist(), back.high.tolist()
    h, t = min(between(rng, (0.05, 0.1)), (z1 - z0) / 5), between(rng, (0.01, 0.018))
    for ratio in (1.0, 0.5, 0.0)[: count(rng, 1, 3)]:
        z = z0 + ratio * (z1 - z0 - h)
        yield LooseObject(PartLabel.BAR, "nailer", block((x0, y, z), (x1, y + t, z + h)))


def _edge_sheets(asset: Asset, rng: np.random.Generator) -> Iterator[LooseObject]:
    """Yields the front edges of panels once more, as sheets."""
    panels = (PartLabel.SIDE_PANEL, PartLabel.TOP_PANEL, PartLabel.BOTTOM_PANEL, PartLabel.DIVIDER)
    label = PartLabel.BAR if chance(rng, 0.7) else PartLabel.FACE_FRAME
    if any(p.label is PartLabel.FACE_FRAME for p in asset.parts):
        return
    for part in asset.parts:
        low, high = part.box.low, part.box.high
        if part.label in panels and part.box.thin_axis != 1 and part.box.size[1] > 0.15:
            yield LooseObject(label, "edge", sheet_of(Box(low, vec3(high[0], low[1], high[2]))))


def _pads(asset: Asset, rng: np.random.Generator) -> Iterator[LooseObject]:
    """Yields a pad under each leg, or near the four corners, each below something that stands on the floor."""
    box, h, r = asset.box, between(rng, (0.003, 0.015)), between(rng, (0.01, 0.025))
    floor = float(box.low[2]) + 0.001
    feet = [p.mesh.vertices[p.mesh.vertices[:, 2] < floor, :2] for p in asset.parts if p.label is PartLabel.LEG]
    spots = [foot.mean(axis=0) for foot in feet if len(foot)]
    if not spots:
        corners = [box.center[:2] + box.half[:2] * s for s in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        standing = np.concatenate([p.mesh.vertices[p.mesh.vertices[:, 2] < floor, :2] for p in asset.parts])
        nearest = [standing[np.linalg.norm(standing - corner, axis=1).argmin()] for corner in corners]
        inward = [spot + r * np.sign(box.center[:2] - spot) for spot in nearest]
        spots = list({tuple(np.round(spot, 3).tolist()): spot for spot in inward}.values())
    label = PartLabel.LEG if chance(rng, 0.6) else PartLabel.MISC
    for x, y in spots:
        top = vec3(float(x), float(y), float(box.low[2]))
        yield LooseObject(label, "pad", turned(top - vec3(0.0, 0.0, h), top, ((0.0, r), (1.0, r)), 8))


def _plates(asset: Asset, rng: np.random.Generator) -> Iterator[LooseObject]:
    """Yields a small plate (a lock, a label holder) on the front of each door or drawer; it rides there."""
    w, h, t = between(rng, (0.008, 0.04)), between(rng, (0.008, 0.03)), between(rng, (0.001, 0.004))
    at = between(rng, (-0.3, 0.3))
    for joint in asset.joints:
        box = asset.part(joint.part).box
        direction = joint.axis.direction
        if motion_kind(joint.type).turns:
            direction = np.cross(direction, box.center - joint.axis.point)
        if (
            direction[int(np.argmax(np.abs(direction)))] * -1 < 0.9 * float(np.linalg.norm(direction))
            or np.argmax(np.abs(direction)) != 1
        ):
            continue  # only on fronts that face -Y
        x, z, y = float(box.center[0]), float(box.center[2] + at * box.size[2]), float(box.low[1])
        mesh = block((x - w / 2, y - t, z - h / 2), (x + w / 2, y, z + h / 2))
        if _is_foremost(asset.part(joint.part), x, z):
            yield LooseObject(PartLabel.MISC, "plate", mesh, carried_by=joint.part)


def _is_foremost(front: Part, x: float, z: float) -> bool:
    """Whether a face of the part that lies in its foremost plane covers x and z: on a recessed panel nothing holds."""
    faces = front.mesh.triangles[:, :, [0, 2]][(front.mesh.triangles[:, :, 1] < front.box.low[1] + 0.0005).all(axis=1)]
    at = np.array([x, z])
    return bool(((faces.min(axis=1) <= at) & (faces.max(axis=1) >= at)).all(axis=1).any())


def _posts(asset: Asset, rng: np.random.Generator) -> Iterator[LooseObject]:
    sides = [p.box for p in asset.parts if p.label is PartLabel.SIDE_PANEL and p.box.thin_axis == 0]
    w, label = between(rng, (0.02, 0.045)), (PartLabel.BAR, PartLabel.LEG, PartLabel.MISC)[int(rng.integers(3))]
    for side in (
        (min(sides, key=lambda b: float(b.low[0])), max(sides, key=lambda b: float(b.high[0]))) if sides else ()
    ):
        x, out = (float(side.low[0]), -w) if side.center[0] < asset.box.center[0] else (float(side.high[0]), w)
        for y, inward in ((float(side.low[1]), w), (float(side.high[1]), -w)):
            mesh = block((x, y, float(side.low[2])), (x + out, y + inward, float(side.high[2])))
            yield LooseObject(label, "post", mesh)


LOOSE_OBJECTS: Final[dict[str, Callable[[Asset, np.random.Generator], Iterator[LooseObject]]]] = {
    "things on top": _things_on_top,
    "things on shelves": _things_on_shelves,
    "basket": _basket,
    "runners": runners,
    "corner plates": _corner_plates,
    "nailers": _nailers,
    "edge sheets": _edge_sheets,
    "pads": _pads,
    "plates": _plates,
    "posts": _posts,
    "hinges": knuckles,
}
