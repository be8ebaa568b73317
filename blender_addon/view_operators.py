"""Looking: the joint of what was picked, everything open, one joint alone, colours by category."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty

from . import objects
from .state import session_of

# Set apart by hue, moving bodies strongest; linear RGB.
COLOURS = {
    "door": (0.80, 0.25, 0.10),
    "drawer": (0.10, 0.35, 0.80),
    "handle": (0.85, 0.65, 0.05),
    "top panel": (0.30, 0.60, 0.25),
    "side panel": (0.45, 0.45, 0.55),
    "back panel": (0.30, 0.30, 0.38),
    "bottom panel": (0.38, 0.34, 0.30),
    "face frame": (0.55, 0.40, 0.60),
    "shelf": (0.20, 0.60, 0.60),
    "divider": (0.10, 0.45, 0.42),
    "bar": (0.60, 0.60, 0.20),
    "leg": (0.45, 0.28, 0.15),
    "misc": (0.50, 0.50, 0.50),
    "unknown": (0.85, 0.15, 0.60),
}
_HARDWARE = (0.65, 0.65, 0.68)


class _Shown:
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return session_of(context).has_result


class GRAFU_OT_pick_joint(_Shown, bpy.types.Operator):
    """Finds the joint of the active object: a part, a handle, either half of a hinge or rail"""

    bl_idname = "grafu.pick_joint"
    bl_label = "Joint of the active object"

    def execute(self, context):
        """Chooses it in the overview."""
        part = objects.joint_part_of(session_of(context), context.active_object)
        rows = [row.part for row in session_of(context).joints]
        if part not in rows:
            self.report({"WARNING"}, "the active object hangs on no joint")
            return {"CANCELLED"}
        session = session_of(context)
        session.is_filling = True  # the picked object stays the active one
        session.joint_index = rows.index(part)
        session.is_filling = False
        return {"FINISHED"}


class GRAFU_OT_select_part(_Shown, bpy.types.Operator):
    """Selects the object of a part"""

    bl_idname = "grafu.select_part"
    bl_label = "Select"

    part: StringProperty(options={"SKIP_SAVE"})

    def execute(self, context):
        """Selects it."""
        session = session_of(context)
        if objects.visual(session, self.part) is None:
            self.report({"WARNING"}, f"there is no object of `{self.part}`")
            return {"CANCELLED"}
        objects.select_part(context, session, self.part)
        return {"FINISHED"}


class GRAFU_OT_show_sources(_Shown, bpy.types.Operator):
    """Shows the objects that were handed over instead of the result, or the result again"""

    bl_idname = "grafu.show_sources"
    bl_label = "Sources"

    on: BoolProperty(name="Sources", default=True, options={"SKIP_SAVE"})

    def execute(self, context):
        """Shows the one and hides the other."""
        session = session_of(context)
        if not objects.sources_of(session):
            self.report({"WARNING"}, "no objects were handed over: it was opened from a folder")
            return {"CANCELLED"}
        for source in objects.sources_of(session):
            source.hide_viewport = source.hide_render = not self.on
        collection = objects.result_collection(session)
        collection.hide_viewport = collection.hide_render = self.on
        return {"FINISHED"}


def _of_leader(empties, part: str, ratio: float) -> dict:
    """Returns by its part how far the joint must open that a part's joint follows; the part's own where it is free."""
    from grafu.export.blend.layout import ID, LEADER, MULTIPLIER

    part_of = {empty[ID]: name for name, empty in empties.items()}
    while LEADER in empties[part]:
        ratio = ratio if empties[part][MULTIPLIER] > 0 else 1.0 - ratio
        part = part_of[empties[part][LEADER]]
    return {part: ratio}


class GRAFU_OT_preview(_Shown, bpy.types.Operator):
    """Opens everything, or one joint alone with those that it waits for; or lets the animation run"""

    bl_idname = "grafu.preview"
    bl_label = "Preview"

    what: EnumProperty(
        name="What",
        items=[
            ("all", "All open", "Every joint at its limit"),
            ("solo", "This one", "One joint, and those that it waits for"),
            ("closed", "All closed", ""),
            ("animation", "Animation", "Closed, open, closed"),
        ],
        options={"SKIP_SAVE"},
    )
    part: StringProperty(description="The moving part; empty: that of the chosen row", options={"SKIP_SAVE"})
    ratio: FloatProperty(name="Open", default=1.0, min=0.0, max=1.0, subtype="FACTOR", options={"SKIP_SAVE"})

    def execute(self, context):
        """Sets the joints."""
        from grafu.export.blend.joints import mute_joint, set_open
        from grafu.export.blend.layout import LEADER

        session = session_of(context)
        empties = objects.joint_empties(session)
        row = session.active_joint
        part = self.part or (row.part if row else "")
        if self.what == "solo" and part not in empties:
            self.report({"WARNING"}, f"`{part}` has no joint")
            return {"CANCELLED"}
        ratios = dict.fromkeys(empties, 1.0 if self.what == "all" else 0.0)
        if self.what == "solo":
            ratios |= dict.fromkeys(objects.waits_for(session, part), 1.0)
            ratios |= _of_leader(empties, part, self.ratio)
        for name, empty in empties.items():
            if LEADER in empty:
                continue  # it follows another
            mute_joint(empty, self.what != "animation")
            set_open(empty, ratios[name])
        if self.what == "animation":
            context.scene.frame_set(context.scene.frame_current)
        context.view_layer.update()
        return {"FINISHED"}


class GRAFU_OT_colours(_Shown, bpy.types.Operator):
    """Colours parts by category, or gives them their own materials back"""

    bl_idname = "grafu.colours"
    bl_label = "Colours by category"

    on: BoolProperty(name="On", default=True, options={"SKIP_SAVE"})

    def execute(self, context):
        """Sets what the objects' slots show; the meshes keep their materials."""
        session = session_of(context)
        session.colours = self.on
        for one in objects.result_objects(session):
            for slot in one.material_slots:
                slot.link = "OBJECT" if self.on else "DATA"
                if self.on:
                    slot.material = _material(one)
        return {"FINISHED"}


def _material(one):
    label = "hardware" if one.get("grafu") == "hardware" else one.get("label", "unknown")
    name = f"GraFu {label}"
    found = bpy.data.materials.get(name)
    if found is None:
        found = bpy.data.materials.new(name)
        colour = (*COLOURS.get(label, _HARDWARE), 1.0)
        found.diffuse_color = colour
        found.use_nodes = True
        found.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = colour
    return found


CLASSES = (
    GRAFU_OT_pick_joint,
    GRAFU_OT_select_part,
    GRAFU_OT_show_sources,
    GRAFU_OT_preview,
    GRAFU_OT_colours,
)
