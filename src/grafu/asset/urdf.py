"""URDF files to rigid bodies with visuals: links, joints, meshes and primitives. Collision shapes are ignored.

Everything comes out in the coordinates of the root link, every joint at zero. It settles no frame.
"""

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, final

import numpy as np

from grafu.articulation.articulated_object import Coupling
from grafu.articulation.motion_kind import MotionKind, kind_named
from grafu.asset.bodies import Body, BodyVisual, StatedMotion, annotation_of_bodies, drafts_of_visuals
from grafu.asset.drafts import parts_of_drafts
from grafu.asset.labels import is_whole_part
from grafu.asset.link_groups import with_links_as_groups
from grafu.asset.options import LoadOptions, check_parts
from grafu.asset.reading import Convention, Reading
from grafu.asset.resources import ModelFiles
from grafu.asset.urdf_shapes import ShapeReader, numbers, origin_of, read_xml
from grafu.asset.visual_names import visual_name
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mat4
from grafu.geometry.axis import Axis
from grafu.geometry.transform import invert

CONVENTION = Convention("the format (URDF: metres, Z up)", up="+Z", unit=1.0, usual_up="+Z")
_LARGEST = 1e12  # metres: products with the sizes of meshes stay finite
_LOOSE = "floating"  # the link moves, the file does not say how


@final
@dataclass(frozen=True)
class UrdfBodies:
    """The bodies of a URDF, its visuals link by link as the file has them, and notes on what was left out.

    `up` is the root link's Z in the coordinates of the visuals, `base` the link that the others hang on.
    """

    bodies: tuple[Body, ...]
    visuals: tuple[BodyVisual, ...]
    notes: tuple[str, ...]
    up: tuple[float, float, float] = (0.0, 0.0, 1.0)
    base: str = ""


@final
@dataclass(frozen=True)
class _JointElement:
    name: str
    kind: str
    parent: str
    child: str
    origin: Mat4
    axis: tuple[float, ...]
    lower: float
    upper: float
    limited: bool
    mimic: Coupling | None = None


@final
@dataclass(frozen=True)
class _Tree:
    """The links with their visuals' elements, the joint above each link, and the pose of each link at zero."""

    path: Path
    robot: Any
    links: dict[str, Any]
    above: dict[str, _JointElement]
    roots: tuple[str, ...]
    T_root_link: dict[str, Mat4]


def read_urdf(path: Path, options: LoadOptions, files: ModelFiles | None = None) -> Reading:
    """Returns the model in the coordinates of its root link.

    Raises:
        UnreadableAsset: if the file is no URDF, its joints do not form a tree, or no shape could be read.
        AssetTooLarge: if it has more of something than the limits allow.
    """
    files = files or ModelFiles(path, options.limits)
    robot = read_xml(path, files)
    check_parts(len(robot.findall("link/visual/geometry/*")), path, options.limits)
    found = bodies_of_robot(robot, path, files)
    parts = parts_of_drafts(drafts_of_visuals(with_links_as_groups(found.visuals, found.base, options.parts)))
    annotation = annotation_of_bodies(list(found.bodies), up=2)
    return Reading("urdf", parts, CONVENTION, annotation, notes=tuple(dict.fromkeys(found.notes)))


def read_bodies(path: Path, files: ModelFiles, mesh_frame: bool = False) -> UrdfBodies:
    """Returns the bodies of a URDF file.

    Args:
        path: the file.
        files: the files of the model.
        mesh_frame: give coordinates of the link with visuals that is nearest to the root instead of the root link's.
    """
    return bodies_of_robot(read_xml(path, files), path, files, mesh_frame)


def bodies_of_robot(
    robot: Any, path: Path, files: ModelFiles, mesh_frame: bool = False, made: Sequence[tuple[Surface, ...]] = ()
) -> UrdfBodies:
    """Returns the bodies of a `<robot>` element that `path` holds; see `read_bodies`, and of `made` `ShapeReader`."""
    tree = _read_tree(robot, path, files)
    heads = _heads(tree)
    base = _base_link(tree) if mesh_frame else tree.roots[0]
    T_base_root = invert(tree.T_root_link[base])
    shapes = ShapeReader(path, files, _materials(tree.robot), made)
    visuals: dict[str, list[BodyVisual]] = {}
    for link in sorted(tree.links, key=lambda name: tree.links[name].find("visual") is None):
        visuals.setdefault(heads[link], []).extend(_link_visuals(tree, link, shapes, T_base_root))
    bodies = tuple(_body(tree, heads, head, tuple(found), T_base_root) for head, found in visuals.items())
    place = {link: number for number, link in enumerate(tree.links)}
    in_order = tuple(sorted((v for found in visuals.values() for v in found), key=lambda visual: place[visual.link]))
    if not in_order:
        missing = f" ({shapes.notes[0]})" if shapes.notes else ""
        raise UnreadableAsset(f"{path} has no visual shape that can be read{missing}: expected visuals with meshes")
    x, y, z = T_base_root[:3, 2].tolist()
    return UrdfBodies(bodies, in_order, (*shapes.notes, *_kind_notes(tree)), (x, y, z), _base_link(tree))


def _read_tree(robot: Any, path: Path, files: ModelFiles) -> _Tree:
    if robot.tag != "robot":
        raise UnreadableAsset(
            f"{path} has the root <{robot.tag}>: expected <robot>, a URDF (xacro must be expanded first)"
        )
    elements = robot.findall("link")
    files.limits.require("nodes", len(elements), path)
    links = {link.get("name", ""): link for link in elements}
    if not links:
        raise UnreadableAsset(f"{path} has no links: expected a URDF with links and visuals")
    if len(links) < len(elements):
        twice = next(name for name, count in Counter(e.get("name", "") for e in elements).items() if count > 1)
        raise UnreadableAsset(f"{path}: several links are named {twice!r}; expected a name of its own for each")
    joints = [_joint_element(element, path) for element in robot.findall("joint")]
    above: dict[str, _JointElement] = {}
    for joint in joints:
        for end in (joint.parent, joint.child):
            if end not in links:
                raise UnreadableAsset(
                    f"{path}: joint {joint.name!r} names the link {end!r}, which is not there; add it"
                )
        if joint.child in above:
            raise UnreadableAsset(f"{path}: link {joint.child!r} has two parent joints; expected a tree; remove one")
        above[joint.child] = joint
    roots = tuple(name for name in links if name not in above)
    return _Tree(path, robot, links, above, roots, _poses(path, links, above, files))


def _poses(path: Path, links: Iterable[str], above: dict[str, _JointElement], files: ModelFiles) -> dict[str, Mat4]:
    """Returns the pose of every link at zero, each from the one above it; none may lie in a cycle."""
    poses = {link: np.eye(4) for link in links if link not in above}
    below: dict[str, list[_JointElement]] = {}
    for joint in above.values():
        below.setdefault(joint.parent, []).append(joint)
    reached, depth = list(poses), 1
    while reached:
        files.limits.require("depth", depth, path)
        joints = [joint for link in reached for joint in below.get(link, ())]
        poses |= {joint.child: poses[joint.parent] @ joint.origin for joint in joints}
        reached, depth = [joint.child for joint in joints], depth + 1
    lost = next((link for link in links if link not in poses), None)
    if lost is not None:
        raise UnreadableAsset(f"{path}: the joints form a cycle through link {lost!r}; expected a tree")
    far = next((link for link, T in poses.items() if not np.abs(T).max() < _LARGEST), None)
    if far is not None:
        raise UnreadableAsset(f"{path}: link {far!r} lies beyond all furniture; mend the origins of its joints")
    return poses


def _joint_element(element: Any, path: Path) -> _JointElement:
    name, kind = element.get("name", ""), element.get("type", "fixed")
    ends = [element.find(tag) for tag in ("parent", "child")]
    if any(end is None for end in ends):
        raise UnreadableAsset(f"{path}: joint {name!r} lacks a parent or a child; expected both")
    limit, axis = element.find("limit"), element.find("axis")
    lower, upper = (numbers(None if limit is None else limit.get(key), (0.0,), path)[0] for key in ("lower", "upper"))
    direction = numbers(axis.get("xyz") if axis is not None else None, (1.0, 0.0, 0.0), path)
    limited = kind != "continuous" and limit is not None and lower != upper
    parent, child = (end.get("link", "") for end in ends)
    mimic = _mimic(element, path)
    return _JointElement(name, kind, parent, child, origin_of(element, path), direction, lower, upper, limited, mimic)


def _mimic(element: Any, path: Path) -> Coupling | None:
    """Returns which joint a joint follows; None where it follows none, or would be static (a multiplier of 0)."""
    mimic = element.find("mimic")
    if mimic is None:
        return None
    ((multiplier,), (offset,)) = (numbers(mimic.get(k), (v,), path) for k, v in (("multiplier", 1.0), ("offset", 0.0)))
    return Coupling(mimic.get("joint", ""), multiplier, offset) if multiplier else None


def _kind(joint: _JointElement) -> MotionKind | None:
    return kind_named("urdf", joint.kind)


def _moves(joint: _JointElement) -> bool:
    return _kind(joint) is not None and any(joint.axis)


def _is_fixed(joint: _JointElement) -> bool:
    return not _moves(joint) and joint.kind != _LOOSE


def _heads(tree: _Tree) -> dict[str, str]:
    """Returns for every link the topmost one that it is rigidly fixed to; poses list each link after the one above."""
    heads: dict[str, str] = {}
    for link in tree.T_root_link:
        joint = tree.above.get(link)
        heads[link] = heads[joint.parent] if joint is not None and _is_fixed(joint) else link
    return heads


def _base_link(tree: _Tree) -> str:
    """Returns of the links with visuals the first that hangs on the fewest others, whether these move or not."""
    shown = [link for link in tree.links if tree.links[link].find("visual") is not None]
    return min(shown, key=lambda link: len(_upward(tree, link)), default=tree.roots[0])


def _upward(tree: _Tree, link: str) -> list[str]:
    """Returns the link and those that it hangs on, up to the root."""
    chain = [link]
    while chain[-1] in tree.above:
        chain.append(tree.above[chain[-1]].parent)
    return chain


def _group(tree: _Tree, link: str) -> str:
    """Returns the nearest link, itself or above it, that is named as one whole door or drawer; the root states nothing.

    Links count as the nodes of a scene do, by their names alone: a joint that is made fixed changes nothing.
    """
    return next((name for name in _upward(tree, link)[:-1] if is_whole_part(name)), "")


def _link_visuals(tree: _Tree, link: str, shapes: ShapeReader, T_base_root: Mat4) -> list[BodyVisual]:
    made = []
    T_base_link = T_base_root @ tree.T_root_link[link]
    for element in tree.links[link].findall("visual"):
        shape = shapes.read(element)
        if shape is None:
            continue
        T = T_base_link @ origin_of(element, tree.path)
        name = visual_name(element.get("name") or "", link, Path(shape.file).stem, link in tree.roots)
        surfaces = tuple(s.transformed(T) for s in shape.surfaces)
        made.append(BodyVisual(name, surfaces, link, shape.file, _group(tree, link)))
    return made


def _body(tree: _Tree, heads: dict[str, str], head: str, visuals: tuple[BodyVisual, ...], T_base_root: Mat4) -> Body:
    joint = tree.above.get(head)
    if joint is None:
        return Body(head, visuals[0].link if visuals else head, visuals)
    above = heads[joint.parent]
    parent = above if above in tree.above else None
    kind = _kind(joint)
    if kind is None:  # it moves, and the file does not say how
        return Body(head, head, visuals, parent=parent, is_loose=True)
    T = T_base_root @ tree.T_root_link[head]
    axis = Axis(T[:3, 3], T[:3, :3] @ np.array(joint.axis))
    coupling = joint.mimic and _by_link(tree, joint.mimic)
    motion = StatedMotion(kind.type, axis, joint.lower, joint.upper, joint.limited, coupling)
    return Body(head, head, visuals, motion, parent)


def _by_link(tree: _Tree, mimic: Coupling) -> Coupling | None:
    """Returns a coupling that names the link which its leader moves; None where that joint is not there."""
    link = next((link for link, joint in tree.above.items() if joint.name == mimic.leader and _moves(joint)), None)
    return None if link is None else replace(mimic, leader=link)


def _materials(robot: Any) -> dict[str, Any]:
    return {m.get("name", ""): m for m in robot.findall("material")}


def _kind_notes(tree: _Tree) -> list[str]:
    loose = [j for j in tree.above.values() if j.kind == _LOOSE]
    odd = [j for j in tree.above.values() if _kind(j) is None and j.kind not in ("fixed", _LOOSE)]
    zero = [j for j in tree.above.values() if _kind(j) is not None and not any(j.axis)]
    extra = [f"link {name} hangs on no joint and is kept in place" for name in tree.roots[1:]]
    said = [f"joint {j.name} is {j.kind}, which is not built: {j.child} is kept in place" for j in odd]
    said += [f"joint {j.name} is {j.kind}: how {j.child} moves is not said" for j in loose]
    return said + [f"joint {j.name} has a zero axis: {j.child} is kept in place" for j in zero] + extra
