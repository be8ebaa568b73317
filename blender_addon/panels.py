"""The sidebar: what there is to see and to press. It changes nothing itself."""

import bpy

from .run_operators import active_run
from .state import session_of, settings_of

_ICONS = {"ok": "CHECKMARK", "warning": "ERROR", "error": "CANCEL"}


class GRAFU_UL_joints(bpy.types.UIList):
    """One row per door and drawer."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index=0, flag=0):
        """Draws level, part and mechanism."""
        row = layout.row(align=True)
        row.label(text=item.part + (" *" if item.changed else ""), icon=_ICONS[item.level])
        row.label(text=item.mechanism or "no joint")


class GRAFU_UL_additions(bpy.types.UIList):
    """One row per added part."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index=0, flag=0):
        """Draws the part with its switch."""
        row = layout.row(align=True)
        row.label(text=item.part)
        row.label(text=item.about)
        button = row.operator("grafu.set_addition", text="", icon="CHECKBOX_HLT" if item.accepted else "CHECKBOX_DEHLT")
        button.part, button.accepted = item.part, not item.accepted


class GRAFU_UL_parts(bpy.types.UIList):
    """One row per part of the input."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index=0, flag=0):
        """Draws the part and its category, which a click corrects."""
        row = layout.row(align=True)
        row.label(text=item.part)
        button = row.operator("grafu.set_label", text=item.category)
        button.part, button.label = item.part, item.category


class _Panel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "GraFu"


class _ResultPanel(_Panel):
    @classmethod
    def poll(cls, context):
        return session_of(context).has_result


class GRAFU_PT_main(_Panel, bpy.types.Panel):
    """The first panel: run, stop, what came of it."""

    bl_label = "GraFu"

    def draw(self, context):
        """Draws it."""
        layout, session, run = self.layout, session_of(context), active_run()
        if run is not None:
            layout.label(text=f"{round(100 * run.share)} %  {run.stage} ...", icon="TIME")
            layout.operator("grafu.cancel", icon="CANCEL")
            return
        layout.operator("grafu.functionalize", icon="PLAY")
        if session.has_result:
            layout.operator("grafu.run_again", icon="FILE_REFRESH")
        if session.status:
            for line in _wrapped(session.status):
                layout.label(text=line)


class GRAFU_PT_joints(_ResultPanel, bpy.types.Panel):
    """All joints, and the chosen one."""

    bl_label = "Joints"

    def draw(self, context):
        """Draws it."""
        layout, session = self.layout, session_of(context)
        layout.template_list("GRAFU_UL_joints", "", session, "joints", session, "joint_index")
        row = layout.row(align=True)
        row.operator("grafu.pick_joint", text="", icon="EYEDROPPER")
        for what, text in (("all", "All open"), ("solo", "This one"), ("closed", "Closed"), ("animation", "Animation")):
            row.operator("grafu.preview", text=text).what = what
        row = layout.row(align=True)
        row.operator("grafu.colours", text="Colours").on = True
        row.operator("grafu.colours", text="Materials").on = False
        row = layout.row(align=True)
        row.operator("grafu.show_sources", text="Sources").on = True
        row.operator("grafu.show_sources", text="Result").on = False
        joint = session.active_joint
        if joint is not None:
            _draw_joint(layout.box(), joint, context.scene)


def _draw_joint(box, joint, scene):
    box.label(text=joint.part, icon=_ICONS[joint.level])
    for line in (joint.figures, *_wrapped(joint.why)):
        if line:
            box.label(text=line)
    empty = next((o for o in scene.objects if o.get("grafu") == "joint" and o.get("child") == joint.part), None)
    if empty is not None and "open" in empty:
        box.label(text=_limits(empty))
        box.prop(empty, '["open"]', text="Open", slider=True)
    row = box.row(align=True)
    row.operator("grafu.set_joint", icon="MODIFIER").part = joint.part
    row.operator("grafu.reset_joint", text="", icon="LOOP_BACK").part = joint.part
    row = box.row(align=True)
    row.operator("grafu.set_handle", icon="GRIP").part = joint.part
    row.operator("grafu.reset_handle", text="", icon="LOOP_BACK").part = joint.part


def _limits(empty) -> str:
    if empty["type"] == "revolute":
        return f"turns by {57.29578 * empty['upper']:.0f} degrees"
    return f"slides by {100 * empty['upper']:.1f} cm"


class GRAFU_PT_additions(_ResultPanel, bpy.types.Panel):
    """What was added, top and interior."""

    bl_label = "Added parts"

    def draw(self, context):
        """Draws it."""
        layout, session = self.layout, session_of(context)
        layout.template_list("GRAFU_UL_additions", "", session, "additions", session, "addition_index")
        layout.operator("grafu.set_top", icon="MESH_PLANE")
        row = layout.row(align=True)
        row.operator("grafu.show_compartments", icon="MESH_CUBE")
        row.operator("grafu.furnish", icon="ALIGN_JUSTIFY")
        for number, choice in sorted(settings_of(session).additions.compartments.items()):
            layout.label(text=f"compartment {number + 1}: {choice.shelves} shelves, {choice.dividers} dividers")


class GRAFU_PT_parts(_ResultPanel, bpy.types.Panel):
    """The parts of the input."""

    bl_label = "Categories"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        """Draws it."""
        session = session_of(context)
        self.layout.template_list("GRAFU_UL_parts", "", session, "parts", session, "part_index")


class GRAFU_PT_output(_ResultPanel, bpy.types.Panel):
    """The last step."""

    bl_label = "Finalize"

    def draw(self, context):
        """Draws it."""
        self.layout.operator("grafu.finalize", icon="EXPORT")


def _wrapped(text: str, width: int = 48) -> list:
    lines = [""]
    for word in text.split():
        if lines[-1] and len(lines[-1]) + len(word) >= width:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    return lines


CLASSES = (
    GRAFU_UL_joints,
    GRAFU_UL_additions,
    GRAFU_UL_parts,
    GRAFU_PT_main,
    GRAFU_PT_joints,
    GRAFU_PT_additions,
    GRAFU_PT_parts,
    GRAFU_PT_output,
)
