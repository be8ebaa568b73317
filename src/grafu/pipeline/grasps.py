"""How each moving link of a result can be held in the end, by kind, and its grasp frames."""

from dataclasses import replace

from grafu.additions.step import StepResult
from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.grasp_search import GraspHint, with_grasps
from grafu.joints.plan import RealizationPlan
from grafu.joints.realize import Realized
from grafu.joints.report import LIFT_ARMS, RealizationReport
from grafu.pipeline.stages import Stages
from grafu.pipeline.words import Grasp
from grafu.processes.cache import NO_CACHE, Cache

_ON_FLOOR = 0.01  # metres: what ends lower stands on the floor


def with_grasp_frames(
    realized: Realized, fittings: StepResult, plan: RealizationPlan, stages: Stages, cache: Cache = NO_CACHE
) -> Realized:
    """Returns what was realized with the grasp frame of each link that can be held."""
    hints = _hints(realized.object, grasp_kinds(realized.object, fittings, realized.report, plan), fittings)

    def held() -> Realized:
        return replace(realized, object=cache.value("grasps", with_grasps, realized.object, hints))

    return stages.timed("grasp frames", held, lambda _: realized)


def _hints(made: ArticulatedObject, kinds: dict[str, Grasp], fittings: StepResult) -> dict[str, GraspHint]:
    """Returns, by link, how and about where each can be held; what is driven or cannot be held is left out."""
    link_of = {visual.name: link.id for link in made.links for visual in link.visuals}
    hints: dict[str, GraspHint] = {}
    for moving, kind in kinds.items():
        if kind == "none" or kind == "driven":
            continue
        seen, hint = fittings.grasps.get(moving), GraspHint(kind)
        if seen is not None and seen.kind == kind:
            hint = replace(hint, part=seen.part)
            if kind != "handle":  # a handle is its whole part
                hint = replace(hint, center=seen.center, length=seen.length)
        hints[link_of.get(moving, moving)] = hint
    carved = {link_of.get(c.part.id, c.part.id): c for c in fittings.changes.carved}
    return hints | {link: GraspHint("recess", c.part.id, c.centre, float(c.size[0])) for link, c in carved.items()}


def grasp_kinds(
    made: ArticulatedObject, fittings: StepResult, report: RealizationReport, plan: RealizationPlan
) -> dict[str, Grasp]:
    """Returns how each moving body can be grasped in the end; a follower without a grasp of its own is not in it."""
    found: dict[str, Grasp] = {moving: grasp.kind for moving, grasp in fittings.grasps.items()}
    found |= {a.part.carried_by: "handle" for a in fittings.additions if a.part.carried_by}
    found |= {c.part.id: "recess" for c in fittings.changes.carved}
    for one in report.installed:
        if one.template == LIFT_ARMS:
            found.setdefault(one.moving, "driven")
    return found | {moving: _grasp_of_small(made, moving) for moving in small_parts(report, plan)}


def small_parts(report: RealizationReport, plan: RealizationPlan) -> frozenset[str]:
    """Returns the knobs, buttons, wheels and casters with a joint of their own: no plan asks for these."""
    planned = {request.moving for request in plan.joints}
    others = (made for made in report.installed if made.template != LIFT_ARMS)
    return frozenset(made.moving for made in others if made.moving not in planned)


def _grasp_of_small(made: ArticulatedObject, moving: str) -> Grasp:
    """Returns how a small part is moved: what stands on the floor rolls with the piece, the others are held."""
    floor = min(float(link.mesh.box.low[2]) for link in made.links)
    below = [made.link(moving), *(made.link(joint.child) for joint in made.joints if joint.parent == moving)]
    stands = min(float(link.mesh.box.low[2]) for link in below) <= floor + _ON_FLOOR
    return "driven" if stands else "itself"
