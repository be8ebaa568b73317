"""The compartments as boxes of wire, numbered, in the place of the result."""

import bpy

from . import objects
from .state import compartments_of, session_of

_NAME = "GraFu compartments"


def draw_boxes(context) -> None:
    """Draws a box for each compartment of the last run."""
    collection = bpy.data.collections.new(_NAME)
    collection["grafu"] = "compartments"
    context.scene.collection.children.link(collection)
    root = next(o for o in objects.result_objects(context.scene) if o.get("grafu") == "link" and o.parent is None)
    for number, compartment in enumerate(compartments_of(session_of(context))):
        collection.objects.link(_box(number, compartment["corners"], root.matrix_world))


def remove_boxes(scene) -> bool:
    """Removes the boxes of the compartments; returns whether there were any."""
    shown = [c for c in scene.collection.children if c.get("grafu") == "compartments"]
    for collection in shown:
        for box in list(collection.objects):
            mesh = box.data
            bpy.data.objects.remove(box)
            bpy.data.meshes.remove(mesh)
        bpy.data.collections.remove(collection)
    return bool(shown)


def _box(number, corners, matrix):
    mesh = bpy.data.meshes.new(f"compartment {number + 1}")
    edges = [(k, k | 1 << axis) for k in range(8) for axis in range(3) if not k >> axis & 1]  # corners count in bits
    mesh.from_pydata([tuple(corner) for corner in corners], edges, [])
    box = bpy.data.objects.new(f"compartment {number + 1}", mesh)
    box["grafu"], box["number"] = "compartment", number
    box.matrix_world = matrix
    box.display_type, box.show_name = "WIRE", True
    return box
