"""Handles of a joint dragged in a real Blender window, pictures in its dialogs; writes what it saw. Asserts nothing."""

import json
from pathlib import Path

import bpy
from mathutils import Euler, Vector
from window_hand import ARGUMENTS, FOLDER, Hand, play

import blender_addon
from blender_addon import (
    addition_operators,
    drag_operators,
    gizmos,
    joint_operators,
    objects,
    panels,
    run_operators,
    thumbnails,
)

FACTS: dict = {}
PART = "door_1"
_ABOVE = Euler((0.9, 0.0, 0.4))


def session():
    return panels.session_of(bpy.context)


def empty():
    return objects.joint_empties(session())[PART]


def running():
    return run_operators.active_run() is not None


def script():
    hand = Hand()
    hand.watch_questions(joint_operators.CLASSES)
    hand.watch_questions(addition_operators.CLASSES)
    blender_addon.register()
    for one in list(bpy.data.objects):
        bpy.data.objects.remove(one)
    bpy.context.preferences.view.smooth_view = 0
    bpy.ops.import_scene.gltf(filepath=ARGUMENTS[0])
    for one in bpy.data.objects:
        one.select_set(one.type == "MESH")
    hand.call(bpy.ops.ed.undo_push, message="loaded")
    hand.call(bpy.ops.grafu.functionalize, motion="rule")
    yield from hand.wait_while(running)
    yield 0.5
    view(hand)
    session().joint_index = next(k for k, row in enumerate(session().joints) if row.part == PART)
    yield 1.0
    hand.picture("handles")
    FACTS["limits"] = [empty()["upper"]]
    yield from opened(hand)
    yield from narrowed(hand)
    yield from rehung(hand)
    yield from pictures(hand)
    FACTS["faults"] = hand.faults
    Path(FOLDER, "facts.json").write_text(json.dumps(FACTS))


def view(hand):
    """The model from above and from the right, so that doors open towards the eye."""
    space = hand.area.spaces[0]
    space.region_3d.view_rotation = _ABOVE.to_quaternion()
    hand.call(bpy.ops.view3d.view_all, "EXEC_DEFAULT")
    space.region_3d.view_distance *= 1.6


def seen(hand, point):
    """Where a point of the world is seen, pixels from the window's lower left corner."""
    from bpy_extras.view3d_utils import location_3d_to_region_2d

    region = hand.region("WINDOW")
    at = location_3d_to_region_2d(region, hand.area.spaces[0].region_3d, Vector(point))
    return int(region.x + at.x), int(region.y + at.y)


def grip(value, beyond=0.0):
    """Where the grip of the door is at a value, in the world; `beyond`: metres along the arrow there."""
    from grafu.export.blend.grips import grips_of

    found = grips_of(empty())
    return empty().matrix_world @ Vector(found.point_at(value) + beyond * found.direction_at(value))


def drag(hand, start, end):
    """Drags from one place of the window to another."""
    hand.event("MOUSEMOVE", at=(start[0] - 40, start[1] - 40))
    yield 0.2
    hand.event("MOUSEMOVE", at=start)
    yield 0.5
    hand.event("LEFTMOUSE", "PRESS", start)
    yield 0.2
    for k in range(1, 9):
        at = tuple(round(a + (b - a) * k / 8) for a, b in zip(start, end, strict=True))
        hand.event("MOUSEMOVE", at=at)
        yield 0.1
    hand.event("LEFTMOUSE", "RELEASE", end)
    yield 0.5


def opened(hand):
    """The arrow that opens the door, half way; then closed by undo."""
    hand.call(bpy.ops.ed.undo_push, message="before")
    start, end = seen(hand, grip(0.0, 0.05)), seen(hand, grip(0.8))
    yield from drag(hand, start, end)
    FACTS["opened"] = [empty()["open"] * empty()["upper"], empty()["upper"]]
    hand.picture("opened")
    hand.call(bpy.ops.ed.undo)
    yield 0.3
    FACTS["undone"] = empty()["open"]


def narrowed(hand):
    """The arrow of the widest opening, drawn back; then Escape amid another drag."""
    upper = empty()["upper"]
    yield from drag(hand, seen(hand, grip(upper, 0.05)), seen(hand, grip(0.9)))
    yield from hand.wait_while(running)
    yield 0.5
    FACTS["limits"].append(empty()["upper"])
    FACTS["status"] = session().status
    choice = json.loads(session().settings_json)["joints"]
    FACTS["asked for"] = choice[PART]["opening"]


def rehung(hand):
    """The dot on the border, dragged to the other side."""
    place = gizmos.border_place(bpy.context, empty())
    ends = drag_operators.borders_in_world(empty())
    FACTS["side"] = [session().joints[PART].side]
    other = {"left": "right", "right": "left"}[FACTS["side"][0]]
    yield from drag(hand, seen(hand, place), seen(hand, (ends[other][0] + ends[other][1]) / 2))
    yield from hand.wait_while(running)
    yield 0.5
    FACTS["side"].append(session().joints[PART].side)


def pictures(hand):
    """The pictures in the dialogs; they are drawn behind the window as soon as there is a result."""
    yield from hand.wait_while(lambda: not thumbnails.how_many())
    icons = [item[3] for item in addition_operators.handle_items(None, bpy.context)]
    FACTS["icons"] = [len(icons), len({icon for icon in icons if isinstance(icon, int)})]
    for name in ("set_handle", "set_joint"):
        hand.call(getattr(bpy.ops.grafu, name), part=PART)
        yield 0.8
        hand.picture(name)
        yield from hand.press("ESC")
    FACTS["drawn"] = hand.drawn


play(script())
