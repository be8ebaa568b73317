"""Uses the add-on in a real Blender window step by step, and keeps what the screen shows; it runs inside Blender.

Beside each `NAME.xwd` stands `NAME.json`: `box`, the rectangle that matters (left, top, width, height, pixels; null:
what differs from the picture before it), and `whole`: whether it is a sidebar, whose empty rest does not matter.
"""

import json
import sys
from pathlib import Path

import bpy
from mathutils import Euler
from window_hand import ARGUMENTS, FOLDER, Hand, play

import blender_addon
from blender_addon import lists, objects, panels, run_operators, thumbnails

SOURCE, *LEFT_OUT = ARGUMENTS
_VIEW = Euler((1.2, 0.0, 0.5))  # from the front, a little from the right and from above
_AMID = 0.3  # of a run
_AJAR = 0.4
_TO_PICTURE = (0, -130)  # pixels from the pointer to the picture in a dialog that opens below it
_OPEN = 1.25  # how much more room it takes when it is open
_only: set = set()  # names of the panels that are drawn; empty: all


def script():
    for panel in panels.CLASSES:
        _let_hide(panel)
    panels.GRAFU_PT_parts.bl_options = set()
    blender_addon.register()
    bpy.context.preferences.system.use_region_overlap = False
    hand = Hand()
    hand.watch(panels.CLASSES, lists.CLASSES)
    load()
    yield from stage(hand)
    yield from hand.open_tab("GRAFU_PT_main")
    yield from run(hand)
    yield from look(hand)
    yield from refine(hand)
    yield from add(hand)
    yield from end(hand)
    yield from beside(hand)
    if hand.faults:
        sys.exit("\n".join(hand.faults))


def _let_hide(panel):
    asked = panel.poll if "poll" in dir(panel) else None

    def poll(cls, context):
        return (not _only or cls.__name__ in _only) and (asked is None or asked(context))

    panel.poll = classmethod(poll)


def load():
    """The model's parts, and nothing else in the scene."""
    for one in list(bpy.data.objects):
        bpy.data.objects.remove(one)
    bpy.ops.import_scene.gltf(filepath=SOURCE)
    for one in list(bpy.data.objects):
        if one.type == "MESH" and one.name.startswith(tuple(LEFT_OUT)) and LEFT_OUT:
            bpy.data.objects.remove(one)
        else:
            one.select_set(one.type == "MESH")


def stage(hand):
    """A plain view of the model, its materials' colours on it."""
    space = hand.area.spaces[0]
    space.overlay.show_cursor = space.overlay.show_floor = False
    space.overlay.show_axis_x = space.overlay.show_axis_y = space.overlay.show_object_origins = False
    space.overlay.show_relationship_lines = False
    space.shading.color_type = "MATERIAL"
    view = space.region_3d
    view.view_rotation, view.view_perspective = _VIEW.to_quaternion(), "PERSP"
    yield 0.3
    hand.call(bpy.ops.view3d.view_selected, "EXEC_DEFAULT", use_all_regions=True)
    yield 0.5
    view.view_distance *= _OPEN
    yield 0.3


def run(hand):
    keep(hand, "start", hand.area)
    hand.call(bpy.ops.grafu.functionalize)
    yield from hand.wait_while(lambda: running() and run_operators.active_run().ratio < _AMID)
    yield 0.2
    keep(hand, "running", hand.region("UI"), whole=True)
    yield from hand.wait_while(running)
    yield from hand.wait_while(lambda: not thumbnails.how_many())
    yield 0.6


def look(hand):
    """The result, open; the overview; colours by category."""
    deselect()
    hand.call(bpy.ops.grafu.preview, "EXEC_DEFAULT", what="all")
    yield 0.5
    keep(hand, "result", hand.area)
    yield from panel(hand, "joints", {"GRAFU_PT_main", "GRAFU_PT_joints"})
    hand.call(bpy.ops.grafu.colours, "EXEC_DEFAULT", on=True)
    yield 0.4
    keep(hand, "categories_seen", hand.area)
    yield from panel(hand, "show", {"GRAFU_PT_view"})
    hand.call(bpy.ops.grafu.colours, "EXEC_DEFAULT", on=False)
    hand.call(bpy.ops.grafu.preview, "EXEC_DEFAULT", what="closed")
    hand.call(bpy.ops.grafu.preview, "EXEC_DEFAULT", what="solo")
    deselect()
    yield 0.5
    keep(hand, "overlay", hand.area)
    session = panels.session_of(bpy.context)
    hand.call(bpy.ops.grafu.preview, "EXEC_DEFAULT", what="solo", ratio=_AJAR)
    objects.select_part(bpy.context, session, session.active_joint.part)
    hand.event("MOUSEMOVE", at=(5, 5))
    yield 0.7
    keep(hand, "handles", hand.area)
    deselect()


def refine(hand):
    """The questions about one joint, and how its part moves."""
    rows = panels.session_of(bpy.context).joints
    part = next((row.part for row in rows if row.type == "revolute"), rows[0].part)
    sliding = next((row.part for row in rows if row.type == "prismatic"), part)
    hand.call(bpy.ops.grafu.preview, "EXEC_DEFAULT", what="closed")
    yield 0.3
    bpy.context.scene.grafu_overlay = False
    yield 0.3
    yield from question(hand, "hinges", bpy.ops.grafu.set_joint, part=part)
    yield from question(hand, "rails", bpy.ops.grafu.set_joint, part=sliding)
    yield from question(hand, "handle", bpy.ops.grafu.set_handle, part=part)
    yield from question(hand, "motion", bpy.ops.grafu.set_motion, part=part)
    yield from all_templates(hand, part)


def add(hand):
    """What was added; top; compartments."""
    yield from panel(hand, "added", {"GRAFU_PT_additions", "GRAFU_PT_interior"})
    yield from question(hand, "top", bpy.ops.grafu.set_top)
    hand.call(bpy.ops.grafu.preview, "EXEC_DEFAULT", what="all")
    hand.call(bpy.ops.grafu.show_compartments, "EXEC_DEFAULT")
    boxes = [one for one in bpy.data.objects if one.get("grafu") == "compartment"]
    for one in boxes[:1]:
        one.select_set(True)
    yield 0.5
    keep(hand, "compartments", hand.area)
    yield from question(hand, "furnish", bpy.ops.grafu.furnish)
    hand.call(bpy.ops.grafu.show_compartments, "EXEC_DEFAULT")
    deselect()
    bpy.context.scene.grafu_overlay = True


def end(hand):
    yield from panel(hand, "categories", {"GRAFU_PT_parts", "GRAFU_PT_output"})


def beside(hand):
    """What Finalize asks; what it wrote, opened beside the model."""
    preferences = bpy.context.preferences.view
    preferences.filebrowser_display_type = "SCREEN"
    hand.call(bpy.ops.grafu.finalize)
    yield from hand.wait_while(lambda: browser_of(hand) is None)
    yield 1.0
    browser = browser_of(hand)
    asked = next(region for region in browser.regions if region.type == "TOOL_PROPS")
    keep(hand, "finalize", asked, whole=True)
    yield from hand.press("ESC", (browser.x + browser.width // 2, browser.y + browser.height // 2))
    hand.call(bpy.ops.grafu.finalize, "EXEC_DEFAULT", directory=FOLDER, name="final", formats={"glb"})
    yield from hand.wait_while(running)
    things = [one for one in bpy.context.view_layer.objects if one.type == "MESH" and one.visible_get()]
    width = max(one.dimensions.x for one in things)
    bpy.context.scene.cursor.location.x = 1.3 * width
    hand.call(bpy.ops.grafu.open_result, "EXEC_DEFAULT", directory=str(Path(FOLDER, "final")))
    panels.session_of(bpy.context).status = ""  # it names a temporary folder
    for one in bpy.context.view_layer.objects:
        one.select_set(one.type == "MESH" and one.visible_get())
    hand.call(bpy.ops.view3d.view_selected, "EXEC_DEFAULT", use_all_regions=True)
    deselect()
    for _ in range(3):  # panels glide to their places
        hand.area.tag_redraw()
        yield 0.7
    keep(hand, "beside", hand.area)


def browser_of(hand):
    """The file browser, or None."""
    return next((area for area in hand.window.screen.areas if area.type == "FILE_BROWSER"), None)


def running():
    return run_operators.active_run() is not None


def deselect():
    for one in bpy.context.view_layer.objects:
        one.select_set(False)


def panel(hand, name, shown):
    """Keeps the sidebar with these panels alone."""
    _only.update(shown)
    hand.area.tag_redraw()
    yield 0.5
    keep(hand, name, hand.region("UI"), whole=True)
    _only.clear()
    hand.area.tag_redraw()
    yield 0.3


def question(hand, name, operator, **arguments):
    """Keeps a question as it is asked."""
    at = hand.area.x + hand.area.width // 3, hand.area.y + 2 * hand.area.height // 3
    hand.event("MOUSEMOVE", at=at)
    yield 0.2
    keep(hand, f"{name}_before", hand.area)
    hand.call(operator, **arguments)
    yield 0.6
    keep(hand, name, None)
    yield from hand.press("ESC", at)


def all_templates(hand, part):
    """All handles, as a click on the picture in the dialog shows them."""
    at = hand.area.x + hand.area.width // 2, hand.area.y + hand.area.height // 2
    hand.event("MOUSEMOVE", at=at)
    yield 0.2
    keep(hand, "templates_before", hand.area)
    hand.call(bpy.ops.grafu.set_handle, part=part)
    yield 0.6
    yield from hand.press("LEFTMOUSE", tuple(a + b for a, b in zip(at, _TO_PICTURE, strict=True)))
    yield 0.6
    keep(hand, "templates", None)
    yield from hand.press("ESC", at)
    yield from hand.press("ESC", at)


def keep(hand, name, rectangle, whole=False):
    """Keeps the screen, and which of it matters."""
    hand.picture(name)
    height = hand.window.height
    r = rectangle
    box = None if r is None else [r.x, height - r.y - r.height, r.width, r.height]
    Path(FOLDER, f"{name}.json").write_text(json.dumps({"box": box, "whole": whole}))


play(script())
