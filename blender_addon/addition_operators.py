"""What is added: handles and grips front by front, the top, shelves by compartment; accepted or rejected."""

from dataclasses import replace

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, StringProperty

from .boxes import boxes_of, draw_boxes, remove_boxes
from .run_operators import Applies
from .state import compartments_of, session_of

SAME = "same"
_items: dict = {}


def handle_items(_, __):
    """Returns all handles and grips for a menu; Blender wants the texts kept."""
    if "handles" not in _items:
        from grafu.templates.handles import HANDLES

        grips = [("grip", "Grip that fits"), ("groove", "Groove"), ("edge", "Edge notch"), ("hole", "Hole")]
        _items["handles"] = [
            (SAME, "Like the others", "The style of the model's other handles"),
            *((h.id, h.title, h.family) for h in HANDLES),
            *((name, title, "carved into the front") for name, title in grips),
            ("none", "Nothing", "No handle and no grip"),
        ]
    return _items["handles"]


class _Adds(Applies):
    """What does not fit is not built: neither a joint nor anything that was asked for may be lost."""

    def unfit(self, before, after):
        from grafu.pipeline.triage import lost, newly_skipped

        return lost(before, after) or newly_skipped(before, after)


class GRAFU_OT_set_handle(_Adds, bpy.types.Operator):
    """Gives a door or drawer the handles or the grip that are chosen, whether it had any or not"""

    bl_idname = "grafu.set_handle"
    bl_label = "Handle"

    part: StringProperty(name="Part", options={"HIDDEN", "SKIP_SAVE"})
    style: EnumProperty(name="Style", items=handle_items, options={"SKIP_SAVE"})
    count: IntProperty(name="Handles", description="0: as usual", default=0, min=0, max=4, options={"SKIP_SAVE"})
    offset: FloatVectorProperty(
        name="Offset", description="To the right, and up", size=2, subtype="TRANSLATION", options={"SKIP_SAVE"}
    )
    length: FloatProperty(
        name="Length",
        description="0: as suits the front",
        default=0.0,
        min=0.0,
        subtype="DISTANCE",
        options={"SKIP_SAVE"},
    )
    replaces: BoolProperty(
        name="Replace", description="Take away the handles that it has", default=True, options={"SKIP_SAVE"}
    )

    def invoke(self, context, event):
        """Asks."""
        row = session_of(context).active_joint
        self.part = self.part or (row.part if row else "")
        return context.window_manager.invoke_props_dialog(self)

    def changed(self, context, settings):
        """Returns the settings with the front's choice."""
        from grafu.pipeline.addition_config import HandleChoice

        style = "" if self.style == SAME else self.style
        across, up = (round(v, 6) for v in self.offset)
        choice = HandleChoice(style, self.count, (across, up), round(self.length, 6), self.replaces)
        return settings.with_front(self.part, choice)


class GRAFU_OT_reset_handle(Applies, bpy.types.Operator):
    """Leaves a door or drawer to be grasped as the model is: its own handles, or what it lacks"""

    bl_idname = "grafu.reset_handle"
    bl_label = "Handle as found"

    part: StringProperty(name="Part", options={"HIDDEN", "SKIP_SAVE"})

    def changed(self, context, settings):
        """Returns the settings without a choice for the front."""
        return settings.with_front(self.part, None)


class GRAFU_OT_set_top(_Adds, bpy.types.Operator):
    """Adds a top of this shape and size where none is there, or in the place of the one that is; or adds none"""

    bl_idname = "grafu.set_top"
    bl_label = "Top"

    add: BoolProperty(name="Add where missing", default=True, options={"SKIP_SAVE"})
    replaces: BoolProperty(
        name="Replace", description="Put it in the place of the top that is there", options={"SKIP_SAVE"}
    )
    shape: EnumProperty(
        name="Shape", items=[(s, s.title(), "") for s in ("rectangle", "rounded", "chamfered")], options={"SKIP_SAVE"}
    )
    thickness: FloatProperty(name="Thickness", default=0.025, min=0.001, subtype="DISTANCE", options={"SKIP_SAVE"})
    front: FloatProperty(name="Overhang in front", default=0.02, min=0.0, subtype="DISTANCE", options={"SKIP_SAVE"})
    side: FloatProperty(name="Overhang at the sides", default=0.01, min=0.0, subtype="DISTANCE", options={"SKIP_SAVE"})
    back: FloatProperty(name="Overhang behind", default=0.0, min=0.0, subtype="DISTANCE", options={"SKIP_SAVE"})

    def invoke(self, context, event):
        """Asks."""
        return context.window_manager.invoke_props_dialog(self)

    def changed(self, context, settings):
        """Returns the settings with the top."""
        from grafu.realization.top.config import TopConfig

        sizes = {name: round(getattr(self, name), 6) for name in ("thickness", "front", "side", "back")}
        top = TopConfig(shape=self.shape, **sizes) if self.add else None
        return replace(settings, additions=replace(settings.additions, top=top, replaces_top=self.replaces))


class GRAFU_OT_show_compartments(bpy.types.Operator):
    """Shows the compartments as boxes of wire, numbered; again: takes them away"""

    bl_idname = "grafu.show_compartments"
    bl_label = "Show compartments"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        """Whether there is a result."""
        return session_of(context).has_result

    def execute(self, context):
        """Draws or removes the boxes."""
        session = session_of(context)
        if remove_boxes(session):
            return {"FINISHED"}
        if not compartments_of(session):
            self.report({"WARNING"}, "no compartment was found")
            return {"CANCELLED"}
        draw_boxes(session)
        return {"FINISHED"}


class GRAFU_OT_furnish(_Adds, bpy.types.Operator):
    """Furnishes one compartment with shelves and dividers of its own; the selected boxes, where no number is given"""

    bl_idname = "grafu.furnish"
    bl_label = "Furnish"

    number: IntProperty(
        name="Compartment", description="From 0; -1: the selected boxes", default=-1, min=-1, options={"SKIP_SAVE"}
    )
    shelves: IntProperty(name="Shelves", default=1, min=0, max=20, options={"SKIP_SAVE"})
    dividers: IntProperty(name="Dividers", default=0, min=0, max=20, options={"SKIP_SAVE"})
    thickness: FloatProperty(
        name="Thickness", description="0: as usual", default=0.0, min=0.0, subtype="DISTANCE", options={"SKIP_SAVE"}
    )
    inset: FloatProperty(name="Front inset", description="-1: as usual", default=-1.0, min=-1.0, options={"SKIP_SAVE"})

    def invoke(self, context, event):
        """Asks."""
        return context.window_manager.invoke_props_dialog(self)

    def changed(self, context, settings):
        """Returns the settings with what the compartments get."""
        from grafu.realization.interior.request import CompartmentChoice

        chosen = [self.number] if self.number >= 0 else _selected_numbers(context)
        if not chosen:
            raise ValueError("choose a compartment: show them, and select boxes")
        inset = None if self.inset < 0 else round(self.inset, 6)
        choice = CompartmentChoice(self.shelves, self.dividers, round(self.thickness, 6) or None, inset)
        for number in chosen:
            settings = settings.with_compartment(number, choice)
        return settings


def _selected_numbers(context):
    shown = boxes_of(session_of(context))
    own = set(shown.objects) if shown is not None else set()
    return sorted(o["number"] for o in context.selected_objects if o in own)


class GRAFU_OT_set_addition(Applies, bpy.types.Operator):
    """Leaves an added part out, or takes it in again"""

    bl_idname = "grafu.set_addition"
    bl_label = "Accept or reject"

    part: StringProperty(name="Part", options={"HIDDEN", "SKIP_SAVE"})
    accepted: BoolProperty(name="Accept", options={"SKIP_SAVE"})

    def changed(self, context, settings):
        """Returns the settings with the part rejected or not."""
        return settings.with_addition(self.part, accepted=self.accepted)


CLASSES = (
    GRAFU_OT_set_handle,
    GRAFU_OT_reset_handle,
    GRAFU_OT_set_top,
    GRAFU_OT_show_compartments,
    GRAFU_OT_furnish,
    GRAFU_OT_set_addition,
)
