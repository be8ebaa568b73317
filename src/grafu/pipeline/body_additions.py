"""What is added before joints are built, because they must respect it: a top, carcass boards, the boxes of drawers."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import final

from grafu.additions.addition import Addition
from grafu.additions.carcass.complete import CarcassCompletion, complete_carcass
from grafu.additions.carcass.missing_panels import missing_panels
from grafu.additions.drawer_box.complete import DrawerBoxes, complete_drawers, with_attached
from grafu.additions.top.complete import TopVerdict, missing_tops
from grafu.additions.top.config import DEFAULT_TOP
from grafu.additions.top.replace import ReplacedTop, no_top, replace_top
from grafu.additions.top.unwanted import why_no_top
from grafu.asset.part import Asset
from grafu.geometry.box import Box
from grafu.graph.completion import GraphCompletion
from grafu.joints.plan import RealizationPlan
from grafu.pipeline.addition_config import AdditionConfig
from grafu.refusal import Refusal
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True)
class Body:
    """The asset and the plan with what was added, and what was found on the way, wanted or not.

    `removed` names the parts of the input that were replaced.
    """

    asset: Asset
    plan: RealizationPlan
    top: TopVerdict
    carcass: CarcassCompletion
    drawers: DrawerBoxes
    additions: tuple[Addition, ...]
    skipped: tuple[Refusal, ...]
    removed: frozenset[str] = frozenset()


def complete_body(asset: Asset, completion: GraphCompletion, plan: RealizationPlan, config: AdditionConfig) -> Body:
    """Returns the asset with the top, boards and drawer boxes that it lacks and may have."""
    chosen = _top(asset, completion, plan, config)
    top = chosen.verdict
    above = _kept(top.additions, config)
    removed = chosen.removed if above else frozenset()
    grown = _with(replace(asset, parts=tuple(p for p in asset.parts if p.id not in removed)), above)
    boxes = config.drawer_boxes
    drawers = complete_drawers(grown.parts, plan, *(() if boxes is None else (boxes,)), build=boxes is not None)
    drawers = replace(drawers, additions=_kept(drawers.additions, config))
    grown, plan = _with(grown, drawers.additions), with_attached(plan, drawers)
    if config.carcass is None:
        carcass = CarcassCompletion(missing_panels(grown.parts, plan))
    else:
        carcass = complete_carcass(grown.parts, plan, config.carcass)
    carcass = replace(carcass, additions=_kept(carcass.additions, config))
    skipped = [*carcass.refused, *drawers.refused, *([chosen.refused] if chosen.refused else [])]
    additions = (*above, *drawers.additions, *carcass.additions)
    return Body(_with(grown, carcass.additions), plan, top, carcass, drawers, additions, tuple(skipped), removed)


def _top(asset: Asset, completion: GraphCompletion, plan: RealizationPlan, config: AdditionConfig) -> ReplacedTop:
    """Returns whether there is a top, and the one to add or to put in its place."""
    if config.top is not None and config.replaces_top:
        nodes = completion.completed.nodes
        called = [node.id for node in nodes if node.label is PartLabel.TOP_PANEL]
        return replace_top(asset.parts, plan.joints, called, config.top, _predicted_top(completion))
    predicted = _predicted_top(completion)
    top = missing_tops(asset.parts, plan.joints, config.top or DEFAULT_TOP, predicted)
    unwanted = _unwanted_top(asset, plan, predicted) if top.additions else ""
    if unwanted:
        return ReplacedTop(replace(top, covered=True, why=unwanted, addition=None, others=()))
    if config.top is None:
        return ReplacedTop(replace(top, addition=None, others=()))
    return ReplacedTop(top, frozenset(), no_top(top.why) if top.missing and top.addition is None else None)


def _unwanted_top(asset: Asset, plan: RealizationPlan, predicted: Box | None) -> str:
    """Returns why furniture that is open above stays so, empty where it lacks its top."""
    named = why_no_top((asset.name, *(part.source.name for part in asset.parts)))
    if named or plan.joints or plan.refused or predicted is not None:
        return named
    return "nothing in it moves and no top was predicted: a crate or an open shelf stays open"


def _kept(additions: Sequence[Addition], config: AdditionConfig) -> tuple[Addition, ...]:
    return tuple(addition for addition in additions if addition.part.id not in config.rejected)


def _predicted_top(completion: GraphCompletion) -> Box | None:
    nodes = (completion.completed.node(name) for name in completion.added)
    return next((node.box for node in nodes if node.label is PartLabel.TOP_PANEL), None)


def _with(asset: Asset, additions: Sequence[Addition]) -> Asset:
    return replace(asset, parts=(*asset.parts, *(addition.part for addition in additions)))
