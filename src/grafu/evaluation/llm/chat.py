"""Requests to a language model, its replies, and what they used up, as values. Nothing is sent here."""

import json
from hashlib import sha256
from typing import Any, Literal, final

from grafu.dataclass import dataclass


@final
@dataclass(frozen=True, slots=True)
class Message:
    """One message of a conversation; `picture` is a PNG, or empty."""

    role: Literal["system", "user", "assistant"]
    text: str
    picture: bytes = b""


@final
@dataclass(frozen=True, slots=True)
class ChatRequest:
    """All that determines a reply, as far as anything does.

    A picture does not count in the `key`: it shows what the text states, and another machine may draw it otherwise in
    its last bits.
    """

    model: str
    messages: tuple[Message, ...]
    max_tokens: int | None = None
    temperature: float | None = None

    @property
    def options(self) -> dict[str, Any]:
        """What is sent beside model and messages."""
        stated = {"max_tokens": self.max_tokens, "temperature": self.temperature}
        return {name: value for name, value in stated.items() if value is not None}

    @property
    def key(self) -> str:
        """A hash: the same request has the same key in every run."""
        said = [[message.role, message.text, bool(message.picture)] for message in self.messages]
        text = json.dumps([self.model, said, self.options], sort_keys=True)
        return sha256(text.encode()).hexdigest()[:32]


@final
@dataclass(frozen=True, slots=True)
class Reply:
    """What a model replied, the tokens of prompt and reply (None: not stated), and what it took to get it.

    `seconds` are those of all `requests`, the last of which was answered.
    """

    text: str
    tokens_in: int | None
    tokens_out: int | None
    seconds: float
    requests: int = 1


@final
@dataclass(frozen=True, slots=True)
class Usage:
    """What asking about one model of furniture, or about several, used up; tokens are None where one is not stated."""

    requests: int = 0
    unanswered: int = 0
    tokens_in: int | None = 0
    tokens_out: int | None = 0
    seconds: float = 0.0

    def __add__(self, other: "Usage") -> "Usage":
        return Usage(
            self.requests + other.requests,
            self.unanswered + other.unanswered,
            _sum(self.tokens_in, other.tokens_in),
            _sum(self.tokens_out, other.tokens_out),
            self.seconds + other.seconds,
        )


def usage_of(reply: Reply) -> Usage:
    """Returns what one reply used up."""
    return Usage(reply.requests, reply.requests - 1, reply.tokens_in, reply.tokens_out, reply.seconds)


def _sum(a: int | None, b: int | None) -> int | None:
    return None if a is None or b is None else a + b
