import pytest
from blend_probe import probe

from grafu.errors import ExportError
from grafu.export.blend.exporter import export_blend, find_interpreter


@pytest.fixture(scope="session")
def interpreter():
    try:
        return find_interpreter()
    except ExportError as error:
        pytest.skip(str(error))


@pytest.fixture(scope="session")
def reopened(interpreter, tmp_path_factory):
    """Returns what Blender finds in the .blend of an object."""

    def reopen(articulated):
        data = export_blend(articulated)["model.blend"]
        return probe(interpreter, data, tmp_path_factory.mktemp("blend"))

    return reopen


@pytest.fixture(scope="session")
def reopened_cabinet(reopened, cabinet):
    return reopened(cabinet)
