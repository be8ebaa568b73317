"""The sidebar: what there is to see and to press. It changes nothing itself, and reads only what the scene holds."""

import bpy

from .asset_operators import registered_library
from .lists import BUTTONS, ICON, LEVEL_ICONS
from .objects import joint_empties
from .run_operators import active_run
from .state import session_of, shown_slot, slots_in
from .texts import draw_text, is_cut
from .versions import draw_progress

_BOX = 18.0  # pixels that a box takes


class _Panel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "GraFu"


class _ResultPanel(_Panel):
    @classmethod
    def poll(cls, context):
        return session_of(context).has_result


class GRAFU_PT_main(_Panel, bpy.types.Panel):
    """The first panel: run, stop, result."""

    bl_label = "GraFu"

    def draw(self, context):
        """Draws it."""
        layout, session, run = self.layout, session_of(context), active_run()
        if run is not None:
            draw_progress(layout, run.ratio, run.doing)
            layout.operator("grafu.cancel", icon="CANCEL")
            return
        column = layout.column(align=True)
        column.operator("grafu.functionalize", icon="PLAY")
        column.operator("grafu.open_result", text="Open result ...", icon="FILE_FOLDER")
        if session.has_result:
            again = column.row(align=True)
            again.enabled = not session.fixed
            again.operator("grafu.run_again", icon="FILE_REFRESH")
            column.operator("grafu.remove_model", icon="TRASH")
            _draw_models(context, layout)
        elif not session.status:
            draw_text(context, layout, "Select the mesh objects of one piece of furniture: each is a part.")
        if session.status:
            draw_text(context, layout, session.status)


def _draw_models(context, layout):
    """Draws a button for each model, where there are several."""
    slots = [(slot, one) for slot, one in enumerate(slots_in(context.scene)) if one.has_result]
    if len(slots) < 2:
        return
    column, shown = layout.column(align=True), shown_slot(context)
    for slot, one in slots:
        title = one.collection.name if one.collection is not None else "model"
        button = column.operator("grafu.choose_model", text=title, icon="OUTLINER_COLLECTION", depress=slot == shown)
        button.slot = slot


class GRAFU_PT_joints(_ResultPanel, bpy.types.Panel):
    """All joints, and the chosen one."""

    bl_label = "Joints"

    def draw_header_preset(self, context):
        """Draws how many need attention."""
        levels = [row.level for row in session_of(context).joints]
        for level in ("warning", "error"):
            if level in levels:
                self.layout.label(text=str(levels.count(level)), icon=LEVEL_ICONS[level])

    def draw(self, context):
        """Draws it."""
        layout, session = self.layout, session_of(context)
        layout.template_list("GRAFU_UL_joints", "", session, "joints", session, "joint_index", rows=5)
        joint = session.active_joint
        if joint is not None:
            _draw_joint(context, layout.box(), joint)


def _draw_joint(context, box, joint):
    row, cut = box.row(), is_cut(context, joint.part, ICON + _BOX, ICON)
    row.label(text=joint.level if cut else joint.part, icon=LEVEL_ICONS[joint.level])
    row.operator("grafu.pick_joint", text="", icon="EYEDROPPER")
    empty = joint_empties(session_of(context)).get(joint.part)
    moves = empty is not None and "open" in empty
    lines = [
        joint.part if cut else "",
        joint.mechanism,
        joint.why,
        *joint.figures.splitlines(),
        _limits(empty) if moves else "",
    ]
    draw_text(context, box, "\n".join(line for line in lines if line), _BOX)
    if moves:
        box.prop(empty, '["open"]', text="Open", slider=True)
    column = box.column(align=True)
    _draw_choice(column, "joint", joint.part, joint.changed, "Hinges or rails", "MODIFIER")
    _draw_choice(column, "handle", joint.part, joint.front_changed, "Handle", "GRIP")
    _draw_choice(column, "motion", joint.part, joint.motion_changed, "Motion", "CON_ROTLIMIT")


def _draw_choice(column, what, part, changed, text, icon):
    """Draws a button that asks, and one that takes back what was chosen."""
    row = column.row(align=True)
    row.operator(f"grafu.set_{what}", text=f"{text} ...", icon=icon).part = part
    back = row.row(align=True)
    back.enabled = changed
    back.operator(f"grafu.reset_{what}", text="", icon="LOOP_BACK").part = part


def _limits(empty) -> str:
    from grafu.articulation.motion_kind import motion_kind
    from grafu.vocabulary import JointType

    kind = motion_kind(JointType(empty["type"]))
    return f"{kind.verb} by {kind.worded(empty['upper'])}"


class GRAFU_PT_view(_ResultPanel, bpy.types.Panel):
    """How the model is shown."""

    bl_label = "Show"

    def draw(self, context):
        """Draws it."""
        session, column = session_of(context), self.layout.column(align=True)
        for pair in (
            (("all", "All open"), ("closed", "All closed")),
            (("solo", "This one"), ("animation", "Animation")),
        ):
            row = column.row(align=True)
            for what, text in pair:
                row.operator("grafu.preview", text=text).what = what
        column = self.layout.column(align=True)
        button = column.operator("grafu.colours", icon="COLOR", depress=session.colours)
        button.on = not session.colours
        shown = any(row.object is not None and not row.object.hide_viewport for row in session.sources)
        column.prop(context.scene, "grafu_overlay", icon="DRIVER_ROTATIONAL_DIFFERENCE", toggle=True)
        if session.sources:
            button = column.operator("grafu.show_sources", text="Source objects", icon="HIDE_OFF", depress=shown)
            button.on = not shown


class GRAFU_PT_additions(_ResultPanel, bpy.types.Panel):
    """What was added."""

    bl_label = "Added parts"

    def draw(self, context):
        """Draws it."""
        layout, session = self.layout, session_of(context)
        if session.additions:
            layout.template_list("GRAFU_UL_additions", "", session, "additions", session, "addition_index", rows=3)
            if 0 <= session.addition_index < len(session.additions):
                row = session.additions[session.addition_index]
                _draw_whole(context, layout, session.additions, row.part, row.about.split(": ")[-1], ICON)
        else:
            layout.label(text="Nothing was added")
        if session.left_out:
            draw_text(context, layout, f"Left out:\n{session.left_out}")


class GRAFU_PT_interior(_ResultPanel, bpy.types.Panel):
    """Top and shelves."""

    bl_label = "Top and interior"

    def draw(self, context):
        """Draws it."""
        layout, session = self.layout, session_of(context)
        shown = session.boxes is not None
        column = layout.column(align=True)
        column.operator("grafu.set_top", text="Top ...", icon="MESH_PLANE")
        column.operator("grafu.show_compartments", icon="MESH_CUBE", depress=shown)
        column.operator("grafu.furnish", text="Furnish ...", icon="ALIGN_JUSTIFY")
        if session.furnished:
            draw_text(context, layout, session.furnished)


class GRAFU_PT_parts(_ResultPanel, bpy.types.Panel):
    """The parts of the input."""

    bl_label = "Categories"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        """Draws it."""
        layout, session = self.layout, session_of(context)
        layout.template_list("GRAFU_UL_parts", "", session, "parts", session, "part_index", rows=5)
        if 0 <= session.part_index < len(session.parts):
            row = session.parts[session.part_index]
            _draw_whole(context, layout, session.parts, row.part, row.category, BUTTONS)


def _draw_whole(context, layout, rows, name, about, taken):
    """Draws the chosen row once more, whole, where the list has too little room for it; `taken`: pixels of icons."""
    longest = max((row.part for row in rows), key=len)
    if is_cut(context, f"{longest}  {about}", taken):
        draw_text(context, layout, f"{name}: {about}")


class GRAFU_PT_assets(_Panel, bpy.types.Panel):
    """Templates in the asset browser."""

    bl_label = "Templates"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        """Draws it."""
        column, there = self.layout.column(align=True), registered_library() is not None
        column.operator("grafu.use_asset", icon="PIVOT_ACTIVE")
        text = "Write the asset library anew" if there else "Add the asset library"
        column.operator("grafu.add_assets", text=text, icon="ASSET_MANAGER")
        column.operator("grafu.remove_assets", icon="TRASH")


class GRAFU_PT_output(_ResultPanel, bpy.types.Panel):
    """The last step."""

    bl_label = "Finalize"

    def draw(self, context):
        """Draws it."""
        self.layout.operator("grafu.finalize", text="Finalize ...", icon="EXPORT")


CLASSES = (
    GRAFU_PT_main,
    GRAFU_PT_joints,
    GRAFU_PT_view,
    GRAFU_PT_additions,
    GRAFU_PT_interior,
    GRAFU_PT_parts,
    GRAFU_PT_assets,
    GRAFU_PT_output,
)
