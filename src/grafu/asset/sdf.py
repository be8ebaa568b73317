"""SDF models (.sdf, Gazebo) as robots: links, visuals, joints, nested models. Collision shapes are ignored.

Poses are resolved here, frame by frame; links and shapes are then read as those of a URDF. Names such as
`model://NAME/meshes/door.dae` lead into the model's own folder. Models that a file includes are left out, with a note.
"""

from pathlib import Path
from typing import Any, final

import numpy as np

from grafu.articulation.motion_kind import kind_named
from grafu.asset.options import LoadOptions, check_parts
from grafu.asset.reading import Convention, Reading
from grafu.asset.resources import ModelFiles
from grafu.asset.robot_document import RobotDocument, RobotJoint
from grafu.asset.scan_files import parse_xml
from grafu.asset.urdf_shapes import numbers
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset
from grafu.geometry.arrays import Mat4
from grafu.geometry.transform import euler_matrix, from_rotation, quaternion_matrix

CONVENTION = Convention("the format (SDF: metres, Z up)", up="+Z", unit=1.0, usual_up="+Z")
_WORLD = "world"
_UNLIMITED = 1e6  # radians or metres: SDF's own default is 1e16
_FRAMES = ("link", "joint", "frame", "model")
_SOLIDS = {  # the sizes of each shape, and a URDF's word for each
    "box": {"size": "size"},
    "cylinder": {"radius": "radius", "length": "length"},
    "sphere": {"radius": "radius"},
    "capsule": {"radius": "radius", "length": "length"},
    "ellipsoid": {"radii": "radii"},
}


def read_sdf(path: Path, options: LoadOptions, files: ModelFiles | None = None) -> Reading:
    """Returns the models of an SDF file in the coordinates of its world.

    Raises:
        UnreadableAsset: if the file is no SDF, its joints do not form a tree, or no shape could be read.
        AssetTooLarge: if it has more of something than the limits allow.
    """
    files = files or ModelFiles(path, options.limits)
    root = parse_xml(files.read(path), path, "an SDF model", files.limits)
    if root.tag != "sdf":
        raise UnreadableAsset(f"{path} has the root <{root.tag}>: expected <sdf>, a Gazebo model")
    check_parts(len(root.findall(".//model/link/visual/geometry/*")), path, options.limits)
    document = RobotDocument(path)
    document.add_link(_WORLD, np.eye(4))
    worlds = [root, *root.findall("world")]
    for element in (model for world in worlds for model in world.findall("model")):
        _Model(element, path, document, _version(root)).add("", np.eye(4))
    document.notes += [f"<include> {_text(e, 'uri')} is not followed" for e in root.iter("include")]
    return document.reading("sdf", CONVENTION, files, options.parts)


def _version(root: Any) -> tuple[int, ...]:
    return tuple(int(word) for word in root.get("version", "1.6").split(".") if word.isdecimal())


@final
@dataclass(frozen=True)
class _Model:
    """One `<model>` and what is placed in it."""

    element: Any
    path: Path
    document: RobotDocument
    version: tuple[int, ...]

    def add(self, prefix: str, T_world_above: Mat4) -> None:
        """Adds links, visuals and joints to the document, each name behind `prefix`; then those of nested models."""
        T = T_world_above @ self._own_pose(self.element)
        links, joints = self.element.findall("link"), self.element.findall("joint")
        moved_by = {_text(joint, "child"): joint for joint in joints}
        for link in links:
            name = link.get("name", "")
            self._add_link(prefix, link, T, self._placed(moved_by.get(name, link)))
        for nested in self.element.findall("model"):
            _Model(nested, self.path, self.document, self.version).add(f"{prefix}{nested.get('name', '')}::", T)
        for joint in joints:
            self.document.add_joint(self._joint(prefix, joint))

    def _add_link(self, prefix: str, link: Any, T: Mat4, T_model_frame: Mat4) -> None:
        """Adds a link in the frame of the joint above it, `T_model_frame`, with its visuals."""
        name, T_world_link = f"{prefix}{link.get('name', '')}", T @ self._placed(link)
        self.document.add_link(name, T @ T_model_frame)
        for visual in link.findall("visual"):
            shape = self._shape(visual)
            if shape is None:
                continue
            at = self._own_pose(visual)
            base = visual.find("pose").get("relative_to") if visual.find("pose") is not None else None
            pose = T @ self._frame(base, frozenset()) @ at if base else T_world_link @ at
            color, texture = self._look(visual)
            self.document.add_visual(name, visual.get("name", ""), pose, shape, color, texture)

    def _placed(self, element: Any, seen: frozenset[str] = frozenset()) -> Mat4:
        """Returns the pose of a link, joint, frame or nested model in this model."""
        pose = element.find("pose")
        base = (pose.get("relative_to") if pose is not None else None) or ""
        if not base and element.tag == "joint":
            base = _text(element, "child")
        if not base and element.tag == "frame":
            base = element.get("attached_to", "")
        own = self._own_pose(element)
        return self._frame(base, seen) @ own if base else own

    def _frame(self, name: str, seen: frozenset[str]) -> Mat4:
        """Returns the pose of what a name means in this model."""
        if name in ("__model__", _WORLD):
            return np.eye(4)
        first, _, rest = name.partition("::")
        found = next((e for tag in _FRAMES for e in self.element.findall(tag) if e.get("name") == first), None)
        if found is None or name in seen or len(seen) > 200:
            why = "in a circle" if found is not None else "which is not there"
            raise UnreadableAsset(f"{self.path}: a pose is relative to {name!r}, {why}; mend the SDF")
        T = self._placed(found, seen | {name})
        if not rest:
            return T
        return T @ _Model(found, self.path, self.document, self.version)._frame(rest, frozenset())

    def _own_pose(self, element: Any) -> Mat4:
        pose = element.find("pose")
        if pose is None or not (pose.text or "").strip():
            return np.eye(4)
        if pose.get("rotation_format") == "quat_xyzw":
            *xyz, x, y, z, w = numbers(pose.text, (0.0,) * 7, self.path)
            if not any((x, y, z, w)):
                raise UnreadableAsset(f"{self.path}: a quaternion is all zeros; mend the SDF")
            return from_rotation(quaternion_matrix(w, x, y, z), np.array(xyz))
        values = numbers(pose.text, (0.0,) * 6, self.path)
        angles = np.radians(values[3:]) if pose.get("degrees", "") in ("true", "1") else np.array(values[3:])
        return from_rotation(euler_matrix(angles.tolist()), np.array(values[:3]))

    def _shape(self, visual: Any) -> tuple[str, dict[str, str]] | None:
        geometry = visual.find("geometry")
        element = next((e for e in (geometry if geometry is not None else ()) if isinstance(e.tag, str)), None)
        if element is None or element.tag in ("plane", "empty"):
            return None
        if element.tag == "mesh":
            if element.find("submesh") is not None:
                self.document.notes.append(f"of {_text(element, 'uri')} all is shown, not only one submesh")
            return "mesh", {"filename": _text(element, "uri"), "scale": _text(element, "scale") or "1 1 1"}
        sizes = _SOLIDS.get(element.tag, {})
        return element.tag, {word: _text(element, tag) for tag, word in sizes.items()}

    def _look(self, visual: Any) -> tuple[tuple[float, ...] | None, str]:
        """Returns the colour of a visual, None where it states none, and its image."""
        material = visual.find("material")
        if material is None:
            return None, ""
        texture = _text(material, "pbr/metal/albedo_map") or _text(material, "pbr/specular/albedo_map")
        stated = next((_text(material, tag) for tag in ("diffuse", "ambient") if _text(material, tag)), "")
        if not stated:
            return None, texture
        rgba = numbers(stated, (0.0,) * len(stated.split()), self.path)
        rgba = (*rgba, 1.0)[:4] if len(rgba) in (3, 4) else (0.8, 0.8, 0.8, 1.0)
        clear = numbers(_text(visual, "transparency") or "0", (0.0,), self.path)[0]
        return (*rgba[:3], rgba[3] * (1.0 - clear)), texture

    def _joint(self, prefix: str, joint: Any) -> RobotJoint:
        ends = [_text(joint, tag) for tag in ("parent", "child")]
        parent, child = (end if end == _WORLD else f"{prefix}{self._link_of(end)}" for end in ends)
        axis, kind = joint.find("axis"), joint.get("type", "")
        name, moves = f"{prefix}{joint.get('name', '')}", kind_named("urdf", kind)  # SDF's words are a URDF's
        if axis is None:
            return RobotJoint(name, kind if moves is None else "fixed", parent, child)
        limits = self._limits(axis)
        kind = "continuous" if moves is not None and moves.turns and limits is None else kind
        return RobotJoint(name, kind, parent, child, self._axis(joint, axis), limits, self._mimic(prefix, axis))

    def _link_of(self, name: str) -> str:
        """Returns the link that a joint's end means: itself, or what a frame is attached to."""
        for _ in range(200):
            frame = next((e for e in self.element.findall("frame") if e.get("name") == name), None)
            if frame is None:
                return name
            name = frame.get("attached_to", "")
        return name

    def _axis(self, joint: Any, axis: Any) -> tuple[float, ...]:
        """Returns the axis in the frame of the joint."""
        xyz = axis.find("xyz")
        direction = np.array(numbers(xyz.text if xyz is not None else None, (0.0, 0.0, 1.0), self.path))
        base = xyz.get("expressed_in", "") if xyz is not None else ""
        in_model = _text(axis, "use_parent_model_frame") in ("true", "1") or self.version < (1, 5)
        if base or in_model:
            R = self._frame(base or "__model__", frozenset())[:3, :3]
            direction = self._placed(joint)[:3, :3].T @ R @ direction
        return tuple(float(v) for v in direction)

    def _limits(self, axis: Any) -> tuple[float, float] | None:
        limit = axis.find("limit")
        texts = [_text(limit, tag) if limit is not None else "" for tag in ("lower", "upper")]
        if not all(texts) or any(word in text.lower() for text in texts for word in ("inf", "nan")):
            return None
        lower, upper = (numbers(text, (0.0,), self.path)[0] for text in texts)
        return None if max(abs(lower), abs(upper)) > _UNLIMITED else (lower, upper)

    def _mimic(self, prefix: str, axis: Any) -> tuple[str, float, float] | None:
        mimic = axis.find("mimic")
        if mimic is None:
            return None
        multiplier, offset, reference = (
            numbers(_text(mimic, tag) or None, (0.0,), self.path)[0] for tag in ("multiplier", "offset", "reference")
        )
        return f"{prefix}{mimic.get('joint', '')}", multiplier, offset - multiplier * reference


def _text(element: Any, tag: str) -> str:
    """Returns the text of a child, empty where there is none."""
    return (element.findtext(tag) or "").strip()
