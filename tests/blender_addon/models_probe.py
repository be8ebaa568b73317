"""Several models in one scene: each has settings, result and compartments of its own. It asserts nothing.

Started as `python models_probe.py ADDON_PARENT SAMPLE FOLDER` by a Python that has `bpy` and `grafu`.
"""

import sys
from pathlib import Path

import bpy

addon_parent, sample, out = sys.argv[1:4]
sys.path.insert(0, addon_parent)

from probe_end import carry_out  # noqa: E402

import blender_addon  # noqa: E402
from blender_addon import boxes, objects, state  # noqa: E402

FACTS = []


def session():
    return state.session_of(bpy.context)


def activate(thing):
    bpy.context.view_layer.objects.active = thing


def choose(things):
    for one in bpy.context.view_layer.objects:
        one.select_set(one in things)


def meshes(collection) -> list:
    return [o for o in bpy.data.collections[collection].objects if o.type == "MESH"]


def models() -> list:
    """What every session of the scene holds."""
    found = []
    for one in state.slots_in(bpy.context.scene):
        collection = objects.result_collection(one)
        found.append(
            {
                "title": collection.name if collection else "",
                "objects": sorted(o.name for o in objects.result_objects(one)),
                "counts": {row.part: row.mechanism.split()[0] for row in one.joints},
                "sources": sorted(source.name for source in objects.sources_of(one)),
                "settings": one.settings_json,
                "boxes": len(boxes.boxes_of(one).objects) if boxes.boxes_of(one) else 0,
            }
        )
    return found


def note(step, result=None, **more):
    FACTS.append({"step": step, "result": list(result or []), "models": models(), "status": session().status, **more})


def bring(name, shift) -> list:
    """Imports the sample once more, in a collection of its own; returns its meshes."""
    known = set(bpy.data.objects)
    collection = bpy.data.collections.new(name)
    bpy.context.scene.collection.children.link(collection)
    bpy.ops.import_scene.gltf(filepath=sample)
    new = [o for o in bpy.data.objects if o not in known]
    for one in new:
        for holder in one.users_collection:
            holder.objects.unlink(one)
        collection.objects.link(one)
        if one.parent is None:
            one.location.x += shift
    bpy.context.view_layer.update()
    return [o for o in new if o.type == "MESH"]


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    blender_addon.register()
    grafu = bpy.ops.grafu
    left, right = bring("left chest", 0.0), bring("right chest", 2.0)
    camera = bpy.data.objects.new("camera", None)
    bpy.context.scene.collection.objects.link(camera)
    bpy.ops.ed.undo_push(message="start")
    for name, things in (("left", left), ("right", right)):
        choose(things)
        activate(things[0])
        note(name, grafu.functionalize("EXEC_DEFAULT", True, motion="rule"))
    right_part, left_part = session().joints[0].part, state.slots_in(bpy.context.scene)[0].joints[0].part
    shown = {}
    for key, thing in (("source", left[0]), ("lamp after it", camera), ("other", right[0]), ("nothing", None)):
        activate(thing)
        shown[key] = objects.result_collection(session()).name
    activate(objects.joint_empties(state.slots_in(bpy.context.scene)[0])[left_part])
    shown["joint"] = objects.result_collection(session()).name
    note("shown", shown=shown)
    note("change left", grafu.set_joint("EXEC_DEFAULT", True, part=left_part, scale=0.8))
    bpy.ops.ed.undo()
    note("undone")
    bpy.ops.ed.redo()
    note("redone")
    FACTS[-1]["shown"] = objects.result_collection(session()).name
    FACTS[-1]["active"] = bpy.context.view_layer.objects.active.get("child")
    grafu.show_compartments("EXEC_DEFAULT", True)
    note("boxes")
    for one in (*meshes("left chest"), *meshes("right chest")):  # an undo makes other objects of them
        one.hide_viewport = False
    choose([*meshes("left chest"), *meshes("right chest")])
    note("both", grafu.functionalize("EXEC_DEFAULT", True, motion="rule"))
    path = str(Path(out) / "room.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    note("opened again")
    bpy.ops.ed.undo_push(message="opened")
    grafu.choose_model("EXEC_DEFAULT", True, slot=1)
    note("chosen", shown=objects.result_collection(session()).name, right=right_part)
    note("removed", grafu.choose_model("EXEC_DEFAULT", True, slot=0) and grafu.remove_model("EXEC_DEFAULT", True))
    FACTS[-1]["hidden"] = [o.hide_viewport for o in meshes("left chest")]
    bpy.ops.ed.undo()
    note("removal undone")
    bpy.ops.ed.redo()
    note("right alone", grafu.run_again("EXEC_DEFAULT", True))
    choose(meshes("left chest"))
    note("left anew", grafu.functionalize("EXEC_DEFAULT", True, motion="rule"))
    old_file()


def old_file():
    """A scene as it was saved when it had one model: no session knows its collection."""
    while len(state.slots_in(bpy.context.scene)) > 1:
        state.clear_slot(bpy.context.scene, 1)
    only = bpy.context.scene.grafu
    for name in [c.name for c in bpy.context.scene.collection.children if c != only.collection and c.get("grafu")]:
        from grafu.export.blend.objects import remove_object

        remove_object(bpy.data.collections[name])
    only.property_unset("collection")
    activate(None)
    note("old file")
    note("old file goes on", bpy.ops.grafu.run_again("EXEC_DEFAULT", True))


carry_out(main, out, FACTS)
