"""COLLADA scenes (.dae), read by pycollada: nodes with geometry are parts. It settles no frame.

The XML is read with the care of a URDF first. Images are sought in the model's folder and nowhere else; skins, splines,
cameras and lights are left out. The library is an extra (`grafu[formats]`).
"""

import io
from collections.abc import Iterator
from dataclasses import field
from pathlib import Path
from typing import Any, final
from urllib.parse import unquote

import numpy as np

from grafu.asset.drafts import drafts_of_nodes, parts_of_drafts
from grafu.asset.mesh_files import linear_channel, named_texture, surface_of_corners
from grafu.asset.options import LoadOptions, check_parts
from grafu.asset.reading import Convention, Reading
from grafu.asset.resources import ModelFiles
from grafu.asset.scan_files import library_call, parse_xml
from grafu.asset.scene_nodes import Chain, SceneNode
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import Mat4

_EXPECTED = "COLLADA 1.4 or 1.5 with triangles or polygons; export it again"
_UP = {"X_UP": "+X", "Y_UP": "+Y", "Z_UP": "+Z"}
_MOST_NOTES = 5  # of what pycollada could not read
_LARGEST = 1e12  # of a number in a transform or a position: products of some of them stay finite


def read_collada(path: Path, options: LoadOptions, files: ModelFiles | None = None) -> Reading:
    """Returns the scene of a .dae file in its own coordinates.

    Raises:
        UnreadableAsset: if the file is missing or damaged, or pycollada is not installed.
        AssetTooLarge: if it has more of something than the limits allow.
    """
    scene = _Scene(path, files or ModelFiles(path, options.limits))
    nodes = scene.nodes()
    check_parts(len(nodes), path, options.limits)
    metres, up = scene.metres, scene.up
    convention = Convention(f"the file (COLLADA: {metres:g} m per unit, {up[1]} up)", up=up, unit=metres)
    parts = parts_of_drafts(drafts_of_nodes(nodes, path.name))
    return Reading("mesh file", parts, convention, notes=tuple(dict.fromkeys(scene.notes)))


def read_collada_surfaces(path: Path, files: ModelFiles) -> tuple[tuple[Surface, ...], tuple[str, ...]]:
    """Returns all surfaces of a .dae file in metres, along the axes of the file, and notes on what was left out.

    So robots mean it (RViz, Gazebo): the unit counts, the axis that points up does not.

    Raises:
        UnreadableAsset: if the file is missing or damaged, or pycollada is not installed.
        AssetTooLarge: if it has more of something than the limits allow.
    """
    scene = _Scene(path, files)
    T = np.diag([scene.metres, scene.metres, scene.metres, 1.0])
    surfaces = tuple(surface.transformed(T) for node in scene.nodes() for surface in node.surfaces)
    return surfaces, tuple(dict.fromkeys(scene.notes))


@final
@dataclass
class _Scene:
    """The document while it is read. Not a value: notes gather."""

    path: Path
    files: ModelFiles
    notes: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._document = _document(self.path, self.files)
        self._materials: dict[int, Material] = {}
        lost = [str(getattr(error, "msg", error)).splitlines()[0][:120] for error in self._document.errors]
        self.notes += [f"of {self.path.name}, something was left out: {why}" for why in dict.fromkeys(lost)][
            :_MOST_NOTES
        ]
        self.notes += ["animations are not read as joints"] if self._document.animations else []
        about = self._document.assetInfo
        metres = getattr(about, "unitmeter", None)
        self.metres = metres if metres is not None and 1e-6 < metres < 1e6 else 1.0
        self.up = _UP.get(getattr(about, "upaxis", None) or "Y_UP", "+Y")

    def nodes(self) -> list[SceneNode]:
        """Returns the nodes with faces."""
        roots = [] if self._document.scene is None else self._document.scene.nodes
        found: list[SceneNode] = []
        for name, chain, T, shapes in self._placed(roots):
            surfaces = tuple(s for shape in shapes for s in self._surfaces(shape, T))
            if surfaces:
                found.append(SceneNode(name, chain, surfaces))
        return found

    def _placed(self, roots: list[Any]) -> Iterator[tuple[str, Chain, Mat4, list[Any]]]:
        """Yields name, chain, pose and geometry instances of each node that has any, in the order of the file."""
        from collada.scene import ControllerNode, GeometryNode, Node

        stack: list[tuple[Any, Mat4, Chain]] = [(node, np.eye(4), ()) for node in reversed(roots)]
        count = 0
        while stack:
            node, above, chain = stack.pop()
            if not isinstance(node, Node):
                continue
            count += 1
            self.files.limits.require("nodes", count, self.path)
            self.files.limits.require("depth", len(chain) + 1, self.path)
            T = above @ _finite(node.matrix, self.path)
            named = getattr(node, "node", node)  # an instance of a node is named as that node
            name = str(named.name or named.id or f"node_{count}")
            here = (*chain, (count, name))
            children = list(node.children)
            if any(isinstance(child, ControllerNode) for child in children):
                self.notes.append(f"the skin of {name} is not read and was left out")
            shapes = [child for child in children if isinstance(child, GeometryNode)]
            if shapes:
                yield name, here, T, shapes
            stack += [(child, T, here) for child in reversed(children)]

    def _surfaces(self, shape: Any, T: Mat4) -> Iterator[Surface]:
        painted = {str(bound.symbol): bound.target for bound in shape.materials}
        for primitive in shape.geometry.primitives:
            self.files.tally.add(self.path, primitives=1)
            with library_call(self.path, _EXPECTED):
                triangles = _triangles(primitive)
            if triangles is None:
                self.notes.append("lines and splines have no faces and were left out")
                continue
            material = self._material(painted.get(str(triangles.material)))
            surface = self._surface(triangles, material)
            if not surface.is_empty:
                yield surface if np.array_equal(T, np.eye(4)) else surface.transformed(T)

    def _surface(self, triangles: Any, material: Material) -> Surface:
        count = len(triangles.index)
        self.files.tally.add(self.path, faces=count, vertices=0 if triangles.vertex is None else len(triangles.vertex))
        if not count:
            return surface_of_corners(np.zeros((0, 3), np.int64), np.zeros((0, 3)), *_NOTHING, None, material)
        vertices, normals = _finite(triangles.vertex, self.path), triangles.normal
        uv = np.asarray(triangles.texcoordset[0], np.float64)[:, :2] if len(triangles.texcoordset) else np.zeros((0, 2))
        at = [triangles.vertex_index, triangles.texcoord_indexset[0] if len(uv) else None, triangles.normal_index]
        corners = np.stack([np.full(3 * count, -1) if i is None else np.asarray(i).ravel() for i in at], axis=1)
        sizes = (len(vertices), len(uv), 0 if normals is None else len(normals))
        if (corners[:, 0] < 0).any() or (corners >= np.maximum(sizes, 0)).any():
            raise UnreadableAsset(f"{self.path} names a vertex that is not there: expected {_EXPECTED}")
        bent = np.zeros((0, 3)) if normals is None else _finite(normals, self.path)
        return surface_of_corners(corners.astype(np.int64), vertices, uv, bent, None, material)

    def _material(self, material: Any) -> Material:
        if material is None:
            return Material()
        if id(material) not in self._materials:
            self._materials[id(material)] = self._painted(str(material.name or material.id), material.effect)
        return self._materials[id(material)]

    def _painted(self, name: str, effect: Any) -> Material:
        shown, texture = effect.diffuse, None
        image = getattr(getattr(getattr(shown, "sampler", None), "surface", None), "image", None)
        if image is not None:
            file = unquote(str(image.path)).replace("\\", "/").removeprefix("file://")
            texture = named_texture(file, self.path.parent, self.files, self.notes)
        red, green, blue = _colour(shown) or (1.0, 1.0, 1.0)
        alpha = _opacity(effect)
        return Material(
            name=name,
            base_color=(linear_channel(red), linear_channel(green), linear_channel(blue), alpha),
            roughness=0.7,
            base_color_texture=texture,
            alpha_mode="BLEND" if alpha < 0.999 else "OPAQUE",
            double_sided=True,
        )


_NOTHING = (np.zeros((0, 2)), np.zeros((0, 3)))


def _document(path: Path, files: ModelFiles) -> Any:
    """Returns what pycollada makes of a file."""
    data = files.read(path)
    root = parse_xml(data, path, "a COLLADA scene", files.limits)
    if not str(root.tag).endswith("COLLADA"):
        raise UnreadableAsset(f"{path} has the root <{root.tag}>: expected {_EXPECTED}")
    try:
        import collada
    except ImportError:
        raise UnreadableAsset(
            f"{path} is COLLADA, which is read by pycollada: install it with `pip install 'grafu[formats]'`"
        ) from None
    unread = [collada.common.DaeError]  # what it does not know is left out
    with library_call(path, _EXPECTED):
        return collada.Collada(io.BytesIO(data), ignore=unread, aux_file_loader=lambda _: b"")


def _triangles(primitive: Any) -> Any:
    """Returns a primitive as a set of triangles, None where it has no faces."""
    from collada.polylist import Polylist
    from collada.triangleset import TriangleSet

    if isinstance(primitive, TriangleSet):
        return primitive
    return primitive.triangleset() if isinstance(primitive, Polylist) else None


def _finite(values: Any, path: Path) -> np.ndarray:
    numbers = np.asarray(values, dtype=np.float64)
    if not np.abs(numbers).max(initial=0.0) < _LARGEST:
        raise UnreadableAsset(f"{path} holds numbers that no furniture has: expected finite coordinates")
    return numbers


def _colour(value: Any) -> tuple[float, float, float] | None:
    """Returns red, green and blue of a colour in sRGB, None where there is none."""
    if not isinstance(value, tuple | list) or len(value) < 3:
        return None
    red, green, blue = (float(v) for v in value[:3])
    return (red, green, blue) if np.isfinite([red, green, blue]).all() else None


def _opacity(effect: Any) -> float:
    """Returns how opaque an effect is, 0..1; 1 where it states that nothing would be seen, as some exporters do."""
    tint, factor = effect.transparent, effect.transparency
    if not isinstance(tint, tuple | list) or len(tint) < 4 or not isinstance(factor, float | int):
        return 1.0
    seen = 1.0 - np.mean(tint[:3]) * factor if str(effect.opaque_mode) == "RGB_ZERO" else tint[3] * factor
    return float(seen) if 0.02 < seen < 1.0 else 1.0
