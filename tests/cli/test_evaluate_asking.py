"""`grafu evaluate` with language models and installed systems: rows that were asked, that failed, that were not run."""

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from chat_server import KEY, ChatServer, chat_server, completion, environment
from folders import contents
from grafu.cli.main import main
from small_assets import write_pnm

FEW = ["--tables", "motion,static,models", "--jobs", "1", "--quiet"]
CONFIG = """\
examples = 1
picture = false
attempts = 2
pause = 0.01
timeout = 20
corrections = 0
price_in = 3.0
price_out = 15.0
"""
SECRETS = ("OPENAI_API_KEY", "OPENAI_BASE_URL")


def command(data: Path, out: Path, methods: str, *more: str) -> list[str]:
    config = data.parent / "llm.toml"
    config.write_text(CONFIG)
    start = ["evaluate", "--data", str(data), "--out", str(out), "--methods", methods]
    return [*start, *FEW, "--llm", str(config), *more]


def reply_to(request: dict[str, Any]) -> dict[str, Any]:
    """Replies as a good model would: it finds the door and the drawer of the small cabinet by their names."""
    text = request["messages"][1]["content"]
    parts = {part["name"]: part["id"] for part in json.loads(text[text.index("{") :])["parts"]}
    door, drawer, side = (next(p for name, p in parts.items() if word in name) for word in ("door", "drawer", "side"))
    if "edits" in request["messages"][0]["content"]:
        edits = [{"do": "hinge", "part": door, "edge": "left"}, {"do": "slide", "part": drawer, "direction": "front"}]
        return completion(json.dumps({"edits": edits}))
    edges = [
        {"kind": "hinge", "parent": side, "child": door, "border": "-X", "axis": "-Z"},
        {"kind": "rail", "parent": side, "child": drawer, "axis": "-Y"},
    ]
    return completion(f"```json\n{json.dumps({'edges': edges})}\n```")


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("furniture") / "data"
    write_pnm(folder / "first")
    return folder


@pytest.fixture(autouse=True)
def no_endpoint(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in SECRETS:
        monkeypatch.delenv(name, raising=False)


@pytest.fixture
def good(monkeypatch: pytest.MonkeyPatch) -> Iterator[ChatServer]:
    with chat_server(reply_to) as chat:
        for name, value in environment(chat).items():
            monkeypatch.setenv(name, value)
        yield chat


def table(out: Path, name: str) -> list[dict[str, Any]]:
    return json.loads((out / "tables" / f"{name}.json").read_text())["rows"]


def figures(out: Path, method: str) -> dict[str, Any]:
    return next(row for row in table(out, "motion") if (row["method"], row["over"]) == (method, "objects"))


@pytest.mark.slow
def test_models_are_asked_once_and_what_it_cost_is_stated(
    data: Path, tmp_path: Path, good: ChatServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    methods, out = "llm:large:8b,llm-edit:large:8b", tmp_path / "out"
    assert main(command(data, out, methods)) == 0
    for method in methods.split(","):
        assert figures(out, method)["aligned"]["value"] == 1.0
        assert figures(out, method)["works_fixed"]["value"] == 1.0
        (row,) = (row for row in table(out, "usage") if row["method"] == method)
        assert (row["models"], row["not_run"], row["failures"], row["requests"], row["unanswered"]) == (1, 0, 0, 1, 0)
        assert (row["tokens_in"], row["tokens_out"]) == (1000, 50)
        assert row["price"] == pytest.approx(1000 * 3e-6 + 50 * 15e-6)
        assert row["seconds"] >= 0
    assert [request["model"] for request in good.requests] == ["large:8b", "large:8b"]
    assert "What asking language models used" in (out / "index.html").read_text()

    held = b"".join(contents(out).values())
    assert KEY.encode() not in held  # neither the key nor the endpoint is in any file
    assert good.address.split("//")[1].split("/")[0].encode() not in held

    for name in SECRETS:
        monkeypatch.delenv(name)
    other = tmp_path / "other"  # replies are read from the folder
    assert main(command(data, other, methods, "--replies", str(out / "replies"))) == 0
    assert len(good.requests) == 2
    for name in ("motion.csv", "usage.csv", "static.csv"):
        assert (other / "tables" / name).read_bytes() == (out / "tables" / name).read_bytes()


def test_what_cannot_be_run_is_a_row_that_states_why_and_the_rest_goes_on(
    data: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    run = tmp_path / "run.toml"
    run.write_text('command = ["no-such-program", "{out}"]')
    methods, out = f"annotation,llm:m,llm-edit:m,singapo-run:{run}", tmp_path / "out"
    assert main(command(data, out, methods)) == 0
    said = capfd.readouterr().err
    assert figures(out, "annotation")["aligned"]["value"] == 1.0
    for method, why in (("llm:m", "set OPENAI_API_KEY"), (f"singapo-run:{run}", "singapo is not installed")):
        row = figures(out, method)
        assert row["data"].startswith("not run: ")
        assert why in row["data"]
        assert (row["objects"], row["aligned"]) == (1, None)
        assert f"{method}: not run on 1 model: " in said
    assert [(row["models"], row["not_run"], row["price"]) for row in table(out, "usage")] == [(0, 1, 0.0), (0, 1, 0.0)]
    assert {row["method"] for row in table(out, "static")} == {"annotation", "GraFu (the paper, PN-M)"}
    assert "## Not run" in (out / "tables" / "index.md").read_text()
    assert "not run" in (out / "index.html").read_text()


def test_what_was_not_run_is_run_by_the_same_command_later(
    data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "out"
    assert main(command(data, out, "llm:m")) == 0
    assert figures(out, "llm:m")["data"].startswith("not run")
    with chat_server(reply_to) as chat:
        for name, value in environment(chat).items():
            monkeypatch.setenv(name, value)
        assert main(command(data, out, "llm:m")) == 0
    assert figures(out, "llm:m")["aligned"]["value"] == 1.0


@pytest.mark.parametrize(
    ("answer", "states", "counts"),
    [
        ("I cannot do that.", "a reply that cannot be used: a reply must hold one JSON object", (1, 0)),
        (500, "no reply: the endpoint answered HTTP 500; asked 2 times", (2, 2)),
    ],
)
def test_a_bad_reply_is_a_failure_that_is_counted(
    answer: Any, states: str, counts: tuple[int, int], data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    out = tmp_path / "out"
    with chat_server(answer) as chat:
        for name, value in environment(chat).items():
            monkeypatch.setenv(name, value)
        assert main(command(data, out, "llm:m")) == 1
    said = capfd.readouterr().err
    assert states in said
    assert "Traceback" not in said
    assert KEY not in said
    row = figures(out, "llm:m")
    assert (row["parts"], row["aligned"]["value"], row["works_fixed"]["value"]) == (2, 0.0, 0.0)
    (used,) = table(out, "usage")
    assert (used["failures"], used["requests"], used["unanswered"]) == (1, *counts)
    assert KEY.encode() not in b"".join(contents(out).values())


def test_tokens_that_are_not_stated_make_the_price_unknown(data: Path, tmp_path: Path, good: ChatServer) -> None:
    good.answers = [lambda request: completion(reply_to(request)["choices"][0]["message"]["content"], tokens=None)]
    assert main(command(data, tmp_path / "out", "llm:m")) == 0
    (row,) = table(tmp_path / "out", "usage")
    assert (row["tokens_in"], row["tokens_out"], row["price"]) == ("unknown", "unknown", "unknown")
    assert "unknown" in (tmp_path / "out" / "tables" / "usage.md").read_text()


@pytest.mark.parametrize(
    ("config", "methods", "states"),
    [
        ("", "llm", "`llm:MODEL` with the name of a language model"),
        ("", "llm-edit", "`llm-edit:MODEL`"),
        ("", "singapo-run", "`singapo-run:FILE`"),
        ("", "singapo-run:nowhere.toml", "nowhere.toml cannot be read"),
        ("examples = 'many'", "llm:m", "`examples`"),
        ("examples = -1", "llm:m", "must not be negative"),
        ("key = 'sk'", "llm:m", "`key`"),
        ("examples =", "llm:m", "is no TOML"),
        ("", "llm:m,llm:m", "each once"),
    ],
)
def test_wrong_options_end_in_one_line(
    config: str, methods: str, states: str, data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = command(data, tmp_path / "out", methods)
    (data.parent / "llm.toml").write_text(config)
    assert main(words) == 2
    said = capsys.readouterr().err
    assert states in said
    assert said.count("\n") == 1
    assert not (tmp_path / "out").exists()


def test_the_client_is_imported_only_where_a_model_is_asked() -> None:
    code = "import sys, grafu.cli.evaluate, grafu.evaluation.perform; print('openai' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"
