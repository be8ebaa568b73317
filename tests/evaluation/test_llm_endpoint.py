"""Requests over a local endpoint: answered well, badly, late and not at all; replies are kept, secrets are not."""

import json
from pathlib import Path
from typing import Any

import pytest

from chat_server import KEY, LATE, ChatServer, chat_server, completion, environment
from grafu.errors import ExportError, NotRun
from grafu.evaluation.llm.chat import ChatRequest, Message, Reply, Usage
from grafu.evaluation.llm.config import LanguageModel, LlmConfig
from grafu.evaluation.llm.endpoint import NoReply, endpoint_of
from grafu.evaluation.llm.recording import Unanswered, replies_of

ASKED = (Message("system", "Instructions that are long."), Message("user", "What moves?", b"\x89PNG"))
REQUEST = ChatRequest("m", ASKED, temperature=0.5)
QUICK = LlmConfig(timeout=5.0, pause=0.01, attempts=3)


def model(folder: Path, config: LlmConfig = QUICK, name: str = "m") -> LanguageModel:
    return LanguageModel(name, config, folder / "replies")


def ask_at(chat: ChatServer, folder: Path, config: LlmConfig = QUICK) -> Reply:
    return replies_of(model(folder, config), lambda: endpoint_of(environment(chat)))(ASKED)


def texts_below(folder: Path) -> str:
    return "\n".join(path.read_text() for path in folder.rglob("*") if path.is_file())


def test_a_request_carries_instructions_picture_and_key_and_its_reply_is_counted() -> None:
    with chat_server("It does.") as chat:
        reply = endpoint_of(environment(chat)).send(REQUEST, 5.0)
    (sent,) = chat.requests
    assert (reply.text, reply.tokens_in, reply.tokens_out) == ("It does.", 1000, 50)
    assert reply.seconds > 0
    assert chat.keys == [f"Bearer {KEY}"]
    assert (sent["model"], sent["temperature"], "max_tokens" in sent) == ("m", 0.5, False)
    assert sent["messages"][0] == {"role": "system", "content": "Instructions that are long."}
    kinds = [part["type"] for part in sent["messages"][1]["content"]]
    assert kinds == ["text", "image_url"]


@pytest.mark.parametrize(
    ("answer", "again", "states"),
    [
        (500, True, "HTTP 500"),
        (429, True, "HTTP 429"),
        (400, False, r"HTTP 400 \(for a model that reads no pictures, state `picture = false`"),
        (401, False, "HTTP 401"),
        (404, False, "HTTP 404"),
        (b"<html>busy</html>", True, "no chat completion"),
        (b"{}", True, "no chat completion"),
        ({"choices": []}, True, "no chat completion"),
        ({"choices": [{"message": None}]}, True, "no chat completion"),
        (LATE, True, "no reply within 0.2 s"),
    ],
)
def test_what_is_no_reply_is_said_without_the_endpoints_own_words(answer: Any, again: bool, states: str) -> None:
    with chat_server(answer) as chat, pytest.raises(NoReply, match=states) as failure:
        endpoint_of(environment(chat)).send(REQUEST, 0.2 if answer is LATE else 5.0)
    assert failure.value.again is again
    assert KEY not in str(failure.value)
    assert chat.address not in str(failure.value)


@pytest.mark.parametrize("address", ["http://127.0.0.1:9/v1", "nonsense", "http://"])
def test_an_endpoint_that_is_not_there_cannot_be_reached(address: str) -> None:
    endpoint = endpoint_of({"OPENAI_BASE_URL": address})
    with pytest.raises(NoReply) as failure:
        endpoint.send(REQUEST, 1.0)
    assert "127.0.0.1" not in str(failure.value)


def test_tokens_that_are_not_stated_are_unknown() -> None:
    with chat_server(completion("Yes.", tokens=None)) as chat:
        reply = endpoint_of(environment(chat)).send(REQUEST, 5.0)
    assert (reply.tokens_in, reply.tokens_out) == (None, None)
    total = Usage(1, 0, 10, 5, 1.0) + Usage(1, 0, None, None, 2.0)
    assert total == Usage(2, 0, None, None, 3.0)


def test_without_an_endpoint_or_the_client_nothing_is_run(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(NotRun, match="set OPENAI_API_KEY"):
        endpoint_of({})
    monkeypatch.setattr("grafu.evaluation.llm.endpoint.find_spec", lambda _: None)
    with pytest.raises(NotRun, match=r"pip install 'grafu\[llm\]'"):
        endpoint_of({"OPENAI_API_KEY": KEY})


def test_a_request_is_sent_again_a_bounded_number_of_times(tmp_path: Path) -> None:
    with chat_server(500, 429, "At last.") as chat:
        reply = ask_at(chat, tmp_path)
    assert (reply.text, reply.requests, len(chat.requests)) == ("At last.", 3, 3)
    with chat_server(500) as chat, pytest.raises(Unanswered, match="HTTP 500; asked 3 times") as failure:
        ask_at(chat, tmp_path / "other")
    assert (failure.value.requests, len(chat.requests)) == (3, 3)
    with chat_server(401) as chat, pytest.raises(Unanswered, match="asked once"):
        ask_at(chat, tmp_path / "other")
    assert len(chat.requests) == 1
    assert not (tmp_path / "other").exists()  # what got no reply is asked again by the next run


def test_a_late_reply_is_not_waited_for(tmp_path: Path) -> None:
    config = LlmConfig(timeout=0.1, pause=0.0, attempts=2)
    with chat_server(LATE) as chat, pytest.raises(Unanswered, match=r"no reply within 0\.1 s; asked 2 times"):
        ask_at(chat, tmp_path, config)


def test_a_reply_is_kept_and_given_again_without_any_endpoint(tmp_path: Path) -> None:
    with chat_server(500, "It does.") as chat:
        first = ask_at(chat, tmp_path)
    again = replies_of(model(tmp_path), lambda: endpoint_of({}))
    assert again(ASKED) == first
    assert again((ASKED[0], Message("user", "What moves?", b"another picture of it"))) == first
    for other in (ASKED[:1], (ASKED[0], Message("user", "What else?")), (ASKED[0], Message("user", "What moves?"))):
        with pytest.raises(NotRun):
            again(other)
    with pytest.raises(NotRun):
        replies_of(model(tmp_path, name="other"), lambda: endpoint_of({}))(ASKED)


def test_a_record_holds_the_request_and_no_secret(tmp_path: Path) -> None:
    with chat_server(lambda _: f"The key is {KEY} at {chat.address}, as the manual has it.") as chat:
        reply = ask_at(chat, tmp_path)
        address = chat.address
    held = texts_below(tmp_path)
    (record,) = (json.loads(path.read_text()) for path in (tmp_path / "replies").glob("*.json"))
    assert "What moves?" in held
    assert "Instructions that are long." in held
    assert record["reply"]["text"] == reply.text
    assert reply.text.count("[removed]") == 2
    assert KEY not in held + repr(endpoint_of({"OPENAI_API_KEY": KEY}))
    assert address not in held


def test_a_word_in_place_of_a_key_is_left_in_replies() -> None:
    with chat_server('{"edges": []}') as chat:
        endpoint = endpoint_of({"OPENAI_BASE_URL": chat.address, "OPENAI_API_KEY": "e"})
        assert endpoint.send(REQUEST, 5.0).text == '{"edges": []}'


def test_nothing_is_asked_where_the_reply_could_not_be_kept(tmp_path: Path) -> None:
    (tmp_path / "replies").write_text("mine")
    with chat_server("It does.") as chat, pytest.raises(ExportError, match="another --replies"):
        ask_at(chat, tmp_path)
    assert chat.requests == []


@pytest.mark.parametrize(
    "damage", ["", "{", "[]", '{"schema": "grafu.reply/1", "reply": {"text": 1}}', '{"schema": 2}']
)
def test_a_damaged_record_is_asked_for_again(tmp_path: Path, damage: str) -> None:
    with chat_server("It does.") as chat:
        first = ask_at(chat, tmp_path)
        (file,) = (tmp_path / "replies").glob("*.json")
        file.write_text(damage)
        assert ask_at(chat, tmp_path).text == first.text
    assert len(chat.requests) == 2


@pytest.mark.parametrize(
    "wrong",
    [
        {"examples": -1},
        {"timeout": 0.0},
        {"attempts": 0},
        {"max_tokens": 0},
        {"price_in": -1.0},
        {"pause": float("nan")},
    ],
)
def test_a_config_out_of_range_is_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match=next(iter(wrong))):
        LlmConfig(**wrong)
