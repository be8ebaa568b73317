"""MJCF models (.xml, MuJoCo) as robots: MuJoCo resolves classes, frames and poses; our own readers read the meshes.

MuJoCo is given text alone, in which meshes and images are names that it does not open. Links and shapes are then read
as those of a URDF. The library is an extra (`grafu[sim]`).
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, final

import numpy as np
from lxml import etree

from grafu.articulation.motion_kind import kind_named
from grafu.asset.mjcf_text import COLLISION, SHOWN_GROUPS, MjcfText, whole_text
from grafu.asset.options import LoadOptions
from grafu.asset.reading import Convention, Reading
from grafu.asset.resources import ModelFiles
from grafu.asset.robot_document import RobotDocument, RobotJoint, spaced
from grafu.asset.scan_files import library_call
from grafu.asset.urdf_shapes import numbers
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset
from grafu.geometry.arrays import Mat4
from grafu.geometry.transform import from_rotation

CONVENTION = Convention("the format (MJCF: metres, Z up)", up="+Z", unit=1.0, usual_up="+Z")
_EXPECTED = "an MJCF model that MuJoCo compiles"
_WORDS = ("free", "ball", "slide", "hinge")  # by MuJoCo's number
_FLOATING = "floating"  # a URDF's word for what moves in some other way


@final
@dataclass(frozen=True)
class _Geom:
    """A geom as MuJoCo understands it: its type as MuJoCo's name for it (`MESH`), mesh and material by name."""

    type: str
    mesh: str
    material: str
    rgba: tuple[float, ...]
    is_shown: bool


def read_mjcf(path: Path, options: LoadOptions, files: ModelFiles | None = None) -> Reading:
    """Returns the model in the coordinates of its world, every joint as drawn.

    Raises:
        UnreadableAsset: if the file is no MJCF, does not compile, no shape could be read, or MuJoCo is not installed.
        AssetTooLarge: if it has more of something than the limits allow.
    """
    files = files or ModelFiles(path, options.limits)
    model = _Model(path, whole_text(path, files))
    return model.document().reading("mjcf", CONVENTION, files, options.parts)


@final
class _Model:
    """The model twice: as it was written, for what its elements are, and without files, for where they are."""

    def __init__(self, path: Path, text: MjcfText) -> None:
        self.path, self.text = path, text
        mujoco = _library(path)
        with library_call(path, _EXPECTED):
            spec = mujoco.MjSpec.from_string(_written(text))
            self._geoms = {geom.name: _geom(geom) for geom in spec.geoms}
            self._meshes = {mesh.name or Path(mesh.file).stem: mesh for mesh in spec.meshes}
            self._materials = {m.name: (_rgba(m), [str(t) for t in m.textures if t]) for m in spec.materials}
            self._images = {t.name or Path(t.file).stem: t.file for t in spec.textures if str(t.type).endswith("2D")}
            self._mesh_folder, self._image_folder = (_folder(text, key) for key in ("meshdir", "texturedir"))
            files = {name for name, geom in self._geoms.items() if geom.mesh or geom.type in ("MESH", "HFIELD", "SDF")}
            text.without_files({f"{name.partition('_')[0]}_" for name in files})
            self.model: Any = mujoco.MjModel.from_xml_string(_written(text))
            self.state: Any = mujoco.MjData(self.model)
            mujoco.mj_kinematics(self.model, self.state)

    def document(self) -> RobotDocument:
        """Returns the model as a robot."""
        document = RobotDocument(self.path, list(dict.fromkeys(self.text.notes)))
        names = self._body_names()
        joints = {body: self._joints_of(body) for body in range(self.model.nbody)}
        for body, name in enumerate(names):
            document.add_link(name, self._frame(body, joints[body]))
            for numbered, T, size in self._shown_geoms(body):
                self._add_geom(document, name, numbered, T, size)
        for body in range(1, self.model.nbody):
            document.add_joint(self._joint(body, joints[body], names))
        return document

    def _body_names(self) -> list[str]:
        seen: dict[str, int] = {}
        names = []
        for body in range(self.model.nbody):
            name = self.text.name(self.model.body(body).name) or (f"body_{body}" if body else "world")
            seen[name] = seen.get(name, 0) + 1
            names.append(name if seen[name] == 1 else f"{name}_{seen[name]}")
        return names

    def _joints_of(self, body: int) -> list[int]:
        first, count = int(self.model.body_jntadr[body]), int(self.model.body_jntnum[body])
        return list(range(first, first + count))

    def _frame(self, body: int, joints: list[int]) -> Mat4:
        """Returns the frame of a body at the joint above it, along the axes of the body."""
        R = np.array(self.state.xmat[body]).reshape(3, 3)
        return from_rotation(R, np.array(self.state.xanchor[joints[0]] if joints else self.state.xpos[body]))

    def _shown_geoms(self, body: int) -> Iterator[tuple[str, Mat4, np.ndarray]]:
        """Yields the number, pose and half sizes of each geom that is no collision shape."""
        first, count = int(self.model.body_geomadr[body]), int(self.model.body_geomnum[body])
        for index in range(first, first + count):
            name = self.model.geom(index).name
            if self._geoms[name].is_shown and not COLLISION.search(self.text.class_of(name)):
                R = np.array(self.state.geom_xmat[index]).reshape(3, 3)
                yield name, from_rotation(R, np.array(self.state.geom_xpos[index])), self.model.geom_size[index]

    def _add_geom(self, document: RobotDocument, link: str, numbered: str, T: Mat4, size: np.ndarray) -> None:
        geom = self._geoms[numbered]
        shape = self._mesh(geom, document.notes) if geom.type == "MESH" else _solid(geom.type, size)
        if shape is None:
            if geom.type not in ("PLANE", "MESH"):
                document.notes.append(f"a geom of type {geom.type.lower()} is not read and was left out")
            return
        rgba, textures = self._materials.get(geom.material, (geom.rgba, []))
        image = next((self._images[name] for name in textures if name in self._images), "")
        texture = f"{self._image_folder}{image}" if image else ""
        document.add_visual(link, self.text.name(numbered), T, shape, rgba, texture)

    def _mesh(self, geom: _Geom, notes: list[str]) -> tuple[str, dict[str, str]] | None:
        mesh = self._meshes.get(geom.mesh)
        if mesh is None or not mesh.file:
            notes.append(f"mesh {geom.mesh} has no file and was left out")
            return None
        if np.any(mesh.refpos) or not np.allclose(mesh.refquat, (1.0, 0.0, 0.0, 0.0)):
            notes.append(f"refpos and refquat of mesh {geom.mesh} are not applied")
        return "mesh", {"filename": f"{self._mesh_folder}{mesh.file}", "scale": spaced(mesh.scale)}

    def _joint(self, body: int, joints: list[int], names: list[str]) -> RobotJoint:
        """Returns the joint above a body; a free one at the world holds the whole in its place."""
        parent, child = names[int(self.model.body_parentid[body])], names[body]
        kinds = [kind_named("mjcf", _WORDS[int(self.model.jnt_type[joint])]) for joint in joints]
        if not joints or (kinds == [None] and not self.model.body_parentid[body]):
            return RobotJoint(f"{child} stands", "fixed", parent, child)
        first, name = joints[0], self._joint_name(joints[0])
        moves = kinds[0]
        if len(joints) > 1 or moves is None:
            return RobotJoint(name, _FLOATING, parent, child)
        R = np.array(self.state.xmat[body]).reshape(3, 3)
        axis = R.T @ np.array(self.state.xaxis[first])
        drawn = float(self.model.qpos0[self.model.jnt_qposadr[first]])
        limited = bool(self.model.jnt_limited[first])
        low, high = (float(v) - drawn for v in self.model.jnt_range[first])
        kind = "continuous" if moves.turns and not limited else moves.word("urdf")
        return RobotJoint(name, kind, parent, child, axis, (low, high) if limited else None, self._mimic(name))

    def _joint_name(self, joint: int) -> str:
        return self.text.name(self.model.joint(joint).name) or f"joint_{joint}"

    def _mimic(self, name: str) -> tuple[str, float, float] | None:
        """Returns which joint a joint follows in a straight line; both count from where they are drawn."""
        found = next(((leader, text) for follower, leader, text in self.text.couplings if follower == name), None)
        if found is None or not found[0]:
            return None
        count = len(found[1].split())
        values = (*numbers(found[1], (0.0,) * count, self.path), 0.0, 0.0) if count else (0.0, 1.0)
        return found[0], values[1], values[0]


def _library(path: Path) -> Any:
    try:
        import mujoco
    except ImportError:
        raise UnreadableAsset(
            f"{path} is MJCF, which is read by MuJoCo: install it with `pip install 'grafu[sim]'`"
        ) from None
    return mujoco


def _written(text: MjcfText) -> str:
    return str(etree.tostring(text.root, encoding="unicode"))


def _folder(text: MjcfText, key: str) -> str:
    """Returns the folder that files of a kind lie in, with a slash behind it; empty for that of the model."""
    for element in reversed(text.root.findall("compiler")):
        found = element.get(key) or element.get("assetdir")
        if found:
            return f"{found.rstrip('/')}/"
    return ""


def _geom(geom: Any) -> _Geom:
    rgba = _rgba(geom)
    kind = str(getattr(geom.type, "name", geom.type)).removeprefix("mjGEOM_")
    shown = int(geom.group) < SHOWN_GROUPS and rgba[3] > 0.0
    return _Geom("MESH" if geom.meshname else kind, geom.meshname, geom.material, rgba, shown)


def _rgba(element: Any) -> tuple[float, ...]:
    return tuple(float(v) for v in element.rgba)


def _solid(kind: str, half: np.ndarray) -> tuple[str, dict[str, str]] | None:
    """Returns a solid as a URDF has it, None for what is none; MuJoCo counts half sizes."""
    if kind == "BOX":
        return "box", {"size": spaced(2 * half)}
    if kind == "SPHERE":
        return "sphere", {"radius": spaced(half[:1])}
    if kind == "ELLIPSOID":
        return "ellipsoid", {"radii": spaced(half)}
    if kind in ("CYLINDER", "CAPSULE"):
        return kind.lower(), {"radius": spaced(half[:1]), "length": spaced(2 * half[1:2])}
    return None
