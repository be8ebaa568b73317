"""Axes and arcs over the 3D view: each joint in the colour of its level, the chosen one bold. It computes no line."""

import bpy
from bpy.props import BoolProperty

from . import objects
from .state import session_of, slots_in
from .versions import line_shader

COLOURS = {"ok": (0.25, 0.85, 0.35, 0.9), "warning": (1.0, 0.7, 0.1, 0.95), "error": (1.0, 0.2, 0.15, 1.0)}
_NOW = (1.0, 1.0, 1.0, 0.95)
_THIN, _BOLD = 1.5, 4.0  # pixels
_DRAGGED = (0.35, 0.7, 1.0, 1.0)
_handle = None
_dragged: tuple = ()  # ends of the line that is dragged to, in the world


def show_dragged(ends) -> None:
    """Shows a line while something is dragged: its ends in the world; none: no longer."""
    global _dragged
    _dragged = tuple(ends)


def strokes(context) -> list:
    """Returns what is drawn: colour, width in pixels, and the ends of its lines in the world, for each joint."""
    from grafu.export.blend.marks import marks_of

    found, shown = [], session_of(context)
    for session in slots_in(context.scene):
        levels = {row.part: row.level for row in session.joints}
        chosen = session.active_joint.part if session == shown and session.active_joint else ""
        for part, empty in objects.joint_empties(session).items():
            marks = marks_of(empty) if empty.visible_get() else None
            if marks is None:
                continue
            width = _BOLD if part == chosen else _THIN
            colour = COLOURS[levels.get(part, "ok")]
            parts = [(colour, width, (*marks.axis, *marks.range)), (_NOW, width, marks.now)]
            found += [(paint, wide, _in_world(empty, pairs)) for paint, wide, pairs in parts]
    return [*found, (_DRAGGED, _BOLD, [tuple(end) for end in _dragged])] if _dragged else found


def _in_world(empty, pairs) -> list:
    from mathutils import Vector

    return [tuple(empty.matrix_world @ Vector(point)) for pair in pairs for point in pair]


def _draw():
    from gpu import state
    from gpu_extras.batch import batch_for_shader

    context = bpy.context
    if not (context.scene.grafu_overlay and context.space_data.overlay.show_overlays):
        return
    shader = line_shader()
    state.depth_test_set("NONE")  # what lies behind a door is seen, too
    state.blend_set("ALPHA")
    for colour, width, ends in strokes(context):
        shader.bind()
        shader.uniform_float("viewportSize", (context.region.width, context.region.height))
        shader.uniform_float("lineWidth", width)
        shader.uniform_float("color", colour)
        batch_for_shader(shader, "LINES", {"pos": ends}).draw(shader)
    state.blend_set("NONE")


def attach():
    """Gives every scene its switch; in a window, draws."""
    global _handle
    bpy.types.Scene.grafu_overlay = BoolProperty(
        name="Axes and ranges",
        description="Shows each joint's axis, its range, and in white how far it is open; the chosen joint is bold",
        default=True,
    )
    if not bpy.app.background:
        _handle = bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_VIEW")


def detach():
    """Takes both back."""
    global _handle
    if _handle is not None:
        bpy.types.SpaceView3D.draw_handler_remove(_handle, "WINDOW")
        _handle = None
    del bpy.types.Scene.grafu_overlay
