"""Several models in one scene: which one the sidebar shows, and one taken out again."""

import bpy
from bpy.props import IntProperty

from . import objects
from .boxes import remove_boxes
from .run_operators import active_run
from .state import clear_slot, fill_slot, session_of, shown_slot, slots_in


class GRAFU_OT_choose_model(bpy.types.Operator):
    """Shows this model in the sidebar; a click on any of its objects does the same"""

    bl_idname = "grafu.choose_model"
    bl_label = "Choose model"
    bl_options = {"REGISTER", "UNDO"}

    slot: IntProperty(name="Model", description="Its place among those of the scene", min=0, options={"SKIP_SAVE"})

    def execute(self, context):
        """Makes its chosen part the active object."""
        scene = context.scene
        if self.slot >= len(slots_in(scene)) or not slots_in(scene)[self.slot].has_result:
            self.report({"WARNING"}, "there is no such model")
            return {"CANCELLED"}
        session = fill_slot(scene, self.slot)
        row = session.active_joint
        context.view_layer.objects.active = None
        objects.select_part(context, session, row.part if row else "")
        return {"FINISHED"}


class GRAFU_OT_remove_model(bpy.types.Operator):
    """Takes this model's result out of the scene, with all that was chosen for it; its sources are shown again"""

    bl_idname = "grafu.remove_model"
    bl_label = "Remove result"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        """Whether there is a result."""
        return active_run() is None and session_of(context).has_result

    def execute(self, context):
        """Removes it."""
        session, slot = session_of(context), shown_slot(context)
        for source in objects.sources_of(session):
            source.hide_viewport = source.hide_render = False
        remove_boxes(session)
        objects.remove_result(session)
        clear_slot(context.scene, slot)
        return {"FINISHED"}


CLASSES = (GRAFU_OT_choose_model, GRAFU_OT_remove_model)
