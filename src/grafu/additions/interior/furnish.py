"""`furnish`: shelves and dividers for compartments, each cut to its walls and proved free of everything that moves.

A panel that finds no place is refused with the reason; what stands is never changed. It finds no compartments.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from math import radians, tan
from typing import final

from grafu.additions.interior.arrangement import (
    Arrangement,
    by_size,
    placed_hints,
    rowed,
    shared_out,
    stacked,
)
from grafu.additions.interior.carousel import carousels_in
from grafu.additions.interior.compartments import Compartment
from grafu.additions.interior.config import InteriorConfig, Sizes
from grafu.additions.interior.making import Panel, PanelMaker, named_in
from grafu.additions.interior.occupied import is_drawer
from grafu.additions.interior.outline import FreeSpace
from grafu.additions.interior.panels import WallRays, clearing_of
from grafu.additions.interior.request import NO_CHOICES, CompartmentChoice, InteriorKind, InteriorRequest
from grafu.additions.likeness import surface_like
from grafu.additions.step import Addition, PanelHint, added_part, free_ids
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.raycast import RayCaster
from grafu.refusal import Asked, Reason, Refusal
from grafu.scene.scene import Scene
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True)
class Furnished:
    """The panels that were added, and what was not, and why."""

    additions: tuple[Addition, ...] = ()
    refused: tuple[Refusal, ...] = ()


def furnish(
    compartments: Sequence[Compartment],
    request: InteriorRequest,
    scene: Scene,
    config: InteriorConfig = InteriorConfig(),
    hints: Sequence[PanelHint] = (),
    chosen: Mapping[int, CompartmentChoice] = NO_CHOICES,
) -> Furnished:
    """Returns shelves and dividers for the compartments of a scene whose joints are built.

    `hints` are what the completed graph expects; only `predicted` requests use them. `chosen` holds by number (from 0)
    the compartments that get something of their own instead.
    """
    if request.kind is InteriorKind.NONE and not chosen:
        return Furnished()
    if not compartments:
        if request.kind is InteriorKind.PREDICTED and not chosen:  # nothing is missing where there is no room for it
            return Furnished()
        return Furnished((), (refused_panel(None, None, Reason.NO_COMPARTMENT, why_inapplicable(scene, config)),))
    sizes = config.sizes(scene.extent)
    wanted, refused = _arranged(compartments, request, sizes, config, hints)
    wanted = [_own(chosen.get(number), arrangement) for number, arrangement in enumerate(wanted)]
    beyond = [k for k in chosen if k >= len(compartments)]
    why = f"there is no such compartment, only {len(compartments)}"
    refused += [refused_panel(k, None, Reason.NO_COMPARTMENT, why) for k in beyond]
    chosen = {k: choice for k, choice in chosen.items() if k not in beyond}
    carousels: list[Addition] = []
    if request.trays:
        carousels, unfit = carousels_in(compartments, request.trays, scene, config, chosen)
        refused += unfit
    if all(arrangement == Arrangement() for arrangement in wanted):
        return Furnished(tuple(carousels), tuple(refused))
    clearing, walls = clearing_of(scene, config), _walls(compartments, scene, config.askew_cells * sizes.cell)
    space = FreeSpace(scene, compartments, sizes, config)
    panels: list[Panel] = []
    for number, arrangement in enumerate(wanted):
        own = _own_sizes(chosen.get(number), sizes)
        maker = PanelMaker(number, compartments[number], walls, clearing, space, own, config)
        for outcome in maker.panels(arrangement):
            if isinstance(outcome, Panel):
                panels.append(outcome)
            else:
                refused.append(outcome)
    refused += _fewer_than_chosen(panels, chosen, {one.part for one in refused})
    return Furnished((*carousels, *_additions(panels, compartments, request, scene)), tuple(refused))


def _fewer_than_chosen(
    panels: Sequence[Panel],
    chosen: Mapping[int, CompartmentChoice],
    told: Collection[str],
) -> list[Refusal]:
    """Returns the compartments that took fewer panels than were chosen for them, unless that was reported."""
    found = []
    for number, choice in chosen.items():
        made = {label: sum(p.compartment == number and p.label is label for p in panels) for label in PartLabel}
        cells = made[PartLabel.DIVIDER] + 1
        wanted = {PartLabel.DIVIDER: choice.dividers, PartLabel.SHELF: choice.shelves * cells}
        found += [
            refused_panel(number, label, Reason.FEWER, f"there is room for {made[label]} only")
            for label, count in wanted.items()
            if made[label] < count and named_in(number, label) not in told
        ]
    return found


def _own(choice: CompartmentChoice | None, arrangement: Arrangement) -> Arrangement:
    return arrangement if choice is None else Arrangement(choice.shelves, choice.dividers)


def _own_sizes(choice: CompartmentChoice | None, sizes: Sizes) -> Sizes:
    if choice is None:
        return sizes
    thickness = sizes.thickness if choice.thickness is None else choice.thickness
    return replace(sizes, thickness=thickness, inset=sizes.inset if choice.inset is None else choice.inset)


def _walls(compartments: Sequence[Compartment], scene: Scene, margin: float) -> WallRays:
    """Returns the still meshes in some compartments and up to `margin` metres around them."""
    whole = Box.enclosing(compartment.box for compartment in compartments)
    return WallRays((RayCaster(scene.static_mesh_near(whole, margin)),))


def refused_panel(compartment: int | None, label: PartLabel | None, reason: Reason, why: str) -> Refusal:
    """Returns the refusal of panels of a kind (None: of any) in a compartment (None: in all)."""
    return Refusal(named_in(compartment, label), reason, why, Asked.INTERIOR)


def why_inapplicable(scene: Scene, config: InteriorConfig) -> str:
    """Returns why a scene without compartments has none, in words."""
    if any(is_drawer(scene, moving, config.rooms.thin) for moving in scene.moving_bodies.values()):
        return "no compartment: drawers take all the room between walls"
    return "no compartment: no room large enough lies between walls"


def _arranged(
    compartments: Sequence[Compartment],
    request: InteriorRequest,
    sizes: Sizes,
    config: InteriorConfig,
    hints: Sequence[PanelHint],
) -> tuple[list[Arrangement], list[Refusal]]:
    """Returns what each compartment is to get, and what none can."""
    if request.kind is InteriorKind.NONE:
        return [Arrangement()] * len(compartments), []
    if request.kind is InteriorKind.AUTO:
        return [by_size(compartment, sizes, config) for compartment in compartments], []
    if request.kind is InteriorKind.PREDICTED:
        return placed_hints(compartments, hints, sizes, config)
    return _counted(compartments, request, sizes, config)


def _counted(
    compartments: Sequence[Compartment], request: InteriorRequest, sizes: Sizes, config: InteriorConfig
) -> tuple[list[Arrangement], list[Refusal]]:
    refused: list[Refusal] = []
    angle = radians(request.angle_deg)
    shelves, dividers = [0] * len(compartments), [0] * len(compartments)
    for label, groups, counts, wanted in (
        (PartLabel.SHELF, stacked(compartments, sizes, config), shelves, request.shelves),
        (PartLabel.DIVIDER, rowed(compartments, sizes, config), dividers, request.dividers),
    ):
        for group in groups:
            able = [k for k in group if label is PartLabel.DIVIDER or not compartments[k].is_chest]
            if not able and wanted:
                why = "a chest that opens upwards takes no shelves"
                refused.append(refused_panel(group[0], label, Reason.UNSUITABLE, why))
                continue
            axes = [2 if label is PartLabel.SHELF else compartments[k].side_axis for k in able]
            lengths = [float(compartments[k].box.size[a]) for k, a in zip(able, axes, strict=True)]
            if label is PartLabel.SHELF:
                drops = (tan(angle) * float(compartments[k].box.size[compartments[k].depth_axis]) for k in able)
                lengths = [length - drop for length, drop in zip(lengths, drops, strict=True)]
            given = shared_out(lengths, len(able) - 1, wanted, sizes.thickness, sizes.least_pitch)
            for k, count in zip(able, given, strict=True):
                counts[k] = count
            if able and sum(given) < wanted - (len(able) - 1):
                why = f"there is room for {sum(given) + len(able) - 1} only, with {sizes.least_pitch:.2f} m between"
                refused.append(refused_panel(able[0], label, Reason.FEWER, why))
    return [Arrangement(s, d, angle=angle) for s, d in zip(shelves, dividers, strict=True)], refused


def _additions(
    panels: list[Panel], compartments: Sequence[Compartment], request: InteriorRequest, scene: Scene
) -> tuple[Addition, ...]:
    """Returns the panels as parts with ids of their own that look like the walls around them."""
    found: list[Addition] = []
    for label in (PartLabel.SHELF, PartLabel.DIVIDER):
        own = [panel for panel in panels if panel.label is label]
        for name, panel in zip(free_ids(label.value, len(own), scene.parts), own, strict=True):
            compartment = compartments[panel.compartment]
            walls = [scene.parts[wall] for wall in dict.fromkeys(w for face in compartment.walls for w in face)]
            part = added_part(name, label, [surface_like(panel.mesh, walls)])
            found.append(Addition(part, _why(compartment, request), f"panel {panel.label.value}"))
    return tuple(found)


def _why(compartment: Compartment, request: InteriorRequest) -> str:
    width, depth, height = compartment.box.size
    where = f"behind {', '.join(compartment.behind)}" if compartment.behind else "open in front"
    return f"interior {request}: a compartment of {width:.2f} x {depth:.2f} x {height:.2f} m, {where}"
