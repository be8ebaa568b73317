"""Blender's objects for and from a run: the selection as GLB, the result in its place, parts and joints found again.

Results are found by their custom properties (docs/exports.md, `model.blend`), never by their names.
"""

import json
import shutil
from pathlib import Path

import bpy
import mathutils

KIND, ID = "grafu", "id"  # custom properties
OBJECT, LINK, JOINT = "object", "link", "joint"  # values of the property `grafu`
_UP = mathutils.Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))  # glTF's Y up to Blender's Z up


def sources_of(session) -> list:
    """Returns the objects that were handed over and still are there."""
    return [row.object for row in session.sources if row.object is not None]


def common_holder(things) -> str:
    """Returns the name of the collection that holds all objects, else of what all hang on; else `model`."""
    held = set(things[0].users_collection).intersection(*(thing.users_collection for thing in things))
    named = sorted(c.name for c in held if not c.is_embedded_data and c.name != "Collection")  # Blender's first one
    parents = [_ancestors(thing) for thing in things]
    shared = [parent.name for parent in parents[0] if all(parent in others for others in parents)]
    return (*named, *reversed(shared), "model")[0]


def _ancestors(thing) -> list:
    return [thing.parent, *_ancestors(thing.parent)] if thing.parent is not None else []


def hand_over(context, sources, file: str, path: Path) -> Path:
    """Writes mesh objects to `path`, a GLB, and returns it; or a copy of the GLB in `file`; or `file`, of another form.

    Raises:
        OSError: if the file is gone, or there are no objects.
    """
    if not file:
        if not sources:
            raise OSError("the objects that were handed over are gone")
        export_sources(context, sources, path)
        return path
    given = Path(bpy.path.abspath(file))
    if not given.exists():
        raise OSError(f"the input of this result is gone: {given}")
    return Path(shutil.copyfile(given, path)) if given.suffix.lower() == ".glb" else given


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


def place_of(input_to_output):
    """Returns the pose of a result that stands where its sources do."""
    return _UP @ mathutils.Matrix(input_to_output).inverted()


def show_result(session, articulated, place) -> None:
    """Puts a model's result where `place` states (None: where the one before stands), and hides its sources."""
    from grafu.export.blend.objects import build_object

    scene, marked = session.id_data, _marked(session)
    place = root_of(session).matrix_world.copy() if place is None else place
    if not remove_result(session) and not any(c.get(KIND) == OBJECT for c in scene.collection.children):
        _set_frames(scene)
    built = build_object(articulated, scene)
    session.collection = built.collection
    root_of(session).matrix_world = place
    for source in sources_of(session):
        source.hide_viewport = source.hide_render = True
    _mark_again(session, *marked)


def _marked(session):
    """Returns kind and id of the result's objects that are selected, and of the active one."""
    layer = session.id_data.view_layers[0]
    own = {one: (one.get(KIND), one.get(ID)) for one in result_objects(session)}
    return {key for one, key in own.items() if one.select_get(view_layer=layer)}, own.get(layer.objects.active)


def _mark_again(session, selected, active) -> None:
    """Selects in a new result what was selected in the one before."""
    layer = session.id_data.view_layers[0]
    for one in result_objects(session):
        key = (one.get(KIND), one.get(ID))
        if key in selected:
            one.select_set(True, view_layer=layer)
        if key == active:
            layer.objects.active = one


def remove_result(session) -> bool:
    """Takes a model's result out of Blender; returns whether there was one."""
    from grafu.export.blend.objects import remove_object

    old = result_collection(session)
    if old is not None:
        remove_object(old)
    return old is not None


def _set_frames(scene) -> None:
    """Sets the length of the cycle and goes to its first frame, where everything is closed."""
    from grafu.export.blend.layout import FIRST_FRAME, LAST_FRAME

    scene.frame_start, scene.frame_end = FIRST_FRAME, LAST_FRAME
    scene.frame_set(FIRST_FRAME)


def result_collection(session):
    """Returns the collection of a model's result, or None."""
    if session.collection is None and session.has_result:  # a file of the time when a scene had one model
        return next((c for c in session.id_data.collection.children if c.get(KIND) == OBJECT), None)
    return session.collection


def result_objects(session) -> list:
    """Returns all objects of a model's result."""
    collection = result_collection(session)
    return list(collection.all_objects) if collection is not None else []


def root_of(session):
    """Returns the empty of the result's root link: moving it moves the model."""
    return next(
        o for o in result_objects(session) if o.get(KIND) == LINK and (o.parent is None or KIND not in o.parent)
    )


def joint_empties(session) -> dict:
    """Returns the empties of the result's joints by the id of the part that moves."""
    return {o["child"]: o for o in result_objects(session) if o.get(KIND) == JOINT}


def visual(session, part: str):
    """Returns the mesh object of a part or piece of hardware, or None."""
    kinds = ("part", "added", "hardware")
    return next((o for o in result_objects(session) if o.get(ID) == part and o.get(KIND) in kinds), None)


def joint_part_of(session, thing) -> str:
    """Returns the id of the moving part whose joint an object of the result is of; empty: of none.

    It hangs on the joint, or is the still half of its hardware, which bears the part's name.
    """
    part = moving_part_of(thing)
    if part or thing is None or thing.get(KIND) != "hardware":
        return part
    _, named = thing[ID].split("_", 1)
    return max((p for p in joint_empties(session) if named.startswith(f"{p}_")), key=len, default="")


def nearest_part(session, point) -> str:
    """Returns the id of the door or drawer whose surface is nearest to a point of the world; empty: there is none."""
    found = {row.part: visual(session, row.part) for row in session.joints}
    distances = {part: _distance(thing, point) for part, thing in found.items() if thing is not None}
    return min(distances, key=distances.get, default="")


def _distance(thing, point) -> float:
    found, nearest, _, _ = thing.closest_point_on_mesh(thing.matrix_world.inverted() @ point)
    return (thing.matrix_world @ nearest - point).length if found else float("inf")


def moving_part_of(thing) -> str:
    """Returns the id of the moving part whose joint carries an object of the result; empty: it is static."""
    while thing is not None:
        if thing.get(KIND) == JOINT:
            return thing["child"]
        thing = thing.parent
    return ""


def waits_for(session, part: str) -> list:
    """Returns the parts that must be open before one can move, the farthest first."""
    empties = joint_empties(session)
    by_joint = {empty[ID]: child for child, empty in empties.items()}
    found = []
    for joint in json.loads(empties[part]["after"]):
        child = by_joint[joint]
        found += [*waits_for(session, child), child]
    return list(dict.fromkeys(found))


def select_part(context, session, part: str) -> None:
    """Selects the object of a part, and nothing else."""
    found = visual(session, part)
    for one in context.view_layer.objects:
        one.select_set(False)
    if found is not None and found.name in context.view_layer.objects:
        found.select_set(True)
        context.view_layer.objects.active = found
