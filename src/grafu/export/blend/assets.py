"""Templates as assets of Blender: a `.blend` in which each is marked and has a picture, and the list of its catalogs.

It works in a Blender that holds other things, and leaves these alone. A hinge or rail is an empty that shows a
collection which opens and closes (of a collection that is marked itself, Blender 5.0 does not write the picture); a
handle is one mesh whose back is at z = 0, so that it is dropped onto a front upright.
"""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, final
from uuid import NAMESPACE_URL, uuid5

import bpy
import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.dataclass import dataclass
from grafu.export.blend.layout import ID, KIND
from grafu.export.blend.objects import build_object, names_set_aside, remove_object
from grafu.export.whole_file import whole_file, write_whole
from grafu.geometry.arrays import vec3
from grafu.geometry.transform import rotation_about

TEMPLATE = "template"
"""The value of the property `grafu` of an asset; its property `kind` is `hinge`, `rail` or `handle`."""
KIND_OF_TEMPLATE = "kind"
FILE_NAME = "templates.blend"
CATALOG_NAME = "blender_assets.cats.txt"  # Blender's own name
CATALOGS = {"hinge": "Hinges", "rail": "Rails", "handle": "Handles"}
_CATALOGS_VERSION = 1  # of the form of Blender's file


@final
@dataclass(frozen=True)
class TemplateAsset:
    """A template to be offered: its kind (`hinge`, `rail`, `handle`), id, title, a few words, itself and its picture.

    The picture is an array of rows from above, columns and RGBA, 0..255.

    Raises:
        ValueError: if the kind is another one, or the picture is not such an array.
    """

    kind: str
    id: str
    title: str
    about: str
    made: ArticulatedObject
    picture: np.ndarray

    def __post_init__(self) -> None:
        if self.kind not in CATALOGS:
            raise ValueError(f"`TemplateAsset.kind` must be one of {', '.join(CATALOGS)}: got {self.kind}")
        if self.picture.ndim != 3 or self.picture.shape[2] != 4:
            raise ValueError(f"`TemplateAsset.picture` must have rows, columns and RGBA: got {self.picture.shape}")


def catalog_id(kind: str) -> str:
    """Returns the id of the catalog of a kind, the same in every library."""
    return str(uuid5(NAMESPACE_URL, f"grafu/{kind}"))


def save_assets(assets: Sequence[TemplateAsset], folder: Path) -> Path:
    """Writes `templates.blend` and Blender's list of catalogs into a folder, and returns the path of the first.

    Raises:
        RuntimeError: if Blender cannot write the file.
    """
    made: list[tuple[Any, Any]] = []
    path = folder / FILE_NAME
    with names_set_aside():
        scene = bpy.data.scenes.new("templates")
        try:
            made.extend(_built(asset, scene) for asset in assets)
            with whole_file(path) as fresh:
                bpy.data.libraries.write(str(fresh), {one for one, _ in made}, fake_user=True, compress=True)
        finally:
            for shown, collection in made:
                bpy.data.objects.remove(shown)
                remove_object(collection)
            bpy.data.scenes.remove(scene)
    write_whole(_catalogs(), folder / CATALOG_NAME)
    return path


def _built(asset: TemplateAsset, scene: Any) -> tuple[Any, Any]:
    """Returns what is marked as the asset, and the collection that was built for it."""
    is_handle = asset.kind == "handle"
    built = build_object(_upright(asset.made) if is_handle else asset.made, scene, animate=False)
    (shown,) = built.visuals.values() if is_handle else (_instance(built.collection),)
    shown.parent = None  # a handle is offered alone, without its link
    shown.name = asset.title
    shown[KIND], shown[ID], shown[KIND_OF_TEMPLATE] = TEMPLATE, asset.id, asset.kind
    shown.asset_mark()
    about = shown.asset_data
    about.description, about.catalog_id = asset.about, catalog_id(asset.kind)
    about.tags.new(asset.kind)
    about.tags.new("grafu")
    _show(shown, asset.picture)
    return shown, built.collection


def _instance(collection: Any) -> Any:
    """Returns an empty that shows a collection."""
    empty = bpy.data.objects.new(collection.name, None)
    empty.instance_type, empty.instance_collection = "COLLECTION", collection
    return empty


def _upright(handle: ArticulatedObject) -> ArticulatedObject:
    """Returns a handle, an object of one visual, turned so that it stands out upwards and not to the front."""
    T = rotation_about(np.zeros(3), vec3(1.0, 0.0, 0.0), -np.pi / 2)
    (link,) = handle.links
    visuals = (replace(one, surfaces=tuple(s.transformed(T) for s in one.surfaces)) for one in link.visuals)
    return replace(handle, links=(replace(link, visuals=tuple(visuals)),))


def _show(shown: Any, picture: np.ndarray) -> None:
    """Gives an asset its picture; Blender's rows begin below."""
    preview = shown.preview_ensure()
    preview.image_size = picture.shape[1], picture.shape[0]
    values = np.ascontiguousarray(picture[::-1], dtype=np.float32) / 255.0
    preview.image_pixels_float.foreach_set(values.ravel())


def _catalogs() -> str:
    """Returns Blender's list of catalogs: id, path and short name of each."""
    lines = (f"{catalog_id(kind)}:GraFu/{name}:{name}" for kind, name in CATALOGS.items())
    return "\n".join([f"VERSION {_CATALOGS_VERSION}", "", *lines, ""])
