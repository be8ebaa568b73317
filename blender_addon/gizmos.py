"""Handles in the 3D View for the chosen joint: an arrow that opens it, one for its limit, a dot for its border.

They only show where these are, and start `grafu.drag_joint`.
"""

import bpy
from mathutils import Matrix, Vector

from . import objects
from .drag_operators import BORDER, LIMIT, OPEN, borders_in_world
from .overlay import COLOURS
from .run_operators import active_run
from .state import session_of

_LENGTHS = {OPEN: 0.6, LIMIT: 0.9}  # of an arrow, in Blender's unit for these
_SIZE = 0.16  # of the dot
_ALPHA, _BRIGHT = 0.75, 1.0
_NOW = (1.0, 1.0, 1.0)
_BORDER = (0.35, 0.7, 1.0)


class GRAFU_GGT_joint(bpy.types.GizmoGroup):
    """The handles of the chosen joint."""

    bl_idname = "GRAFU_GGT_joint"
    bl_label = "GraFu joint"
    bl_space_type = "VIEW_3D"
    bl_region_type = "WINDOW"
    bl_options = {"3D", "PERSISTENT", "SHOW_MODAL_ALL"}

    @classmethod
    def poll(cls, context):
        """Whether a joint is chosen that can be seen, and nothing runs."""
        return context.scene.grafu_overlay and active_run() is None and draggable(context) is not None

    def setup(self, context):
        """Makes them."""
        self._arrows = {OPEN: self._arrow(OPEN, "NORMAL", _NOW), LIMIT: self._arrow(LIMIT, "BOX", COLOURS["ok"][:3])}
        self._dot = self._started("GIZMO_GT_move_3d", BORDER, _BORDER)
        self._dot.draw_style, self._dot.draw_options = "RING_2D", {"FILL", "ALIGN_VIEW"}
        self._dot.scale_basis = _SIZE

    def draw_prepare(self, context):
        """Puts them where the joint is now."""
        from grafu.export.blend.grips import grips_of

        empty = draggable(context)
        grips = grips_of(empty) if empty is not None else None
        for one in self.gizmos:
            one.hide = grips is None
        if grips is None:
            return
        for what, value in ((OPEN, grips.value), (LIMIT, grips.upper)):
            self._arrows[what].matrix_basis = _along(empty, grips.point_at(value), grips.direction_at(value))
        place = border_place(context, empty)
        self._dot.hide = place is None
        if place is not None:
            self._dot.matrix_basis = Matrix.Translation(place)

    def _arrow(self, what, style, colour):
        made = self._started("GIZMO_GT_arrow_3d", what, colour)
        made.draw_style, made.length = style, _LENGTHS[what]
        return made

    def _started(self, kind, what, colour):
        made = self.gizmos.new(kind)
        made.target_set_operator("grafu.drag_joint").what = what
        made.color, made.alpha = colour, _ALPHA
        made.color_highlight, made.alpha_highlight = colour, _BRIGHT
        made.use_draw_modal = True
        return made


def draggable(context):
    """Returns the empty of the chosen joint where it moves by itself and something of it is selected, else None."""
    session, active = session_of(context), context.active_object
    row = session.active_joint if session.has_result else None
    if row is None or active is None or not active.select_get():
        return None
    if objects.joint_part_of(session, active) != row.part:
        return None
    empty = objects.joint_empties(session).get(row.part)
    if empty is None or "open" not in empty or "leader" in empty or not empty.visible_get():
        return None
    return empty


def border_place(context, empty):
    """Returns where the dot for the border stands, in the world; None where the part does not turn about one."""
    row = session_of(context).joints.get(empty["child"])
    ends = borders_in_world(empty).get(row.side) if row is not None and row.moves == "turns" else None
    return (ends[0] + ends[1]) / 2.0 if ends else None


def _along(empty, point, direction):
    """Returns the pose of an arrow in the world: from a point, its Z along a direction, both in a joint's frame."""
    M = empty.matrix_world
    towards = (M.to_3x3() @ Vector(direction)).to_track_quat("Z", "Y")
    return Matrix.Translation(M @ Vector(point)) @ towards.to_matrix().to_4x4()


CLASSES = (GRAFU_GGT_joint,)
