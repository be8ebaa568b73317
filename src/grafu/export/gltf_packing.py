"""glTF primitives compressed with Draco (KHR_draco_mesh_compression), encoded by DracoPy (`grafu[formats]`).

Positions are rounded to one grid about the origin of their node, so that what touches still does. What was encoded is
decoded at once: Draco changes the order of vertices, and accessors describe what a reader will find.
"""

from collections.abc import Mapping
from importlib.util import find_spec
from math import ceil, log2
from typing import Any, Final, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.errors import ExportError
from grafu.export.gltf_buffer import GltfBuffer, narrowed
from grafu.geometry.config_checks import require_positive

EXTENSION: Final = "KHR_draco_mesh_compression"
_DRACO: Final = {"POSITION": 0, "NORMAL": 1, "COLOR_0": 2, "TEXCOORD_0": 3}
"""The library's numbers of the kinds of attributes."""
_MOST_BITS: Final = 30
"""As many as the library takes."""


@final
@dataclass(frozen=True, slots=True)
class DracoConfig:
    """What compression may change.

    Raises:
        ValueError: if a number is not above 0.
    """

    step: float = 1e-4
    """Positions are rounded to multiples of this (m): by at most half of it along each axis."""
    uv_step: float = 1.0 / 16384.0
    """Texture coordinates are rounded to less than this: a quarter of a pixel of an image 4096 wide."""
    normal_bits: int = 10
    """Bits of either coordinate of a normal on the library's octahedron: a fraction of a degree."""
    effort: int = 7
    """How hard the library tries, 0 to 10: it decides on size and time, not on what is changed."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


DEFAULT_DRACO_CONFIG = DracoConfig()


def require_draco() -> None:
    """Refuses where DracoPy is missing.

    Raises:
        ExportError: if it is.
    """
    if find_spec("DracoPy") is None:
        raise ExportError("the formats `glb-draco` and `glb-merged-draco` need DracoPy: pip install 'grafu[formats]'")


def add_packed(
    arrays: Mapping[str, np.ndarray], corners: np.ndarray, buffer: GltfBuffer, config: DracoConfig
) -> dict[str, Any] | None:
    """Returns the tables of a primitive whose compressed bytes go into the buffer; None: the library cannot pack it.

    `arrays` are the attributes of vertices by glTF's names, `corners` the vertices of triangles.
    """
    import DracoPy

    try:
        data = _encoded(arrays, corners, config)
        made = DracoPy.decode(data)
    except (DracoPy.EncodingFailedException, DracoPy.FileTypeException):
        return None
    found = {entry["attribute_type"]: entry for entry in made.attributes}
    if len(made.faces) == 0 or not all(_DRACO[name] in found for name in arrays):
        return None
    attributes, ids = {}, {}
    for name, values in arrays.items():
        entry = found[_DRACO[name]]
        read = np.asarray(entry["data"]).reshape(-1, values.shape[1]).astype(values.dtype)
        attributes[name], ids[name] = buffer.add_compressed(read, name == "POSITION"), int(entry["unique_id"])
    packed = {EXTENSION: {"bufferView": buffer.add_bytes(data), "attributes": ids}}
    indices = buffer.add_compressed(narrowed(np.asarray(made.faces).ravel()))
    return {"attributes": attributes, "indices": indices, "extensions": packed}


def _encoded(arrays: Mapping[str, np.ndarray], corners: np.ndarray, config: DracoConfig) -> bytes:
    import DracoPy

    points, uv = arrays["POSITION"], arrays.get("TEXCOORD_0")
    first = np.floor(points.min(axis=0).astype(np.float64) / config.step)
    last = np.ceil(points.max(axis=0).astype(np.float64) / config.step)
    bits = _bits(float((last - first).max()))
    data: bytes = DracoPy.encode(
        points,
        corners.astype(np.uint32),
        quantization_bits=bits,
        quantization_range=(2**bits - 1) * config.step,
        quantization_origin=(first * config.step).tolist(),
        compression_level=config.effort,
        colors=arrays.get("COLOR_0"),
        tex_coord=None if uv is None else uv.astype(np.float64),  # the library takes no others
        tex_coord_quantization_bits=None if uv is None else _bits(float(np.ptp(uv, axis=0).max()) / config.uv_step),
        normals=arrays["NORMAL"].astype(np.float64),
        normal_quantization_bits=config.normal_bits,
    )
    return data


def _bits(steps: float) -> int:
    """Returns how many bits count so many steps."""
    return min(max(ceil(log2(steps + 1.0)), 1), _MOST_BITS)
