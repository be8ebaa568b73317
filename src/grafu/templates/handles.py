"""The built-in handles: one table of styles and real-world sizes. It builds nothing until asked."""

from functools import cache

from grafu.errors import TemplateError
from grafu.templates import handle_bars as bars
from grafu.templates import handle_cups as cups
from grafu.templates import handle_knobs as knobs
from grafu.templates.handle import HandleSize, HandleTemplate

# Sizes are those of common furniture handles; bars come in hole distances of 96 to 480 mm and as rods of up to 1.2 m,
# edge profiles by the metre.
HANDLES: tuple[HandleTemplate, ...] = (
    HandleTemplate("bar-round", "Round bar", "bar", HandleSize(0.16, 0.034), 1.2, bars.round_bar),
    HandleTemplate("bar-square", "Square bar", "bar", HandleSize(0.138, 0.032), 1.2, bars.square_bar),
    HandleTemplate("bar-slim", "Bent rod", "bar", HandleSize(0.136, 0.028), 0.5, bars.slim_bar),
    HandleTemplate("bar-arched", "Arched band", "bar", HandleSize(0.13, 0.026), 0.35, bars.arched_bar),
    HandleTemplate("bar-tee", "Bar beyond its posts", "bar", HandleSize(0.188, 0.035), 1.2, bars.tee_bar),
    HandleTemplate("bar-strip", "Flat strip", "bar", HandleSize(0.17, 0.025), 1.2, bars.strip),
    HandleTemplate("bar-profile", "Edge profile", "bar", HandleSize(0.2, 0.02), 3.0, bars.profile),
    HandleTemplate("bail", "Drop handle", "bar", HandleSize(0.1, 0.024), 0.2, bars.bail, turns=False),
    HandleTemplate("knob-round", "Round knob", "knob", HandleSize(0.03, 0.026), 0.05, knobs.knob(knobs.ROUND)),
    HandleTemplate("knob-flat", "Flat knob", "knob", HandleSize(0.032, 0.022), 0.06, knobs.knob(knobs.FLAT)),
    HandleTemplate("knob-mushroom", "Mushroom", "knob", HandleSize(0.033, 0.028), 0.05, knobs.knob(knobs.MUSHROOM)),
    HandleTemplate("knob-square", "Square knob", "knob", HandleSize(0.028, 0.026), 0.05, knobs.square_knob),
    HandleTemplate("knob-cone", "Cone", "knob", HandleSize(0.024, 0.026), 0.045, knobs.knob(knobs.CONE)),
    HandleTemplate("knob-turned", "Turned knob", "knob", HandleSize(0.034, 0.034), 0.055, knobs.knob(knobs.TURNED)),
    HandleTemplate("ring", "Ring", "knob", HandleSize(0.045, 0.018), 0.08, knobs.ring, turns=False),
    HandleTemplate("cup-shell", "Shell", "cup", HandleSize(0.09, 0.026), 0.16, cups.shell, turns=False),
    HandleTemplate("cup-square", "Square cup", "cup", HandleSize(0.08, 0.024), 0.16, cups.square_cup, turns=False),
    HandleTemplate("cup-slim", "Slim cup", "cup", HandleSize(0.12, 0.018), 0.3, cups.slim_cup, turns=False),
)


@cache
def handle_template(template_id: str) -> HandleTemplate:
    """Returns a built-in handle.

    Raises:
        TemplateError: if there is no such handle.
    """
    for template in HANDLES:
        if template.id == template_id:
            return template
    raise TemplateError(f"`template_id` must be one of {', '.join(t.id for t in HANDLES)}: got {template_id!r}")
