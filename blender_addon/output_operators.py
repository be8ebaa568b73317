"""Output: all checks again and every format into a folder, with the settings that give the same without Blender."""

import json
from pathlib import Path

import bpy
from bpy.props import BoolProperty, StringProperty

from . import objects, work
from .boxes import remove_boxes
from .run_operators import active_run
from .state import session_of, settings_of


class GRAFU_OT_finalize(bpy.types.Operator):
    """Runs `grafu functionalize` with what was chosen: files, report and settings go to a folder"""

    bl_idname = "grafu.finalize"
    bl_label = "Finalize"
    bl_options = {"REGISTER", "UNDO"}

    directory: StringProperty(name="Folder", subtype="DIR_PATH", options={"SKIP_SAVE"})
    formats: StringProperty(
        name="Formats", description="Separated by commas", default="glb,urdf", options={"SKIP_SAVE"}
    )
    name: StringProperty(name="Name", description="Of the results: FOLDER/NAME", default="model", options={"SKIP_SAVE"})
    overwrite: BoolProperty(
        name="Overwrite", description="Replace results that are there already", options={"SKIP_SAVE"}
    )
    clean: BoolProperty(
        name="Clean up", description="Remove the source objects and the boxes of compartments", options={"SKIP_SAVE"}
    )

    @classmethod
    def poll(cls, context):
        """Whether there is a result."""
        return active_run() is None and session_of(context).has_result

    def invoke(self, context, event):
        """Asks for the folder."""
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        """Writes; the window waits, for it is the last step."""
        session = session_of(context)
        name = bpy.path.clean_name(self.name) or "model"
        run = work.Command()
        try:
            sources = objects.sources_of(session)
            if not sources:
                raise work.Failed("the objects that were handed over are gone")
            source, settings = run.folder / f"{name}.glb", run.folder / "settings.json"
            objects.export_sources(context, sources, source)
            settings.write_text(json.dumps(settings_of(session).to_json(), indent=1) + "\n")
            run.start("grafu.cli.main", self._arguments(source, settings))
            run.wait()
            run.require_success()
            target = Path(bpy.path.abspath(self.directory)) / name
            (target / "source.glb").write_bytes(source.read_bytes())
            (target / "settings.json").write_bytes(settings.read_bytes())
            report = json.loads((target / "report.json").read_text(encoding="utf-8"))
        except (work.Failed, OSError, RuntimeError) as error:
            session.status = str(error)
            self.report({"WARNING"}, session.status)
            return {"CANCELLED"}
        finally:
            run.close()
        if self.clean:
            remove_boxes(session)
            for source in sources:
                bpy.data.objects.remove(source)
            session.sources.clear()
        session.status = f"written to {target}: {_verdict(report)}"
        self.report({"INFO"}, session.status)
        return {"FINISHED"}

    def _arguments(self, source, settings) -> list:
        out = bpy.path.abspath(self.directory)
        given = ["functionalize", str(source), "--settings", str(settings), "--out", out, "--formats", self.formats]
        return [*given, "--overwrite"] if self.overwrite else given


def _verdict(report) -> str:
    joints = report["joints"]
    colliding = sum(joint["collision_share"] > 0 for joint in joints)
    return f"{len(joints)} joints, {colliding} collide, {len(report['skipped'])} left out"


CLASSES = (GRAFU_OT_finalize,)
