"""An articulated object as objects of a running Blender: collections, empties, meshes, drivers, animation.

It works in any scene, beside whatever is there. It reads and writes no files.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import field
from pathlib import Path
from typing import Any, final

import bpy
import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Link, Visual
from grafu.articulation.kinematics import link_origins
from grafu.dataclass import dataclass
from grafu.export.blend.joints import (
    couple_joint,
    describe_joint,
    drive_link,
    drive_swing,
    key_joint,
    turn_to_axis,
)
from grafu.export.blend.layout import (
    COLLECTION_OF_ROLE,
    COLOR_LAYER,
    FIRST_FRAME,
    FRAME_RATE,
    ID,
    KIND,
    LABEL,
    LAST_FRAME,
    RIG,
    UV_LAYER,
    Kind,
    cycle_keys,
    fitted_name,
)
from grafu.export.blend.materials import BlenderMaterials
from grafu.export.blend.mesh_arrays import BlendMaterial, MeshArrays, mesh_arrays
from grafu.geometry.arrays import Vec3

_ARROW_RATIO = 0.15  # of the largest side: seen beside a door, and no longer than it
_MARK_RATIO = 0.03
_NAMED = (
    "scenes",
    "collections",
    "objects",
    "meshes",
    "materials",
    "actions",
)  # images keep theirs: some are Blender's


@final
@dataclass(frozen=True)
class BuiltObject:
    """What an articulated object is in Blender: a collection, empties by link and joint id, meshes by visual name."""

    collection: Any
    links: dict[str, Any] = field(default_factory=dict)
    joints: dict[str, Any] = field(default_factory=dict)
    visuals: dict[str, Any] = field(default_factory=dict)


def build_object(articulated: ArticulatedObject, scene: Any = None, animate: bool = True) -> BuiltObject:
    """Builds an object in a scene (None: the current one), closed, and returns what was built.

    Raises:
        ArticulationError: if joints wait for one another.
    """
    keys = cycle_keys(articulated) if animate else {}
    built = _Builder(articulated, bpy.context.scene if scene is None else scene).build()
    for joint, ratios in keys.items():
        key_joint(built.joints[joint], ratios)
    return built


def set_scene(scene: Any) -> None:
    """Sets a scene's units to metres and its frames to the length of the cycle, and goes to its first."""
    scene.unit_settings.system = "METRIC"
    scene.unit_settings.scale_length = 1.0
    scene.render.fps = FRAME_RATE
    scene.frame_start, scene.frame_end = FIRST_FRAME, LAST_FRAME
    scene.frame_set(FIRST_FRAME)


def save_object(articulated: ArticulatedObject, path: Path) -> None:
    """Writes an object into a `.blend` of its own, from a Blender that holds other things, and leaves these alone.

    In the file everything has its own name, whatever namesakes there are.

    Raises:
        ArticulationError: if joints wait for one another.
        RuntimeError: if Blender cannot write the file.
    """
    with names_set_aside():
        scene = bpy.data.scenes.new(fitted_name(articulated.name, 4))
        built = build_object(articulated, scene)
        try:
            set_scene(scene)
            bpy.data.libraries.write(str(path), {scene}, compress=True)
        finally:
            remove_object(built.collection)
            bpy.data.scenes.remove(scene)


@contextmanager
def names_set_aside() -> Iterator[None]:
    """Lets whatever Blender holds go by other names for a while, but for what it has from other files.

    Full names of such things name the file, too.
    """
    kinds = (getattr(bpy.data, kind) for kind in _NAMED)
    named = [(one, one.name) for kind in kinds for one in kind if one.name_full == one.name]
    for number, (one, _) in enumerate(named):
        one.name = f"set aside {number}"
    try:
        yield
    finally:
        for one, name in named:
            one.name = name


def remove_object(collection: Any) -> None:
    """Takes an object's collection out of Blender with all that it alone used: meshes, actions, materials, images."""
    inner = [*collection.children_recursive, collection]
    owned = {obj for part in inner for obj in part.objects}
    doomed: set[Any] = set(owned)
    for obj in owned:
        mesh = obj.data
        if mesh is not None:
            doomed |= {mesh, *(material for material in mesh.materials if material is not None)}
        if obj.animation_data is not None and obj.animation_data.action is not None:
            doomed.add(obj.animation_data.action)
    doomed |= {
        n.image for m in doomed if isinstance(m, bpy.types.Material) for n in m.node_tree.nodes if _shows_image(n)
    }
    outside = {user for one in doomed for user in bpy.data.user_map(subset={one})[one]} - doomed - set(inner)
    kept = {one for one in doomed - owned if bpy.data.user_map(subset={one})[one] & outside}
    bpy.data.batch_remove([*(doomed - kept), *inner])


def _shows_image(node: Any) -> bool:
    return node.type == "TEX_IMAGE" and node.image is not None


@final
class _Builder:
    """Fills the collections of one object."""

    def __init__(self, articulated: ArticulatedObject, scene: Any) -> None:
        self._object = articulated
        self._origins = link_origins(articulated)
        self._arrays = {
            (link.id, visual.name): mesh_arrays(visual, self._stands(visual, link.id))
            for link in articulated.links
            for visual in link.visuals
        }
        doubled = frozenset[BlendMaterial]().union(*(arrays.doubled for arrays in self._arrays.values()))
        self._materials = BlenderMaterials(doubled)
        meshes = [link.mesh for link in articulated.links if len(link.mesh.faces)]
        self._side = max((float(np.max(mesh.box.size)) for mesh in meshes), default=1.0)
        self._built = BuiltObject(_collection(articulated.name, scene.collection))
        self._built.collection[KIND], self._built.collection[ID] = Kind.OBJECT.value, articulated.name
        kinds = (*COLLECTION_OF_ROLE.values(), RIG)
        self._inner = {kind: _inner_collection(articulated.name, kind, self._built.collection) for kind in kinds}

    def build(self) -> BuiltObject:
        for link in self._object.links_from_root:
            self._add_link(link)
            for visual in link.visuals:
                self._add_visual(visual, link.id)
        self._drive_swings()
        for joint in self._object.moving_joints:
            if joint.coupling is not None:
                couple_joint(self._built.joints[joint.id], self._built.joints[joint.coupling.leader], joint.coupling)
        return self._built

    def _stands(self, visual: Visual, link: str) -> Vec3:
        """Returns where the frame of a mesh stands, object frame: that of its link, or on the pin that it turns on."""
        on_pin = visual.swing and visual.swing.axis.closest_point(visual.mesh.box.center)
        return self._origins[link] if on_pin is None else on_pin

    def _drive_swings(self) -> None:
        """Lets what turns on its own pin do so: all joints have their empties by now."""
        for link in self._object.links:
            for visual in link.visuals:
                if visual.swing is not None:
                    holder = self._built.joints[self._object.joint_of[visual.swing.moving].id]
                    offset = self._stands(visual, link.id) - self._origins[link.id]
                    drive_swing(self._built.visuals[visual.name], visual.swing, holder, offset)

    def _add_link(self, link: Link) -> None:
        joint = self._object.joint_of.get(link.id)
        empty = self._empty(f"{link.id}_link", "PLAIN_AXES", _MARK_RATIO)
        empty[KIND], empty[ID] = Kind.LINK.value, link.id
        self._built.links[link.id] = empty
        if joint is None:
            return
        holder = self._empty(f"{joint.id}_joint", "SINGLE_ARROW", _ARROW_RATIO)
        self._built.joints[joint.id] = holder
        describe_joint(holder, joint)
        holder.parent = self._built.links[joint.parent]
        holder.location = self._origins[joint.child] - self._origins[joint.parent]
        turn_to_axis(holder, joint.axis.direction)
        empty.parent = holder
        empty.matrix_parent_inverse = holder.rotation_quaternion.to_matrix().to_4x4().transposed()
        drive_link(empty, holder, joint)

    def _add_visual(self, visual: Visual, link: str) -> None:
        mesh = self._mesh(visual, self._arrays[link, visual.name])
        made = bpy.data.objects.new(fitted_name(visual.name, 4), mesh)
        made[KIND], made[ID], made[LABEL] = visual.role.value, visual.name, visual.label.value
        made.parent = self._built.links[link]
        self._inner[COLLECTION_OF_ROLE[visual.role]].objects.link(made)
        self._built.visuals[visual.name] = made

    def _mesh(self, visual: Visual, arrays: MeshArrays) -> Any:
        mesh = bpy.data.meshes.new(fitted_name(visual.name, 4))
        for shown in arrays.materials:
            mesh.materials.append(self._materials.material_of(shown))
        if len(arrays.faces):
            _fill(mesh, arrays)
        return mesh

    def _empty(self, name: str, display: str, ratio: float) -> Any:
        empty = bpy.data.objects.new(fitted_name(name, 4), None)
        empty.empty_display_type, empty.empty_display_size = display, ratio * self._side
        self._inner[RIG].objects.link(empty)
        return empty


def _collection(name: str, parent: Any) -> Any:
    made = bpy.data.collections.new(fitted_name(name, 4))
    parent.children.link(made)
    return made


def _inner_collection(name: str, kind: str, parent: Any) -> Any:
    return _collection(f"{fitted_name(name, 4 + len(kind) + 1)} {kind}", parent)


def _fill(mesh: Any, arrays: MeshArrays) -> None:
    corners = arrays.faces.ravel()
    mesh.vertices.add(len(arrays.vertices))
    mesh.vertices.foreach_set("co", _floats(arrays.vertices))
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners.astype(np.int32))
    mesh.polygons.add(len(arrays.faces))
    mesh.polygons.foreach_set("loop_start", np.arange(0, len(corners), 3, dtype=np.int32))
    if bpy.app.version < (4, 1):  # later it follows from where the faces start
        mesh.polygons.foreach_set("loop_total", np.full(len(arrays.faces), 3, dtype=np.int32))
    mesh.polygons.foreach_set("material_index", arrays.material_index.astype(np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(len(arrays.faces), dtype=bool))
    if arrays.uv is not None:
        mesh.uv_layers.new(name=UV_LAYER).data.foreach_set("uv", _floats(arrays.uv))
    if arrays.colors is not None:
        layer = mesh.color_attributes.new(COLOR_LAYER, "FLOAT_COLOR", "POINT")
        layer.data.foreach_set("color", _floats(arrays.colors))
    mesh.update(calc_edges=True)
    if hasattr(mesh, "use_auto_smooth"):  # before 4.1 custom normals had to be switched on
        mesh.use_auto_smooth = True
    mesh.normals_split_custom_set(arrays.normals.astype(np.float32))


def _floats(values: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(values, dtype=np.float32).ravel()
