"""Questions that tests ask of what `blend_probe` found; told apart by the documented custom properties."""

import numpy as np

from grafu.articulation.kinematics import link_poses, with_coupled
from grafu.export.blend.mesh_arrays import mesh_arrays
from grafu.geometry.transform import transform_points

NEAR = 1e-5  # metres: what single precision leaves of an object of some metres


def objects_of(found, *kinds):
    """Returns the objects of some kinds, with Blender's names for them, by their own ids."""
    objects = {name: o for name, o in found["objects"].items() if o["properties"].get("grafu") in kinds}
    return {o["properties"]["id"]: (name, o) for name, o in objects.items()}


def visuals_of(found):
    return objects_of(found, "part", "added", "hardware")


def posed_triangles(found, poses, name):
    blender_name, o = visuals_of(found)[name]
    return transform_points(poses[blender_name], o["triangles"].reshape(-1, 3)).reshape(-1, 3, 3)


def assert_posed(found, poses, articulated, values):
    """Every part stands where the joints' own arithmetic puts it; that its faces are the input's is shown elsewhere."""
    motions, values = link_poses(articulated, values, shown=True), with_coupled(articulated, values)
    for link in articulated.links:
        for visual in link.visuals:
            arrays, T = mesh_arrays(visual, np.zeros(3)), motions[link.id]
            if visual.swing is not None:
                T = T @ visual.swing.motion(values.get(articulated.joint_of[visual.swing.moving].id, 0.0))
            expected = transform_points(T, arrays.vertices)[arrays.faces]
            assert np.allclose(posed_triangles(found, poses, visual.name), expected, rtol=0.0, atol=NEAR), visual.name
