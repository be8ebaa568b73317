"""All joints of a plan, one after the other, each within its fraction of the time: doors first, then drawers.

One part that cannot be built, or takes more than its fraction, does not cost the others theirs.

How moving bodies may be expected to move before their joints are built, so that hardware keeps out of their way.

A door is expected to turn about the first pin of a hinge class that leaves it free, else about the axis that was asked
for; a drawer slides. What is built later may differ.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial

from grafu.geometry.budget import has_time, present_budget, within
from grafu.geometry.config_checks import at_scale
from grafu.joints.build import Built, build_joint
from grafu.joints.config import RealizationConfig
from grafu.joints.hinge.search import door_search
from grafu.joints.known import SceneChange, change_between, worked_out
from grafu.joints.plan import JointRequest
from grafu.joints.rail.search import drawer_search
from grafu.processes.cache import NO_CACHE, Cache
from grafu.refusal import Reason, Refusal
from grafu.scene.scene import JointMotion, Scene
from grafu.templates.template import Gallery


def expected_motions(
    requests: Iterable[JointRequest], scene: Scene, config: RealizationConfig, cache: Cache = NO_CACHE
) -> dict[str, JointMotion]:
    """Returns the expected motion of each requested joint, by moving body; none for drawers that no rails can carry."""
    found: dict[str, JointMotion] = {}
    for request in requests:
        work = partial(_expected_motion, request, config)
        motion = worked_out("expected motion", work, request.moving, scene, cache, request, config)
        found |= {} if motion is None else {request.moving: motion}
    return found


def _expected_motion(request: JointRequest, config: RealizationConfig, scene: Scene) -> JointMotion | None:
    config = at_scale(config, scene.metre)
    if request.kind.turns:
        door = door_search(request, scene, config)
        return JointMotion(door.expected_axis, request.type, door.wanted, is_built=False)
    drawer = drawer_search(request, scene, config)
    return None if drawer is None else JointMotion(drawer.axis, request.type, drawer.wanted, is_built=False)


Outcomes = tuple[list[Built], list[Refusal], Scene]


def in_order(joints: Iterable[JointRequest]) -> list[JointRequest]:
    """Returns one request per part (the first), doors before drawers; attached parts only if their parent is stated.

    Where the stated parent has no request, it is the part without others between that the moving part is attached to.
    """
    first: dict[str, JointRequest] = {}
    for request in joints:
        first.setdefault(request.moving, request)
    ridden = {part for request in first.values() for part in request.attached}
    kept = [request for request in first.values() if request.parent or request.moving not in ridden]
    return sorted((_on_requested(request, kept) for request in kept), key=lambda r: not r.kind.turns)


def _on_requested(request: JointRequest, requests: Sequence[JointRequest]) -> JointRequest:
    if request.parent in ("", *(other.moving for other in requests)):
        return request
    above = [other for other in requests if request.moving in other.attached]
    nearest = min(above, key=lambda other: len(other.attached), default=None)
    return replace(request, parent=nearest.moving if nearest else "")


def build_fairly(
    requests: Sequence[JointRequest], scene: Scene, gallery: Gallery, config: RealizationConfig, cache: Cache
) -> Outcomes:
    """Returns the outcomes of all requests, each joint keeping out of the expected motions of those built after it.

    Doors for which that left no place are expected to move as was asked for, and all is built again; the first try
    stands unless the second builds more.
    """
    find = partial(expected_motions, requests, scene, config, cache)
    joint_motions: Mapping[str, JointMotion] = within(config.time.expecting, find, lambda _: {})
    budget = present_budget().fraction(config.time.building)
    with budget.in_force():
        first = _build_all(requests, replace(scene, joint_motions=joint_motions), gallery, config, cache)
        left = {skip.part for skip in first[1] if skip.reason is not Reason.TOO_COMPLEX} & joint_motions.keys()
        asked = [request for request in requests if request.moving in left and request.kind.turns]
        if not asked or not first[0] or budget.left == 0:
            return first
        wider = {r.moving: replace(joint_motions[r.moving], axis=r.axis) for r in asked}
        second = _build_all(requests, replace(scene, joint_motions={**joint_motions, **wider}), gallery, config, cache)
    return second if len(second[1]) < len(first[1]) else first


def _build_all(
    requests: Sequence[JointRequest], scene: Scene, gallery: Gallery, config: RealizationConfig, cache: Cache
) -> Outcomes:
    """Returns the joints built, those that were not, and the scene with all hardware.

    What takes more than its fraction of the time is tried again at the end, in what the others left: small parts first,
    as they take least.
    """
    built, skipped, scene = _build_each(requests, scene, gallery, config, cache)
    late = {skip.part for skip in skipped if skip.reason is Reason.TOO_COMPLEX}
    again = [request for request in requests if request.moving in late]
    if not again or not has_time():
        return built, skipped, scene
    again.sort(key=lambda request: len(scene.moving_mesh(request.moving).faces))
    more, lost, scene = _build_each(again, scene, gallery, config, cache)
    return [*built, *more], [*(skip for skip in skipped if skip.part not in late), *lost], scene


def _build_each(
    requests: Sequence[JointRequest], scene: Scene, gallery: Gallery, config: RealizationConfig, cache: Cache
) -> Outcomes:
    """Returns the same of joints that are built in turn, each within its fraction of the time."""
    built: list[Built] = []
    skipped: list[Refusal] = []
    for k, request in enumerate(requests):
        outcome = _build(request, len(requests) - k, scene, gallery, config, cache)
        if isinstance(outcome, Refusal):
            skipped.append(outcome)
            scene = replace(
                scene,
                joint_motions={
                    name: joint_motion for name, joint_motion in scene.joint_motions.items() if name != request.moving
                },
            )
            continue
        scene = outcome.scene
        built.append(outcome)
    return built, skipped, scene


def _build(
    request: JointRequest, left: int, scene: Scene, gallery: Gallery, config: RealizationConfig, cache: Cache
) -> Built | Refusal:
    """Returns one joint of those `left` to build, or why it could not be built."""
    work = partial(_built, request, scene, gallery, config, cache)
    return within(config.time.of_joint(left), work, partial(Refusal, request.moving, Reason.TOO_COMPLEX))


def _built(
    request: JointRequest, scene: Scene, gallery: Gallery, config: RealizationConfig, cache: Cache
) -> Built | Refusal:
    """Returns one joint, or why it could not be built; where all that it reads is the same, it is not built again."""
    if not cache.keeps:  # a change of the old scene would be listed anew; this one goes on with what is known of it
        return build_joint(request, scene, gallery, config)

    def work(noted: Scene) -> tuple[Built | Refusal, SceneChange | None]:
        outcome = build_joint(request, noted, gallery, config)
        if isinstance(outcome, Refusal):
            return outcome, None
        return replace(outcome, scene=Scene({}, {}, scene.extent)), change_between(scene, outcome.scene)

    outcome, change = worked_out("joint", work, request.moving, scene, cache, request, gallery, config)
    return outcome if isinstance(outcome, Refusal) or change is None else replace(outcome, scene=change.of(scene))
