"""What shape and names alone show of how parts move, whatever was predicted."""

from collections.abc import Collection
from dataclasses import replace
from typing import final

from grafu.additions.config import AdditionConfig
from grafu.additions.interior.request import NOTHING, PREDICTED
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.config_checks import at_scale
from grafu.graph.edit import without_nodes
from grafu.graph.functional_graph import FunctionalGraph
from grafu.joints.box_flaps import with_box_flaps, with_flap_labels
from grafu.joints.boxes_behind import with_boxes_behind
from grafu.joints.building_doors import building_door, with_building_doors, with_door_labels
from grafu.joints.config import RealizationConfig, SmallPartConfig
from grafu.joints.drawn_hinges import with_drawn_hinges
from grafu.joints.drop_supports import with_supported_leaves
from grafu.joints.extension_leaves import with_shown_extensions
from grafu.joints.folding import with_folds
from grafu.joints.hung_parts import with_hung_parts
from grafu.joints.layered_fronts import with_layered_fronts
from grafu.joints.lifts import with_lifts
from grafu.joints.lone_leaves import with_lone_labels, with_lone_leaf
from grafu.joints.named_cases import with_case_label
from grafu.joints.on_lids import with_parts_on_lids
from grafu.joints.parallel_lifts import with_named_lifts
from grafu.joints.plan import JointRequest, PlanConfig, RealizationPlan
from grafu.joints.portholes import with_porthole_labels
from grafu.joints.pull_outs import with_pull_outs
from grafu.joints.racks import with_racks
from grafu.joints.raised_leaves import with_raised_leaves
from grafu.joints.ring_seats import with_seat_labels, with_seat_pair
from grafu.joints.screens import with_screen, with_screen_labels
from grafu.joints.shown_folds import shown_folds
from grafu.joints.sliding_doors import with_sliding_doors
from grafu.joints.sliding_panes import with_pane_labels
from grafu.joints.swivel_mirrors import swivel_mirrors
from grafu.joints.swivels import swivels
from grafu.joints.tilting_fronts import with_shown_tilts
from grafu.joints.trays import with_trays
from grafu.joints.waste_bins import with_waste_bins
from grafu.joints.wide_bars import with_wide_bars
from grafu.joints.windows import window, with_window_labels, with_windows
from grafu.scene.scale import metre_on
from grafu.vocabulary import PartLabel

_RACKS = (PartLabel.SHELF, PartLabel.MISC)


@final
@dataclass(frozen=True, slots=True)
class WantedSmallParts:
    """Whether joints of small parts are built, and of which: of `chosen` parts and links of their own; None: of all."""

    any: bool
    chosen: frozenset[str] | None = None


def with_labels_by_shape(asset: Asset) -> Asset:
    """Returns the asset in which the leaves of a building's door or window, a round door, flaps and seats are doors.

    So are panes that slide past one another.
    What holds drawers that all parts are called has none.
    """
    doors = with_door_labels(with_lone_labels(with_pane_labels(with_screen_labels(with_case_label(asset)))))
    return with_seat_labels(with_flap_labels(with_porthole_labels(with_window_labels(doors))))


def shown_by_shape(
    plan: RealizationPlan,
    asset: Asset,
    graph: FunctionalGraph,
    joints: RealizationConfig,
    settled: Collection[str] = (),
    small: bool | None = None,
) -> tuple[RealizationPlan, frozenset[str]]:
    """Returns a predicted plan with what shapes and names alone show of how parts move, and the trays that turn.

    `settled` are the parts whose motions the user states; `small` is as in the settings.
    """
    plan = with_layered_fronts(_without_small(plan, asset, graph, settled, joints.plan), asset, settled)
    plan = with_lone_leaf(with_windows(with_building_doors(plan, asset), asset), asset, settled)
    plan = with_sliding_doors(with_drawn_hinges(plan, asset, joints), asset)
    plan = with_pull_outs(with_folds(plan, shown_folds(plan, asset, joints, settled), joints.fold), asset, graph)
    plan = with_wide_bars(with_boxes_behind(plan, asset, settled), asset, settled)
    plan = with_box_flaps(with_seat_pair(plan, asset, settled), asset, settled)
    plan = with_parts_on_lids(with_hung_parts(with_screen(plan, asset, settled), asset, settled), asset, settled)
    plan = with_named_lifts(with_shown_tilts(plan, asset, graph), asset)
    plan = with_raised_leaves(with_supported_leaves(with_shown_extensions(plan, asset), asset), asset)
    plan = with_racks(plan, asset, graph)
    plan = with_trays(with_waste_bins(plan, asset, graph), asset, graph)
    plan = with_lifts(plan, _of_input(graph, asset), at_scale(joints.lift, metre_on(asset.extent)))
    plan = _without_knobs(plan, asset, settled, at_scale(joints.small, metre_on(asset.extent)))
    return _without_turntables(plan, asset, small)


def _of_input(graph: FunctionalGraph, asset: Asset) -> FunctionalGraph:
    """Returns the graph without the parts that were only predicted to be missing."""
    known = {part.id for part in asset.parts}
    added = [node.id for node in graph.nodes if node.id not in known]
    return without_nodes(graph, added) if added else graph


def _without_small(
    plan: RealizationPlan, asset: Asset, graph: FunctionalGraph, settled: Collection[str], config: PlanConfig
) -> RealizationPlan:
    """Returns the plan in which, of parts that are neither doors nor drawers, racks and the like alone move.

    Knobs, buttons and turntables are built as small parts, where these are wanted; leaves and supports of tables, as
    their shapes show.
    """
    least = config.rack * asset.extent

    def is_kept(request: JointRequest) -> bool:
        node = graph.node(request.moving)
        is_rack = request.kind.slides and node.label in _RACKS and float(node.box.size.max()) >= least
        is_front = node.label.is_movable or node.label is PartLabel.UNKNOWN
        return is_front or request.moving in settled or is_rack

    return replace(plan, joints=tuple(request for request in plan.joints if is_kept(request)))


def _without_knobs(
    plan: RealizationPlan, asset: Asset, settled: Collection[str], config: SmallPartConfig
) -> RealizationPlan:
    """Returns the plan without nameless parts of the size and shape of a knob: no door or drawer has these."""
    nameless = (r.moving for r in plan.joints if r.moving not in settled)
    guessed = [part for name in nameless if (part := asset.part(name)).label is PartLabel.UNKNOWN]
    if not guessed:
        return plan
    from grafu.joints.small_knobs import are_shaped_as_knobs  # local: most runs do without

    shaped = are_shaped_as_knobs(guessed, asset.box, config)
    return replace(plan, joints=tuple(r for r in plan.joints if r.moving not in shaped))


def _without_turntables(
    plan: RealizationPlan, asset: Asset, small: bool | None
) -> tuple[RealizationPlan, frozenset[str]]:
    """Returns the plan without trays that are round, and these: they turn, and are built as small parts.

    `small` is as in the settings; with False they slide as they were predicted.
    """
    sliding = {r.moving for r in plan.joints if r.kind.slides and asset.part(r.moving).label is PartLabel.DRAWER}
    if small is False or not sliding:
        return plan, frozenset()
    from grafu.joints.small_parts import round_trays  # local: most runs do without

    turning = round_trays(asset, sliding)
    return replace(plan, joints=tuple(r for r in plan.joints if r.moving not in turning)), turning


def _carousels(asset: Asset) -> frozenset[str]:
    from grafu.joints.small_parts import carousels  # local: most runs do without the rest of it

    return carousels(asset)


def additions_wanted(asset: Asset, wanted: AdditionConfig) -> AdditionConfig:
    """Returns what is added to an asset: predicted shelves not in doors and windows, nor through a carousel's trays."""
    if wanted.interior != PREDICTED:
        return wanted
    if building_door(asset) is None and window(asset) is None and not _carousels(asset):
        return wanted
    return replace(wanted, interior=NOTHING)


def small_parts_wanted(
    asset: Asset, reads_annotation: bool, wanted: bool | None, turning: frozenset[str]
) -> WantedSmallParts:
    """Returns which joints of small parts are built; by default (`wanted` None) where they are stated and read.

    Else by default those of the `turning` trays, of parts that are links, and of what is on a building's door.
    """
    if wanted is not None:
        return WantedSmallParts(wanted)
    if asset.small_joints:
        return WantedSmallParts(reads_annotation)
    door = building_door(asset)
    chosen = turning | swivel_mirrors(asset) | swivels(asset) | _carousels(asset)
    chosen |= {part.id for parts in door.on_leaf for part in parts} if door else set()
    return WantedSmallParts(bool(chosen) or any(part.source.link for part in asset.parts), chosen)
