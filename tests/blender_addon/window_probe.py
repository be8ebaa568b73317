"""Uses the add-on in a real Blender window as a user would; writes what it saw. It asserts nothing."""

import json
import os
import signal
from pathlib import Path

import bpy
from window_hand import ARGUMENTS, FOLDER, Hand, play

import blender_addon
from blender_addon import (
    addition_operators,
    interior_operators,
    joint_operators,
    lists,
    motion_operators,
    panels,
    run_operators,
    work,
)

FACTS: dict = {"version": list(bpy.app.version)}
DIALOGS = ("set_joint", "set_handle", "set_top", "furnish", "set_label", "set_motion")


def script():
    panels.GRAFU_PT_parts.bl_options = panels.GRAFU_PT_assets.bl_options = set()  # open, so that they are drawn
    hand = Hand()
    hand.watch(panels.CLASSES, lists.CLASSES)
    for module in (joint_operators, motion_operators, addition_operators, interior_operators):
        hand.watch_questions(module.CLASSES)
    blender_addon.register()
    for one in list(bpy.data.objects):
        bpy.data.objects.remove(one)
    bpy.ops.import_scene.gltf(filepath=ARGUMENTS[0])
    for one in bpy.data.objects:
        one.select_set(one.type == "MESH")
        if one.name == "door_1":
            one["grafu"] = {"role": "part"}  # as in a GLB that grafu wrote
    hand.call(bpy.ops.ed.undo_push, message="loaded")
    yield from hand.open_tab("GRAFU_PT_main")
    yield from stopped(hand)
    yield from functionalized(hand)
    yield from changed(hand)
    yield from asked(hand)
    yield from shown(hand)
    yield from finalized(hand)
    yield from left(hand)
    FACTS["drawn"], FACTS["faults"] = hand.drawn, hand.faults
    Path(FOLDER, "facts.json").write_text(json.dumps(FACTS))


def session():
    return panels.session_of(bpy.context)


def running():
    return run_operators.active_run() is not None


def hold(signal_number=signal.SIGSTOP):
    """Lets the process pause amid a run, or go on: what happens meanwhile does not hang on how fast it is."""
    os.kill(work._staying._running.pid, signal_number)


def stopped(hand):
    """Escape during a run."""
    hand.call(bpy.ops.grafu.functionalize, motion="rule")
    hold()
    yield 0.5
    FACTS["was running"] = running()
    yield from hand.press("ESC")
    FACTS["stopped"] = [running(), session().status, session().has_result]


def functionalized(hand):
    """A run to its end; what it works on is undone and done again meanwhile."""
    before = hand.drawn["GRAFU_PT_main"]
    FACTS["began"] = hand.call(bpy.ops.grafu.functionalize, motion="rule")
    hold()
    yield 0.8
    FACTS["can begin another"] = bpy.ops.grafu.functionalize.poll()
    hold(signal.SIGCONT)
    yield from hand.wait_while(running)
    yield 1.0
    FACTS["drawn while it ran"] = hand.drawn["GRAFU_PT_main"] - before
    FACTS["ended"] = [session().status, len(session().joints), len(session().sources)]
    if not session().has_result:
        raise RuntimeError(f"no result: {session().status}")


def changed(hand):
    """A change that fits, with undo pressed while it is made; and one that does not."""
    hand.call(bpy.ops.grafu.set_joint, "EXEC_DEFAULT", part="door_1", template="piano")
    hold()
    yield 0.3
    hand.call(bpy.ops.ed.undo_push, message="something else")
    hand.call(bpy.ops.ed.undo)
    hold(signal.SIGCONT)
    yield from hand.wait_while(running)
    yield 1.0
    row = next(row for row in session().joints if row.part == "door_1")
    alive = [one.object is not None and one.object.name in bpy.data.objects for one in session().sources]
    FACTS["changed"] = [row.mechanism, row.changed, all(alive)]
    hand.call(bpy.ops.grafu.set_joint, "EXEC_DEFAULT", part="door_1", mechanism="P")
    yield from hand.wait_while(running)
    yield 0.5
    row = next(row for row in session().joints if row.part == "door_1")
    FACTS["unfit"] = [row.mechanism, session().status]


def asked(hand):
    """Every operator that asks opens its question; Escape closes it and changes nothing."""
    before = session().settings_json
    for name in DIALOGS:
        hand.call(getattr(bpy.ops.grafu, name))
        yield 0.5
        yield from hand.press("ESC")
    FACTS["asked"] = [running(), session().settings_json == before]


def shown(hand):
    """All that is looked at."""
    for what in ("all", "solo", "closed", "animation"):
        hand.call(bpy.ops.grafu.preview, "EXEC_DEFAULT", what=what)
        yield 0.2
    for on in (True, False):
        hand.call(bpy.ops.grafu.colours, "EXEC_DEFAULT", on=on)
        yield 0.2
        hand.call(bpy.ops.grafu.show_sources, "EXEC_DEFAULT", on=on)
        yield 0.2
        hand.call(bpy.ops.grafu.show_compartments, "EXEC_DEFAULT")
        yield 0.2
    hand.picture("shown")


def finalized(hand):
    """Files, from the window."""
    hand.call(bpy.ops.grafu.finalize, "EXEC_DEFAULT", directory=FOLDER, name="final", formats={"glb"})
    yield from hand.wait_while(running)
    yield 0.5
    FACTS["finalized"] = [session().status, sorted(path.name for path in Path(FOLDER, "final").iterdir())]


def left(hand):
    """Another file is opened while a run goes on."""
    hand.call(bpy.ops.grafu.run_again)
    hold()
    yield 0.3
    FACTS["left a run"] = running()
    bpy.ops.wm.read_homefile(use_empty=True)
    yield 0.5
    FACTS["after another file"] = [running(), session().has_result]


play(script())
