"""Running: every operator that changes what is built edits the settings, runs `grafu`, and shows what comes back.

A change that does not fit leaves everything as it was, and states why. In a window the run goes on behind it, with its
stage in the sidebar and Escape to stop it; without a window (and with `wait`) the operator waits.
"""

from dataclasses import replace

import bpy
from bpy.props import BoolProperty, EnumProperty

from . import objects, thumbnails, work
from .boxes import draw_boxes, remove_boxes
from .state import fill_slot, free_slot, report_of, session_of, settings_of, shown_slot, slot_of, store

MOTIONS = [
    ("auto", "Automatic", "The trained network, or the rule where there are no weights"),
    ("network", "Network", "The trained network"),
    ("rule", "Rule", "The rule-based baseline: names, boxes and handles"),
]
STATICS = [
    ("both", "Graph and geometry", "What the completed graph expects and what tests of the geometry find missing"),
    ("graph", "Graph", "Only what the completed graph expects"),
    ("geometry", "Geometry", "Only what tests of the geometry find missing"),
]
_TICK = 0.1  # seconds between looks at the process
_active = None


def active_run():
    """Returns the run that goes on behind the window, or None."""
    return _active


class Applies:
    """The base of all operators that start a run.

    Each states what it changes, `changed(context, settings)`, and may say what makes a change unfit.
    """

    bl_options = {"REGISTER", "UNDO"}
    _run = None
    _is_modal = False  # whether the window passes it events already
    wait: BoolProperty(name="Wait", description="Let the window wait for the result", options={"HIDDEN", "SKIP_SAVE"})

    @classmethod
    def poll(cls, context):
        """Whether it can be used now."""
        return _active is None and session_of(context).has_result

    def unfit(self, before, after):
        """Returns why the change does not fit, in words; empty where it does."""
        from grafu.pipeline.triage import lost

        return lost(before, after)

    def sources(self, context):
        """Returns the objects to work on."""
        return objects.sources_of(session_of(context))

    def file(self, context):
        """Returns the file to work on instead of objects, of a model that was opened; empty: the objects."""
        session = session_of(context)
        if session.fixed:
            raise work.Failed(session.fixed)
        return session.source_file

    def slot(self, context):
        """Returns the place of the model's session among those of the scene."""
        return shown_slot(context)

    def title(self, context):
        """Returns the model's name."""
        return report_of(session_of(context)).input.name

    def execute(self, context):
        """Runs; see the module."""
        from grafu.errors import FunctionalizationError

        work.warm()  # it starts while Blender's own imports go on
        try:
            self._scene, self._slot = context.scene.name, self.slot(context)
            self._settings = self.changed(context, settings_of(session_of(context)))
        except (FunctionalizationError, ValueError) as error:
            return self._refused(context, str(error))
        self._run = work.Run(self._settings)
        try:
            sources, self._file = list(self.sources(context)), self.file(context)
            self._names = [source.name for source in sources]  # what is undone meanwhile makes other objects of them
            title = bpy.path.clean_name(self.title(context)) or "model"
            self._run.source = objects.hand_over(context, sources, self._file, self._run.folder / f"{title}.glb")
            self._run.start()
        except (work.Failed, OSError, RuntimeError) as error:
            self._run.close()
            return self._refused(context, str(error))
        return self._launched(context)

    def _launched(self, context):
        global _active
        if bpy.app.background or self.wait:
            self._run.wait()
            return self._finish(context)
        _active = self._run
        self._timer = context.window_manager.event_timer_add(_TICK, window=context.window)
        if not self._is_modal:  # a second time, and Blender would free it twice
            context.window_manager.modal_handler_add(self)
            self._is_modal = True
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Looks at the process at every tick; Escape stops it."""
        if (event.type == "ESC" and event.value == "PRESS") or self._run.is_cancelled:
            self._end(context)
            return self._refused(context, "stopped")
        if event.type == "TIMER":
            _tell(context, f"GraFu: {self._run.doing}; Escape stops it")
            _redraw(context)
            if self._run.is_done:
                return self._finish(context)
        return {"PASS_THROUGH"}

    def cancel(self, context):
        """Ends with the window, where another file is opened; also called where the question is not answered."""
        if self._run is not None:
            self._end(context)

    def _finish(self, context):
        try:
            self._run.require_success()
            return self._shown(context)
        except work.Failed as error:
            return self._refused(context, str(error))
        finally:
            self._end(context)

    def _shown(self, context):
        from grafu.pipeline.report_schema import Report
        from grafu.pipeline.words import counted

        scene = bpy.data.scenes.get(self._scene)
        if scene is None:
            raise work.Failed("the scene is gone")
        session = fill_slot(scene, self._slot)
        before, after = report_of(session), Report.read_json(self._run.text("report.json"))
        unfit = "; ".join(self.unfit(before, after)) if before is not None else ""
        if unfit:
            return self._refused(context, unfit)
        made = self._run.result()
        session.sources.clear()
        for name in self._names:
            session.sources.add().object = bpy.data.objects.get(name)
        session.source_file = self._file
        objects.show_result(session, made, None if self._file else objects.place_of(after.frame.input_to_output))
        store(session, self._settings, self._run.text("report.json"), self._run.text("interior.json"), made)
        session.colours = False
        if remove_boxes(session):
            draw_boxes(session)
        joints, added = counted(len(after.joints), "joint"), counted(len(after.added), "added part")
        session.status = f"{joints}, {added}, {len(after.skipped)} left out"
        self.report({"INFO"}, session.status)
        thumbnails.begin()
        return {"FINISHED"}

    def _refused(self, context, why):
        from grafu.visible import visible

        why = visible(why)
        session_of(context).status = why
        self.report({"WARNING"}, why)
        return {"CANCELLED"}

    def _end(self, context):
        global _active
        if _active is self._run:
            _active = None
            context.window_manager.event_timer_remove(self._timer)
            _tell(context, None)
            _redraw(context)
        self._run.close()


def _tell(context, text):
    """Says something below the window, or no longer (None)."""
    if context.workspace is not None:
        context.workspace.status_text_set(text)


def _redraw(context):
    for area in context.screen.areas if context.screen else ():
        if area.type == "VIEW_3D":
            area.tag_redraw()


class GRAFU_OT_functionalize(Applies, bpy.types.Operator):
    """Makes the selected objects work: each is a part, its name states what. Objects of a model give that model anew"""

    bl_idname = "grafu.functionalize"
    bl_label = "Functionalize"

    motion: EnumProperty(name="Motions from", items=MOTIONS, options={"SKIP_SAVE"})
    keep: BoolProperty(
        name="Keep settings", description="Keep what was chosen for the model before", options={"SKIP_SAVE"}
    )
    statics: EnumProperty(name="Missing parts by", items=STATICS, default="both", options={"SKIP_SAVE"})
    small_parts: BoolProperty(
        name="Small parts", description="Knobs, buttons, wheels and casters get joints of their own"
    )

    @classmethod
    def poll(cls, context):
        """Whether parts are selected."""
        cls.poll_message_set("select the mesh objects of one piece of furniture, and let what runs end")
        return _active is None and bool(_selected(context))

    def sources(self, context):
        """Returns the selected objects."""
        return _selected(context)

    def file(self, context):
        """Returns none: the objects are worked on."""
        return ""

    def slot(self, context):
        """Returns the place of the model that the objects are of, or that of a new one."""
        scene = context.scene
        known = {slot_of(scene, one) for one in _selected(context)} - {None}
        if len(known) > 1:
            raise ValueError("the selected objects are of several models: select those of one")
        return known.pop() if known else free_slot(scene)

    def title(self, context):
        """Returns the name of what holds all the objects, a parent or a collection; else `model`."""
        return objects.common_holder(_selected(context))

    def changed(self, context, settings):
        """Returns fresh settings, or the ones before."""
        from grafu.additions.statics import Statics
        from grafu.pipeline.motion_source import MotionSource
        from grafu.pipeline.settings import Settings

        base = settings if self.keep else Settings()
        if not self.keep:
            base = replace(base, additions=replace(base.additions, statics=Statics(self.statics)))
        small = self.small_parts or base.small_parts
        return replace(base, motion=MotionSource(self.motion), small_parts=small)

    def unfit(self, before, after):
        """Nothing: it is another model."""
        return ()


def _selected(context):
    """Returns the selected meshes that are no result's: these say so in words, what our own GLB brings does not."""
    return [o for o in context.selected_objects if o.type == "MESH" and not isinstance(o.get("grafu"), str)]


class GRAFU_OT_run_again(Applies, bpy.types.Operator):
    """Functionalizes the same objects again, as they are now, with what was chosen"""

    bl_idname = "grafu.run_again"
    bl_label = "Run again"

    def changed(self, context, settings):
        """Returns the same settings."""
        return settings

    def unfit(self, before, after):
        """Nothing: the objects may have changed."""
        return ()


class GRAFU_OT_cancel(bpy.types.Operator):
    """Stops the run that goes on; everything stays as it was"""

    bl_idname = "grafu.cancel"
    bl_label = "Stop"

    @classmethod
    def poll(cls, context):
        """Whether one goes on."""
        return _active is not None

    def execute(self, context):
        """Stops it."""
        _active.is_cancelled = True
        return {"FINISHED"}


CLASSES = (GRAFU_OT_functionalize, GRAFU_OT_run_again, GRAFU_OT_cancel)


def stop():
    """Stops a run that goes on."""
    if _active is not None:
        _active.close()
