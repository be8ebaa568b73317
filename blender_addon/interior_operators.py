"""Compartments: shown as boxes, and furnished with shelves and dividers of their own."""

import bpy
from bpy.props import EnumProperty, FloatProperty, IntProperty

from .addition_operators import Adds
from .boxes import boxes_of, draw_boxes, remove_boxes
from .questions import ask, chosen_or, draw_number, fill, own_switch, split
from .state import compartments_of, session_of, settings_of, slots_in

SELECTED = "selected"
_items: dict = {}


def compartment_items(_, context):
    """Returns the compartments for a menu, and the selected ones; Blender wants the texts kept."""
    number = len(compartments_of(session_of(context))) if context is not None else 0
    if number not in _items:
        each = [(str(k), f"Compartment {k + 1}", "", k + 1) for k in range(number)]
        _items[number] = [(SELECTED, "The selected boxes", "Those that are shown", 0), *each]
    return _items[number]


class GRAFU_OT_show_compartments(Adds, bpy.types.Operator):
    """Shows the compartments as boxes of wire, numbered; again: takes them away"""

    bl_idname = "grafu.show_compartments"
    bl_label = "Show compartments"

    def execute(self, context):
        """Draws or removes the boxes; those of a result that was opened are found by a run first."""
        session = session_of(context)
        if remove_boxes(session):
            return {"FINISHED"}
        return self._drawn(session) if session.interior_json else super().execute(context)

    def changed(self, context, settings):
        """Returns the same settings."""
        return settings

    def _shown(self, context):
        result = super()._shown(context)
        if result == {"FINISHED"}:
            self._drawn(slots_in(bpy.data.scenes[self._scene])[self._slot])
        return result

    def _drawn(self, session):
        if compartments_of(session):
            draw_boxes(session)
            return {"FINISHED"}
        session.status = "no compartment was found"
        self.report({"WARNING"}, session.status)
        return {"CANCELLED"}


class GRAFU_OT_furnish(Adds, bpy.types.Operator):
    """Furnishes one compartment with shelves and dividers of its own; the selected boxes, where no number is given"""

    bl_idname = "grafu.furnish"
    bl_label = "Furnish"

    number: IntProperty(
        name="Compartment",
        description="From 0; -1: as `compartment` states",
        default=-1,
        min=-1,
        options={"HIDDEN", "SKIP_SAVE"},
    )
    compartment: EnumProperty(name="Compartment", items=compartment_items, options={"SKIP_SAVE"})
    shelves: IntProperty(name="Shelves", default=1, min=0, max=20, options={"SKIP_SAVE"})
    dividers: IntProperty(name="Dividers", default=0, min=0, max=20, options={"SKIP_SAVE"})
    thickness: FloatProperty(
        name="Thickness", description="0: as usual", default=0.0, min=0.0, subtype="DISTANCE", options={"SKIP_SAVE"}
    )
    own_thickness: own_switch()
    inset: FloatProperty(
        name="Front inset",
        description="-1: as usual",
        default=-1.0,
        min=-1.0,
        subtype="DISTANCE",
        options={"SKIP_SAVE"},
    )
    own_inset: own_switch()

    def invoke(self, context, event):
        """Asks, with what holds now filled in."""
        additions = settings_of(session_of(context)).additions
        numbers, found = _selected_numbers(context), compartments_of(session_of(context))
        if not numbers and found and self.compartment == SELECTED:
            self.compartment, numbers = "0", [0]
        choice = next((additions.compartments[k] for k in numbers if k in additions.compartments), None)
        if choice is not None:
            self.shelves, self.dividers = choice.shelves, choice.dividers
        fill(self, "thickness", choice and choice.thickness, additions.interior_sizes.thickness)
        self.own_inset = choice is not None and choice.inset is not None
        self.inset = choice.inset if self.own_inset else additions.interior_sizes.inset
        return ask(self, context)

    def draw(self, context):
        """Draws the question."""
        layout = split(self)
        layout.prop(self, "compartment")
        if self.compartment == SELECTED:
            numbers = _selected_numbers(context)
            named = ", ".join(str(number + 1) for number in numbers)
            layout.label(
                text=f"Selected: {named}" if numbers else "Show the compartments, and select boxes", icon="INFO"
            )
        layout.prop(self, "shelves")
        layout.prop(self, "dividers")
        draw_number(layout, self, "thickness", "Thickness")
        draw_number(layout, self, "inset", "Front inset")

    def changed(self, context, settings):
        """Returns the settings with what the compartments get."""
        from grafu.additions.interior.request import CompartmentChoice

        chosen = [self.number] if self.number >= 0 else _selected_numbers(context)
        if self.number < 0 and self.compartment != SELECTED:
            chosen = [int(self.compartment)]
        if not chosen:
            raise ValueError("choose a compartment: show them, and select boxes")
        inset = chosen_or(self, "inset", -1.0)
        thickness = chosen_or(self, "thickness", 0.0) or None
        choice = CompartmentChoice(self.shelves, self.dividers, thickness, None if inset < 0 else inset)
        for number in chosen:
            settings = settings.with_compartment(number, choice)
        return settings


def _selected_numbers(context):
    shown = boxes_of(session_of(context))
    own = set(shown.objects) if shown is not None else set()
    return sorted(o["number"] for o in context.selected_objects if o in own)


CLASSES = (GRAFU_OT_show_compartments, GRAFU_OT_furnish)
