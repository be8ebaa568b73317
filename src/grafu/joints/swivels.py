"""What swivels on what carries it: seats of office chairs and bar stools, plates below televisions, tops of stands.

They are found by a word (`swivel_seat`), or as all that stands on one round column above at least three wheels. What
stands on such a part goes with it. A piece with doors or drawers above its column is left as it is.
"""

from collections.abc import Mapping, Sequence
from typing import Final, final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Visual
from grafu.asset.names import spoken
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.touching import near_pairs, touching_pairs
from grafu.joints.config import SmallPartConfig
from grafu.joints.plan import JointRequest
from grafu.joints.small_knobs import Piece, round_about, turning
from grafu.scene.scale import metre_on

_UP: Final = 2
_WORDS: Final = frozenset({"swivel", "swivelling", "swiveling", "revolving", "rotating"})
_OTHERS: Final = frozenset({
    "caster", "castor", "wheel", "mirror", "bracket", "hinge", "bearing", "base", "mechanism", "arm", "door", "drawer",
    "tray", "knob", "handle",
})  # fmt: skip
_WHEELS: Final = frozenset({"wheel", "wheels", "caster", "casters", "castor", "castors", "roller"})


@final
@dataclass(frozen=True)
class SwivelConfig:
    """What stands on a column, and what swivels; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("touching", "on_column")
    touching: float = 0.003
    """What is nearer than this touches (metres) ..."""
    on_column: float = 0.02
    """... and as near as this to a column is what it carries (metres): few models draw the mechanism between."""
    slim: float = 0.25
    """Greatest diameter of a column (fraction of the longer level side of the whole) ..."""
    high: float = 0.12
    """... and least height (fraction of that of the whole): a column of a chair may be short."""
    middle: float = 0.15
    """How far its axis is from the middle of what it carries at most (fraction of that one's longer level side)."""
    above: float = 0.3
    """What it carries begins above this part of its height (fraction)."""
    wheels: int = 3
    """So many wheels stand below what swivels where no word tells."""

    def __post_init__(self) -> None:
        require_positive(self, "touching", "on_column", "wheels")
        require_ratios(self, "slim", "high", "middle", "above")


def swivels(asset: Asset) -> frozenset[str]:
    """Returns the parts of an asset that swivel, without those that they take along."""
    free = [part for part in asset.parts if part.carried_by is None]
    return frozenset(r.moving for r in _requests({part.id: part.mesh for part in free}, asset))


def swivel_requests(made: ArticulatedObject, asset: Asset) -> tuple[JointRequest, ...]:
    """Returns how the static parts of an object swivel; `asset` is what it was made from."""
    return _requests({visual.name: visual.mesh for visual in made.link(made.root).visuals}, asset)


def _requests(meshes: Mapping[str, TriangleMesh], asset: Asset) -> tuple[JointRequest, ...]:
    config = at_scale(SwivelConfig(), metre_on(asset.extent))
    words = {part.id: frozenset(spoken(part.source.name)) for part in asset.parts}
    called = [name for name in meshes if words.get(name, frozenset()) & _WORDS and not words[name] & _OTHERS]
    rolling = sum(bool(words.get(name, frozenset()) & _WHEELS) for name in meshes)
    if not called and rolling < config.wheels:
        return ()
    touching = _contacts(meshes, config)
    upper = _above_called(called, meshes, touching, config) if called else None
    found = (upper, _middle(upper, called, meshes, touching)) if upper else _on_column(meshes, words, config)
    movable = {part.id for part in asset.parts if part.label.is_movable}
    if found is None or found[0] & movable or len(found[0]) == len(meshes):
        return ()
    names, middle = found
    largest = max(sorted(names), key=lambda name: float(np.prod(np.sort(meshes[name].box.size)[1:])))
    moving = called[0] if upper else largest
    attached = tuple(name for name in meshes if name in names and name != moving)
    return (turning(moving, Axis(middle, vec3(0.0, 0.0, 1.0)), attached),)


def _contacts(meshes: Mapping[str, TriangleMesh], config: SwivelConfig) -> dict[str, set[str]]:
    names = list(meshes)
    near = near_pairs([meshes[name].box for name in names], config.touching)
    found: dict[str, set[str]] = {name: set() for name in names}
    for a, b in touching_pairs([meshes[name] for name in names], near, config.touching):
        found[names[a]].add(names[b])
        found[names[b]].add(names[a])
    return found


def _hanging(
    start: Sequence[str],
    level: float,
    meshes: Mapping[str, TriangleMesh],
    touching: Mapping[str, set[str]],
) -> set[str]:
    """Returns what hangs together with some parts, of those that begin above a level, metres."""
    found: set[str] = set()
    queue = list(start)
    while queue:
        name = queue.pop()
        if name in found or float(meshes[name].box.low[_UP]) < level:
            continue
        found.add(name)
        queue += touching[name]
    return found


def _above_called(
    called: Sequence[str],
    meshes: Mapping[str, TriangleMesh],
    touching: Mapping[str, set[str]],
    config: SwivelConfig,
) -> set[str] | None:
    """Returns what is called so, with what stands on it; None where it stands on nothing, or all hangs together."""
    level = min(float(meshes[name].box.low[_UP]) for name in called) - config.touching
    found = _hanging(called, level, meshes, touching)
    below = [name for name in meshes if name not in found and float(meshes[name].box.low[_UP]) < level]
    held = any(touching[name] & found for name in below)
    return found if held else None


def _middle(
    upper: set[str], called: Sequence[str], meshes: Mapping[str, TriangleMesh], touching: Mapping[str, set[str]]
) -> Vec3:
    """Returns where the axis is: in the middle of a round part right below, else of what is called so."""
    around = Box.enclosing(meshes[name].box for name in called)
    below = sorted({other for name in upper for other in touching[name]} - upper)
    found = [one for name in below if (one := _round(name, meshes[name])) is not None]
    inside = [axis.point for axis, _ in found if _is_in_plan(axis.point, around)]
    return np.asarray(inside[0]) if inside else around.center


def _is_in_plan(point: Vec3, box: Box) -> bool:
    return bool(np.all(point[:_UP] >= box.low[:_UP]) and np.all(point[:_UP] <= box.high[:_UP]))


def _round(name: str, mesh: TriangleMesh) -> tuple[Axis, float] | None:
    """Returns the upright axis about which a part is round, and its diameter in metres; None where it is not."""
    found = round_about(Piece("", Visual(name, (Surface(mesh),))), _UP, SmallPartConfig())
    return None if found is None else (found.axis, found.diameter)


def _on_column(
    meshes: Mapping[str, TriangleMesh], words: Mapping[str, frozenset[str]], config: SwivelConfig
) -> tuple[set[str], Vec3] | None:
    """Returns a round column with all that it alone carries above wheels, and its middle; None where none does."""
    whole = Box.enclosing(mesh.box for mesh in meshes.values())
    for name, mesh in meshes.items():
        box = mesh.box
        if box.size[_UP] < config.high * whole.size[_UP] or (one := _round(name, mesh)) is None:
            continue
        axis, diameter = one
        if diameter > config.slim * float(whole.size[:_UP].max()):
            continue
        level = float(box.low[_UP] + config.above * box.size[_UP])
        upper = {n for n, other in meshes.items() if float(other.box.low[_UP]) >= level}
        lower = set(meshes) - upper - {name}
        crosses = any(float(meshes[other].box.high[_UP]) > float(box.high[_UP]) for other in lower)
        if not upper or crosses or not any(meshes[n].box.overlaps(box, config.on_column) for n in upper):
            continue
        wheels = sum(bool(words.get(other, frozenset()) & _WHEELS) for other in lower)
        carried = Box.enclosing(meshes[other].box for other in upper)
        off = float(np.abs(axis.point - carried.center)[:_UP].max())
        if wheels >= config.wheels and off <= config.middle * float(carried.size[:_UP].max()):
            return upper | {name}, np.asarray(axis.point)
    return None
