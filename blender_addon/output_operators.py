"""Output: all checks again and every format into a folder, with the settings that give the same without Blender."""

import json
from pathlib import Path

import bpy
from bpy.props import BoolProperty, EnumProperty, StringProperty

from . import objects, work
from .boxes import remove_boxes
from .run_operators import Applies, active_run
from .state import report_of, session_of, settings_of, shown_slot, slots_in

BLEND = "blend"
_items: list = []


def format_items(_, __):
    """Returns all that the package writes for a menu; Blender wants the texts kept."""
    if not _items:
        from grafu.export.formats import FORMATS

        formats = enumerate(FORMATS.values())
        _items.extend((one.name, one.title, one.about, "NONE", 1 << number) for number, one in formats)
    return _items


def _default_formats():
    from grafu.export.formats import DEFAULT_FORMATS

    return {*DEFAULT_FORMATS, BLEND}


class GRAFU_OT_finalize(Applies, bpy.types.Operator):
    """Runs everything once more from the start: files, report and settings go to a folder"""

    bl_idname = "grafu.finalize"
    bl_label = "Finalize"

    directory: StringProperty(name="Folder", subtype="DIR_PATH", options={"SKIP_SAVE"})
    formats: EnumProperty(
        name="Formats",
        description="What to write; several with Shift. Nothing chosen: GLB, URDF and Blend",
        items=format_items,
        options={"ENUM_FLAG", "SKIP_SAVE"},
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
        """Whether there is a result, and nothing runs."""
        return active_run() is None and session_of(context).has_result

    def invoke(self, context, event):
        """Opens the file dialog for the folder."""
        self.formats = self.formats or _default_formats()
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def draw(self, context):
        """Draws what is asked beside the folder, each format on a line of its own."""
        layout = self.layout
        layout.prop(self, "name", text="Name")
        layout.label(text="Formats; several with Shift:")
        layout.column(align=True).prop(self, "formats")
        layout.prop(self, "overwrite")
        layout.prop(self, "clean")

    def execute(self, context):
        """Starts; in a window the rest goes on behind it."""
        from grafu.errors import AssetError

        session = session_of(context)
        self._scene, self._slot = context.scene.name, shown_slot(context)
        self._run = work.Command()
        try:
            self._start(context, session)
        except (work.Failed, OSError, RuntimeError, AssetError) as error:
            self._run.close()
            return self._refused(context, str(error))
        return self._launched(context)

    def _start(self, context, session) -> None:
        from grafu.export.output_names import name_of_model

        sources, folder = objects.sources_of(session), self._run.folder
        self._formats = set(self.formats) or _default_formats()
        if session.fixed:
            raise work.Failed(session.fixed)
        written = folder / f"{bpy.path.clean_name(self.name) or 'model'}.glb"
        self._source = objects.hand_over(context, sources, session.source_file, written)
        piece = report_of(session).input.name if settings_of(session).reading.pieces == "split" else ""
        self._target = Path(bpy.path.abspath(self.directory)).absolute() / name_of_model(self._source, piece)
        settings, order = folder / "settings.json", folder / "order.json"
        settings.write_text(json.dumps(settings_of(session).to_json(), indent=1) + "\n")
        wanted = {
            "source": str(self._source),
            "settings": str(settings),
            "out": str(self._target.parent),
            "formats": sorted(self._formats - {BLEND}),
            "overwrite": self.overwrite,
            "piece": piece,
            "object": str(folder / "object.packed"),
        }
        order.write_text(json.dumps(wanted))
        self._run.start("grafu.cli.finalize", [str(order)])

    def _shown(self, context):
        from grafu.errors import FunctionalizationError
        from grafu.export.files import add_files
        from grafu.visible import visible

        scene = bpy.data.scenes.get(self._scene)
        session = slots_in(scene)[self._slot] if scene is not None else None
        try:
            added = {"settings.json": self._run.folder / "settings.json"}
            if self._source.parent == self._run.folder:  # else it is the file that was given, where it was
                added["source.glb"] = self._source
            blend = {"model.blend": self._saved_blend()} if BLEND in self._formats else {}
            add_files(self._target, {**added, **blend}, {BLEND: tuple(blend)} if blend else {})
            report = json.loads((self._target / "report.json").read_text(encoding="utf-8"))
        except (OSError, RuntimeError, FunctionalizationError) as error:
            return self._refused(context, f"written to {self._target}, but not whole: {error}")
        if self.clean and session is not None:
            remove_boxes(session)
            for source in objects.sources_of(session):
                bpy.data.objects.remove(source)
            session.sources.clear()
        message = visible(f"written to {self._target}: {_verdict(report)}")
        if session is not None:
            session.status = message
        self.report({"INFO"}, message)
        return {"FINISHED"}

    def _saved_blend(self) -> Path:
        """Returns a `.blend` that this Blender wrote: no other is needed."""
        from grafu.export.blend.objects import save_object

        made = self._run.folder / "model.blend"
        save_object(self._run.result(), made)
        return made


def _verdict(report) -> str:
    from grafu.pipeline.words import counted

    joints = report["joints"]
    colliding = sum(joint["collision_share"] > 0 for joint in joints)
    return f"{counted(len(joints), 'joint')}, {colliding} collide, {len(report['skipped'])} left out"


CLASSES = (GRAFU_OT_finalize,)
