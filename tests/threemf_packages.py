"""3MF packages of the small cabinet, written by our own code: colours, components, transforms."""

from collections.abc import Mapping
from io import BytesIO
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

import numpy as np

from small_assets import AS_IT_IS, CABINET, mesh_of

_CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
OAK, GLASS = "#996633", "#FFFFFF40"


def threemf_text(
    unit: str = "millimeter", matrix: np.ndarray = 1000 * AS_IT_IS, below: Mapping[str, str] | None = None
) -> str:
    """Returns the model; `below` puts parts, by name, as components into objects of their own."""
    objects, placed = "", []
    for number, name in enumerate(CABINET, 2):
        mesh = mesh_of(name)
        rows = "".join(f'<vertex x="{x:.9g}" y="{y:.9g}" z="{z:.9g}"/>' for x, y, z in mesh.vertices @ matrix.T)
        faces = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in mesh.faces)
        look = 1 if name == "handle-8" else 0
        objects += (
            f'<object id="{number}" name="{name}" type="model" pid="1" pindex="{look}"><mesh>'
            f"<vertices>{rows}</vertices><triangles>{faces}</triangles></mesh></object>"
        )
        if name not in (below or {}):
            placed.append(str(number))
    for number, group in enumerate(dict.fromkeys((below or {}).values()), 100):
        within = [n for n, name in enumerate(CABINET, 2) if (below or {}).get(name) == group]
        parts = "".join(f'<component objectid="{n}" transform="1 0 0 0 1 0 0 0 1 0 0 0"/>' for n in within)
        objects += f'<object id="{number}" name="{group}" type="model"><components>{parts}</components></object>'
        placed.append(str(number))
    items = "".join(f'<item objectid="{n}"/>' for n in placed)
    colours = f'<base name="oak" displaycolor="{OAK}"/><base name="glass" displaycolor="{GLASS}"/>'
    return (
        f'<?xml version="1.0"?><model unit="{unit}" xmlns="{_CORE}"><resources>'
        f'<basematerials id="1">{colours}</basematerials>{objects}</resources><build>{items}</build></model>'
    )


def threemf_bytes(text: str | None = None) -> bytes:
    """Returns the package, without the time of day."""
    stream = BytesIO()
    with ZipFile(stream, "w", ZIP_DEFLATED) as package:
        entry = ZipInfo("3D/3dmodel.model")
        entry.compress_type = ZIP_DEFLATED
        package.writestr(entry, threemf_text() if text is None else text)
    return stream.getvalue()


def write_threemf(folder: Path, data: bytes | None = None) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "cabinet.3mf"
    path.write_bytes(threemf_bytes() if data is None else data)
    return path
