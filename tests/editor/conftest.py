from collections.abc import Iterator
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def model(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A cabinet in a file, with a part whose name is an attack."""
    pytest.importorskip("starlette")
    pytest.importorskip("httpx2")
    from editing import write_model

    return write_model(tmp_path_factory.mktemp("model") / "cabinet.glb")


@pytest.fixture(scope="session")
def inside():
    """A builder whose cache all tests share."""
    from editing import Inside

    return Inside()


@pytest.fixture
def editing(model: Path, inside, tmp_path: Path) -> Iterator:
    """A server that edits the cabinet, with its results in a folder of its own."""
    from editing import Editing

    from grafu.editor.workspace import open_all

    with Editing(open_all([model], tmp_path / "out"), tmp_path / "scratch", inside) as found:
        yield found


@pytest.fixture(scope="session")
def lasting(model: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator:
    """A server that many tests share, with what was changed before."""
    from edit_page import Server

    server = Server(str(model), "--out", str(tmp_path_factory.mktemp("lasting") / "out"))
    yield server
    server.kill()
