"""Places the hinges of one door: a search over pins, classes and templates, judged by sweeping real meshes.

The best by (free through the wanted opening, out of its neighbours' way, class preference C > F > P, nearness to the
initial axis) is taken, and its pin becomes the rectified axis.
"""

from dataclasses import replace

from grafu.articulation.articulated_object import Visual
from grafu.realization.hinge.candidates import PinCandidate
from grafu.realization.hinge.fit import fit_hinge, hinge_count, hinge_heights, hinge_size
from grafu.realization.hinge.hardware import InstalledHinge, Site, install, is_out_of_the_way
from grafu.realization.hinge.pivot import pivot_ends
from grafu.realization.hinge.search import DoorSearch, JudgedPin
from grafu.realization.limits import in_the_way, motion_about
from grafu.realization.placement import Placement, nearest_part
from grafu.templates.template import Gallery, HingeModel
from grafu.vocabulary import JointType

_HEIGHT_SHIFTS = (0.0, 0.04, -0.04, 0.08, -0.08, 0.12, -0.12, 0.2, -0.2, 0.28, -0.28, 0.31, -0.31)
_LEAST_SHARE = 0.3  # an opening below this share of the wanted one is no motion
PIVOT = "pivot"
_ENOUGH = 5  # once this many makeshift pins have been tried with hardware, more will not help


def place_hinges(search: DoorSearch, gallery: Gallery) -> Placement | None:
    """Returns the best placement that works; None where no pin can be given hardware."""
    tried = 0
    for judged in search.in_order():
        if judged.free < _LEAST_SHARE * search.wanted or tried > _ENOUGH:
            break
        tried += judged.pin.preference > 3
        install_at = _with_pivots if judged.pin.is_pivot else _with_hardware
        placed = install_at(judged, search, gallery)
        if placed is not None:
            return placed
    return None


def _with_hardware(judged: JudgedPin, search: DoorSearch, gallery: Gallery) -> Placement | None:
    """Returns the placement of the first template of the pin's class whose hinges all fit; None where none does."""
    count = hinge_count(search.frame.length)
    for model in gallery.hinges_of(judged.pin.mechanism):
        size = hinge_size(model, search.frame, judged.pin, count)
        if size is None:
            continue
        upper = search.widest(judged.axis, min(model.build(size).range, search.config.door_opening))
        if upper < _LEAST_SHARE * search.wanted:
            return None
        site = _site(judged, upper, search)
        hinges = _installed(model, judged.pin, site, count, search)
        if hinges:
            return _placement(judged, model.id, upper, hinges, search)
    return None


def _with_pivots(judged: JudgedPin, search: DoorSearch, _: Gallery) -> Placement | None:
    """Returns the placement on discs at the door's ends; None where neither end meets the static body."""
    upper = search.widest(judged.axis, search.config.door_opening)
    if upper < _LEAST_SHARE * search.wanted:
        return None
    site = _site(judged, upper, search)
    door = search.scene.parts[search.request.moving].mesh
    near = search.scene.static_mesh_near(door.box, 0.25 * float(door.box.size.max()))
    ends = pivot_ends(search.frame, judged.pin, door, near, 0.2 * search.frame.length)
    held = [InstalledHinge((static,), (dynamic,)) for static, dynamic in ends]
    held = [hinge for hinge in held if is_out_of_the_way(hinge, site)]
    return _placement(judged, PIVOT, upper, held, search) if held else None


def _site(judged: JudgedPin, upper: float, search: DoorSearch) -> Site:
    box = search.scene.parts[search.request.moving].box
    unit = search.scene.unit
    others = tuple(o for o in search.neighbours if o.collider.box.overlaps(box, 0.1 * unit))
    return Site(
        frame=search.frame,
        door=search.scene.moving_mesh(search.request.moving),
        door_body=search.body,
        scene=search.scene,
        static_rays=search.static_rays,
        obstacles=tuple(in_the_way(search.obstacles, box.grown(0.2 * unit))),
        neighbours=others,
        motion=motion_about(judged.axis, JointType.REVOLUTE),
        upper=upper,
        depth=search.depth,
        anchor=search.config.anchor * unit,
        reach=search.config.bridge * unit,
    )


def _installed(
    model: HingeModel, pin: PinCandidate, site: Site, count: int, search: DoorSearch
) -> list[InstalledHinge]:
    """Returns one hinge per height, each shifted along the pin where its place is taken; empty where one finds none."""
    size = hinge_size(model, search.frame, pin, count)
    if size is None:
        return []
    hinges: list[InstalledHinge] = []
    for z in hinge_heights(search.frame.length, count):
        shifts = (s * search.frame.length for s in _HEIGHT_SHIFTS)
        tries = (install(fit_hinge(model, size, search.frame, pin, z + shift), pin, site) for shift in shifts)
        placed = next((hinge for hinge in tries if hinge is not None), None)
        if placed is None:
            return []
        hinges.append(placed)
    return hinges


def _placement(
    judged: JudgedPin, template: str, upper: float, hinges: list[InstalledHinge], search: DoorSearch
) -> Placement:
    part = search.request.moving
    static = [_named(v, part, k) for k, hinge in enumerate(hinges) for v in hinge.static]
    dynamic = [_named(v, part, k) for k, hinge in enumerate(hinges) for v in hinge.dynamic]
    return Placement(
        axis=judged.axis,
        upper=upper,
        mechanism=judged.pin.mechanism,
        template=template,
        mount=nearest_part(static[0], search.scene, search.request.mounts),
        count=len(hinges),
        dynamic=tuple(dynamic),
        static=tuple(static),
        in_way=judged.neighbours,
    )


def _named(visual: Visual, part: str, index: int) -> Visual:
    """Returns the visual under a name that is unique in the object: kind, part, index, end."""
    kind, _, end = visual.name.partition("_")
    return replace(visual, name=f"{kind}_{part}_{index}_{end}")
