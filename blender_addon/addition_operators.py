"""What is added: handles and grips front by front, the top; accepted or rejected."""

from dataclasses import replace

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, StringProperty

from . import thumbnails
from .questions import ask, chosen_or, draw_number, draw_part, draw_template, fill, own_switch, split
from .run_operators import Applies
from .state import session_of, settings_of

SAME, NOTHING = "same", "none"
GRIPS = [("grip", "Grip that fits"), ("groove", "Groove"), ("edge", "Edge notch"), ("hole", "Hole")]
_LENGTH = 0.128  # metres: the commonest bow handle, where one is chosen
_TOP = ("thickness", "front", "side", "back")
SHAPES = ("rectangle", "rounded", "chamfered", "oval", "capsule")
_PROFILES = (
    ("AUTO", "As usual", "Rounded, or as in the settings"),
    ("rounded", "Rounded", "Rounded ends and bottoms"),
    ("sharp", "Sharp", "Sharp corners"),
)
_items: dict = {}


def handle_items(_, __):
    """Returns all handles and grips for a menu; Blender wants the texts kept."""
    key = "handles", thumbnails.how_many()
    if key not in _items:
        from grafu.templates.handles import HANDLES

        rows = [
            (SAME, "Like the others", "The style of the model's other handles", "LINKED"),
            *((h.id, h.title, h.family, thumbnails.icon_of("handle", h.id)) for h in HANDLES),
            *((name, title, "carved into the front", "MOD_BOOLEAN") for name, title in GRIPS),
            (NOTHING, "Nothing", "No handle and no grip", "X"),
        ]
        _items[key] = [(*row, number) for number, row in enumerate(rows)]
    return _items[key]


def grip_length(name, description):
    """Returns a property for a length of a recessed grip, metres."""
    return FloatProperty(
        name=name, description=description, default=0.0, min=0.0, subtype="DISTANCE", options={"SKIP_SAVE"}
    )


class Adds(Applies):
    """What does not fit is not built: neither a joint nor anything that was asked for may be lost."""

    def unfit(self, before, after):
        """What stood and is lost, and what was asked for and is not built."""
        from grafu.pipeline.triage import lost, newly_skipped

        return lost(before, after) or newly_skipped(before, after)


class GRAFU_OT_set_handle(Adds, bpy.types.Operator):
    """Gives a door or drawer the handles or the grip that are chosen, whether it had any or not"""

    bl_idname = "grafu.set_handle"
    bl_label = "Handle"

    part: StringProperty(name="Part", options={"HIDDEN", "SKIP_SAVE"})
    style: EnumProperty(name="Style", items=handle_items, options={"SKIP_SAVE"})
    count: IntProperty(name="Handles", description="0: as usual", default=0, min=0, max=4, options={"SKIP_SAVE"})
    own_count: own_switch()
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
    own_length: own_switch()
    width: grip_length("Width", "Across the gripped edge; 0: as suits the front")
    depth: grip_length("Depth", "Of a groove; 0: as suits the front")
    profile: EnumProperty(name="Profile", items=_PROFILES, options={"SKIP_SAVE"})
    replaces: BoolProperty(
        name="Replace", description="Take away the handles that it has", default=True, options={"SKIP_SAVE"}
    )

    def invoke(self, context, event):
        """Asks, with what holds now filled in."""
        session = session_of(context)
        row = session.active_joint
        self.part = self.part or (row.part if row else "")
        choice = settings_of(session).additions.fronts.get(self.part)
        if choice is not None:
            self.style, self.offset, self.replaces = choice.style or SAME, choice.offset, choice.replaces
            self.width, self.depth, self.profile = choice.width, choice.depth, choice.profile or "AUTO"
        fill(self, "count", choice.count if choice is not None else 0, 1)
        fill(self, "length", choice.length if choice is not None else 0.0, _LENGTH)
        return ask(self, context)

    def draw(self, context):
        """Draws what matters for such a handle."""
        layout = split(self)
        draw_part(layout, self.part)
        draw_template(layout, self, "style")
        if self.style in dict(GRIPS):
            draw_number(layout, self, "length", "Length")
            for name in ("width", "depth", "profile"):
                layout.prop(self, name)
        elif self.style != NOTHING:
            draw_number(layout, self, "count", "Handles")
            draw_number(layout, self, "length", "Length")
            layout.prop(self, "offset", index=0, text="To the right")
            layout.prop(self, "offset", index=1, text="Up")
        layout.prop(self, "replaces", text="Replace its handles")

    def changed(self, context, settings):
        """Returns the settings with the front's choice."""
        from grafu.additions.handle.config import HandleChoice

        style = "" if self.style == SAME else self.style
        across, up = (round(v, 6) for v in self.offset)
        count, length = chosen_or(self, "count", 0), chosen_or(self, "length", 0.0)
        grip = {}
        if style in dict(GRIPS):
            profile = "" if self.profile == "AUTO" else self.profile
            grip = {"width": round(self.width, 6), "depth": round(self.depth, 6), "profile": profile}
        choice = HandleChoice(style, count, (across, up), length, self.replaces, **grip)
        return settings.with_front(self.part, choice)


class GRAFU_OT_reset_handle(Applies, bpy.types.Operator):
    """Leaves a door or drawer to be grasped as the model is: its own handles, or what it lacks"""

    bl_idname = "grafu.reset_handle"
    bl_label = "Handle as found"

    part: StringProperty(name="Part", options={"HIDDEN", "SKIP_SAVE"})

    def changed(self, context, settings):
        """Returns the settings without a choice for the front."""
        return settings.with_front(self.part, None)


class GRAFU_OT_set_top(Adds, bpy.types.Operator):
    """Adds a top of this shape and size where none is there, or in the place of the one that is; or adds none"""

    bl_idname = "grafu.set_top"
    bl_label = "Top"

    add: BoolProperty(name="Add where missing", default=True, options={"SKIP_SAVE"})
    replaces: BoolProperty(
        name="Replace", description="Put it in the place of the top that is there", options={"SKIP_SAVE"}
    )
    shape: EnumProperty(name="Shape", items=[(s, s.title(), "") for s in SHAPES], options={"SKIP_SAVE"})
    thickness: FloatProperty(name="Thickness", default=0.025, min=0.001, subtype="DISTANCE", options={"SKIP_SAVE"})
    front: FloatProperty(name="Overhang in front", default=0.02, min=0.0, subtype="DISTANCE", options={"SKIP_SAVE"})
    side: FloatProperty(name="Overhang at the sides", default=0.01, min=0.0, subtype="DISTANCE", options={"SKIP_SAVE"})
    back: FloatProperty(name="Overhang behind", default=0.0, min=0.0, subtype="DISTANCE", options={"SKIP_SAVE"})

    def invoke(self, context, event):
        """Asks, with what holds now filled in."""
        additions = settings_of(session_of(context)).additions
        self.replaces = additions.replaces_top
        if additions.top is not None:
            self.shape = additions.top.shape
            for name in _TOP:
                setattr(self, name, getattr(additions.top, name))
        return ask(self, context)

    def draw(self, context):
        """Draws the question."""
        layout = split(self)
        layout.prop(self, "add")
        if self.add:
            layout.prop(self, "replaces", text="Replace the one that is there")
            for name in ("shape", *_TOP):
                layout.prop(self, name)

    def changed(self, context, settings):
        """Returns the settings with the top."""
        from grafu.additions.top.config import TopConfig

        sizes = {name: round(getattr(self, name), 6) for name in _TOP}
        top = replace(settings.additions.top or TopConfig(), shape=self.shape, **sizes) if self.add else None
        return replace(settings, additions=replace(settings.additions, top=top, replaces_top=self.replaces))


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
    GRAFU_OT_set_addition,
)
