"""Dragging in the 3D View: a joint opens within its limits; its widest opening and its border become requests.

A request is the one that the dialogs make: it is built at once where the button is let go, and can be undone.
"""

from dataclasses import replace

import bpy
from bpy.props import EnumProperty, FloatProperty, StringProperty

from . import objects, overlay
from .motion_operators import SIDES, USUAL
from .run_operators import Applies
from .state import session_of

OPEN, LIMIT, BORDER = "open", "limit", "border"
WHATS = [
    (OPEN, "Open", "How far it is open, within its limits"),
    (LIMIT, "Limit", "Its widest opening"),
    (BORDER, "Border", "The border that it turns about"),
]
_LEAST = {True: 0.05, False: 0.01}  # radians of what turns, metres of what slides: less is no opening
_MOST_TURN = 3.1415  # radians
_MOST_SLIDE = 2.0  # of the present travel
_SAME = 1e-3  # of a limit: nearer, and it is the one that holds


class GRAFU_OT_drag_joint(Applies, bpy.types.Operator):
    """Drag to open the joint, or to choose its widest opening or the border that it turns about"""

    bl_idname = "grafu.drag_joint"
    bl_label = "Drag joint"

    what: EnumProperty(name="What", items=WHATS, options={"SKIP_SAVE"})
    part: StringProperty(name="Part", description="Empty: that of the chosen row", options={"SKIP_SAVE"})
    value: FloatProperty(name="Value", description="Radians or metres", options={"SKIP_SAVE"})
    side: EnumProperty(name="Border", items=SIDES, options={"SKIP_SAVE"})
    _is_dragged = False

    def invoke(self, context, event):
        """Begins to drag."""
        from grafu.export.blend.grips import grips_of

        self._choose_part(context)
        empty = self._empty(context)
        grips = grips_of(empty) if empty is not None else None
        if grips is None or context.region_data is None:
            self.report({"WARNING"}, f"`{self.part}` has no joint that could be dragged")
            return {"CANCELLED"}
        self._grips, self._before = grips, (empty["open"], grips.upper)
        self.value = grips.upper if self.what == LIMIT else grips.value
        self._is_dragged = True
        _show(empty, self.what, self.value)
        context.window_manager.modal_handler_add(self)
        self._is_modal = True
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Follows the pointer; then looks at the process, as every run does."""
        if not self._is_dragged:
            return super().modal(context, event)
        if event.type == "MOUSEMOVE":
            self._follow(context, (event.mouse_region_x, event.mouse_region_y))
        elif event.type in ("ESC", "RIGHTMOUSE"):
            self._let_go(context)
            return {"CANCELLED"}
        elif event.type == "LEFTMOUSE" and event.value == "RELEASE":
            self._let_go(context)
            return self.execute(context)
        return {"RUNNING_MODAL"}

    def cancel(self, context):
        """Ends with the window."""
        if self._is_dragged:
            self._let_go(context)
        super().cancel(context)

    def execute(self, context):
        """Opens the joint, or builds the request."""
        from grafu.export.blend.joints import mute_joint

        self._choose_part(context)
        empty = self._empty(context)
        if empty is None or "open" not in empty:
            self.report({"WARNING"}, f"`{self.part}` has no joint that could be dragged")
            return {"CANCELLED"}
        if self.what == OPEN:
            mute_joint(empty)
            _open_to(empty, self.value)
            return {"FINISHED"}
        if self._is_as_before(context, empty):
            return {"CANCELLED"}
        return super().execute(context)

    def changed(self, context, settings):
        """Returns the settings with the limit or the border."""
        from grafu.joints.motion_choice import MotionChoice, Moves, Side
        from grafu.joints.plan import AUTOMATIC

        choice = settings.joints.get(self.part, AUTOMATIC)
        if self.what == LIMIT:
            return settings.with_joint(self.part, replace(choice, opening=round(self.value, 6)))
        if self.side == USUAL:
            raise ValueError(f"choose the border that `{self.part}` turns about")
        row = session_of(context).joints.get(self.part)
        settings = settings.with_joint(self.part, replace(choice, flipped=False))
        motion = MotionChoice(Moves.TURNS, Side(self.side), bool(row is not None and row.inwards))
        return settings.with_motion(self.part, motion)

    def unfit(self, before, after):
        """What else stood and is lost, and the joint itself where it is not built as dragged."""
        from grafu.pipeline.triage import lost, not_built

        return (*lost(before, after, besides=(self.part,)), *not_built(after, self.part))

    def _choose_part(self, context):
        row = session_of(context).active_joint
        self.part = self.part or (row.part if row else "")

    def _empty(self, context):
        return objects.joint_empties(session_of(context)).get(self.part)

    def _is_as_before(self, context, empty) -> bool:
        """Whether nothing was dragged anywhere."""
        if self.what == LIMIT:
            return abs(self.value - empty["upper"]) < _SAME * empty["upper"]
        row = session_of(context).joints.get(self.part)
        return row is not None and row.side == self.side

    def _follow(self, context, at) -> None:
        """Sets the value, or the border, that is under the pointer."""
        empty = self._empty(context)
        if empty is None:
            return
        if self.what == BORDER:
            self.side = nearest_border(context, empty, at) or self.side
            overlay.show_dragged(_border_in_world(empty, self.side))
        else:
            self.value = within(self._grips, self.what, self._grips.value_under(_ray(context, empty, at), self.value))
            _show(empty, self.what, self.value)
        context.area.tag_redraw()

    def _let_go(self, context) -> None:
        """Shows everything as it was before."""
        self._is_dragged = False
        overlay.show_dragged(())
        empty = self._empty(context)
        if empty is not None:
            empty["open"], empty["upper"] = self._before
            empty.update_tag()
        context.area.tag_redraw()


def within(grips, what: str, value: float) -> float:
    """Returns the nearest value that can be asked for: open within the limits, a limit that is an opening."""
    if what == OPEN:
        return min(max(value, grips.lower), grips.upper)
    most = _MOST_TURN if grips.turns else _MOST_SLIDE * grips.upper
    return min(max(value, grips.lower + _LEAST[grips.turns]), most)


def nearest_border(context, empty, at) -> str:
    """Returns the border of a joint's part whose middle is seen nearest to a point of the region; empty: none is."""
    from bpy_extras.view3d_utils import location_3d_to_region_2d
    from mathutils import Vector

    distances = {}
    for side, (one, other) in borders_in_world(empty).items():
        seen = location_3d_to_region_2d(context.region, context.region_data, (one + other) / 2.0)
        if seen is not None:
            distances[side] = (seen - Vector(at)).length
    return min(distances, key=distances.get, default="")


def borders_in_world(empty) -> dict:
    """Returns the borders that a joint's part could turn about, by side: two points of the world each."""
    from mathutils import Vector

    from grafu.export.blend.grips import borders_of

    link, found = borders_of(empty)
    return {side.value: tuple(link.matrix_world @ Vector(end) for end in ends) for side, ends in found.items()}


def _border_in_world(empty, side: str) -> tuple:
    return borders_in_world(empty).get(side, ())


def _ray(context, empty, at):
    """Returns what is under a point of the region as a ray in the frame of a joint's empty."""
    from bpy_extras.view3d_utils import region_2d_to_origin_3d, region_2d_to_vector_3d

    from grafu.geometry.axis import Axis

    M = empty.matrix_world.inverted()
    start = region_2d_to_origin_3d(context.region, context.region_data, at)
    towards = M.to_3x3() @ region_2d_to_vector_3d(context.region, context.region_data, at)
    return Axis(tuple(M @ start), tuple(towards))


def _show(empty, what: str, value: float) -> None:
    """Shows the joint while it is dragged: open, or wide open at the limit."""
    from grafu.export.blend.joints import mute_joint

    mute_joint(empty)
    if what == LIMIT:
        empty["upper"], empty["open"] = value, 1.0
        empty.update_tag()
    elif what == OPEN:
        _open_to(empty, value)


def _open_to(empty, value: float) -> None:
    """Opens a joint to a value, radians or metres, within its limits."""
    from grafu.export.blend.joints import set_open

    lower, upper = empty["lower"], empty["upper"]
    set_open(empty, min(max((value - lower) / (upper - lower), 0.0), 1.0) if upper > lower else 0.0)


CLASSES = (GRAFU_OT_drag_joint,)
