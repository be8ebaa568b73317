"""A top in the place of the one that furniture has: asked for by hand, since what is there is no fault.

Only parts that are called top panels and stand still are taken away. It changes no part and builds no joint.
"""

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import final

from grafu.additions.addition import free_ids
from grafu.additions.top.complete import TopVerdict, missing_tops
from grafu.additions.top.config import DEFAULT_TOP, TopConfig
from grafu.asset.part import Part
from grafu.geometry.box import Box
from grafu.joints.plan import JointRequest
from grafu.refusal import Asked, Reason, Refusal
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True)
class ReplacedTop:
    """The verdict on the furniture as it came with the new top, the ids of what it replaces, and why it does not.

    `refused` is None where a top was put; one that merely was missing replaces nothing.
    """

    verdict: TopVerdict
    removed: frozenset[str] = frozenset()
    refused: Refusal | None = None


def no_top(why: str, reason: Reason = Reason.NO_SUPPORT) -> Refusal:
    """Returns the refusal of a top; by default, because nothing carries a slab."""
    return Refusal(PartLabel.TOP_PANEL.value, reason, why, Asked.TOP)


def replace_top(
    parts: Sequence[Part],
    moving_bodies: Iterable[JointRequest],
    tops: Collection[str],
    config: TopConfig = DEFAULT_TOP,
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
