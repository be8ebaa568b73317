"""Templates in Blender's asset browser: added as a library, taken out again, and built where one was dropped."""

from dataclasses import replace
from pathlib import Path

import bpy
from bpy.props import StringProperty

from . import objects, thumbnails
from .run_operators import Applies, active_run
from .state import session_of
from .versions import add_asset_library, own_folder, remove_asset_library

LIBRARY = "GraFu"
_FOLDER = "assets"


def registered_library():
    """Returns Blender's entry of the library of templates, or None."""
    folder = own_folder(_FOLDER)
    found = bpy.context.preferences.filepaths.asset_libraries
    return next((one for one in found if one.path and Path(one.path) == folder), None)


def dropped(thing) -> tuple:
    """Returns kind (`hinge`, `rail`, `handle`) and id of the template that an object is; both empty: it is none."""
    is_template = thing is not None and thing.get(objects.KIND) == "template"
    return (thing["kind"], thing[objects.ID]) if is_template else ("", "")


class GRAFU_OT_add_assets(Applies, bpy.types.Operator):
    """Adds hinges, rails and handles to Blender's asset browser, each with its picture, as the library GraFu"""

    bl_idname = "grafu.add_assets"
    bl_label = "Add the asset library"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        """Whether nothing runs."""
        return active_run() is None

    def execute(self, context):
        """Has the templates made by a process, then writes them as assets."""
        self._run = thumbnails.started()
        return self._launched(context)

    def _shown(self, context):
        from grafu.errors import FunctionalizationError
        from grafu.export.blend.assets import save_assets

        folder = own_folder(_FOLDER)
        try:
            save_assets([_asset(self._run.folder, entry) for entry in thumbnails.entries_in(self._run.folder)], folder)
        except (OSError, RuntimeError, FunctionalizationError) as error:
            return self._refused(context, f"the asset library was not written to {folder}: {error}")
        if registered_library() is None:
            add_asset_library(LIBRARY, folder)
        self.report({"INFO"}, f"the asset browser has the library {LIBRARY}: {folder}")
        return {"FINISHED"}


def _asset(folder: Path, entry: dict):
    from grafu.export.blend.assets import TemplateAsset
    from grafu.export.blend.process import unpacked

    made = unpacked((folder / f"{entry['key']}.packed").read_bytes())
    picture = _pixels(folder / f"{entry['key']}.png")
    return TemplateAsset(entry["kind"], entry["id"], entry["title"], entry["about"], made, picture)


def _pixels(path: Path):
    """Returns a picture's rows from above, columns and RGBA, 0..255; Blender's rows begin below."""
    import numpy as np

    image = bpy.data.images.load(str(path))
    try:
        values = np.empty(len(image.pixels), np.float32)
        image.pixels.foreach_get(values)
        rows = values.reshape(image.size[1], image.size[0], 4)[::-1]
        return np.rint(rows * 255.0).astype(np.uint8)
    finally:
        bpy.data.images.remove(image)


class GRAFU_OT_remove_assets(bpy.types.Operator):
    """Takes the library GraFu out of the asset browser, and removes its files"""

    bl_idname = "grafu.remove_assets"
    bl_label = "Remove the asset library"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        """Whether it is there, and nothing runs."""
        return active_run() is None and registered_library() is not None

    def execute(self, context):
        """Removes it; files of others in its folder stay."""
        from grafu.export.blend.assets import CATALOG_NAME, FILE_NAME

        remove_asset_library(registered_library())
        for name in (CATALOG_NAME, FILE_NAME):
            (own_folder(_FOLDER) / name).unlink(missing_ok=True)
        return {"FINISHED"}


class GRAFU_OT_use_asset(Applies, bpy.types.Operator):
    """Gives the nearest door or drawer the hinge, rail or handle that was dropped from the asset browser"""

    bl_idname = "grafu.use_asset"
    bl_label = "Use the dropped template"

    part: StringProperty(name="Part", description="Empty: the nearest door or drawer", options={"SKIP_SAVE"})

    @classmethod
    def poll(cls, context):
        """Whether the active object is a template, there is a model, and nothing runs."""
        cls.poll_message_set("drop a hinge, rail or handle of the library GraFu onto a door or drawer of a result")
        return super().poll(context) and dropped(context.active_object) != ("", "")

    def changed(self, context, settings):
        """Returns the settings with the template chosen for the part."""
        from grafu.additions.handle.config import HandleChoice
        from grafu.joints.plan import AUTOMATIC

        kind, template = dropped(context.active_object)
        self._dropped = context.active_object.name
        place = context.active_object.matrix_world.translation
        self.part = self.part or objects.nearest_part(session_of(context), place)
        if not self.part:
            raise ValueError("this model has no door and no drawer that could take the template")
        if kind == "handle":
            choice = settings.additions.fronts.get(self.part, HandleChoice())
            return settings.with_front(self.part, replace(choice, style=template))
        joint = settings.joints.get(self.part, AUTOMATIC)
        return settings.with_joint(self.part, replace(joint, mechanism=None, template=template))

    def unfit(self, before, after):
        """What stood and is lost, and the template where it is not built."""
        from grafu.pipeline.triage import lost, newly_skipped, not_built

        others = lost(before, after, besides=(self.part,))
        return (*others, *not_built(after, self.part), *newly_skipped(before, after))

    def _shown(self, context):
        result = super()._shown(context)
        one = bpy.data.objects.get(self._dropped)
        if result == {"FINISHED"} and one is not None:
            bpy.data.objects.remove(one)
        return result


CLASSES = (GRAFU_OT_add_assets, GRAFU_OT_remove_assets, GRAFU_OT_use_asset)
