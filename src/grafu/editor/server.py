"""The server's routes: pages, scripts, what was built, choices, progress. It binds nothing and opens nothing."""

import asyncio
import json
from collections.abc import AsyncIterator, Awaitable, Callable, Sequence
from contextlib import asynccontextmanager
from functools import cache
from pathlib import Path
from typing import Any, Final, final

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import HTMLResponse, JSONResponse, RedirectResponse, Response, StreamingResponse
from starlette.routing import Route

from grafu.api.saving import MODEL_PAGE
from grafu.asset.json_files import read_own
from grafu.dataclass import dataclass
from grafu.editor.access import Guarded
from grafu.editor.builder import BuildProcess, Builds
from grafu.editor.building import FILES
from grafu.editor.pages import model_page_of, wall_page, wall_row
from grafu.editor.scripts import SCRIPTS, style
from grafu.editor.session import Session
from grafu.editor.workspace import Workspace
from grafu.errors import AssetError, FunctionalizationError, OptionError
from grafu.templates.gallery import open_handles
from grafu.viewer.pictures import MIME, thumbnail_of_page

_MOST_BODY: Final = 65536  # bytes of a choice
_MOST_PAGE: Final = 256 * 2**20  # bytes of a page that a picture is taken from
_HANDLE_SIZE: Final = (84, 62)  # pixels of the picture of a handle
_HEARTBEAT: Final = 15.0  # seconds without news after which a line keeps the connection

Handler = Callable[[Request], Awaitable[Response]]


@final
@dataclass(frozen=True)
class EditedModels:
    """All models that are edited, and the builder that they share."""

    sessions: tuple[Session, ...]
    builder: Builds

    def session(self, request: Request) -> Session:
        """Returns the session that an address names. Raises OptionError if there is none of its number."""
        number = request.path_params["number"]
        if number >= len(self.sessions):
            raise OptionError(f"there are {len(self.sessions)} models: got number {number}")
        return self.sessions[number]


def models_of(workspaces: Sequence[Workspace], scratch: Path) -> EditedModels:
    """Returns a session for each model; what the pages fetch goes to folders in `scratch`."""
    builder = BuildProcess()
    sessions = []
    for number, workspace in enumerate(workspaces):
        folder = scratch / str(number)
        folder.mkdir(parents=True)
        sessions.append(Session(workspace, builder, folder))
    return EditedModels(tuple(sessions), builder)


def application(models: EditedModels, token: str, port: int) -> Guarded:
    """Returns the server as an ASGI application that answers under `/TOKEN/` alone."""
    model = "/m/{number:int}"
    routes = [
        Route("/", _start(models)),
        Route("/style.css", _style),
        *(Route(f"/{name}", _script(name)) for name in SCRIPTS),
        Route("/thumbnail/{number:int}", _plainly(models, _thumbnail)),
        Route("/handle/{style}", _handle),
        Route(f"{model}/", _plainly(models, _page)),
        Route(f"{model}/state", _plainly(models, _state)),
        *(Route(f"{model}/{name}", _plainly(models, _file(name))) for name in FILES),
        Route(f"{model}/events", _plainly(models, _events)),
        *(Route(f"{model}/{name}", _plainly(models, act), methods=["POST"]) for name, act in _ACTIONS.items()),
    ]

    @asynccontextmanager
    async def lifespan(_: Starlette) -> AsyncIterator[None]:
        yield
        models.builder.stop()

    return Guarded(Starlette(routes=routes, lifespan=lifespan), token, port)


Act = Callable[[EditedModels, Session, Request], Awaitable[Response]]


def _plainly(models: EditedModels, act: Act) -> Handler:
    """Returns a handler that states in one line what the user got wrong."""

    async def handle(request: Request) -> Response:
        try:
            return await act(models, models.session(request), request)
        except FunctionalizationError as error:
            return JSONResponse({"error": " ".join(str(error).split())}, 400)

    return handle


def _start(models: EditedModels) -> Handler:
    async def start(_: Request) -> Response:
        if len(models.sessions) == 1:
            return RedirectResponse("m/0/")
        rows = [_row(number, session) for number, session in enumerate(models.sessions)]
        return HTMLResponse(wall_page(rows))

    return start


def _row(number: int, session: Session) -> dict[str, Any]:
    report = session.built.report if session.built else session.workspace.report
    has_picture = (session.workspace.folder / MODEL_PAGE).is_file()
    return wall_row(number, session.workspace.name, report, has_picture)


async def _style(_: Request) -> Response:
    return Response(style(), media_type="text/css")


def _script(name: str) -> Handler:
    async def script(_: Request) -> Response:
        return Response(SCRIPTS[name](), media_type="text/javascript")

    return script


async def _thumbnail(_: EditedModels, session: Session, __: Request) -> Response:
    def picture() -> bytes:
        try:
            return thumbnail_of_page(read_own(session.workspace.folder / MODEL_PAGE, "a page of grafu", _MOST_PAGE))
        except AssetError:  # no page, or a damaged one
            return b""

    data = await run_in_threadpool(picture)
    return Response(data, media_type=MIME) if data else Response(status_code=404)


async def _handle(request: Request) -> Response:
    picture = await run_in_threadpool(_handle_picture, request.path_params["style"])
    return Response(picture, media_type="image/png") if picture else Response(status_code=404)


@cache
def _handle_picture(style: str) -> bytes:
    """Returns a small picture of a handle; empty where there is none of this name."""
    from grafu.render.gallery import handle_picture
    from grafu.render.picture import encode_png

    template = open_handles(None).get(style)
    return encode_png(handle_picture(template, size=_HANDLE_SIZE)) if template else b""


async def _page(models: EditedModels, session: Session, request: Request) -> Response:
    session.build()
    return HTMLResponse(model_page_of(session.workspace.name, request.path_params["number"], len(models.sessions)))


async def _state(_: EditedModels, session: Session, __: Request) -> Response:
    if session.built is None:
        raise OptionError("nothing is built yet")
    return JSONResponse(session.page_state())


def _file(name: str) -> Act:
    async def file(_: EditedModels, session: Session, request: Request) -> Response:
        if session.built is None or request.url.query != session.built.state[name]:
            raise OptionError(f"the {name} that were asked for are not those of the last build")
        return Response(session.built.files[name], media_type="application/octet-stream")

    return file


async def _events(_: EditedModels, session: Session, __: Request) -> Response:
    async def lines() -> AsyncIterator[str]:
        events = session.events()
        waiting = asyncio.ensure_future(anext(events))
        try:
            while True:
                done, _ = await asyncio.wait([waiting], timeout=_HEARTBEAT)
                if not done:
                    yield ": still here\n\n"
                    continue
                yield f"data: {json.dumps(waiting.result())}\n\n"
                waiting = asyncio.ensure_future(anext(events))
        finally:
            waiting.cancel()

    return StreamingResponse(lines(), media_type="text/event-stream")


async def _choose(_: EditedModels, session: Session, request: Request) -> Response:
    body = await _body(request)
    question, part = body.get("question"), body.get("part")
    if not isinstance(question, str) or not isinstance(part, str):
        raise OptionError("a choice must have a question and a part, both as text")
    session.choose(question, part, body.get("value"))
    return JSONResponse(session.status())


async def _body(request: Request) -> dict[str, Any]:
    """Returns the JSON object that a request holds. Raises OptionError if it holds none, or one that is too large."""
    data = bytearray()
    async for chunk in request.stream():
        data += chunk
        if len(data) > _MOST_BODY:
            raise OptionError(f"a choice must be at most {_MOST_BODY} bytes")
    try:
        body = json.loads(data)
    except (ValueError, RecursionError):
        body = None
    if not isinstance(body, dict):
        raise OptionError("a choice must be a JSON object")
    return body


async def _undo(_: EditedModels, session: Session, __: Request) -> Response:
    session.undo()
    return JSONResponse(session.status())


async def _redo(_: EditedModels, session: Session, __: Request) -> Response:
    session.redo()
    return JSONResponse(session.status())


async def _anew(_: EditedModels, session: Session, __: Request) -> Response:
    session.start_anew()
    return JSONResponse(session.status())


async def _stop(_: EditedModels, session: Session, __: Request) -> Response:
    await run_in_threadpool(session.stop)
    return JSONResponse(session.status())


async def _export(_: EditedModels, session: Session, __: Request) -> Response:
    return JSONResponse(await session.export())


_ACTIONS: Final[dict[str, Act]] = {
    "choose": _choose,
    "undo": _undo,
    "redo": _redo,
    "anew": _anew,
    "stop": _stop,
    "export": _export,
}
