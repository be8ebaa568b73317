"""Drawers that are only a front, or lack boards of their box, get what is missing. It builds no rails.

Every drawer that a plan moves is looked at, closed, in its place among all others. Boards are parts of their own that
ride on the drawer. They are labelled misc, as the loose boards of drawers are in other models: none of them is a panel
of the case, and none moves on its own.
"""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import final

import numpy as np

from grafu.additions.closed_scene import ClosedScene, closed_part, closed_scene
from grafu.additions.drawer_box.boards import boards_in_room, boards_to_complete, has_walls
from grafu.additions.drawer_box.config import BoxProbeConfig, DrawerBoxConfig
from grafu.additions.drawer_box.loose import loose_boards
from grafu.additions.drawer_box.room import Room, end_of_room, find_room
from grafu.additions.drawer_box.verdict import BoardName, BoxVerdict, as_front_only, box_verdict
from grafu.additions.likeness import surface_like
from grafu.additions.step import (
    Addition,
    Changes,
    Deficiency,
    DeficiencyKind,
    StepRequest,
    StepResult,
    added_part,
    free_ids,
)
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.cells import pieces_in, spans_of
from grafu.geometry.config_checks import at_scale
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.geometry.transform import translation
from grafu.joints.plan import JointRequest, MotionRole, RealizationPlan
from grafu.joints.racks import is_grid
from grafu.joints.rail.body_region import DrawerFrame, is_shallow
from grafu.joints.rail_config import DrawerConfig
from grafu.refusal import Asked, Reason, Refusal
from grafu.scene.scene import Scene
from grafu.vocabulary import PartLabel

WITH_THE_CASE = "the boards that do not move with it are drawn in their places, as part of what is static"
_NO_DRAWERS = {MotionRole.BIN: "it is a bin", MotionRole.SUPPORT: "it carries a raised leaf"}


@final
@dataclass(frozen=True)
class DrawerBoxes:
    """The outcome for all drawers of a plan: what each has, the boards added, and those that could not be, with why.

    `loose` names parts of the input that turned out to be boards of a drawer's box: drawer, then part. They must move
    with it.
    """

    verdicts: tuple[BoxVerdict, ...] = ()
    additions: tuple[Addition, ...] = ()
    refused: tuple[Refusal, ...] = ()
    loose: tuple[tuple[str, str], ...] = ()


def add_drawer_boxes(scene: Scene, request: StepRequest, config: DrawerBoxConfig | None) -> StepResult:
    """Returns the scene in which drawers have their boxes; without a config it is only said what they lack."""
    boxes = config or DrawerBoxConfig()
    made = complete_drawers(scene, request.plan, boxes, request.drawers, build=config is not None)
    lacking = [verdict for verdict in made.verdicts if verdict.missing]
    return StepResult(
        scene.with_attached(made.loose).with_parts(addition.part for addition in made.additions),
        made.additions,
        Changes(attached=made.loose),
        made.refused,
        tuple(Deficiency(DeficiencyKind.DRAWER_BOX, v.drawer, f"{v.kind}: {v.why}") for v in lacking),
    )


def complete_drawers(
    scene: Scene,
    plan: RealizationPlan,
    config: DrawerBoxConfig = DrawerBoxConfig(),
    drawers: DrawerConfig = DrawerConfig(),
    *,
    build: bool = True,
) -> DrawerBoxes:
    """Returns the boards that the drawers of a plan lack, each drawer keeping out of those of the others.

    `drawers` states what counts as one. `build=False` only looks: what is missing is said, nothing is added.
    """
    requests = [r for r in plan.joints if r.kind.slides]
    if not requests:
        return DrawerBoxes()
    closed = closed_scene(scene, plan, drawers)
    config = at_scale(config, closed.scene.metre)
    verdicts: list[BoxVerdict] = []
    additions: list[Addition] = []
    refused: list[Refusal] = []
    loose: list[tuple[str, str]] = []
    known = set(scene.parts)
    for request in requests:
        if request.moving not in closed.scene.parts:
            continue
        verdict = missing_box(request, closed, config)
        if verdict.kind == "front only":
            found = find_loose(request, closed, config)
            loose += [(request.moving, part_id) for part_id in found]
            closed = closed.with_members(request.moving, found)
            verdict = missing_box(request, closed, config) if found else verdict
        verdicts.append(verdict)
        if not build or not verdict.missing:
            continue
        made = drawer_box(verdict, request, closed, config, known)
        if isinstance(made, Refusal):
            if drawn_with_the_case(verdict, request, closed, config):
                verdicts[-1] = replace(verdict, kind="whole", missing=(), why=WITH_THE_CASE)
                continue
            front = _as_thick_front(verdict, made, request, closed, config)
            boxed = drawer_box(front, request, closed, config, known) if front else made
            if front is None or isinstance(boxed, Refusal):
                refused.append(made)
                continue
            verdicts[-1], made = front, boxed
        additions += made
        known |= {addition.part.id for addition in made}
        closed = closed.with_parts(tuple(closed_part(a.part, request) for a in made))
    return DrawerBoxes(tuple(verdicts), tuple(additions), tuple(refused), tuple(loose))


def find_loose(request: JointRequest, closed: ClosedScene, config: DrawerBoxConfig) -> tuple[str, ...]:
    """Returns the still parts that are boards of the box behind a mere front."""
    framed = closed.framed(request)
    return loose_boards(request, framed[1], framed[0], closed, config) if framed else ()


def missing_box(request: JointRequest, closed: ClosedScene, config: DrawerBoxConfig) -> BoxVerdict:
    """Returns what a drawer, closed, has of a box behind its front, and what is missing."""
    if closed.scene.parts[request.moving].label is PartLabel.DOOR:
        return BoxVerdict(request.moving, "no drawer", why="it is a door, which has what it carries")
    if request.role in _NO_DRAWERS:
        return BoxVerdict(request.moving, "no drawer", why=_NO_DRAWERS[request.role])
    if is_grid(closed.scene.moving_mesh(request.moving)):
        return BoxVerdict(request.moving, "no drawer", why="it is a rack")
    framed = closed.framed(request)
    if framed is None:
        return BoxVerdict(request.moving, "no drawer", why="it does not slide out of a case")
    frame, mesh = framed
    verdict = box_verdict(request.moving, mesh, frame, config, closed.drawers)
    if verdict.kind != "front only" and is_shallow(frame, closed.drawers):
        behind = _space_behind(frame, closed, request, config.probe.behind_middle)
        if behind > config.deeper * frame.depth:
            return as_front_only(verdict, frame, behind)
    return verdict


def _as_thick_front(
    verdict: BoxVerdict, refusal: Refusal, request: JointRequest, closed: ClosedScene, config: DrawerBoxConfig
) -> BoxVerdict | None:
    """Returns the verdict on a drawer as on a front where something stands in the way of the boards that it lacks.

    None where no space lies behind it that is deep beside it. What is drawn of such a front looks like boards of a box:
    a hollow block, flanges.
    """
    framed = closed.framed(request)
    if verdict.kind != "incomplete" or refusal.reason is not Reason.IN_THE_WAY or framed is None:
        return None
    frame = framed[0]
    behind = end_of_room(closed.triangles(request, frame)[0], frame, config) - frame.depth
    return as_front_only(verdict, frame, behind) if behind > config.deeper * frame.depth else None


def drawn_with_the_case(
    verdict: BoxVerdict, request: JointRequest, closed: ClosedScene, config: DrawerBoxConfig
) -> bool:
    """Whether the boards that an incomplete box lacks stand within its outline, merged into parts that are static.

    They look like parts of the case; boards beside them would be doubles.
    """
    framed = closed.framed(request)
    if verdict.kind != "incomplete" or framed is None:
        return False
    frame, mesh = framed
    still, _ = closed.triangles(request, frame)
    half = np.array([frame.width / 2, np.inf, frame.height / 2]) + config.sticks_out
    inside = (np.abs(still) <= half).all(axis=(1, 2)) & (still[..., 1] <= frame.depth + config.sticks_out).all(axis=1)
    inside &= (still[..., 1] >= 0.0).all(axis=1)
    corners = still[inside].reshape(-1, 3)
    boards = TriangleMesh(corners, np.arange(len(corners)).reshape(-1, 3))
    return not box_verdict(request.moving, merge_meshes([mesh, boards]), frame, config, closed.drawers).missing


def drawer_box(
    verdict: BoxVerdict,
    request: JointRequest,
    closed: ClosedScene,
    config: DrawerBoxConfig,
    taken: Iterable[str] = (),
) -> tuple[Addition, ...] | Refusal:
    """Returns the boards that a drawer lacks, at rest as the drawer is drawn, or why there can be none.

    `taken` are the ids that parts have.
    """
    framed = closed.framed(request)
    if framed is None or not verdict.missing:
        return _of(request, Refusal("", Reason.NOT_MISSING, "nothing is missing behind it"))
    frame, mesh = framed
    still, others = closed.triangles(request, frame)
    caster = RayCaster(mesh)
    room: Room | Refusal | None = None
    if verdict.kind == "front only" or not has_walls(verdict):
        front = replace(frame, depth=verdict.inner_front)
        room = find_room(caster, front, still, others, config, closed.limit_behind(request, front, config.opposite))
    if isinstance(room, Refusal):
        return _of(request, room)
    if verdict.kind == "front only" and room is not None:
        boards: Mapping[BoardName, Box] | Refusal = boards_in_room(room.box, caster, frame, config)
    else:
        boards = boards_to_complete(verdict, mesh, caster, frame, config, room.box if room else None)
        if not isinstance(boards, Refusal):
            boards = _free(boards, np.concatenate([still, others]), config.probe)
    if isinstance(boards, Refusal):
        return _of(request, boards)
    return _additions(boards, verdict, request, frame, closed, set(taken))


def _of(request: JointRequest, refusal: Refusal) -> Refusal:
    return replace(refusal, part=request.moving, why=f"no drawer box: {refusal.why}", what=Asked.DRAWER_BOX)


def _space_behind(frame: DrawerFrame, closed: ClosedScene, request: JointRequest, middle: float) -> float:
    """Returns how deep the space behind a part's middle is, metres, 0 where nothing ends it.

    The middle is this fraction of its smaller side wide, to both sides.
    """
    still, others = closed.triangles(request, frame)
    near = np.concatenate([still, others])
    reach = middle * min(frame.width, frame.height)
    low, high = spans_of(near)
    met = (np.abs(low[:, [0, 2]] + high[:, [0, 2]]) / 2 - (high - low)[:, [0, 2]] / 2 < reach).all(axis=1)
    met &= high[:, 1] > frame.depth
    return max(float(low[met, 1].min()) - frame.depth, 0.0) if met.any() else 0.0


def _free(
    boards: Mapping[BoardName, Box], obstacles: np.ndarray, config: BoxProbeConfig
) -> Mapping[BoardName, Box] | Refusal:
    """Returns the boards, or which of them something stands in the way of."""
    for name, board in boards.items():
        inside = board.grown(-min(config.touch, config.touch_ratio * float(board.size.min())))
        if len(pieces_in(obstacles, inside, (4, 4, 4)).low):
            return Refusal("", Reason.IN_THE_WAY, f"something stands where its {name.replace('_', ' ')} would be")
    return boards


def _additions(
    boards: Mapping[BoardName, Box],
    verdict: BoxVerdict,
    request: JointRequest,
    frame: DrawerFrame,
    closed: ClosedScene,
    taken: set[str],
) -> tuple[Addition, ...]:
    ajar = translation(request.drawn_at * np.asarray(request.axis.direction))
    T = ajar @ frame.T_object_drawer
    like = closed.body if verdict.kind == "front only" else (closed.scene.parts[request.moving],)
    why = "it was only a front" if verdict.kind == "front only" else f"its box lacked {verdict.why}"
    made = []
    for name, board in boards.items():
        (part_id,) = free_ids(f"{request.moving}_{name}", 1, taken)
        taken.add(part_id)
        surface = surface_like(TriangleMesh.box_mesh(board).transformed(T), like)
        part = added_part(part_id, PartLabel.MISC, (surface,), request.moving)
        made.append(Addition(part, f"{request.moving}: {why}", "drawer box"))
    return tuple(made)
