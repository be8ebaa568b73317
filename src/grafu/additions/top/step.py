"""The step of tops: none where none belongs, one where it is missing, one in the place of another where it is chosen.

Furniture without tops is known by its names (beds, crates, sinks, appliances); on a sink unit or an appliance one is
put where it is predicted. A top is replaced by hand alone, since what is there is no fault; only parts that are called
top panels and are static are taken away.
"""

from collections.abc import Collection, Iterable, Sequence
from dataclasses import replace
from typing import Final, final

from grafu.additions.step import Changes, Deficiency, DeficiencyKind, StepRequest, StepResult, free_ids
from grafu.additions.top.complete import TopVerdict, missing_tops
from grafu.additions.top.config import TopConfig
from grafu.asset.languages import word_set
from grafu.asset.names import singular, spoken
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.joints.plan import JointRequest, MotionRole
from grafu.refusal import OF_GUESSES, Asked, Reason, Refusal
from grafu.scene.scene import Scene
from grafu.vocabulary import PartLabel

OPEN_ABOVE: Final = word_set("bed mattress cradle crib cot sofa couch armchair crate basket bathtub bin stair")
"""What never has a top."""
TOPLESS: Final = OPEN_ABOVE | word_set(
    "sink basin washbasin washstand stove cooker hob cooktop oven microwave fridge refrigerator freezer "
    "dishwasher washer"
)
"""What has none of its own, unless one is predicted."""


@final
@dataclass(frozen=True)
class TopChoice:
    """Which top is added (None: none), and whether it takes the place of one that is there."""

    config: TopConfig | None = TopConfig()
    replaces: bool = False


@final
@dataclass(frozen=True)
class ReplacedTop:
    """The verdict on the furniture as it came with the new top, the ids of what it replaces, and why it does not.

    `refused` is None where a top was put; one that merely was missing replaces nothing.
    """

    verdict: TopVerdict
    removed: frozenset[str] = frozenset()
    refused: Refusal | None = None


def add_tops(scene: Scene, request: StepRequest, choice: TopChoice) -> StepResult:
    """Returns the scene with the tops that it lacks and may have."""
    made = _chosen(scene, request, choice)
    top = made.verdict
    lacking = ([top.why] if top.missing else []) + [further.why for further in top.others]
    return StepResult(
        scene.without_parts(made.removed).with_parts(addition.part for addition in top.additions),
        top.additions,
        Changes(made.removed),
        () if made.refused is None else (made.refused,),
        tuple(Deficiency(DeficiencyKind.TOP, "", why) for why in lacking),
    )


def _chosen(scene: Scene, request: StepRequest, choice: TopChoice) -> ReplacedTop:
    """Returns whether there is a top, and the one to add or to put in its place."""
    parts = tuple(scene.parts.values())
    joints = tuple(joint for joint in request.plan.joints if joint.role is not MotionRole.EXTENSION)  # leaves are a top
    if choice.config is not None and choice.replaces:
        return replace_top(parts, joints, request.tops, choice.config, request.top)
    if unwanted := _unwanted(request):
        return ReplacedTop(TopVerdict(True, 1.0, unwanted))
    top = missing_tops(parts, joints, choice.config or TopConfig(), request.top)
    if choice.config is None or (request.only_expected and request.top is None):
        return ReplacedTop(replace(top, addition=None, others=()))
    if request.only_expected:
        top = replace(top, others=())
    return ReplacedTop(top, frozenset(), no_top(top.why) if top.missing and top.addition is None else None)


def _unwanted(request: StepRequest) -> str:
    """Returns why furniture that is open above stays so, empty where it lacks its top."""
    if request.top is not None:  # stronger than a name: washstands, bases of stoves and cases of fridges have tops
        return why_no_top(request.names, OPEN_ABOVE)
    named = why_no_top(request.names)
    moves = request.plan.joints or any(refused.reason not in OF_GUESSES for refused in request.plan.refused)
    if named or moves:
        return named
    return "nothing in it moves and no top was predicted: a crate or an open shelf stays open"


def why_no_top(names: Iterable[str], words: Collection[str] = TOPLESS) -> str:
    """Returns why no top is put on what these are the names of (the piece and its parts), empty where one may be.

    `words` are those that exclude one.
    """
    for name in names:
        said = [singular(word) for word in spoken(name)]
        beside = {i for i, word in enumerate(said[1:]) if word in ("side", "room")}  # a bedside table, a bedroom
        found = [word for i, word in enumerate(said) if word in words and i not in beside]
        if found:
            return f"by its name `{name}` it has a {found[0]}, on which no top belongs"
    return ""


def no_top(why: str, reason: Reason = Reason.NO_SUPPORT) -> Refusal:
    """Returns the refusal of a top; by default, because nothing carries a slab."""
    return Refusal(PartLabel.TOP_PANEL.value, reason, why, Asked.TOP)


def replace_top(
    parts: Sequence[Part],
    moving_bodies: Iterable[JointRequest],
    tops: Collection[str],
    config: TopConfig = TopConfig(),
    hint: Box | None = None,
) -> ReplacedTop:
    """Returns the top that takes the place of the parts `tops`; where a top is missing anyway, that one.

    `moving_bodies` are the joints asked for: what moves is no top. `hint` is the box of a top that a network predicts.
    """
    moving_bodies = tuple(moving_bodies)
    found = missing_tops(parts, moving_bodies, config, hint)
    if found.missing:
        return ReplacedTop(found, frozenset(), None if found.addition is not None else no_top(found.why))
    moving = {part for request in moving_bodies for part in (request.moving, *request.attached)}
    old = frozenset(part.id for part in parts if part.id in tops and part.id not in moving)
    if not old:
        why = "no still part of it is called a top panel: correct the category of what is to be replaced"
        return ReplacedTop(found, frozenset(), no_top(f"it has a top, and {why}", Reason.NOTHING_REPLACED))
    made = missing_tops([part for part in parts if part.id not in old], moving_bodies, config)
    if made.addition is None:
        why = "what is left still is covered" if made.covered else made.why
        reason = Reason.NOT_MISSING if made.covered else Reason.NO_SUPPORT
        return ReplacedTop(found, frozenset(), no_top(f"without {', '.join(sorted(old))}, {why}", reason))
    names = free_ids(PartLabel.TOP_PANEL.value.replace(" ", "_"), len(made.additions), {part.id for part in parts})
    first, *others = (
        replace(addition, part=replace(addition.part, id=name), why="it was chosen")
        for name, addition in zip(names, made.additions, strict=True)
    )
    return ReplacedTop(replace(found, addition=first, others=tuple(others)), old)
