"""A local endpoint of chat completions for tests: it answers what each test puts into its list, and keeps what came."""

import json
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

KEY = "sk-secret-0123456789"


def completion(text: str, tokens: tuple[int, int] | None = (1000, 50)) -> dict[str, Any]:
    """A reply in the form of OpenAI's chat completions."""
    choice = {"index": 0, "message": {"role": "assistant", "content": text}, "finish_reason": "stop"}
    head = {"id": "chat-1", "object": "chat.completion", "created": 1, "model": "m", "choices": [choice]}
    if tokens is None:
        return head
    return head | {"usage": {"prompt_tokens": tokens[0], "completion_tokens": tokens[1], "total_tokens": sum(tokens)}}


@dataclass
class ChatServer:
    """`answers` are given in order, the last one again and again: a text, a JSON value, raw bytes, an HTTP state, or
    `LATE`; a function makes one of these from the request."""

    answers: list[Any]
    address: str = ""
    requests: list[dict[str, Any]] = field(default_factory=list)
    keys: list[str] = field(default_factory=list)
    ended: threading.Event = field(default_factory=threading.Event)

    def take(self, request: dict[str, Any], key: str) -> Any:
        answer: Any = self.answers[min(len(self.requests), len(self.answers) - 1)]
        self.requests.append(request)
        self.keys.append(key)
        return answer(request) if isinstance(answer, Callable) else answer


LATE = object()


@contextmanager
def chat_server(*answers: Any) -> Iterator[ChatServer]:
    chat = ChatServer(list(answers))

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            answer = chat.take(body, self.headers.get("Authorization", ""))
            if answer is LATE:
                chat.ended.wait(20)
                return
            state = answer if isinstance(answer, int) else 200
            if isinstance(answer, int):
                answer = {"error": {"message": f"refused for the key {KEY}"}}
            data = answer if isinstance(answer, bytes) else b""
            if not data:
                data = json.dumps(completion(answer) if isinstance(answer, str) else answer).encode()
            self.send_response(state)
            self.send_header("Content-Type", "application/json")
            self.send_header("Content-Length", str(len(data)))
            self.end_headers()
            self.wfile.write(data)

        def log_message(self, *_: Any) -> None:
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server.daemon_threads = True
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01}, daemon=True)
    thread.start()
    chat.address = f"http://127.0.0.1:{server.server_port}/v1"
    try:
        yield chat
    finally:
        chat.ended.set()
        server.shutdown()
        thread.join()
        server.server_close()


def environment(chat: ChatServer) -> dict[str, str]:
    """The variables that lead to a server."""
    return {"OPENAI_BASE_URL": chat.address, "OPENAI_API_KEY": KEY}
