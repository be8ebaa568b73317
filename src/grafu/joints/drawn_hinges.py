"""Hinges that the model has: round barrels along a door's border, or one rod along its lower one.

They carry the door, and tell which border it turns about, whatever the source of motions takes it for.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TypeAlias, final

import numpy as np

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale
from grafu.geometry.mesh import TriangleMesh
from grafu.graph.edges import Hinge
from grafu.joints.barrels import Barrel, DrawnModel, barrels_near, drawn_model, hinge_line, line_at
from grafu.joints.config import RealizationConfig
from grafu.joints.hinge.search import DoorSearch
from grafu.joints.nesting import bodies_of
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.scene.border import SNAP, BorderFrame, border_frame, part_axes
from grafu.scene.scene import Scene

_Line: TypeAlias = tuple[BorderFrame, Sequence[Barrel]]


@final
@dataclass(frozen=True, eq=False)
class DrawnPin:
    """The pin line of drawn hinges along a door's border, and the parts whose shells their barrels are."""

    axis: Axis
    parts: frozenset[str]


def drawn_pin(search: DoorSearch) -> DrawnPin | None:
    """Returns the common pin of round barrels along the door's border, shells of the door or of static parts.

    It is None where fewer than two lie on one line, where they are not spread along the border, and where hardware was
    chosen. One rod is enough where it carries the door; see `with_drawn_hinges`.
    """
    if str(search.request.choice):
        return None
    model = drawn_model(search.scene, search.config)
    line = line_at(search.frame, search.request, model)
    return DrawnPin(search.frame.axis_at(line[0].x, line[0].y), frozenset(b.part for b in line)) if line else None


def barrels_at(frame: BorderFrame, request: JointRequest, scene: Scene, config: RealizationConfig) -> list[Barrel]:
    """Returns the barrels on one line that are spread along a border of a moving body; `config` is in its scale."""
    model = drawn_model(scene, config)
    return hinge_line(frame, list(barrels_near(frame, request.moving, model)), model.drawn)


def with_drawn_hinges(
    plan: RealizationPlan, asset: Asset, config: RealizationConfig = RealizationConfig()
) -> RealizationPlan:
    """Returns the plan in which doors turn about the border along which the model has hinges for them.

    Barrels count where they lie along one border of a door and no other; those of a door beside it that has no others
    are that one's. A rod along the lower border of an upright leaf, which ends at static parts, makes a flap of
    whatever stands on it, be it planned to turn elsewhere or to slide. Joints on moving parts, coupled ones, and those
    for which hardware was chosen stay as they are.
    """
    scene = Scene({p.id: p for p in asset.parts if len(p.mesh.faces)}, bodies_of(plan.joints), asset.extent)
    model = drawn_model(scene, at_scale(config, scene.metre))
    found = _without_neighbours([_lines_of(request, model) for request in plan.joints], model.drawn.line)
    told = zip(plan.joints, found, strict=True)
    return replace(plan, joints=tuple(_on_drawn(r, lines[0], model) if len(lines) == 1 else r for r, lines in told))


def _lines_of(request: JointRequest, model: DrawnModel) -> list[_Line]:
    """Returns the borders of a part along which barrels lie that may carry it, with these; none for other joints."""
    is_settled = str(request.choice) or request.parent or request.coupling or request.drawn_at
    if is_settled or request.moving not in model.scene.parts:
        return []
    leaf = model.scene.parts[request.moving].mesh
    frames = [border_frame(leaf, axis) for axis in _border_axes(leaf)]
    return [(frame, line) for frame in frames if (line := line_at(frame, request, model))]


def _without_neighbours(found: list[list[_Line]], near: float) -> list[list[_Line]]:
    """Returns the lines of each part without those of another part that has no other line, until none is left out.

    In a row of doors that all hang on the left, each has the barrels of the next one along its right border.
    """
    kept = list(found)
    while True:
        single = [(k, _middles(lines[0])) for k, lines in enumerate(kept) if len(lines) == 1]
        before = [len(lines) for lines in kept]
        for k, lines in enumerate(kept):
            own = [line for line in lines if not any(j != k and _meet(_middles(line), m, near) for j, m in single)]
            if own:
                kept[k] = own
        if [len(lines) for lines in kept] == before:
            return kept


def _middles(line: _Line) -> Points:
    """Returns the middles of those barrels of a line that are as high as the part itself, in the object frame."""
    frame, barrels = line
    points = [vec3(b.x, b.y, (b.low + b.high) / 2) for b in barrels]
    return frame.to_object(np.array([p for p in points if abs(p[2]) <= frame.length / 2]).reshape(-1, 3))


def _meet(some: Points, others: Points, near: float) -> bool:
    return bool((np.linalg.norm(some[:, None] - others[None], axis=2) <= near).any())


def _on_drawn(request: JointRequest, found: _Line, model: DrawnModel) -> JointRequest:
    frame, line = found
    leaf = model.scene.parts[request.moving].mesh
    request = _without_barrels(request, line, model)
    if request.kind.turns and _is_same_border(border_frame(leaf, request.axis), frame):
        return request
    outwards = request.kind.sets_off(request.axis, leaf.box.center)
    pin, reference = frame.axis_at(line[0].x, line[0].y), request.reference if request.kind.turns else None
    made = replace(request, type=Hinge.joint_type, axis=pin, reference=reference, mounts=())
    opens = float(made.kind.sets_off(made.axis, leaf.box.center) @ outwards)
    return made if opens > 0 else replace(made, axis=made.axis.reversed())


def _without_barrels(request: JointRequest, line: Sequence[Barrel], model: DrawnModel) -> JointRequest:
    """Returns the request without parts that are barrels of its hinges, where others of these are static: all are."""
    if all(barrel.part in model.scene.moving_ids for barrel in line):
        return request
    barrels = {b.part for b in line if len(model.shells(b.part)) == 1 and b.part != request.moving}
    return replace(request, attached=tuple(name for name in request.attached if name not in barrels))


def _border_axes(mesh: TriangleMesh) -> Iterator[Axis]:
    """Yields a line along each of the four borders of a leaf."""
    axes = part_axes(mesh)
    local = Box.around(mesh.vertices @ axes)
    for along in (k for k in range(3) if k != local.thin_axis):
        across = 3 - along - local.thin_axis
        for sign in (-1.0, 1.0):
            point = np.array(local.center)
            point[across] += sign * local.half[across]
            yield Axis(axes @ point, axes[:, along])


def _is_same_border(a: BorderFrame, b: BorderFrame) -> bool:
    return bool(a.rotation[:, 0] @ b.rotation[:, 0] > SNAP)
