"""Who may ask the server: whoever has the token that is in the address, on this machine, from a page of its own.

Every answer, refusals too, forbids the page to reach anything else, to be framed, and to be kept by anyone.
"""

from collections.abc import Awaitable, Callable, Iterable, MutableMapping
from secrets import compare_digest
from typing import Any, Final, final

from grafu.dataclass import dataclass

Scope = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[MutableMapping[str, Any]]]
Send = Callable[[MutableMapping[str, Any]], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]

HOSTS: Final = ("127.0.0.1", "localhost")
POLICY: Final = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
HEADERS: Final = (
    (b"content-security-policy", POLICY.encode()),
    (b"cache-control", b"no-store"),
    (b"referrer-policy", b"no-referrer"),
    (b"x-content-type-options", b"nosniff"),
    (b"cross-origin-resource-policy", b"same-origin"),
    (b"cross-origin-opener-policy", b"same-origin"),
)
_REFUSED: Final = b"403: this address needs the token that `grafu edit` printed\n"


@final
@dataclass(frozen=True)
class Guarded:
    """An application that answers only under `/TOKEN/`, asked by one of its hosts' names.

    A page elsewhere that makes its own name lead to this machine (DNS rebinding) asks with that name, and is refused;
    so is what another page has a browser send.
    """

    app: App
    token: str
    port: int

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Passes a request on, its path without the token, or refuses it with 403."""
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
            return
        rest = self._path(scope["path"])
        if scope["type"] != "http" or rest is None or not self._is_own(scope["headers"]):
            await _refuse(scope, receive, send)
            return
        await self.app({**scope, "path": rest, "raw_path": rest.encode()}, receive, _with_headers(send))

    def _path(self, path: str) -> str | None:
        """Returns the path after the token; None where another stands in its place."""
        _, first, rest = (*path.split("/", 2), "", "")[:3]
        return f"/{rest}" if compare_digest(first.encode(), self.token.encode()) else None

    def _is_own(self, headers: Iterable[tuple[bytes, bytes]]) -> bool:
        """Whether host and origin, where one is stated, are this server's."""
        names = [f"{host}:{self.port}" for host in HOSTS]
        hosts = [value.decode("latin-1") for name, value in headers if name == b"host"]
        origins = [value.decode("latin-1") for name, value in headers if name == b"origin"]
        return len(hosts) == 1 and hosts[0] in names and all(o in [f"http://{n}" for n in names] for o in origins)


def _with_headers(send: Send) -> Send:
    async def sent(message: MutableMapping[str, Any]) -> None:
        if message["type"] == "http.response.start":
            message = {**message, "headers": [*message.get("headers", ()), *HEADERS]}
        await send(message)

    return sent


async def _refuse(scope: Scope, receive: Receive, send: Send) -> None:
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 1008})
        return
    start = {"type": "http.response.start", "status": 403, "headers": [(b"content-type", b"text/plain"), *HEADERS]}
    await send(start)
    await send({"type": "http.response.body", "body": _REFUSED})
