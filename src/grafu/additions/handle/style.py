"""Which handle a model gets: like the others that it has, or a named or default template. It places nothing."""

from collections.abc import Mapping, Sequence
from typing import final

from grafu.additions.handle.config import HandleConfig
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Material
from grafu.geometry.arrays import median
from grafu.geometry.box import Box
from grafu.scene.front import Front, front_of
from grafu.scene.scene import Scene
from grafu.templates.handles import HANDLES, handle_template
from grafu.templates.solids import BLACK, BRASS, BRONZE, NICKEL, STEEL
from grafu.templates.template import HandleTemplate
from grafu.vocabulary import PartLabel

FINISHES: dict[str, Material] = {"steel": STEEL, "nickel": NICKEL, "brass": BRASS, "bronze": BRONZE, "black": BLACK}


@final
@dataclass(frozen=True, eq=False)
class Sibling:
    """A handle that the model has: its part, the front that it sits on, and its box there, (u, b, v)."""

    part: Part
    front: Front
    box: Box

    @property
    def is_upright(self) -> bool:
        """Whether it is longer up than across."""
        return bool(self.box.size[2] > self.box.size[0])


@final
@dataclass(frozen=True, eq=False)
class HandleStyle:
    """A template with a length and a protrusion in metres, the parts that its metal is like, else its finish."""

    template: HandleTemplate
    length: float
    protrusion: float
    alike: tuple[Part, ...]
    finish: Material


def siblings_of(scene: Scene) -> tuple[Sibling, ...]:
    """Returns the handles that ride on moving bodies of the scene."""
    found = []
    for moving in scene.moving_bodies.values():
        handles = [
            scene.parts[m] for m in moving.members if scene.parts[m].label is PartLabel.HANDLE and m != moving.id
        ]
        if handles:
            front = front_of(scene, moving.id)
            found += [Sibling(p, front, front.box_of(p.mesh.vertices)) for p in handles if len(p.mesh.faces)]
    return tuple(found)


def choose_style(
    fronts: Sequence[Front],
    siblings: Sequence[Sibling],
    factor: float,
    config: HandleConfig,
    own: Mapping[str, HandleTemplate],
) -> HandleStyle:
    """Returns the style of all handles that a model gets.

    `factor` is the length of a metre on it, `own` are the user's templates by id.

    Raises:
        TemplateError: if the config names no template that there is.
    """
    alike = () if config.finish else tuple(s.part for s in siblings)
    finish = FINISHES.get(config.finish, STEEL)
    if config.style or not siblings:
        template = named_template(config.style or config.default, own)
        length = config.length or _length(template, fronts, factor, config)
        return HandleStyle(
            template, min(length, factor * template.longest), factor * template.natural.protrusion, alike, finish
        )
    template, length, protrusion = _like(siblings, factor, config)
    return HandleStyle(template, config.length or length, protrusion, alike, finish)


def named_template(template_id: str, own: Mapping[str, HandleTemplate]) -> HandleTemplate:
    """Returns a template of the user's own, else a built-in one.

    Raises:
        TemplateError: if there is no such handle.
    """
    return own[template_id] if template_id in own else handle_template(template_id)


def _length(template: HandleTemplate, fronts: Sequence[Front], factor: float, config: HandleConfig) -> float:
    natural = factor * template.natural.length
    if template.family != "bar" or not fronts:
        return natural
    wanted = config.bar_ratio * median([max(f.width, f.height) for f in fronts])
    low, high = (factor * length for length in (config.shortest_bar, config.longest_bar))
    return min(max(wanted, low), max(high, natural))


def _like(siblings: Sequence[Sibling], factor: float, config: HandleConfig) -> tuple[HandleTemplate, float, float]:
    """Returns the template most like a model's handles, with their length and protrusion, metres."""
    lengths = [float(max(s.box.size[0], s.box.size[2])) for s in siblings]
    across = [float(min(s.box.size[0], s.box.size[2])) for s in siblings]
    length, width = median(lengths), median(across)
    protrusion = median([min(float(s.box.size[1]), -float(s.box.low[1])) for s in siblings])
    is_knob = length <= factor * config.knob and length <= config.knob_ratio * max(width, 1e-9)
    family = "knob" if is_knob else "bar"
    able = [t for t in HANDLES if t.family == family and factor * t.longest >= length] or [HANDLES[0]]
    round_ones = [t for t in able if t.id in ("bar-round", "knob-round")] or able
    best = min(round_ones, key=lambda t: abs(factor * t.natural.length - length))
    natural = factor * best.natural.protrusion
    return best, length, min(max(protrusion, 0.5 * natural), 2.0 * natural)
