"""Judges what `functionalize` adds to furniture: tops, grasps, handles, interiors, drawer boxes, and what it costs.

    python scripts/judge_additions.py [FOLDER] [--made 60] [--seed 990003] [--kinds] [--jobs 1] [--log FILE]

FOLDER holds pieces of furniture, one folder each; --made judges made furniture with its true joints and all hardware,
--kinds the catalogue of hard kinds, its movers' own handles taken away.
All is measured on the objects that come out, by rays and sweeps that share nothing with what made them. Prints a table
in Markdown, one line per piece (of random furniture only those with a fault), and sums it up. --log keeps each piece's
figures in a file as they come; started again with the same file, it goes on where it stopped. --only interior (or
top, grasp, handle, joint) looks at that alone, which is faster.
"""

import argparse
import json
import re
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

from grafu.articulation.articulated_object import ArticulatedObject, Joint, Visual, VisualRole
from grafu.articulation.sweep import values_before
from grafu.asset.load import load_asset
from grafu.asset.part import Asset
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.graph.parse import parse_graph
from grafu.metrics.bodies import largest_side
from grafu.metrics.panels import panel_faults
from grafu.metrics.rooms import empty_rooms
from grafu.metrics.tops import lost_tops, open_share
from grafu.pipeline.addition_config import NO_ADDITIONS, AdditionConfig
from grafu.pipeline.body_additions import Body, complete_body
from grafu.pipeline.fittings import Fittings, fitted_object
from grafu.pipeline.functionalize import MOTIONS, Functionalized, PipelineConfig, choose_source, functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.report import report_of
from grafu.realization.handle.config import size_factor
from grafu.realization.interior.request import parse_interior
from grafu.realization.interior.turned import furnish_scene
from grafu.synth.generate import make_specimen
from grafu.synth.kinds import TIDY, UNTIDY
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel

SEED = 990_003
INTERIORS = ("shelves=2", "dividers=1", "auto")
POSES = 40  # of each joint in which handles are looked at
WIDE = 0.9  # metres: from here on two handles are no waste
COVERED = 0.97  # share of the plan that a top must cover
OPEN = 0.5  # share of the plan that lies open where there is no top
SKIN = 0.001  # of the largest side: deeper cuts are cuts
LEAST_OPENING = 0.999  # of the opening that a joint has without additions; the rest is a sweep's last step
MANAGER: Any = trimesh.collision.CollisionManager  # untyped
DEFAULT = AdditionConfig()
ALL_KINDS = {**TIDY, **UNTIDY}
KINDS = ("top", "grasp", "handle", "interior", "joint")


@dataclass(frozen=True)
class Verdict:
    """The figures of one piece; no list of faults should hold any."""

    name: str
    kinds: list[str]  # what was looked at
    tops: int  # added
    covered: float | None  # share of the plan under the top that replaces its own; None: it has none to take away
    top_faults: list[str]
    movers: int
    handles: int
    grips: int
    grasp_faults: list[str]  # not graspable, or several handles where one is enough
    handle_faults: list[str]  # cut into something on the way
    panels: list[int]  # per request of `INTERIORS`
    refusals: list[str]  # why something that was asked for inside was not built
    rooms: list[str]  # empty rooms that rays find where no request brought any panel
    interior_faults: list[str]
    boards: int  # of drawer boxes
    waiting: int  # joints that wait for another one, which got a handle
    joint_faults: list[str]  # lost, or opening less, for the sake of additions
    seconds: float
    crash: str = ""  # why it could not be judged

    @property
    def faults(self) -> list[str]:
        """All faults."""
        found = [fault for kind in KINDS for fault in getattr(self, f"{kind}_faults")]
        return [self.crash, *found] if self.crash else found


def main() -> int:
    """Judges, and prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, nargs="?", help="pieces of furniture, one folder each")
    parser.add_argument("--made", type=int, default=0, metavar="N", help="made pieces with their true joints")
    parser.add_argument("--kinds", action="store_true", help="the catalogue of hard kinds")
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--first", type=int, default=0, help="number of the first made piece")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--log", type=Path, help="JSON lines: what was judged before is read from here, the rest added")
    parser.add_argument("--only", choices=KINDS, nargs="+", default=list(KINDS), help="what is looked at (all)")
    options = parser.parse_args()
    if options.folder is None and not options.made and not options.kinds:
        parser.error("nothing to judge: name a folder, --made N or --kinds")
    paths = sorted(p for p in options.folder.iterdir() if p.is_dir()) if options.folder else []
    tasks = {str(path): partial(judge_path, path, options.only) for path in paths}
    numbers = range(options.first, options.first + options.made)
    tasks |= {f"{options.seed}/{number}": partial(judge_made, options.seed, number, options.only) for number in numbers}
    tasks |= {f"kind {kind}": partial(judge_kind, kind, options.only) for kind in (ALL_KINDS if options.kinds else ())}
    known = _logged(options.log)
    with ProcessPoolExecutor(options.jobs) as pool:
        waiting = {name: pool.submit(task) for name, task in tasks.items() if name not in known}
        for name, future in waiting.items():
            error = future.exception()
            known[name] = _crashed(name, error) if error else future.result()
            if options.log and not error:
                with options.log.open("a") as file:
                    file.write(json.dumps([name, asdict(known[name])]) + "\n")
            print(f"  {len(known)}/{len(tasks)}", file=sys.stderr, end="\r")
    print(table([known[name] for name in tasks], whole=bool(paths or options.kinds)))
    return 0


def _crashed(name: str, error: BaseException) -> Verdict:
    """Returns the figures of a piece that could not be judged, with the reason."""
    why = f"{type(error).__name__}: {error}"
    nothing: dict[str, Any] = {"top_faults": [], "grasp_faults": [], "handle_faults": [], "joint_faults": []}
    inside: dict[str, Any] = {"panels": [0] * len(INTERIORS), "refusals": [], "rooms": [], "interior_faults": []}
    counts: dict[str, Any] = {"tops": 0, "movers": 0, "handles": 0, "grips": 0, "boards": 0, "waiting": 0}
    return Verdict(name, [], covered=None, seconds=0.0, crash=why, **counts, **nothing, **inside)


def _logged(path: Path | None) -> dict[str, Verdict]:
    """Returns the figures that a log holds, by what was judged."""
    lines = path.read_text().splitlines() if path and path.exists() else []
    return {name: Verdict(**figures) for name, figures in map(json.loads, lines)}


def judge_path(path: Path, kinds: Sequence[str] = KINDS) -> Verdict:
    """Returns the figures of a piece of furniture in a folder, its motions from the default source."""
    return judge(load_asset(path), MotionSource.AUTO, kinds)


def judge_made(seed: int, number: int, kinds: Sequence[str] = KINDS) -> Verdict:
    """Returns the figures of a made piece, with its true joints, and what somebody left out of it left out."""
    specimen = make_specimen(seed, number)
    whole = specimen.whole
    missing = set(specimen.missing)
    parts = tuple(p for p in whole.parts if p.id not in missing)
    return judge(replace(whole, parts=parts, name=f"{number} {specimen.family}"), MotionSource.ANNOTATION, kinds)


def judge_kind(kind: str, kinds: Sequence[str] = KINDS) -> Verdict:
    """Returns the figures of a piece of the catalogue, with its true joints, without its handles."""
    asset = ALL_KINDS[kind]()
    parts = tuple(part for part in asset.parts if part.label is not PartLabel.HANDLE)
    return judge(replace(asset, parts=parts, name=kind), MotionSource.ANNOTATION, kinds)


def judge(asset: Asset, source: MotionSource, kinds: Sequence[str] = KINDS) -> Verdict:
    """Returns the figures of one piece, of those kinds."""
    result = _run(asset, source)
    tops = sum(a.part.label is PartLabel.TOP_PANEL for a in result.additions)
    plain = _run(asset, source, NO_ADDITIONS) if {"top", "joint"} & {*kinds} else None
    covered, top_faults = _tops(asset, source, plain, result, tops) if plain and "top" in kinds else (None, [])
    inside = _interiors(result) if "interior" in kinds else Inside([0] * len(INTERIORS), [], [], [])
    timings = dict(result.timings)
    return Verdict(
        name=asset.name,
        kinds=list(kinds),
        tops=tops,
        covered=covered,
        top_faults=top_faults,
        movers=len(result.object.joints),
        handles=sum(a.part.label is PartLabel.HANDLE for a in result.additions),
        grips=len(result.fittings.carved),
        grasp_faults=list(_grasp_faults(result)) if "grasp" in kinds else [],
        handle_faults=list(_handle_faults(result)) if "handle" in kinds else [],
        panels=inside.panels,
        refusals=inside.refusals,
        rooms=inside.rooms,
        interior_faults=inside.faults,
        boards=len(result.body.drawers.additions),
        waiting=sum(bool(joint.after and _new_handles(result.object, joint)) for joint in result.object.joints),
        joint_faults=list(_joint_faults(plain, result)) if plain and "joint" in kinds else [],
        seconds=timings["body"] + timings["fittings"],
    )


def _tops(
    asset: Asset, source: MotionSource, plain: Functionalized, result: Functionalized, tops: int
) -> tuple[float | None, list[str]]:
    """Returns what a top covers that replaces the piece's own, and what is wrong with it and with tops added."""
    covered, faults = _without_its_top(asset, source, plain.object)
    seen = open_share([v.mesh for v in _own(plain.object)])
    if tops and seen < OPEN:
        faults.append(f"a top added, {seen:.0%} open")
    if not tops and seen > OPEN:
        faults.append(f"no top added, {seen:.0%} open: {result.body.top.why}")
    return covered, faults


def _run(asset: Asset, source: MotionSource, additions: AdditionConfig = DEFAULT) -> Functionalized:
    return functionalize(asset, source, builtin_gallery(), PipelineConfig(additions=additions))


# Tops: maps from above, by rays.


def _own(articulated: ArticulatedObject) -> list[Visual]:
    """Returns the input's parts, closed, without handles."""
    visuals = (v for link in articulated.links for v in link.visuals)
    own = (v for v in visuals if v.role is VisualRole.PART and v.label is not PartLabel.HANDLE)
    return [v for v in own if len(v.mesh.faces)]


def _body_of(asset: Asset, source: MotionSource) -> Body:
    """Returns a piece with what it gets before joints are built: its top does not depend on them."""
    motion = MOTIONS[choose_source(asset, source)]
    asset = asset if motion.reads_annotation else asset.without_annotation()
    completion = motion.complete(asset, parse_graph(asset))
    return complete_body(asset, completion, motion.plan(asset, completion), DEFAULT)


def _without_its_top(asset: Asset, source: MotionSource, closed: ArticulatedObject) -> tuple[float | None, list[str]]:
    """Returns the least share of a lost top's plan that the one in its place covers, and what is wrong with them."""
    tops = {p.id for p in asset.parts if p.label is PartLabel.TOP_PANEL and len(p.mesh.faces)}
    moving = {p.rides_on for p in asset.parts if p.rides_on} | {joint.part for joint in asset.joints}
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
    share = min((one.covered for one in (lost if len(added) >= len(lost) else missed)), default=1.0)
    faults = [f"its new top covers {share:.1%}"] if share < COVERED else []
    if not len(missed) <= len(added) <= len(lost):
        faults.append(f"{len(added)} tops in place of {len(missed)}")
    return share, faults


# Grasps and handles: sweeps with fcl over the meshes of the object.


def _grasp_faults(result: Functionalized) -> Iterator[str]:
    """Yields movers that nothing can be grasped of, and those with more handles than they need."""
    grasps = {joint.part: joint.grasp for joint in report_of(result).joints}
    factor = size_factor(largest_side(result.object))
    for joint in result.object.joints:
        visuals, added = result.object.link(joint.child).visuals, _new_handles(result.object, joint)
        carved = [c for c in result.fittings.carved if c.part.id in {v.name for v in visuals}]
        before = result.fittings.grasps[joint.child]
        if grasps[joint.child] == "none":
            yield f"`{joint.child}` cannot be grasped"
        width = float(np.max(merge_meshes([v.mesh for v in visuals]).box.size[:2])) / factor
        if len(added) + len(carved) > (2 if width >= WIDE else 1):
            yield f"`{joint.child}` has {len(added)} handles and {len(carved)} grips"
        if (added or carved) and before.kind in ("handle", "recess"):
            yield f"`{joint.child}` had a {before.kind} and got another"


def _handle_faults(result: Functionalized) -> Iterator[str]:
    """Yields added handles that cut into anything on their way, or that other movers run into on theirs.

    What a joint waits for is open as far as it goes; all else rests.
    """
    articulated = result.object
    skin = SKIN * largest_side(articulated)
    for joint in articulated.joints:
        for handle in _new_handles(articulated, joint):
            hit = _met(handle.mesh, joint, _around(articulated, joint), skin)
            yield from (f"`{handle.name}` meets `{name}`" for name in hit)
            struck = (other for other in articulated.joints if other.child != joint.child)
            yield from (
                f"`{other.child}` strikes `{handle.name}`" for other in struck if _strikes(other, handle, result)
            )


def _new_handles(articulated: ArticulatedObject, joint: Joint) -> list[Visual]:
    visuals = articulated.link(joint.child).visuals
    return [v for v in visuals if v.role is VisualRole.ADDED and v.label is PartLabel.HANDLE]


def _around(articulated: ArticulatedObject, joint: Joint) -> Any:
    """Returns all other links at rest, those that a joint waits for wide open."""
    manager = MANAGER()
    for visual in articulated.link(articulated.root).visuals:
        if len(visual.mesh.faces):
            manager.add_object(visual.name, visual.mesh.to_trimesh())
    values = values_before(articulated, joint.id)
    for other in articulated.joints:
        if other.child != joint.child:
            mesh = articulated.link(other.child).mesh
            manager.add_object(other.child, mesh.to_trimesh(), transform=other.motion(values[other.id]))
    return manager


def _met(handle: TriangleMesh, joint: Joint, around: Any, skin: float) -> list[str]:
    found: set[str] = set()
    body = handle.to_trimesh()
    for value in np.linspace(joint.limits.lower, joint.limits.upper, POSES):
        hit, names, contacts = around.in_collision_single(
            body, transform=joint.motion(float(value)), return_names=True, return_data=True
        )
        if hit:
            found |= {n for c in contacts if c.depth > skin for n in c.names if n in names}
    return sorted(found)


def _strikes(mover: Joint, handle: Visual, result: Functionalized) -> bool:
    """Whether a mover runs into a handle that rests; seen from the mover, the handle takes the way backwards."""
    articulated = result.object
    own = next(joint for joint in articulated.joints if handle in articulated.link(joint.child).visuals)
    values = values_before(articulated, mover.id)
    if values[own.id] != own.limits.lower or not len(articulated.link(mover.child).mesh.faces):
        return False  # the handle is out of the way by then
    manager = MANAGER()
    manager.add_object(mover.child, articulated.link(mover.child).mesh.to_trimesh())
    body, skin = handle.mesh.to_trimesh(), SKIN * largest_side(articulated)
    for value in np.linspace(mover.limits.lower, mover.limits.upper, POSES):
        T = np.linalg.inv(mover.motion(float(value)))
        hit, contacts = manager.in_collision_single(body, transform=T, return_data=True)
        if hit and any(contact.depth > skin for contact in contacts):
            return True
    return False


# Interiors, drawer boxes, joints.


@dataclass(frozen=True)
class Inside:
    """What the requests of `INTERIORS` bring: panels of each, refusals and faults of all, and rooms left empty."""

    panels: list[int]
    refusals: list[str]
    rooms: list[str]
    faults: list[str]


def _interiors(result: Functionalized) -> Inside:
    """Returns what comes of all requests, each on the finished piece with its hardware and handles."""
    counts, faults, refusals = [], [], []
    for request in INTERIORS:
        scene = result.fittings.scene
        inside = furnish_scene(scene, parse_interior(request))
        names = {a.part.id for a in inside.additions}
        whole = fitted_object(result.object, Fittings(scene, inside.additions))
        counts.append(len(names))
        refusals += [one.why for one in inside.refused]
        skin = SKIN * largest_side(whole)
        faults += [f"{request}: `{a}` {what} `{b}`" for a, what, b in panel_faults(whole, names, skin)]
    empty = [] if any(counts) else empty_rooms(result.object)
    rooms = [
        " x ".join(f"{side:.2f}" for side in box.size) + f" m at {np.round(box.center, 2).tolist()}" for box in empty
    ]
    return Inside(counts, refusals, rooms, faults)


def _joint_faults(plain: Functionalized, result: Functionalized) -> Iterator[str]:
    """Yields joints that additions cost, or that open less for them."""
    before = {joint.child: joint.limits.upper for joint in plain.object.joints}
    after = {joint.child: joint.limits.upper for joint in result.object.joints}
    for name, upper in before.items():
        if name not in after:
            yield f"`{name}` does not move any more"
        elif after[name] < LEAST_OPENING * upper:
            yield f"`{name}` opens {after[name]:.3f} instead of {upper:.3f}"


def table(found: Sequence[Verdict], whole: bool) -> str:
    """Returns the figures as a table, and summed up; `whole`: also those without a fault."""
    head = "| piece | tops | cover | movers | handles | grips | panels | boards | s | faults |"
    lines = [head, "|---" * 10 + "|"]
    for one in found:
        if whole or one.faults:
            cover = "" if one.covered is None else f"{one.covered:.1%}"
            counts = " / ".join(map(str, one.panels))
            cells = [one.name, one.tops, cover, one.movers, one.handles, one.grips, counts, one.boards]
            lines.append(f"| {' | '.join(map(str, cells))} | {one.seconds:.2f} | {'; '.join(one.faults)} |")
    topped = [one.covered for one in found if one.covered is not None]
    seconds = [one.seconds for one in found]
    panels = [sum(one.panels[k] for one in found) for k in range(len(INTERIORS))]
    looked_into = [one for one in found if "interior" in one.kinds]
    empty = [one for one in looked_into if not any(one.panels)]
    refusals = Counter(_kind_of(why) for one in found for why in one.refusals)
    movers, tops = sum(one.movers for one in found), sum(one.tops for one in found)
    lines += [
        "",
        f"- {sum(bool(one.crash) for one in found)} could not be judged.",
        f"- {len(found)} pieces, {movers} movers, {tops} tops added.",
        f"- Without their own tops: {sum(c >= COVERED for c in topped)} of {len(topped)} get one that covers "
        f"{COVERED:.0%} (least {min(topped, default=1.0):.1%}).",
        f"- Panels for {', '.join(INTERIORS)}: {', '.join(map(str, panels))}.",
        f"- {sum(one.waiting for one in found)} movers with a new handle wait for another to open.",
        f"- {len(looked_into) - len(empty)} pieces get panels, {len(empty)} none; rays find an empty room in "
        f"{sum(bool(one.rooms) for one in empty)} of those:",
        *(
            f"  - {one.name}: {'; '.join(one.rooms)} ({'; '.join(dict.fromkeys(one.refusals))})"
            for one in empty
            if one.rooms
        ),
        "- Not built inside, and why:",
        *(f"  - {count} x {why}" for why, count in refusals.most_common()),
        *(
            f"- {kind} faults: {sum(len(getattr(o, f'{kind}_faults')) for o in found)} "
            f"on {sum(kind in o.kinds for o in found)} pieces."
            for kind in KINDS
        ),
        f"- Seconds for additions: median {np.median(seconds):.2f}, 90 % {np.quantile(seconds, 0.9):.2f}, "
        f"most {max(seconds):.2f}.",
    ]
    return "\n".join(lines)


def _kind_of(why: str) -> str:
    """Returns a reason without the names and numbers of one piece."""
    return re.sub(r"\d+(\.\d+)?", "N", re.sub(r"`[^`]*`", "`...`", why))


if __name__ == "__main__":
    sys.exit(main())
