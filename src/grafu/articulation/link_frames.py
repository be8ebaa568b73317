"""Where each link's own frame stands: exporters and simulators need one per link. It knows no file format."""

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.geometry.arrays import Vec3, vec3


def joint_origin(articulated: ArticulatedObject, joint: Joint) -> Vec3:
    """Returns the point of the joint's axis nearest to the middle of its child, metres, object frame at rest."""
    mesh = articulated.link(joint.child).mesh
    return joint.axis.closest_point(mesh.box.center) if len(mesh.faces) else joint.axis.point


def link_origins(articulated: ArticulatedObject) -> dict[str, Vec3]:
    """Returns the origin of every link's frame in the object frame at rest: the root's is zero, others' their joint's.

    All link frames are parallel to the object frame at rest.
    """
    joints = articulated.joint_of
    root = {articulated.root: vec3(0.0, 0.0, 0.0)}
    return root | {link: joint_origin(articulated, joint) for link, joint in joints.items()}
