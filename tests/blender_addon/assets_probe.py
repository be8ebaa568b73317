"""Templates from the asset browser, and what is dragged in the 3D View, in a Blender without a window. Asserts nothing.

Started as `python assets_probe.py ADDON_PARENT SAMPLE FOLDER` by a Python that has `bpy` and `grafu`.
"""

import sys
from pathlib import Path

import bpy

addon_parent, sample, out = sys.argv[1:4]
sys.path.insert(0, addon_parent)

from probe_end import carry_out  # noqa: E402
from stepping import FACTS, session, step  # noqa: E402

import blender_addon  # noqa: E402
from blender_addon import asset_operators, drag_operators, gizmos, objects, thumbnails  # noqa: E402


def libraries() -> list:
    return [one.path for one in bpy.context.preferences.filepaths.asset_libraries]


def marked() -> dict:
    """What the library holds: by the kind and id of a template, the object that Blender offers."""
    path = Path(asset_operators.registered_library().path) / "templates.blend"
    with bpy.data.libraries.load(str(path), assets_only=True) as (there, taken):
        taken.objects = there.objects
    return {f"{one['kind']}-{one['id']}": one for one in taken.objects}


def stated(one) -> dict:
    pixels = list(one.preview.image_pixels_float)
    heights = [corner[2] for corner in one.bound_box]
    shown = one.instance_collection.all_objects if one.instance_collection else ()
    return {
        "name": one.name,
        "size": list(one.preview.image_size),
        "shown": max(pixels) > min(pixels),
        "catalog": one.asset_data.catalog_id,
        "tags": sorted(one.asset_data.tags.keys()),
        "stands": [min(heights), max(heights)],
        "joints": sum(o.get("grafu") == "joint" for o in shown),
    }


def drop(thing, part):
    """Drops an asset in front of a part."""
    bpy.context.scene.collection.objects.link(thing)
    on = objects.visual(session(), part)
    middle = sum((on.matrix_world @ v.co for v in on.data.vertices), on.matrix_world.translation * 0)
    thing.location = middle / len(on.data.vertices)
    thing.location.y -= 0.02
    bpy.context.view_layer.update()
    bpy.context.view_layer.objects.active = thing
    bpy.ops.ed.undo_push(message="dropped")
    return thing.name


def use(title, one, part):
    name = drop(one, part)
    step(title, bpy.ops.grafu.use_asset)
    FACTS[-1]["dropped is there"] = name in bpy.data.objects


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    blender_addon.register()
    grafu, before = bpy.ops.grafu, libraries()
    known = bpy.types.GizmoGroup.bl_rna_get_subclass_py(gizmos.CLASSES[0].__name__) is not None
    FACTS.append({"step": "before", "can remove": grafu.remove_assets.poll(), "gizmos": known})
    grafu.add_assets()
    first = set(libraries()) - set(before)
    grafu.add_assets()
    folder = Path(asset_operators.registered_library().path)
    FACTS.append({"step": "added", "new": [len(first), len(libraries()) - len(before)]})
    FACTS[-1]["files"] = sorted(path.name for path in folder.iterdir())
    FACTS[-1]["catalogs"] = (folder / "blender_assets.cats.txt").read_text()
    FACTS[-1]["left behind"] = [len(bpy.data.objects), len(bpy.data.scenes), len(bpy.data.images)]
    pictures()
    FACTS.append({"step": "marked", "assets": {key: stated(one) for key, one in marked().items()}})
    bpy.ops.import_scene.gltf(filepath=sample)
    for one in bpy.data.objects:
        one.select_set(one.type == "MESH" and one.name in bpy.context.view_layer.objects)
    bpy.ops.ed.undo_push(message="start")
    step("functionalize", grafu.functionalize, motion="rule")
    FACTS[-1]["can use"] = grafu.use_asset.poll()
    use("handle", marked()["handle-knob-round"], "drawer_1")
    use("hinge", marked()["hinge-piano"], "door_1")
    use("rail on a door", marked()["rail-centre_mount"], "door_1")
    dragged(grafu)
    grafu.remove_assets()
    FACTS.append({"step": "removed", "libraries": libraries() == before, "files": list(map(str, folder.iterdir()))})
    blender_addon.unregister()


def pictures():
    """The pictures of the dialogs, as a process draws them; without a window Blender makes no icons of them."""
    run = thumbnails.started()
    run.wait()
    before = thumbnails.how_many()
    thumbnails.take(run.folder)
    run.close()
    sizes = {key: list(one.image_size) for key, one in thumbnails._pictures.items()}
    FACTS.append({"step": "pictures", "before": before, "sizes": sizes, "gone": not run.folder.exists()})


def dragged(grafu):
    step("limit", grafu.drag_joint, what="limit", part="door_1", value=0.7)
    step("limit again", grafu.drag_joint, what="limit", part="door_1", value=0.7)
    step("limit of a drawer", grafu.drag_joint, what="limit", part="drawer_1", value=0.15)
    step("open", grafu.drag_joint, what="open", part="door_1", value=0.35)
    FACTS[-1]["open"] = objects.joint_empties(session())["door_1"]["open"]
    step("border", grafu.drag_joint, what="border", part="door_1", side="right")
    step("broad face", grafu.drag_joint, what="border", part="door_1", side="front")
    step("no joint", grafu.drag_joint, what="limit", part="back_panel", value=0.5)
    empty = objects.joint_empties(session())["door_1"]
    FACTS[-1]["borders"] = sorted(drag_operators.borders_in_world(empty))


carry_out(main, out, FACTS)
