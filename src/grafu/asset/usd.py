"""OpenUSD scenes (.usd, .usda, .usdc, .usdz), read by usd-core: meshes and plain solids are parts. It settles no frame.

A scene in which joints let rigid bodies move is read as a robot (`usd_robot`): its bodies are links.

Layers and images are sought in the model's folder and nowhere else; a scene that refers to a layer outside of it is
refused before it is opened. What is hidden, or of purpose `guide` or `proxy`, is left out, and so is what moves with
time: the first moment counts. The library is an extra (`grafu[usd]`).
"""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, final

import numpy as np

from grafu.asset.drafts import drafts_of_nodes, parts_of_drafts
from grafu.asset.mesh_files import surface_of_corners
from grafu.asset.options import LoadOptions, check_parts
from grafu.asset.polygons import triangulate
from grafu.asset.reading import Convention, Reading
from grafu.asset.resources import ModelFiles
from grafu.asset.scan_files import library_call
from grafu.asset.scene_nodes import Chain, SceneNode
from grafu.asset.usd_materials import EXPECTED, UsdMaterials
from grafu.asset.usd_physics import bodies_of, joints_of
from grafu.asset.usd_robot import UsdRobot, document_of, is_robot
from grafu.errors import UnreadableAsset
from grafu.geometry.appearance import Surface
from grafu.geometry.mesh import TriangleMesh

_LARGEST = 1e12  # of a number in a transform or a position: products of some of them stay finite
_LAYERS = 200  # that one scene may be made of


def read_usd(path: Path, options: LoadOptions, files: ModelFiles | None = None) -> Reading:
    """Returns an OpenUSD scene in its own coordinates.

    Raises:
        UnreadableAsset: if the file is missing or damaged, refers to layers that lie elsewhere, or usd-core is not
            installed.
        AssetTooLarge: if it has more of something than the limits allow.
    """
    files = files or ModelFiles(path, options.limits)
    scene = _Scene(path, files)
    placed = scene.nodes()
    nodes = [node for _, node in placed]
    check_parts(len(nodes), path, options.limits)
    up, unit = scene.up, scene.metres
    metres = "no unit" if unit is None else f"{unit:g} m per unit"
    convention = Convention(f"the file (OpenUSD: {metres}, {up[1]} up)", up=up, unit=unit)
    robot = scene.robot()
    if nodes and is_robot(robot):
        document = document_of(robot, placed, path)
        document.notes += scene.notes
        return document.reading("usd", convention, files, options.parts)
    parts = parts_of_drafts(drafts_of_nodes(nodes, path.name, by_name=not scene.is_ours))
    return Reading("mesh file", parts, convention, notes=tuple(dict.fromkeys(scene.notes)))


@final
class _Scene:
    """The stage while it is read. Not a value: notes gather."""

    def __init__(self, path: Path, files: ModelFiles) -> None:
        self.path, self.files = path, files
        self.notes: list[str] = []
        self._wholes: set[str] = set()  # prims of parts that grafu wrote
        self._warnings = _unheard(path)
        self._stage = _opened(path, files)
        self._materials = UsdMaterials(path, files, self.notes)
        with library_call(path, EXPECTED):
            self._about()

    def _about(self) -> None:
        from pxr import Usd, UsdGeom

        stated = self._stage.HasAuthoredMetadata("metersPerUnit")
        metres = float(UsdGeom.GetStageMetersPerUnit(self._stage)) if stated else 0.0
        self.metres = metres if 1e-6 < metres < 1e6 else None
        self.up = "+Z" if UsdGeom.GetStageUpAxis(self._stage) == "Z" else "+Y"
        self._poses = UsdGeom.XformCache(Usd.TimeCode.EarliestTime())
        creator = self._stage.GetRootLayer().customLayerData.get("creator", "")
        self.is_ours = str(creator).startswith("grafu")  # it writes a prim for each part

    def robot(self) -> UsdRobot:
        """Returns the rigid bodies and joints of the scene."""
        with library_call(self.path, EXPECTED):
            bodies = bodies_of(self._stage)
            return UsdRobot(bodies, tuple(joints_of(self._stage, self._poses, bodies)) if bodies else ())

    def nodes(self) -> list[tuple[str, SceneNode]]:
        """Returns a node for each shape that is shown, in the order of the scene, with the path of its prim.

        What grafu wrote of one part, a mesh for each surface, is one node.
        """
        found: list[tuple[str, SceneNode]] = []
        for place, node in self._meshes():
            above = place.rpartition("/")[0]
            if above not in self._wholes:
                found.append((place, node))
            elif found and found[-1][0] == above:
                before = found[-1][1]
                found[-1] = above, replace(before, surfaces=before.surfaces + node.surfaces)
            else:
                found.append((above, SceneNode(node.chain[-2][1], node.chain[:-1], node.surfaces)))
        return found

    def _meshes(self) -> Iterator[tuple[str, SceneNode]]:
        from pxr import Usd

        chains: dict[str, Chain] = {}
        predicate = Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)
        for count, prim in enumerate(Usd.PrimRange(self._stage.GetPseudoRoot(), predicate)):
            self.files.limits.require("nodes", count, self.path)
            place = str(prim.GetPath())
            above = chains.get(str(prim.GetPath().GetParentPath()), ())
            chains[place] = (*above, (count, str(prim.GetName()))) if count else ()
            self.files.limits.require("depth", len(above) + 1, self.path)
            if self.is_ours and prim.HasAttribute("grafu:role"):
                self._wholes.add(place)
            surfaces = self._surfaces(prim)
            if surfaces:
                yield place, SceneNode(str(prim.GetName()), chains[place], surfaces)

    def _surfaces(self, prim: Any) -> tuple[Surface, ...]:
        """Returns the surfaces of one prim in the scene's coordinates, empty where it is no shape that is shown."""
        with library_call(self.path, EXPECTED):
            kind = _kind(prim)
            if not kind:
                return ()
            if kind == "other":
                self.notes.append(f"{prim.GetName()} is a {prim.GetTypeName()}, which is not read, and was left out")
                return ()
            T = np.array(self._poses.GetLocalToWorldTransform(prim)).T
        T = _finite(T, self.path)
        made = self._mesh(prim) if kind == "mesh" else self._solid(prim, kind)
        return tuple(surface.transformed(T) for surface in made if not surface.is_empty)

    def _solid(self, prim: Any, kind: str) -> list[Surface]:
        import trimesh

        with library_call(self.path, EXPECTED):
            found = {name: prim.GetAttribute(name).Get() for name in ("size", "radius", "height", "axis")}
            if kind == "cube":
                made = trimesh.creation.box([float(found["size"])] * 3)
            elif kind == "sphere":
                made = trimesh.creation.icosphere(2, float(found["radius"]))
            else:
                made = trimesh.creation.cylinder(float(found["radius"]), float(found["height"]), sections=24)
                made.vertices = np.roll(made.vertices, {"X": 1, "Y": 2}.get(str(found["axis"]), 0), axis=1)
        _finite(made.vertices, self.path)
        self.files.tally.add(self.path, primitives=1, faces=len(made.faces), vertices=len(made.vertices))
        return [Surface(TriangleMesh.from_trimesh(made), self._materials.of(prim))]

    def _mesh(self, prim: Any) -> list[Surface]:
        from pxr import Usd, UsdGeom

        with library_call(self.path, EXPECTED):
            mesh, first = UsdGeom.Mesh(prim), Usd.TimeCode.EarliestTime()
            points = np.asarray(mesh.GetPointsAttr().Get(first) or np.zeros((0, 3)), np.float64).reshape(-1, 3)
            counts = np.asarray(mesh.GetFaceVertexCountsAttr().Get(first) or [], np.int64)
            index = np.asarray(mesh.GetFaceVertexIndicesAttr().Get(first) or [], np.int64)
            whole = len(counts) and counts.min() >= 0 and counts.sum() == len(index)
            whole = whole and len(index) and 0 <= index.min() <= index.max() < len(points)
            turned = str(mesh.GetOrientationAttr().Get()) == "leftHanded"
        if not whole:
            if len(counts) and counts.any():
                raise UnreadableAsset(f"{self.path}: {prim.GetPath()} names points that are not there: {EXPECTED}")
            return []
        self.files.limits.require("corners", int(counts.max()), self.path)
        self.files.tally.add(self.path, faces=int(np.maximum(counts - 2, 0).sum()), vertices=len(points))
        starts = np.concatenate([[0], np.cumsum(counts)])
        corners, owner = triangulate(_finite(points, self.path), index, starts)
        corners = corners[:, ::-1] if turned else corners
        uv = self._primvar(prim, len(points), len(index), 2)
        found = []
        for bound, faces in self._by_material(prim, len(counts)):
            chosen = corners[np.isin(owner, faces)] if faces is not None else corners
            self.files.tally.add(self.path, primitives=1)
            at = chosen.ravel()
            rows = np.stack(
                [index[at], np.full(len(at), -1) if uv is None else uv[1][at], np.full(len(at), -1)], axis=1
            )
            nothing = np.zeros((0, 2))
            coordinates = nothing if uv is None else uv[0]
            found.append(
                surface_of_corners(rows, points, coordinates, np.zeros((0, 3)), None, self._materials.of(bound, prim))
            )
        return found

    def _primvar(self, prim: Any, points: int, corners: int, width: int) -> tuple[np.ndarray, np.ndarray] | None:
        """Returns texture coordinates and, for each corner, which of them; None where the mesh has none that fit."""
        from pxr import UsdGeom

        with library_call(self.path, EXPECTED):
            for primvar in UsdGeom.PrimvarsAPI(prim).GetPrimvars():
                if primvar.GetTypeName().type.typeName not in ("VtArray<GfVec2f>", "VtArray<GfVec2d>"):
                    continue
                values = np.asarray(primvar.ComputeFlattened(), np.float64).reshape(-1, width)
                if not np.isfinite(values).all():
                    continue
                if len(values) == corners and str(primvar.GetInterpolation()) == "faceVarying":
                    return values, np.arange(corners)
                if len(values) == points and str(primvar.GetInterpolation()) in ("vertex", "varying"):
                    index = np.asarray(UsdGeom.Mesh(prim).GetFaceVertexIndicesAttr().Get(), np.int64)
                    return values, index
        return None

    def _by_material(self, prim: Any, count: int) -> list[tuple[Any, np.ndarray | None]]:
        """Returns what binds a material, with the faces it binds it to; None for all."""
        from pxr import UsdGeom

        with library_call(self.path, EXPECTED):
            subsets = UsdGeom.Subset.GetGeomSubsets(UsdGeom.Mesh(prim), "face", "materialBind")
            found = [(s.GetPrim(), np.asarray(s.GetIndicesAttr().Get() or [], np.int64)) for s in subsets]
        if not found:
            return [(prim, None)]
        rest = np.setdiff1d(np.arange(count), np.concatenate([faces for _, faces in found]))
        return [*found, *([(prim, rest)] if len(rest) else [])]


def _unheard(path: Path) -> Any:
    """Returns what takes OpenUSD's warnings as long as it lives: what a file lacks is said here in one line.

    Raises:
        UnreadableAsset: if usd-core is not installed.
    """
    try:
        from pxr import UsdUtils
    except ImportError:
        raise UnreadableAsset(
            f"{path} is OpenUSD, which is read by usd-core: install it with `pip install 'grafu[usd]'`"
        ) from None
    return UsdUtils.CoalescingDiagnosticDelegate()


def _opened(path: Path, files: ModelFiles) -> Any:
    """Returns the stage of a file whose layers all lie in the model's folder."""
    from pxr import Usd

    files.read(path)
    _check_layers(path, files)
    with library_call(path, EXPECTED):
        return Usd.Stage.Open(str(path.absolute()))


def _check_layers(path: Path, files: ModelFiles) -> None:
    """Opens each layer alone, and follows what it refers to.

    Raises:
        UnreadableAsset: if a layer is damaged, or refers to what is not a file of the model.
    """
    from pxr import Sdf

    waiting, seen = [path.absolute()], set[Path]()
    while waiting:
        layer_path = waiting.pop()
        if layer_path in seen:
            continue
        seen.add(layer_path)
        files.limits.require("depth", max(0, len(seen) - _LAYERS), path)
        with library_call(layer_path, EXPECTED):
            layer = Sdf.Layer.FindOrOpen(str(layer_path))
            named = [str(name) for name in layer.GetCompositionAssetDependencies()]
        for name in named:
            if not name or (path.suffix.lower() == ".usdz" and ".." not in name and not name.startswith("/")):
                continue
            sought = files.seek(name, layer_path.parent)
            if sought.path is None:
                raise UnreadableAsset(f"{path} refers to the layer {name}, which {sought.why}")
            files.read(sought.path)
            waiting.append(sought.path.absolute())


def _kind(prim: Any) -> str:
    """Returns `mesh`, `cube`, `cylinder`, `sphere`, `other` for a shape that is not read; empty where none is shown."""
    from pxr import UsdGeom

    if not prim.IsA(UsdGeom.Gprim):
        return ""
    shown = UsdGeom.Imageable(prim)
    if str(shown.ComputePurpose()) in ("guide", "proxy") or str(shown.ComputeVisibility()) == "invisible":
        return ""
    kinds = {"Mesh": "mesh", "Cube": "cube", "Cylinder": "cylinder", "Sphere": "sphere"}
    return kinds.get(str(prim.GetTypeName()), "other")


def _finite(values: np.ndarray, path: Path) -> np.ndarray:
    if not np.abs(values).max(initial=0.0) < _LARGEST:
        raise UnreadableAsset(f"{path} holds numbers that no furniture has: expected finite coordinates")
    return values
