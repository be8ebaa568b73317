"""A small cabinet to edit, a builder without a process of its own, and a client of the server."""

import json
import struct
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

from starlette.testclient import TestClient

from grafu.asset.edit import as_static_object
from grafu.asset.part import Part
from grafu.editor.builder import Answer
from grafu.editor.building import Bench, Order
from grafu.editor.server import EditedModels, application
from grafu.editor.session import Session
from grafu.editor.workspace import Workspace
from grafu.errors import FunctionalizationError, NotBuilt
from grafu.export.glb import export_glb
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Drawer, Stack

ATTACK = "<img src=x onerror='window.hurt=1'><script>window.hurt=1</script>"
TOKEN, PORT = "a-token-of-tests", 4711
DOOR, DRAWER = "door", "drawer"


def write_model(path: Path, *more: Part) -> Path:
    """Writes a cabinet with a drawer above a door, and more parts; the name of its bottom's node is an attack."""
    cabinet = make_cabinet(Cabinet("made", Case(0.5, 0.9), Stack((Drawer(), Door()), (1.0, 3.0))))
    cabinet = replace(cabinet, parts=(*cabinet.parts, *more))
    data = export_glb(as_static_object(cabinet))["model.glb"]
    length = struct.unpack_from("<I", data, 12)[0]
    tree = json.loads(data[20 : 20 + length])
    node = next(node for node in tree["nodes"] if node.get("name", "").startswith("bottom"))
    node["name"] = ATTACK
    chunk = json.dumps(tree).encode()
    chunk += b" " * (-len(chunk) % 4)
    rest = data[20 + length :]
    head = struct.pack("<4sII", b"glTF", 2, 20 + len(chunk) + len(rest)) + struct.pack("<I4s", len(chunk), b"JSON")
    path.write_bytes(head + chunk + rest)
    return path


class Inside:
    """Builds in this process, and remembers what it was asked for."""

    def __init__(self) -> None:
        self.bench = Bench(lambda said: self.on_stage(said["stage"]))
        self.asked: list[Order] = []
        self.on_stage: Any = lambda stage: None

    def ask(self, order: Order, on_stage: Any) -> Answer:
        self.on_stage = on_stage
        self.asked.append(order)
        try:
            return Answer(self.bench.carry_out(order), 0.1)
        except FunctionalizationError as error:
            raise NotBuilt(" ".join(str(error).split())) from None

    def give_way(self) -> None:
        pass

    def stop(self) -> None:
        pass


class Editing:
    """A client of a server that edits some models."""

    def __init__(self, workspaces: tuple[Workspace, ...], scratch: Path, builder: Any) -> None:
        self.sessions = []
        for number, workspace in enumerate(workspaces):
            folder = scratch / str(number)
            folder.mkdir(parents=True)
            self.sessions.append(Session(workspace, builder, folder))
        app = application(EditedModels(tuple(self.sessions), builder), TOKEN, PORT)
        self.client = TestClient(app, base_url=f"http://127.0.0.1:{PORT}")

    def __enter__(self) -> "Editing":
        self.client.__enter__()
        return self

    def __exit__(self, *what: Any) -> None:
        self.client.__exit__(*what)

    def get(self, path: str, **more: Any) -> Any:
        return self.client.get(f"/{TOKEN}{path}", **more)

    def post(self, path: str, body: Any = None) -> Any:
        return self.client.post(f"/{TOKEN}{path}", json=body)

    def open(self) -> dict[str, Any]:
        """Opens the page of the first model and returns its state once it is built."""
        assert self.get("/m/0/").status_code == 200
        return self.settled()

    def settled(self, number: int = 0) -> dict[str, Any]:
        """Returns the state once nothing is being built."""
        end = time.monotonic() + 120
        session = self.sessions[number]
        while session.is_building or (session.built is None and not session.error):
            assert time.monotonic() < end
            time.sleep(0.01)
        return self.get(f"/m/{number}/state").json()

    def choose(self, question: str, part: str, value: Any) -> dict[str, Any]:
        answer = self.post("/m/0/choose", {"question": question, "part": part, "value": value})
        assert answer.status_code == 200, answer.text
        return self.settled()
