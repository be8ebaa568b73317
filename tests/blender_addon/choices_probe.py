"""Runs what is decided by hand about motions, mounts, supports and tops in a Blender without a window. Asserts nothing.

Started as `python choices_probe.py ADDON_PARENT SAMPLES FOLDER` by a Python that has `bpy` and `grafu`.
"""

import sys
from pathlib import Path
from types import SimpleNamespace

import bpy

addon_parent, samples, out = sys.argv[1:4]
sys.path.insert(0, addon_parent)

from probe_end import carry_out  # noqa: E402
from stepping import FACTS, session, step  # noqa: E402

import blender_addon  # noqa: E402
from blender_addon import joint_operators, motion_operators, objects, state  # noqa: E402
from grafu.joints.motion_choice import choice_in_words  # noqa: E402
from grafu.vocabulary import MOTION_WORDS  # noqa: E402


def bring(name):
    """Takes a sample as objects, all selected, in an empty file."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(Path(samples) / f"{name}.glb"))
    for one in bpy.data.objects:
        one.select_set(one.type == "MESH")
    bpy.ops.ed.undo_push(message="start")


def hardware(start) -> list:
    return sorted(o["id"] for o in objects.result_objects(session()) if o.get("id", "").startswith(start))


def offered(part, mechanism="auto") -> list:
    """What a dialog's menus offer for a part: classes and templates."""
    question = SimpleNamespace(asked=True, part=part, mechanism=mechanism)
    menus = (joint_operators.class_items, joint_operators.template_items)
    return [[item[0] for item in menu(question, bpy.context)] for menu in menus]


def chosen_as(word) -> list:
    """What the menus choose for a word of the command, as they offer it: how the part moves then, and the side."""
    choice = choice_in_words(word)
    moves = [item[0] for item in motion_operators.MOVES if item[0] == choice.moves.value]
    sides = [item[0] for item in motion_operators.SIDES if item[0] == (choice.side or motion_operators.USUAL)]
    question = SimpleNamespace(part="door_1", moves=moves[0], side=sides[0], inwards=False)
    change = motion_operators.GRAFU_OT_set_motion.changed
    made = change(question, bpy.context, state.settings_of(session())).motions["door_1"]
    return [made.moves.value, made.side.value if made.side else None, made.inwards]


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    blender_addon.register()
    grafu = bpy.ops.grafu
    bring("sideboard")
    step("functionalize", grafu.functionalize, motion="rule")
    step("reject", grafu.set_motion, part="door_1", moves="fixed")
    FACTS[-1]["row"] = next(row.mechanism for row in session().joints if row.part == "door_1")
    step("hang right", grafu.set_motion, part="door_1", moves="turns", side="right")
    step("flap", grafu.set_motion, part="door_1", moves="turns", side="bottom")
    FACTS[-1]["words"] = {word: chosen_as(word) for word in MOTION_WORDS}
    step("tilts", grafu.set_motion, part="door_1", moves="tilts")
    step("rises on arms", grafu.set_motion, part="door_1", moves="lifts")
    step("slides left", grafu.set_motion, part="door_1", moves="slides", side="left")
    step("no border", grafu.set_motion, part="door_1", moves="turns")
    step("broad face", grafu.set_motion, part="door_1", moves="turns", side="front")
    step("wall slides", grafu.set_motion, part="back_panel", moves="slides", side="back")
    step("no_one", grafu.set_motion, part="no_one", moves="fixed")
    step("as found", grafu.reset_motion, part="door_1")
    active = objects.visual(session(), "door_1")
    bpy.context.view_layer.objects.active = active
    step("active", grafu.set_motion, moves="fixed")
    step("as found again", grafu.reset_motion, part="door_1")
    step("mount", grafu.set_joint, part="door_1", mount="divider_1")
    step("far mount", grafu.set_joint, part="door_1", mount="back_panel")
    step("moving mount", grafu.set_joint, part="door_1", mount="door_2")
    step("hinge supports", grafu.set_joint, part="door_1", supports="slab")
    step("drawn", grafu.set_joint, part="door_1", asked=True, own_count=False, count=4, limited=True, angle=0.8)
    FACTS[-1]["offered"] = {part: offered(part) for part in ("door_1", "drawer_1")}
    FACTS[-1]["of class P"] = offered("door_1", "P")[1]
    step("drawn back", grafu.reset_joint, part="door_1")
    step("replace top", grafu.set_top, replaces=True, thickness=0.04)
    step("old top", grafu.set_top)
    step("divider", grafu.furnish, number=0, shelves=0, dividers=1, thickness=0.012, inset=0.05)
    bring("dresser")
    step("dresser", grafu.functionalize, motion="rule")
    FACTS[-1]["supports"] = hardware("support_drawer_1")
    for supports in ("none", "slab", "divider"):
        step(f"supports {supports}", grafu.set_joint, part="drawer_1", supports=supports)
        FACTS[-1]["supports"] = hardware("support_drawer_1")
        FACTS[-1]["tallest"] = max(
            (objects.visual(session(), name).dimensions.z for name in FACTS[-1]["supports"]), default=0.0
        )
    step("finalize", grafu.finalize, directory=out, name="final", formats={"glb"})
    blender_addon.unregister()


carry_out(main, out, FACTS)
