"""Axes, arcs and the eyedropper in a real Blender window; writes what it saw. It asserts nothing."""

import json
from pathlib import Path
from time import perf_counter

import bpy
from window_hand import ARGUMENTS, FOLDER, Hand, play

import blender_addon
from blender_addon import objects, overlay, state

FACTS: dict = {}


def session():
    return state.session_of(bpy.context)


def script():
    blender_addon.register()
    hand = Hand()
    for one in list(bpy.data.objects):
        bpy.data.objects.remove(one)
    bpy.context.preferences.view.smooth_view = 0
    hand.call(bpy.ops.grafu.open_result, "EXEC_DEFAULT", directory=ARGUMENTS[0])
    FACTS["joints"] = len(session().joints)
    yield 0.5
    hand.call(bpy.ops.view3d.view_all)
    yield 1.5
    hand.picture("on")
    bpy.context.scene.grafu_overlay = False
    yield 1.0
    hand.picture("off")
    bpy.context.scene.grafu_overlay = True
    hand.call(bpy.ops.grafu.preview, "EXEC_DEFAULT", what="all")
    yield 1.0
    hand.picture("open")
    began = perf_counter()
    FACTS["strokes"] = len(overlay.strokes(bpy.context))
    FACTS["seconds"] = perf_counter() - began
    picked(hand)
    Path(FOLDER, "facts.json").write_text(json.dumps(FACTS))
    yield 0.1


def picked(hand):
    """The eyedropper on each object of the result, through the window's own context."""
    found = {}
    for one in objects.result_objects(session()):
        if one.type == "MESH":
            bpy.context.view_layer.objects.active = one
            session().is_filling = True
            session().joint_index = 0
            session().is_filling = False
            result = hand.call(bpy.ops.grafu.pick_joint, "EXEC_DEFAULT")
            found[one["id"]] = session().active_joint.part if result == "FINISHED" else ""
    FACTS["picked"] = found


play(script())
