"""One joint, refined: hinges and rails as chosen, labels corrected. Each change is built again at once."""

from dataclasses import replace

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from .run_operators import Applies
from .state import session_of, settings_of

AUTO = "auto"
PIVOT = "pivot"
CLASSES = [
    (AUTO, "Automatic", "What fits best: C, then F, then P; for drawers the centre mount, then the corner mount"),
    ("C", "C: contact", "Leaves between two faces that touch"),
    ("F", "F: flush", "Leaves on two flush faces"),
    ("P", "P: perpendicular", "Leaves in an inner corner"),
    ("centre-mount", "Centre mount", "Rails at half the height of the drawer's sides"),
    ("corner-mount", "Corner mount", "Rails that carry the drawer from below"),
]
SUPPORTS = [
    (AUTO, "As needed", "The shortest block from a rail to whatever stands there"),
    ("slab", "Slabs", "A slab as large as the rail, out to the wall beside it"),
    ("divider", "Dividers", "An upright board along the rail, from what stands below to what stands above"),
    ("none", "None", "Rails stand only where they touch walls and drawer"),
]
_items: dict = {}


def template_items(_, __):
    """Returns all hinges and rails for a menu; Blender wants the texts kept."""
    if "templates" not in _items:
        from grafu.templates.gallery import builtin_gallery

        gallery = builtin_gallery()
        models = [(m.id, m.title, f"class {m.mechanism.value}") for m in (*gallery.hinges, *gallery.rails)]
        _items["templates"] = [(AUTO, "Automatic", "The first that fits"), *models]
        _items["templates"] += [(PIVOT, "Pivots", "Discs at the ends of the door")]
    return _items["templates"]


class GRAFU_OT_set_joint(Applies, bpy.types.Operator):
    """Builds one joint as chosen; what does not fit is not built, and everything stays as it was"""

    bl_idname = "grafu.set_joint"
    bl_label = "Refine joint"

    part: StringProperty(name="Part", options={"HIDDEN", "SKIP_SAVE"})
    mechanism: EnumProperty(name="Class", items=CLASSES, options={"SKIP_SAVE"})
    template: EnumProperty(name="Template", items=template_items, options={"SKIP_SAVE"})
    scale: FloatProperty(name="Scale", default=1.0, min=0.25, max=4.0, options={"SKIP_SAVE"})
    count: IntProperty(
        name="Hinges", description="0: by the door's height", default=0, min=0, max=12, options={"SKIP_SAVE"}
    )
    flipped: BoolProperty(name="Other side", description="Hang the door on its opposite border", options={"SKIP_SAVE"})
    opening: FloatProperty(
        name="Opens by",
        description="Radians or metres at most; 0: as far as it goes",
        default=0.0,
        min=0.0,
        options={"SKIP_SAVE"},
    )
    mount: StringProperty(
        name="Mount", description="The part that must carry it; empty: what suits", options={"SKIP_SAVE"}
    )
    supports: EnumProperty(name="Supports", items=SUPPORTS, options={"SKIP_SAVE"})

    def invoke(self, context, event):
        """Asks, with what holds now filled in."""
        row = session_of(context).active_joint
        self.part = self.part or (row.part if row else "")
        choice = settings_of(session_of(context)).joints.get(self.part)
        if choice is not None:
            self.mechanism = choice.mechanism.value if choice.mechanism else AUTO
            self.template = choice.template or AUTO
            self.scale, self.count, self.flipped = choice.scale, choice.count, choice.flipped
            self.opening, self.mount = choice.opening or 0.0, choice.mount
            self.supports = choice.supports.value
        return context.window_manager.invoke_props_dialog(self)

    def draw(self, context):
        """Draws what matters for such a joint."""
        layout, session = self.layout, session_of(context)
        row = session.joints.get(self.part)
        slides = row is not None and row.type == "prismatic"
        layout.use_property_split = True
        own = ("supports",) if slides else ("scale", "count", "flipped")
        for name in ("mechanism", "template", *own):
            layout.prop(self, name)
        layout.prop(self, "opening", text="Opens by (m)" if slides else "Opens by (radians)")
        layout.prop_search(self, "mount", session, "parts")

    def unfit(self, before, after):
        """What stood and is lost, and the joint itself where it is not built as chosen."""
        from grafu.pipeline.triage import lost, not_built

        return (*lost(before, after, besides=(self.part,)), *not_built(after, self.part))

    def changed(self, context, settings):
        """Returns the settings with the choice."""
        from grafu.realization.plan import JointChoice, Supports
        from grafu.vocabulary import MechanismClass

        return settings.with_joint(
            self.part,
            JointChoice(
                mechanism=None if self.mechanism == AUTO else MechanismClass(self.mechanism),
                template="" if self.template == AUTO else self.template,
                scale=round(self.scale, 6),  # Blender keeps single precision
                count=self.count,
                flipped=self.flipped,
                opening=round(self.opening, 6) or None,
                mount=self.mount,
                supports=Supports(self.supports),
            ),
        )


class GRAFU_OT_reset_joint(Applies, bpy.types.Operator):
    """Leaves one joint to the search again"""

    bl_idname = "grafu.reset_joint"
    bl_label = "Automatic again"

    part: StringProperty(name="Part", options={"HIDDEN", "SKIP_SAVE"})

    def changed(self, context, settings):
        """Returns the settings without a choice for the joint."""
        from grafu.realization.plan import AUTOMATIC

        return settings.with_joint(self.part, AUTOMATIC)


def label_items(_, __):
    """Returns all categories for a menu."""
    if "labels" not in _items:
        from grafu.vocabulary import PartLabel

        _items["labels"] = [(label.value, label.value, "") for label in PartLabel]
    return _items["labels"]


class GRAFU_OT_set_label(Applies, bpy.types.Operator):
    """Corrects what a part is, and runs again from there: joints come and go with it"""

    bl_idname = "grafu.set_label"
    bl_label = "Correct category"

    part: StringProperty(name="Part", options={"HIDDEN", "SKIP_SAVE"})
    label: EnumProperty(name="Category", items=label_items, options={"SKIP_SAVE"})
    as_read: BoolProperty(name="As read", description="Take the correction back", options={"SKIP_SAVE"})

    def invoke(self, context, event):
        """Asks."""
        return context.window_manager.invoke_props_dialog(self)

    def changed(self, context, settings):
        """Returns the settings with the part's category."""
        from grafu.vocabulary import PartLabel

        if self.as_read:
            return replace(settings, labels={k: v for k, v in settings.labels.items() if k != self.part})
        return settings.with_label(self.part, PartLabel(self.label))

    def unfit(self, before, after):
        """Nothing: what a part is decides whether it moves."""
        return ()


CLASSES = (GRAFU_OT_set_joint, GRAFU_OT_reset_joint, GRAFU_OT_set_label)
