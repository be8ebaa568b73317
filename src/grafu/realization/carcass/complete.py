"""Boards that close a carcass: a thin back between the walls or planted on their rear edges, a bottom between them.

They are added on request only. Each fits the real meshes: rays say where walls end, and a board that would pierce
anything, at rest or as a drawer runs, is not added. Boards stand still and look like the body.
"""

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from grafu.asset.part import Part
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.transform import from_rotation
from grafu.realization.addition import Addition, added_part, free_ids
from grafu.realization.carcass.bays import Bay, View
from grafu.realization.carcass.board_room import BoardRoom
from grafu.realization.carcass.config import CarcassConfig
from grafu.realization.carcass.missing_panels import DEFAULT, MissingPanel, panels_missing
from grafu.realization.drawer_box.surroundings import Surroundings, surroundings_of
from grafu.realization.likeness import surface_like
from grafu.realization.plan import RealizationPlan, Refusal
from grafu.vocabulary import PartLabel

_SIDE_BY_SIDE = 0.06  # share of the object's largest side: bays nearer than this share one back
_WASTED = 0.15  # share of a common back that may cover what lacks none
_FILLED = 0.7  # share of a bay's sides that a board must close
_FRAME = 0.2  # share of the depth in which a face frame or a front may stand before a bottom
_NO_ROOM = "no board fits between the walls without piercing something"
_TOUCH = 5e-4  # metres: less deep than this a board and its neighbour merely touch


@final
@dataclass(frozen=True)
class CarcassCompletion:
    """What the carcasses lack, the boards added, and those that could not be, with why."""

    missing: tuple[MissingPanel, ...] = ()
    additions: tuple[Addition, ...] = ()
    refused: tuple[Refusal, ...] = ()


def complete_carcass(
    parts: Sequence[Part], plan: RealizationPlan, config: CarcassConfig = DEFAULT
) -> CarcassCompletion:
    """Returns the backs and bottoms that close the bodies behind the doors and drawers of a plan."""
    around = surroundings_of(parts, plan)
    missing = panels_missing(around, config)
    additions: list[Addition] = []
    refused: list[Refusal] = []
    taken = {part.id for part in parts}
    rooms = {id(panel.view): _room(panel.view, around) for panel in {id(k.view): k for k in missing}.values()}
    for group in _groups(missing, around.scene.unit):
        room = rooms[id(group[0].view)]
        whole = _whole(group)
        together = _board(whole, room, config) is not None
        for panel in [whole] if together else group:
            board = _board(panel, room, config)
            if board is None:
                refused.append(Refusal(panel.moving_bodies[0], f"no {panel.what.value}: {_NO_ROOM}"))
                continue
            room = rooms[id(panel.view)] = room.with_board(board)
            additions.append(_addition(panel, board, around, taken))
            taken.add(additions[-1].part.id)
    return CarcassCompletion(missing, tuple(additions), tuple(refused))


def _addition(panel: MissingPanel, board: Box, around: Surroundings, taken: Collection[str]) -> Addition:
    (part_id,) = free_ids(panel.what.value.replace(" ", "_"), 1, taken)
    mesh = TriangleMesh.box_mesh(board).transformed(from_rotation(panel.view.rotation))
    return Addition(added_part(part_id, panel.what, (surface_like(mesh, around.body),)), panel.why, "carcass board")


def _groups(missing: Iterable[MissingPanel], unit: float) -> list[list[MissingPanel]]:
    """Returns the lacks of bays that adjoin one another together: they may share one board."""
    groups: list[list[MissingPanel]] = []
    for panel in missing:
        group = next((g for g in groups if _adjoins(panel, _whole(g), unit)), None)
        if group is None:
            groups.append([panel])
        else:
            group.append(panel)
    return groups


def _whole(group: Sequence[MissingPanel]) -> MissingPanel:
    """Returns lacks as one."""
    bay = group[0].bay
    for panel in group[1:]:
        bay = bay.joined(panel.bay)
    return replace(group[0], bay=bay, moving_bodies=bay.moving_bodies, why="; ".join(panel.why for panel in group))


def _adjoins(a: MissingPanel, b: MissingPanel, unit: float) -> bool:
    if a.view is not b.view or a.what is not b.what:
        return False
    low, high = np.minimum(a.bay.low, b.bay.low), np.maximum(a.bay.high, b.bay.high)
    gaps = np.maximum(a.bay.low - b.bay.high, b.bay.low - a.bay.high)[[0, 2]]
    areas = [float((s.high - s.low)[0] * (s.high - s.low)[2]) for s in (a.bay, b.bay)]
    whole = float((high - low)[0] * (high - low)[2])
    return bool(gaps.max() < _SIDE_BY_SIDE * unit and whole - sum(areas) < _WASTED * whole)


def _board(panel: MissingPanel, room: BoardRoom, config: CarcassConfig) -> Box | None:
    """Returns the board that a carcass lacks, in its view; None where none fits."""
    for board in (
        _backs(panel.bay, room, config) if panel.what is PartLabel.BACK_PANEL else _bottoms(panel, room, config)
    ):
        if _fills(board, panel.bay) and room.is_free(board, _TOUCH) and room.holds(board):
            return board
    return None


def _fills(board: Box, bay: Bay) -> bool:
    """Whether a board closes most of a bay along its two longer sides."""
    thin = board.thin_axis
    along = [a for a in range(3) if a != thin]
    return bool(board.size[thin] > 0 and np.all(board.size[along] > _FILLED * (bay.high - bay.low)[along]))


def _room(view: View, around: Surroundings) -> BoardRoom:
    moving = [around.scene.parts[i] for i in sorted(around.scene.moving_ids)]
    merged = (merge_meshes([p.mesh for p in some]) for some in (around.scene.static_parts, moving))
    return BoardRoom.of(*(TriangleMesh(view.local(mesh.vertices), mesh.faces) for mesh in merged))


def _backs(bay: Bay, room: BoardRoom, config: CarcassConfig) -> Iterable[Box]:
    """Yields backs, best first: between the walls, at their rear edges; then planted on these."""
    width, height = float(bay.high[0] - bay.low[0]), float(bay.high[2] - bay.low[2])
    thick = min(config.back, config.thickness_share * min(width, height))
    rear, middle = float(bay.high[1]), (bay.low + bay.high) / 2
    spot = vec3(float(middle[0]), rear - thick / 2, float(middle[2]))
    (x0, x1), (z0, z1) = room.between(spot, 0, bay, 2), room.between(spot, 2, bay, 0)
    yield _box((x0, rear - thick, z0), (x1, rear, z1))
    lap = min(config.on_edge, config.thickness_share * min(width, height))
    body = room.box
    low = vec3(
        max(float(bay.low[0]) - lap, body.low[0]), rear - 0.02 * width, max(float(bay.low[2]) - lap, body.low[2])
    )
    high = vec3(min(float(bay.high[0]) + lap, body.high[0]), body.high[1], min(float(bay.high[2]) + lap, body.high[2]))
    edge = room.rear_of(Box(low, high), rear)
    yield _box((low[0], edge, low[2]), (high[0], edge + thick, high[2]))


def _bottoms(panel: MissingPanel, room: BoardRoom, config: CarcassConfig) -> Iterable[Box]:
    """Yields bottoms, best first: behind fronts that lie before the walls, below those between them; else the other.

    A face frame, or a front between the walls, stands before the board. Where drawers run low, a thinner one is tried.
    """
    bay = panel.bay
    width, depth = (float(bay.high[axis] - bay.low[axis]) for axis in (0, 1))
    full = min(config.bottom, config.thickness_share * min(width, depth))
    foot, floor = float(bay.outline[2]), float(room.box.low[2])
    for thick in (full, 0.4 * full):
        below = foot - min(config.gap, 0.2 * thick) - thick
        for z in (below, foot) if bay.inset else (foot, below):
            if z < floor - _TOUCH:
                continue
            start, end = float(bay.low[1]), float(bay.high[1])
            spot = vec3(float(bay.low[0] + bay.high[0]) / 2, (start + end) / 2, z + thick / 2)
            x0, x1 = room.between(spot, 0, bay, 1)
            _, end = room.between(spot, 1, bay, 0)
            front = room.behind_fronts(_box((x0, start, z), (x1, end, z + thick)), _FRAME)
            yield _box((x0, front, z), (x1, end, z + thick))


def _box(low: tuple[float, float, float], high: tuple[float, float, float]) -> Box:
    return Box(np.minimum(low, high), np.maximum(low, high))
