import subprocess
import sys

import pytest

from grafu.errors import ExportError
from grafu.export.formats import FORMATS, export, exporter_for

EXTRA = ("blend", "usd", "usdz")  # they need what the package does without


def test_every_format_of_the_table_exports(cabinet):
    for name, one in FORMATS.items():
        if name in EXTRA:
            assert one.extra
        elif one.graph:
            with pytest.raises(ExportError, match=f"`{name}` holds a completed graph"):
                export(cabinet, [name])
        else:
            written = exporter_for(name)(cabinet).names
            assert {_top(file) for file in written} == set(one.files)


def _top(file: str) -> str:
    """`model.glb` of itself, `meshes/` of `meshes/door_1.obj`."""
    folder, slash, _ = file.partition("/")
    return folder + slash


def test_formats_are_exported_together(cabinet):
    assert {"model.glb", "model.urdf", "meshes/door_1.obj"} <= set(export(cabinet, ["glb", "urdf"]).names)


def test_an_unknown_format_names_the_known_ones(cabinet):
    with pytest.raises(
        ExportError,
        match=r"unknown format `fbx`: known formats are glb, glb-merged, glb-draco, glb-merged-draco, urdf, mjcf, "
        "sdf, usd, usdz, particulate, singapo, grafu-pred, blend",
    ):
        export(cabinet, ["glb", "fbx"])


def test_the_table_imports_no_exporter():
    code = "import sys, grafu.export.formats; sys.exit('grafu.export.glb' in sys.modules)"

    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
