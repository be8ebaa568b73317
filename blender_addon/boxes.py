"""The compartments as boxes of wire, numbered, in the place of the result."""

import bpy
from mathutils import Matrix, Vector

from . import objects
from .objects import KIND
from .state import compartments_of

_NAME = "GraFu compartments"


def draw_boxes(session) -> None:
    """Draws a box for each compartment of a model's last run."""
    scene = session.id_data
    collection = session.boxes = bpy.data.collections.new(_NAME)
    collection[KIND] = "compartments"
    scene.collection.children.link(collection)
    root = objects.root_of(session)
    for number, compartment in enumerate(compartments_of(session)):
        collection.objects.link(_box(number, compartment["corners"], root.matrix_world))


def remove_boxes(session) -> bool:
    """Removes the boxes of a model's compartments; returns whether there were any."""
    collection = boxes_of(session)
    if collection is None:
        return False
    for box in list(collection.objects):
        mesh = box.data
        bpy.data.objects.remove(box)
        bpy.data.meshes.remove(mesh)
    bpy.data.collections.remove(collection)
    return True


def boxes_of(session):
    """Returns the collection of a model's boxes, or None where they are not shown."""
    if session.collection is None and session.has_result:  # a file of the time when a scene had one model
        return next((c for c in session.id_data.collection.children if c.get(KIND) == "compartments"), None)
    return session.boxes


def _box(number, corners, matrix):
    mesh = bpy.data.meshes.new(f"compartment {number + 1}")
    edges = [(k, k | 1 << axis) for k in range(8) for axis in range(3) if not k >> axis & 1]  # corners count in bits
    middle = sum((Vector(corner) for corner in corners), Vector()) / len(corners)  # where its name stands
    mesh.from_pydata([Vector(corner) - middle for corner in corners], edges, [])
    box = bpy.data.objects.new(f"compartment {number + 1}", mesh)
    box["grafu"], box["number"] = "compartment", number
    box.matrix_world = matrix @ Matrix.Translation(middle)
    box.display_type, box.show_name, box.show_in_front = "WIRE", True, True
    return box
