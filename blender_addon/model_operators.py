"""Models as wholes: one opened from a folder of results, which one the sidebar shows, one taken out again."""

import json
from pathlib import Path

import bpy
import mathutils
from bpy.props import BoolProperty, IntProperty, StringProperty

from . import objects, thumbnails
from .boxes import remove_boxes
from .run_operators import active_run
from .state import clear_slot, fill_slot, free_slot, session_of, shown_slot, slots_in, store


class GRAFU_OT_open_result(bpy.types.Operator):
    """Opens a folder that GraFu wrote, with model.glb and report.json, as another model at the 3D cursor"""

    bl_idname = "grafu.open_result"
    bl_label = "Open result"
    bl_options = {"REGISTER", "UNDO"}

    directory: StringProperty(name="Folder", subtype="DIR_PATH", options={"SKIP_SAVE"})
    filter_folder: BoolProperty(default=True, options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        """Whether nothing runs."""
        return active_run() is None

    def invoke(self, context, event):
        """Opens the file dialog for the folder."""
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        """Shows what the folder holds."""
        from grafu.errors import FunctionalizationError
        from grafu.pipeline.result_folder import read_result
        from grafu.visible import visible

        try:
            found = read_result(Path(bpy.path.abspath(self.directory)))
        except FunctionalizationError as error:
            session_of(context).status = why = visible(str(error))
            self.report({"WARNING"}, why)
            return {"CANCELLED"}
        session = fill_slot(context.scene, free_slot(context.scene))
        session.source_file, session.fixed = str(found.source or ""), found.fixed
        objects.show_result(session, found.object, mathutils.Matrix.Translation(context.scene.cursor.location))
        store(session, found.settings, json.dumps(found.report.to_json()), "", found.object)
        message = found.fixed or f"{len(found.report.joints)} joints, read from {self.directory}"
        session.status = visible(message)
        self.report({"INFO"}, session.status)
        thumbnails.begin()
        return {"FINISHED"}


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


CLASSES = (GRAFU_OT_open_result, GRAFU_OT_choose_model, GRAFU_OT_remove_model)
