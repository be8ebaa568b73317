"""Runs the add-on's operators in a Blender without a window; prints one JSON line per step. It asserts nothing.

Started as `python operators_probe.py ADDON_PARENT SAMPLE FOLDER` by a Python that has `bpy` and `grafu`.
"""

import sys
from pathlib import Path
from time import perf_counter

import bpy

addon_parent, sample, out = sys.argv[1:4]
sys.path.insert(0, addon_parent)

from probe_end import carry_out  # noqa: E402
from stepping import FACTS, session, snapshot, step  # noqa: E402

import blender_addon  # noqa: E402
from blender_addon import objects, state  # noqa: E402


def values() -> dict:
    return {part: round(e["open"], 4) for part, e in objects.joint_empties(session()).items()}


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    began = perf_counter()
    blender_addon.register()
    FACTS.append({"step": "register", "seconds": perf_counter() - began, "torch": "torch" in sys.modules})
    bpy.ops.import_scene.gltf(filepath=sample)
    for one in bpy.data.objects:
        one.select_set(one.type == "MESH")
    bpy.ops.ed.undo_push(message="start")
    grafu = bpy.ops.grafu
    step("functionalize", grafu.functionalize, motion="rule")
    FACTS[-1]["hidden"] = all(o.hide_viewport for o in objects.sources_of(session()))
    FACTS[-1]["places"] = places()
    for mechanism in "CFP":
        step(f"class {mechanism}", grafu.set_joint, part="door_1", mechanism=mechanism)
    step("template", grafu.set_joint, part="door_1", template="piano")
    step("count", grafu.set_joint, part="door_1", count=3, scale=0.8)
    step("opening", grafu.set_joint, part="door_1", opening=1.0)
    step("unfit", grafu.set_joint, part="door_1", mechanism="corner-mount")
    step("reset joint", grafu.reset_joint, part="door_1")
    step("rail", grafu.set_joint, part="drawer_1", mechanism="corner-mount")
    step("restyle", grafu.set_handle, part="drawer_1", style="knob-round", count=2)
    step("remove handle", grafu.set_handle, part="door_2", style="none")
    step("grip", grafu.set_handle, part="door_2", style="grip")
    step("handle back", grafu.reset_handle, part="drawer_1")
    step("top", grafu.set_top, shape="rounded", thickness=0.03)
    step("furnish", grafu.furnish, number=0, shelves=1)
    step("too many", grafu.furnish, number=0, shelves=20)
    step("label", grafu.set_label, part="door_2", label="misc")
    step("label as read", grafu.set_label, part="door_2", as_read=True)
    step("compartments", grafu.show_compartments)
    boxes = [o for o in bpy.data.objects if o.get("grafu") == "compartment"]
    FACTS[-1]["boxes"] = [len(o.data.edges) for o in boxes]
    FACTS[-1]["compartments"] = [[list(o.matrix_world @ v.co) for v in o.data.vertices] for o in boxes]
    FACTS[-1]["named at"] = [list(o.matrix_world.translation) for o in boxes]
    FACTS[-1]["found"] = [one["corners"] for one in state.compartments_of(session())]
    view(grafu)
    saved(grafu)
    without_top(grafu)
    step("finalize", grafu.finalize, directory=out, name="final", formats={"glb", "urdf", "blend"})
    blender_addon.unregister()
    blender_addon.register()
    blender_addon.unregister()
    FACTS.append({"step": "unregister", "gone": not hasattr(bpy.types.Scene, "grafu")})


def without_top(grafu):
    """Another model from the same objects: without its top and shelves, and with a modifier on its door."""
    grafu.show_sources(on=True)
    FACTS.append({"step": "sources", "hidden": [o.hide_viewport for o in objects.sources_of(session())]})
    for one in objects.sources_of(session()):
        one.select_set(not one.name.startswith(("top_panel", "shelf")))
        if one.name == "door_2":
            one.modifiers.new("half", "DECIMATE").ratio = 1.0
            one.modifiers.new("bevel", "BEVEL").width = 0.002
    bpy.ops.ed.undo_push(message="chosen")
    step("topless", grafu.functionalize, motion="rule")
    FACTS[-1]["bevelled"] = len(objects.visual(session(), "door_2").data.vertices)
    FACTS[-1]["sources"] = len(objects.sources_of(session()))
    step("again", grafu.run_again)
    FACTS[-1]["bevelled"] = len(objects.visual(session(), "door_2").data.vertices)
    top = next((row.part for row in session().additions if row.about.startswith("top")), "")
    step("rounded top", grafu.set_top, shape="rounded", thickness=0.03)
    FACTS[-1]["thick"] = round(objects.visual(session(), top).dimensions.z, 4) if top else 0.0
    step("no top", grafu.set_top, add=False)
    step("top again", grafu.set_top, add=True)
    step("reject top", grafu.set_addition, part=top, accepted=False)
    step("accept top", grafu.set_addition, part=top, accepted=True)
    box = next(o for o in bpy.data.objects if o.get("grafu") == "compartment" and o["number"] == 0)
    for one in bpy.context.view_layer.objects:
        one.select_set(one == box)
    step("selected box", grafu.furnish, shelves=2, thickness=0.012)
    step("own box", grafu.furnish, number=1, shelves=1)
    step("no such box", grafu.furnish, number=40, shelves=1)


def view(grafu):
    scene = bpy.context.scene
    before = {m.name for o in objects.result_objects(session()) for m in [s.material for s in o.material_slots] if m}
    grafu.colours(on=True)
    coloured = {s.material.name for o in objects.result_objects(session()) for s in o.material_slots}
    grafu.colours(on=False)
    after = {m.name for o in objects.result_objects(session()) for m in [s.material for s in o.material_slots] if m}
    fact = {"step": "view", "coloured": sorted(coloured), "materials_back": before == after}
    for what in ("all", "closed"):
        grafu.preview(what=what)
        fact[what] = values()
    grafu.preview(what="solo", part="door_2")
    fact["solo"] = values()
    fact["moved"] = moved("door_2")
    grafu.preview(what="animation")
    scene.frame_set(50)
    fact["frame 50"] = values()
    scene.frame_set(0)
    bpy.context.view_layer.objects.active = objects.visual(session(), "handle_5") or objects.visual(session(), "door_2")
    grafu.pick_joint()
    fact["picked"] = session().active_joint.part
    session().joint_index = 0
    fact["selected"] = [o["id"] for o in bpy.context.selected_objects]
    fact["first"] = session().joints[0].part
    FACTS.append(fact)


def moved(part) -> float:
    """How far the middle of a part is from where it is closed."""
    bpy.context.view_layer.update()
    now = middle(objects.visual(session(), part))
    bpy.ops.grafu.preview(what="closed")
    bpy.context.view_layer.update()
    return (now - middle(objects.visual(session(), part))).length


def middle(one):
    from mathutils import Vector

    return sum((one.matrix_world @ Vector(corner) for corner in one.bound_box), Vector()) / 8


def places() -> float:
    """The farthest that a part stands from its source."""
    bpy.context.view_layer.update()
    pairs = ((o, objects.visual(session(), o.name)) for o in objects.sources_of(session()))
    return max((middle(a) - middle(b)).length for a, b in pairs if b is not None)


def saved(grafu):
    """Saves the file, opens it again and goes on."""
    before = snapshot()
    path = str(Path(out) / "session.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    FACTS.append({"step": "opened again", "same": snapshot() == before, "sources": len(objects.sources_of(session()))})
    bpy.ops.ed.undo_push(message="opened")
    step("goes on", grafu.set_joint, part="door_1", count=4)


carry_out(main, out, FACTS)
