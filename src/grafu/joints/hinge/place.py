"""Places the hinges of one door: a search over pins, classes and templates, judged by sweeping real meshes.

The best by (free through the wanted opening, out of its neighbours' way, class preference C > F > P, nearness to the
initial axis) is taken, and its pin becomes the rectified axis. Hardware that another moving body would run into on its
way is left out as long as something else holds the door; the placement notes it.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cache, partial
from typing import final

from grafu.dataclass import dataclass
from grafu.joints.hinge.bracket import bracketed_ends
from grafu.joints.hinge.candidates import (
    PIVOTS,
    PinCandidate,
    fit_hinge,
    heights_to_try,
    hinge_heights,
    hinge_size,
    is_leaf,
    turns_about_itself,
)
from grafu.joints.hinge.concealed import place_concealed
from grafu.joints.hinge.hardware import (
    FLAWS,
    FLOOR,
    OF_PLACE,
    WEAK,
    HingeSite,
    InstalledHinge,
    install,
    judged_hinge,
    resting_leaf,
)
from grafu.joints.hinge.judged import JudgedPin
from grafu.joints.hinge.pivot import is_on_mount, pivot_ends, with_both_ends, with_flaw
from grafu.joints.hinge.search import DoorSearch
from grafu.joints.hinge.sites import placement_of, site_of
from grafu.joints.plan import AUTOMATIC, CUP, PIVOT
from grafu.joints.report import Placement
from grafu.templates.template import Gallery, HingeModel, HingeSize

_ENOUGH = 5  # once this many makeshift pins have been tried with hardware, more will not help
_Drawbacks = tuple[int, bool, bool, int]
_FEWEST = 2  # hinges of a door that has no room for all
_STRUCK = 3  # heights at which a neighbour runs into a hinge before the pin is given up: doors strike all along it


@final
@dataclass(frozen=True)
class _Try:
    """A placement as far as the first hinge that others would run into, and what returns all of it.

    The rest of its hinges is tried only where nothing better is found; None where one of them finds no place.
    """

    placement: Placement
    whole: Callable[[], Placement | None]


def place_hinges(search: DoorSearch, gallery: Gallery) -> Placement | None:
    """Returns the best placement that works, with fewer hinges where all find no room; None where no pin holds any.

    Concealed hinges are taken where they are chosen, first where they are preferred, and else where nothing else holds.
    """
    choice = search.request.choice
    if choice.template == CUP:
        return place_concealed(search, gallery)
    is_first = _may_be_concealed(search) and search.config.hinge.preferred == CUP
    found = (place_concealed(search, gallery) if is_first else None) or _visible(search, gallery)
    return found or (None if is_first else concealed_instead(search, gallery))


def concealed_instead(search: DoorSearch, gallery: Gallery) -> Placement | None:
    """Returns an upright door on concealed hinges; None where something else was chosen, or they find no room."""
    is_left = _may_be_concealed(search) and search.request.choice == AUTOMATIC
    return place_concealed(search, gallery) if is_left else None


def pivoted_within(search: DoorSearch) -> Placement | None:
    """Returns a door on pivots further inside it than usual, which nothing runs into; None where none find room."""
    pins = () if search.request.on_pivots else search.inner
    placements = (one.placement for judged in pins for one in _with_pivots(judged, search))
    return next((found for found in placements if not found.struck_by and not _is_narrow(found, search)), None)


def _may_be_concealed(search: DoorSearch) -> bool:
    choice = search.request.choice
    is_upright = abs(float(search.frame.rotation[2, 2])) > search.config.upright
    return is_upright and choice.takes(CUP) and choice.mechanism is None


def _visible(search: DoorSearch, gallery: Gallery) -> Placement | None:
    """Returns the best placement on hinges of a class, or pivots."""
    least = search.count if search.request.choice.count else min(search.count, _FEWEST)
    placements = (_placed(search, gallery, count) for count in range(search.count, least - 1, -1))
    return next((placement for placement in placements if placement is not None), None)


def _placed(search: DoorSearch, gallery: Gallery, count: int) -> Placement | None:
    """Returns the best placement with so many hinges.

    Where others would run into every placement, it is the first of those that spare the joints that stand already. A
    door that follows a leader takes the first that opens wide: where it stops, the leader must stop as well.
    """
    left_out: list[_Try] = []
    for one in _tries(search, gallery, count):
        found = one.placement
        if not found.struck_by and (not _is_narrow(found, search) or _may_be_narrow(search, left_out)):
            return _noted(found, [other.placement for other in left_out], search.request.moving)
        left_out.append(one)
    least, is_cut = _least_struck(left_out, search), any(_is_faulty(one) for one in left_out)
    return _least_struck([*_tries(search, gallery, count, True)], search) if least is None and is_cut else least


def _may_be_narrow(search: DoorSearch, left_out: Sequence[_Try]) -> bool:
    """Whether the door may open too little: it follows no leader, and nothing that was left out finds a place."""
    return search.request.coupling is None and all(other.whole() is None for other in left_out)


def _least_struck(tries: Sequence[_Try], search: DoorSearch) -> Placement | None:
    """Returns the first whole placement that the fewest joints that stand would run into, wide and sound at best.

    A whole placement has the drawbacks of its first hinge at least: what cannot be better is not placed as a whole.
    """
    in_order = sorted((_drawbacks(one.placement, search), rank, one) for rank, one in enumerate(tries))
    best: tuple[_Drawbacks, int, Placement] | None = None
    for least, rank, one in in_order:
        if best is not None and best[:2] <= (least, rank):
            break
        placement = one.whole()
        if placement is not None and (best is None or (_drawbacks(placement, search), rank) < best[:2]):
            best = _drawbacks(placement, search), rank, placement
    hits = (f"{name} runs into its hardware" for name in _built_ones(best[2].struck_by, search)) if best else ()
    return replace(best[2], notes=tuple(hits)) if best else None


def _is_faulty(one: _Try) -> bool:
    return bool(OF_PLACE & {*one.placement.struck_by})


def _is_narrow(placement: Placement, search: DoorSearch) -> bool:
    return placement.upper < search.config.restricted * search.wanted


def _drawbacks(placement: Placement, search: DoorSearch) -> _Drawbacks:
    """Returns how many joints that stand run into it, whether it opens too little or is loose, and how many flaws."""
    flaws, hits = FLAWS & {*placement.struck_by}, _built_ones(placement.struck_by, search)
    return len(hits), _is_narrow(placement, search), bool(WEAK & flaws), len(flaws)


def _built_ones(moving_bodies: Sequence[str], search: DoorSearch) -> list[str]:
    """Returns those moving bodies whose joints stand."""
    joint_motions = search.scene.joint_motions
    return [name for name in moving_bodies if name in joint_motions and joint_motions[name].is_built]


def _noted(placement: Placement, left_out: Sequence[Placement], moving: str) -> Placement:
    """Returns the placement, and what was left out because others, or its own ends, would run into it."""
    templates: dict[tuple[str, ...], list[str]] = {}
    for other in left_out:
        name = f"{other.template} at another pin" if other.template == placement.template else other.template
        if other.struck_by and name not in templates.setdefault(other.struck_by, []):
            templates[other.struck_by].append(name)
    reasons = []
    for struck_by, which in templates.items():
        others = ["its own door" if name == moving else name for name in struck_by if name not in FLAWS]
        why = [f"stand in the way of {', '.join(others)}"] if others else []
        why += ["reach below the floor"] if FLOOR in struck_by else []
        reasons += [f"{' or '.join(which)} would {' and '.join(why)}"] if why else []
    return replace(placement, left_out=tuple(reasons))


def _tries(search: DoorSearch, gallery: Gallery, count: int, is_thorough: bool = False) -> Iterator[_Try]:
    """Yields placements, best pins first; a pin whose place is at fault gets one template, unless it `is_thorough`."""
    tried = 0
    for judged in search.in_order():
        if judged.free < search.config.least_opening * search.wanted or tried > _ENOUGH:
            return
        tried += judged.pin.preference >= PIVOTS
        pivots = judged.pin.is_pivot
        for one in _with_pivots(judged, search) if pivots else _with_hardware(judged, search, gallery, count):
            yield one
            if _is_faulty(one) and not is_thorough:
                break


def _with_hardware(judged: JudgedPin, search: DoorSearch, gallery: Gallery, count: int) -> Iterator[_Try]:
    """Yields the placements of the templates of the pin's class whose hinges all fit."""
    choice = search.request.choice
    for model in gallery.hinges_of(judged.pin.mechanism):
        size = hinge_size(model, search.frame, judged.pin, count, search.config.hinge, choice.scale)
        if size is None or not choice.takes(model.id):
            continue
        upper = search.widest(judged.axis, min(model.build(size).range, search.most))
        if upper < search.config.least_opening * search.wanted:
            return
        attempt = partial(_attempted, model, judged, site_of(judged, upper, search), count, search)
        placement = attempt(is_whole=False)
        if placement is not None:
            yield _Try(placement, cache(partial(attempt, is_whole=True)))


def _with_pivots(judged: JudgedPin, search: DoorSearch) -> Iterator[_Try]:
    """Yields the placement on discs at the door's ends; none where neither end meets the static body."""
    upper = search.widest(judged.axis, search.most)
    if upper < search.config.least_opening * search.wanted:
        return
    site = site_of(judged, upper, search)
    door = search.scene.parts[search.request.moving].mesh
    at, is_leaf = (search.frame, judged.pin, door, search.carriers), search.request.on_pivots
    ends = bracketed_ends(*at, search.scene.floor, search.config) if is_leaf else pivot_ends(*at, search.config)
    judgements = [judged_hinge(InstalledHinge(static, dynamic), site) for static, dynamic in ends]
    is_spindle = turns_about_itself(search.frame, search.request.axis, search.config.hinge)
    held = [
        hinge if is_spindle else with_flaw(hinge, judged.pin, site)
        for hinge in judgements
        if hinge is not None and is_on_mount(hinge, site)
    ]
    if held:
        free = [hinge for hinge in held if not {*hinge.struck_by} - FLAWS] or held
        placement = placement_of(judged, PIVOT, upper, free if is_spindle else with_both_ends(free), search)
        yield _Try(placement, lambda: placement)


def _attempted(
    model: HingeModel, judged: JudgedPin, site: HingeSite, count: int, search: DoorSearch, is_whole: bool
) -> Placement | None:
    """Returns a placement of one model at one pin; unless `is_whole`, it ends with the first hinge that is struck."""
    hinges: list[InstalledHinge] = []
    for hinge in _installed(model, judged.pin, site, count, search):
        if hinge is None:
            return None
        hinges.append(hinge)
        if hinge.struck_by and not is_whole:
            break
    return placement_of(judged, model.id, site.upper, hinges, search) if hinges else None


def _installed(
    model: HingeModel, pin: PinCandidate, site: HingeSite, count: int, search: DoorSearch
) -> Iterator[InstalledHinge | None]:
    """Yields one hinge per height, each shifted along the pin where its place is taken; None where it finds none."""
    size = hinge_size(model, search.frame, pin, count, search.config.hinge, search.request.choice.scale)
    if size is None:
        return
    size = _on_material(model, size, pin, site, count, search)
    taken: list[float] = []
    for levels in heights_to_try(search.frame, count):
        free = (level for level in levels if all(abs(level - other) > size.length for other in taken))
        tries = ((level, _installed_once(model, size, pin, level, site, search)) for level in free)
        found = _first_unstruck((level, hinge) for level, hinge in tries if hinge is not None)
        if found is None:
            yield None
            return
        taken.append(found[0])
        site = replace(site, beside=(*site.beside, *found[1].dynamic_meshes))
        yield found[1]


def _installed_once(
    model: HingeModel, size: HingeSize, pin: PinCandidate, level: float, site: HingeSite, search: DoorSearch
) -> InstalledHinge | None:
    """Returns one hinge at a height of a pin; what is tried again, with more hinges or thoroughly, is known."""
    key = (model.id, size, pin, level, site.upper, site.beside)
    if key not in search.installed:
        search.installed[key] = install(fit_hinge(model, size, search.frame, pin, level), pin, site)
    return search.installed[key]


def _on_material(
    model: HingeModel, size: HingeSize, pin: PinCandidate, site: HingeSite, count: int, search: DoorSearch
) -> HingeSize:
    """Returns the size with leaves no wider than what they rest on; as it is where that is too narrow for any."""
    heights = hinge_heights(search.frame.length, count)
    widest = [resting_leaf(fit_hinge(model, size, search.frame, pin, float(z)), pin, site) for z in heights]
    leaf = min((width for width in widest if is_leaf(width, size.radius, search.config.hinge)), default=size.leaf)
    return replace(size, leaf=leaf)


def _first_unstruck(hinges: Iterator[tuple[float, InstalledHinge]]) -> tuple[float, InstalledHinge] | None:
    """Returns the first of a few hinges, each with its height, that no neighbour runs into; else the first of all."""
    few: list[tuple[float, InstalledHinge]] = []
    for level, hinge in hinges:
        few.append((level, hinge))
        if not hinge.struck_by:
            return level, hinge
        if len(few) == _STRUCK or FLOOR in hinge.struck_by:
            break
    return few[0] if few else None
