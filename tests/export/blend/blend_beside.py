"""Builds objects in a Blender that holds other things, and takes them out: `python blend_beside.py OBJECT OUT`."""

import json
import os
import sys
from pathlib import Path

import bpy
import numpy as np

from grafu.articulation.articulated_object import JointLimits
from grafu.export.blend.joints import mute_joint, set_limits, set_open
from grafu.export.blend.objects import build_object, remove_object, save_object
from grafu.export.blend.process import unpacked

KINDS = ("objects", "meshes", "materials", "images", "actions", "collections", "node_groups", "scenes")


def _counts() -> dict:
    return {kind: sorted(one.name for one in getattr(bpy.data, kind)) for kind in KINDS}


def _poses(built) -> dict:
    graph = bpy.context.evaluated_depsgraph_get()
    return {link: np.array(o.evaluated_get(graph).matrix_world).tolist() for link, o in built.links.items()}


def _refused(empty, ratio: float) -> bool:
    try:
        set_open(empty, ratio)
    except ValueError:
        return True
    return False


def _run(path: str) -> dict:
    articulated = unpacked(Path(path).read_bytes())
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    own = bpy.data.objects.new("door_1", None)  # another's, of our door's name
    scene.collection.objects.link(own)
    before = _counts()
    first, second = build_object(articulated, scene), build_object(articulated, scene)
    with_two = _counts()
    theirs = bpy.data.objects.new("theirs", bpy.data.meshes.new("theirs"))
    scene.collection.objects.link(theirs)
    theirs.data.materials.append(first.visuals["handle_1"].data.materials[0])
    hinge, rail = second.joints["door_1_hinge"], second.joints["drawer_1_rail"]
    mute_joint(hinge)
    set_open(hinge, 0.5)
    scene.frame_set(50)
    muted = _poses(second)
    others = _poses(first)
    mute_joint(hinge, False)
    scene.frame_set(50)
    unmuted = _poses(second)
    scene.frame_set(0)
    set_open(rail, 1.0)
    bpy.context.view_layer.update()
    by_hand = _poses(second)
    set_limits(hinge, JointLimits(0.0, 0.7))
    scene.frame_set(50)
    limited = _poses(second)
    found = {
        "refused": [_refused(hinge, 1.5), _refused(second.links["door_1"], 0.5), _refused(own, 0.5)],
        "names": [first.visuals["door_1"].name, second.visuals["door_1"].name],
        "ids": [first.visuals["door_1"]["id"], second.visuals["door_1"]["id"]],
    }
    remove_object(second.collection)
    with_one = _counts()
    remove_object(first.collection)
    after = _counts()
    save_object(articulated, Path(path).with_name("saved.blend"))
    saved = _counts()
    return found | {
        "before": before,
        "with_two": with_two,
        "with_one": with_one,
        "after": after,
        "saved": saved,
        "muted": muted,
        "others": others,
        "unmuted": unmuted,
        "by_hand": by_hand,
        "limited": limited,
    }


if __name__ == "__main__":
    Path(sys.argv[2]).write_text(json.dumps(_run(sys.argv[1])))
    os._exit(0)
