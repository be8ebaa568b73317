"""COLLADA documents of the small cabinet, written by our own code: materials, texture coordinates, a hierarchy."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from small_assets import AS_IT_IS, CABINET, mesh_of

_NS = "http://www.collada.org/2005/11/COLLADASchema"
_COLOUR = (
    "<effect id='{0}-fx'><profile_COMMON>{1}<technique sid='common'><lambert><diffuse>{2}</diffuse>{3}</lambert>"
    "</technique></profile_COMMON></effect>"
)
_IMAGE = (
    "<newparam sid='s'><surface type='2D'><init_from>wood-png</init_from></surface></newparam>"
    "<newparam sid='t'><sampler2D><source>s</source></sampler2D></newparam>"
)
_STEEL = "<color>0.5 0.5 0.5 1</color>"
_GLASS = (
    "<transparent opaque='A_ONE'><color>1 1 1 1</color></transparent><transparency><float>0.25</float></transparency>"
)


def _source(name: str, values: np.ndarray, axes: str) -> str:
    text = " ".join(f"{v:.9g}" for v in values.ravel())
    params = "".join(f"<param name='{axis}' type='float'/>" for axis in axes)
    return (
        f"<source id='{name}'><float_array id='{name}-a' count='{values.size}'>{text}</float_array><technique_common>"
        f"<accessor source='#{name}-a' count='{len(values)}' stride='{len(axes)}'>{params}</accessor>"
        "</technique_common></source>"
    )


def _geometry(name: str, points: np.ndarray, faces: np.ndarray, polygons: bool) -> str:
    """A mesh with one texture coordinate per corner of a square; as polygons its triangles are written as such."""
    uv = np.array([[0, 0], [1, 0], [1, 1]])
    index = " ".join(f"{v} {k % 3}" for k, v in enumerate(faces.ravel()))
    inputs = f"<input semantic='VERTEX' source='#{name}-v' offset='0'/>"
    inputs += f"<input semantic='TEXCOORD' source='#{name}-uv' offset='1'/>"
    counts = f"<vcount>{' '.join('3' for _ in faces)}</vcount>" if polygons else ""
    tag = "polylist" if polygons else "triangles"
    return (
        f"<geometry id='{name}'><mesh>{_source(f'{name}-p', points, 'XYZ')}{_source(f'{name}-uv', uv, 'ST')}"
        f"<vertices id='{name}-v'><input semantic='POSITION' source='#{name}-p'/></vertices>"
        f"<{tag} material='skin' count='{len(faces)}'>{inputs}{counts}<p>{index}</p></{tag}></mesh></geometry>"
    )


def collada_text(
    matrix: np.ndarray = AS_IT_IS,
    up: str = "Z_UP",
    metres: float = 1.0,
    materials: Mapping[str, str] = {},
    below: Mapping[str, str] = {},
) -> str:
    """Returns the cabinet as a COLLADA document.

    Args:
        matrix: from the object frame in metres to the document's axes and units.
        up: what the document states about its axes.
        metres: metres per unit, as the document states.
        materials: by part, `wood` (an image), `steel` or `glass`; wood for all others.
        below: by part, the name of a node above it, shared by parts of one drawer.
    """
    geometries, nodes, groups = "", "", dict[str, str]()
    for number, name in enumerate(CABINET):
        mesh = mesh_of(name)
        offset = mesh.vertices[0]
        geometries += _geometry(f"g{number}", (mesh.vertices - offset) @ matrix.T, mesh.faces, number % 2 == 0)
        move = " ".join(f"{v:.9g}" for v in offset @ matrix.T)
        bound = f"<instance_material symbol='skin' target='#{materials.get(name, 'wood')}'/>"
        node = (
            f"<node id='ID{number}' name='{name}'><translate>{move}</translate><instance_geometry url='#g{number}'>"
            f"<bind_material><technique_common>{bound}</technique_common></bind_material></instance_geometry></node>"
        )
        if name in below:
            groups[below[name]] = groups.get(below[name], "") + node
        else:
            nodes += node
    nodes += "".join(f"<node id='{name}' name='{name}'>{inside}</node>" for name, inside in groups.items())
    effects = _COLOUR.format("wood", _IMAGE, "<texture texture='t' texcoord='UV'/>", "")
    effects += _COLOUR.format("steel", "", _STEEL, "") + _COLOUR.format("glass", "", _STEEL, _GLASS)
    kinds = "".join(
        f"<material id='{k}' name='{k}'><instance_effect url='#{k}-fx'/></material>" for k in ("wood", "steel", "glass")
    )
    return (
        f"<?xml version='1.0'?><COLLADA xmlns='{_NS}' version='1.4.1'>"
        f"<asset><unit meter='{metres}'/><up_axis>{up}</up_axis></asset>"
        "<library_images><image id='wood-png'><init_from>textures/wood%20grain.png</init_from></image></library_images>"
        f"<library_effects>{effects}</library_effects><library_materials>{kinds}</library_materials>"
        f"<library_geometries>{geometries}</library_geometries><library_visual_scenes><visual_scene id='scene'>{nodes}"
        "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#scene'/></scene></COLLADA>"
    )


def write_collada(folder: Path, text: str | None = None, image: bytes | None = None) -> Path:
    """Writes the document, and its image where it is given; returns the document's path."""
    folder.mkdir(parents=True, exist_ok=True)
    if image is not None:
        (folder / "textures").mkdir(exist_ok=True)
        (folder / "textures" / "wood grain.png").write_bytes(image)
    path = folder / "cabinet.dae"
    path.write_text(collada_text() if text is None else text)
    return path
