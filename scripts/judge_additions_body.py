"""Faults of what was added to a piece: tops, interiors and joints, for `judge_additions.py`."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from judge_additions_table import COVERED, INTERIORS

from grafu.additions.config import AdditionConfig
from grafu.additions.interior.request import parse_interior
from grafu.additions.interior.turned import furnish_scene
from grafu.additions.step import StepResult
from grafu.articulation.articulated_object import ArticulatedObject, Visual, VisualRole
from grafu.asset.part import Asset
from grafu.evaluation.completeness import SKIN
from grafu.evaluation.static_table import OPEN
from grafu.graph.parse import parse_graph
from grafu.judging.panels import empty_rooms, panel_faults
from grafu.judging.tops import lost_tops, open_ratio
from grafu.metrics.judged import judged_piece
from grafu.pipeline.additions import add_before_joints, fitted_object
from grafu.pipeline.functionalize import MOTIONS, Functionalized, choose_source
from grafu.pipeline.motion_source import MotionSource
from grafu.vocabulary import PartLabel

LEAST_OPENING = 0.999  # of the opening that a joint has without additions; the rest is a sweep's last step
DEFAULT = AdditionConfig()


def top_faults(asset: Asset, source: MotionSource, plain: Functionalized, tops: int) -> tuple[float | None, list[str]]:
    """Returns what a top covers that replaces the piece's own, and what is wrong with it and with tops added."""
    covered, faults = _without_its_top(asset, source, plain.object)
    seen = open_ratio([v.mesh for v in _own(plain.object)])
    if tops and seen < OPEN:
        faults.append(f"a top added, {seen:.0%} open")
    if not tops and seen > OPEN:
        faults.append(f"no top added, {seen:.0%} open")
    return covered, faults


def _own(articulated: ArticulatedObject) -> list[Visual]:
    """Returns the input's parts, closed, without handles."""
    visuals = (v for link in articulated.links for v in link.visuals)
    own = (v for v in visuals if v.role is VisualRole.PART and v.label is not PartLabel.HANDLE)
    return [v for v in own if len(v.mesh.faces)]


def _body_of(asset: Asset, source: MotionSource) -> StepResult:
    """Returns a piece with what it gets before joints are built: its top does not depend on them."""
    motion = MOTIONS[choose_source(asset, source)]
    asset = asset if motion.reads_annotation else asset.without_annotation()
    completion = motion.complete(asset, parse_graph(asset))
    return add_before_joints(asset, completion, motion.plan(asset, completion), DEFAULT)


def _stated_to_move(asset: Asset) -> set[str]:
    """Returns the parts that the input lets move or carry, and those that are pieces of such."""
    stated = asset.as_annotated()
    moving = {p.carried_by for p in stated.parts if p.carried_by} | {joint.part for joint in stated.joints}
    pieces = {s.name for p in stated.parts if p.id in moving for s in p.surfaces if s.name}
    return {p.id for p in asset.parts if p.id in moving or {s.name for s in p.surfaces} & pieces}


def _without_its_top(asset: Asset, source: MotionSource, closed: ArticulatedObject) -> tuple[float | None, list[str]]:
    """Returns the least fraction of a lost top's plan that the one in its place covers, and what is wrong with them."""
    tops = {p.id for p in asset.parts if p.label is PartLabel.TOP_PANEL and len(p.mesh.faces)}
    moving = _stated_to_move(asset)
    standing = {v.name for v in closed.link(closed.root).visuals if not v.label.is_movable}
    own = {v.name: v.mesh for v in _own(closed)}
    taken, left = ([mesh for name, mesh in own.items() if (name in tops) is is_top] for is_top in (True, False))
    still = [mesh for name, mesh in own.items() if name in standing - tops]
    if not taken or tops & moving or not still:
        return None, []  # it has none, or a lid that moves
    additions = _body_of(replace(asset, parts=tuple(p for p in asset.parts if p.id not in tops)), source).additions
    added = [a.part.mesh for a in additions if a.part.label is PartLabel.TOP_PANEL]
    lost = lost_tops(taken, still, [mesh for mesh in left if not any(mesh is s for s in still)], added)
    missed = [one for one in lost if one.is_missed]
    if not missed and not added:
        return None, []  # other boards cover all that it covered
    ratio = min((one.covered for one in (lost if len(added) >= len(lost) else missed)), default=1.0)
    faults = [f"its new top covers {ratio:.1%}"] if ratio < COVERED else []
    if not len(missed) <= len(added) <= len(lost):
        faults.append(f"{len(added)} tops in place of {len(missed)}")
    return ratio, faults


@dataclass(frozen=True)
class Inside:
    """What the requests of `INTERIORS` bring: panels of each, refusals and faults of all, and rooms left empty."""

    panels: list[int]
    refusals: list[str]
    rooms: list[str]
    faults: list[str]


def interior_faults(result: Functionalized) -> Inside:
    """Returns what comes of all requests, each on the finished piece with its hardware and handles."""
    counts, faults, refusals = [], [], []
    for request in INTERIORS:
        scene = result.fittings.scene
        inside = furnish_scene(scene, parse_interior(request))
        names = {a.part.id for a in inside.additions}
        whole = fitted_object(result.object, StepResult(scene, inside.additions))
        counts.append(len(names))
        refusals += [one.why for one in inside.refused]
        piece = judged_piece(whole)
        found = panel_faults(piece, names, SKIN * piece.largest_side)
        faults += [f"{request}: `{a}` {what} `{b}`" for a, what, b in found]
    empty = [] if any(counts) else empty_rooms(judged_piece(result.object))
    rooms = [
        " x ".join(f"{side:.2f}" for side in box.size) + f" m at {np.round(box.center, 2).tolist()}" for box in empty
    ]
    return Inside(counts, refusals, rooms, faults)


def joint_faults(plain: Functionalized, result: Functionalized) -> Iterator[str]:
    """Yields joints that additions cost, or that open less for them."""
    before = {joint.child: joint.limits.upper for joint in plain.object.joints}
    after = {joint.child: joint.limits.upper for joint in result.object.joints}
    for name, upper in before.items():
        if name not in after:
            yield f"`{name}` does not move any more"
        elif after[name] < LEAST_OPENING * upper:
            yield f"`{name}` opens {after[name]:.3f} instead of {upper:.3f}"
