"""The server on this machine alone: a free port of the loopback, a random token, the browser."""

import socket
import webbrowser
from collections.abc import Callable, Sequence
from pathlib import Path
from secrets import token_urlsafe
from typing import Final, final

import uvicorn

from grafu.editor.access import HOSTS
from grafu.editor.server import application, models_of
from grafu.editor.workspace import Workspace
from grafu.errors import OptionError
from grafu.processes.lifetime import scratch_folder

_TOKEN_BYTES: Final = 24
_PATIENCE: Final = 2  # seconds that open connections have to end


@final
class _Announced(uvicorn.Server):
    """Tells its address when it answers."""

    def __init__(self, config: uvicorn.Config, announce: Callable[[], None]) -> None:
        super().__init__(config)
        self._announce = announce

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Starts, then tells."""
        await super().startup(sockets)
        if self.started:
            self._announce()


def serve(workspaces: Sequence[Workspace], say: Callable[[str], None], port: int = 0, browser: bool = True) -> None:
    """Serves until it is interrupted; `say` gets the address. With `port` 0 a free one is taken.

    Raises:
        OptionError: if the port is taken.
    """
    token = token_urlsafe(_TOKEN_BYTES)
    with _bound(port) as listening, scratch_folder() as scratch:
        at = listening.getsockname()[1]
        address = f"http://{HOSTS[0]}:{at}/{token}/"

        def announce() -> None:
            say(address)
            if browser:
                webbrowser.open(address)

        app = application(models_of(workspaces, Path(scratch)), token, at)
        config = uvicorn.Config(
            app,
            log_level="error",
            access_log=False,
            server_header=False,
            timeout_graceful_shutdown=_PATIENCE,
        )
        _Announced(config, announce).run([listening])


def _bound(port: int) -> socket.socket:
    listening = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listening.bind((HOSTS[0], port))
    except OSError as error:
        listening.close()
        raise OptionError(f"the port {port} cannot be used ({error.strerror}): choose another --port") from None
    return listening
