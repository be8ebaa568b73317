"""Blender's objects for and from a run: the selection as GLB, the result in its place, parts and joints found again.

Results are found by their custom properties (docs/exports.md, `model.blend`), never by their names.
"""

import json

import bpy
import mathutils

from .state import ID, KIND, session_of

OBJECT, JOINT = "object", "joint"  # values of the property `grafu`
_UP = mathutils.Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))  # glTF's Y up to Blender's Z up


def sources_of(session) -> list:
    """Returns the objects that were handed over and still are there."""
    return [row.object for row in session.sources if row.object is not None]


def export_sources(context, objects, path) -> None:
    """Writes mesh objects to a GLB as they stand in the world, modifiers applied, with names and materials.

    Each is a root of its own in the file, whatever it hangs on in the scene: each object is a part.
    """
    copies, meshes = [], []
    hidden = [original for original in objects if original.hide_viewport]
    for original in hidden:
        original.hide_viewport = False  # what is hidden has no modifiers applied
    context.view_layer.update()
    graph = context.evaluated_depsgraph_get()
    scene = bpy.data.scenes.new("grafu export")
    names = {}
    try:
        for original in objects:
            mesh = bpy.data.meshes.new_from_object(original.evaluated_get(graph), depsgraph=graph)
            copy = bpy.data.objects.new(original.name, mesh)
            copy.matrix_world = original.matrix_world
            scene.collection.objects.link(copy)
            copies.append(copy)
            meshes.append(mesh)
            names[copy] = original
        _swap_names(names)
        with context.temp_override(scene=scene, view_layer=scene.view_layers[0]):
            bpy.ops.export_scene.gltf(
                filepath=str(path),
                export_format="GLB",
                use_active_scene=True,
                export_animations=False,
                export_extras=False,
                export_yup=True,
            )
    finally:
        for original in hidden:
            original.hide_viewport = True
        _swap_names(names)
        for copy in copies:
            bpy.data.objects.remove(copy)
        for mesh in meshes:
            bpy.data.meshes.remove(mesh)
        bpy.data.scenes.remove(scene)


def _swap_names(names) -> None:
    """Exchanges the names of copies and originals: Blender gives no two objects the same one."""
    for copy, original in names.items():
        copied, named = copy.name, original.name
        copy.name, original.name = "grafu swap", copied
        copy.name = named


def show_result(context, articulated, input_to_output) -> None:
    """Puts a result where its sources stand, in the place of the one before; the sources are hidden."""
    from grafu.export.blend.objects import build_object, remove_object

    old = result_collection(context.scene)
    if old is not None:
        remove_object(old)
    else:
        _set_frames(context.scene)
    built = build_object(articulated, context.scene)
    T = _UP @ mathutils.Matrix(input_to_output).inverted()
    root = next(empty for empty in built.links.values() if empty.parent is None)
    root.matrix_world = T
    for source in sources_of(session_of(context)):
        source.hide_viewport = source.hide_render = True


def _set_frames(scene) -> None:
    """Sets the length of the cycle and goes to its first frame, where everything is closed."""
    from grafu.export.blend.layout import FIRST_FRAME, LAST_FRAME

    scene.frame_start, scene.frame_end = FIRST_FRAME, LAST_FRAME
    scene.frame_set(FIRST_FRAME)


def result_collection(scene):
    """Returns the collection of the scene's result, or None."""
    return next((c for c in scene.collection.children if c.get(KIND) == OBJECT), None)


def result_objects(scene) -> list:
    """Returns all objects of the scene's result."""
    collection = result_collection(scene)
    return list(collection.all_objects) if collection is not None else []


def joint_empties(scene) -> dict:
    """Returns the empties of the result's joints by the id of the part that moves."""
    return {o["child"]: o for o in result_objects(scene) if o.get(KIND) == JOINT}


def visual(scene, part: str):
    """Returns the mesh object of a part or piece of hardware, or None."""
    kinds = ("part", "added", "hardware")
    return next((o for o in result_objects(scene) if o.get(ID) == part and o.get(KIND) in kinds), None)


def moving_part_of(thing) -> str:
    """Returns the id of the moving part whose joint carries an object of the result; empty: it stands still."""
    while thing is not None:
        if thing.get(KIND) == JOINT:
            return thing["child"]
        thing = thing.parent
    return ""


def waits_for(scene, part: str) -> list:
    """Returns the parts that must be open before one can move, the farthest first."""
    empties = joint_empties(scene)
    by_joint = {empty[ID]: child for child, empty in empties.items()}
    found = []
    for joint in json.loads(empties[part]["after"]):
        child = by_joint[joint]
        found += [*waits_for(scene, child), child]
    return list(dict.fromkeys(found))


def select_part(context, part: str) -> None:
    """Selects the object of a part, and nothing else."""
    found = visual(context.scene, part)
    for one in context.view_layer.objects:
        one.select_set(False)
    if found is not None and found.name in context.view_layer.objects:
        found.select_set(True)
        context.view_layer.objects.active = found
