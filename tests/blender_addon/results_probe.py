"""Folders of results opened in a Blender without a window, changed, and refused. It asserts nothing.

Started as `python results_probe.py ADDON_PARENT SAMPLE FOLDER` by a Python that has `bpy` and `grafu`; FOLDER holds
results in `out/` and broken ones in `bad/`.
"""

import sys
from pathlib import Path

import bpy

addon_parent, _, out = sys.argv[1:4]
sys.path.insert(0, addon_parent)

from probe_end import carry_out  # noqa: E402

import blender_addon  # noqa: E402
from blender_addon import objects, state  # noqa: E402

FACTS = []


def session():
    return state.session_of(bpy.context)


def things() -> list:
    """Every object of the model that is shown: what it is, and its size."""
    return sorted(
        [o["grafu"], o["id"], o.get("upper", 0.0), len(o.data.polygons) if o.data else 0]
        for o in objects.result_objects(session())
    )


def place() -> list:
    """Where the model stands that is shown."""
    return [round(v, 4) for v in objects.root_of(session()).matrix_world.translation] if session().has_result else []


def note(step, result, **more):
    bpy.context.view_layer.update()
    fact = {
        "step": step,
        "result": list(result),
        "status": session().status,
        "things": things(),
        "rows": {row.part: [row.level, row.mechanism] for row in session().joints},
        "models": sum(one.has_result for one in state.slots_in(bpy.context.scene)),
        "place": place(),
    }
    FACTS.append(fact | more)


def opened(folder):
    return bpy.ops.grafu.open_result("EXEC_DEFAULT", True, directory=str(Path(out, folder)))


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    blender_addon.register()
    scene, grafu = bpy.context.scene, bpy.ops.grafu
    bpy.ops.ed.undo_push(message="start")
    for folder in sorted(p.name for p in Path(out, "bad").iterdir()):
        note(f"bad {folder}", opened(f"bad/{folder}"))
    note("many", opened("out"))
    scene.cursor.location = (3.0, 1.0, 0.0)
    note("chest", opened("out/chest"), **opened_facts())
    bpy.ops.ed.undo()
    note("undone", [])
    bpy.ops.ed.redo()
    note("redone", [])
    grafu.preview(what="all")
    FACTS[-1]["open"] = {part: e["open"] for part, e in objects.joint_empties(session()).items()}
    note("sources", grafu.show_sources("EXEC_DEFAULT", True, on=True))
    objects.root_of(session()).location.x = 5.0
    part = session().joints[0].part
    note("changed", grafu.set_joint("EXEC_DEFAULT", True, part=part, count=2))
    note("again", grafu.run_again("EXEC_DEFAULT", True))
    path = str(Path(out) / "opened.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    note("goes on", bpy.ops.grafu.reset_joint("EXEC_DEFAULT", True, part=part))
    final = {"directory": str(Path(out, "final")), "name": "done", "formats": {"glb"}}
    note("finalized", bpy.ops.grafu.finalize("EXEC_DEFAULT", True, **final))
    note("reopened", opened("final/done"))
    bpy.ops.ed.undo_push(message="reopened")
    note("compartments", bpy.ops.grafu.show_compartments("EXEC_DEFAULT", True), boxes=boxes())
    bpy.ops.ed.undo()
    note("compartments undone", [], boxes=boxes())
    note("sourceless", opened("sourceless"))
    note("sourceless changed", bpy.ops.grafu.set_joint("EXEC_DEFAULT", True, part=part, count=2))


def boxes() -> int:
    """How many compartments of the model that is shown stand in the scene as boxes."""
    return len(session().boxes.objects) if session().boxes is not None else 0


def opened_facts() -> dict:
    scene = bpy.context.scene
    scene.frame_set(50)
    wide = {part: round(empty["open"], 4) for part, empty in objects.joint_empties(session()).items()}
    scene.frame_set(0)
    return {"frame 50": wide, "end": scene.frame_end}


carry_out(main, out, FACTS)
