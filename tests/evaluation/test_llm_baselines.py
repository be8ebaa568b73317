"""From a model's parts to what the pipeline makes of a reply: right ones, wrong ones, corrected ones; examples."""

import json
from pathlib import Path

import pytest

from grafu.asset.part import Asset
from grafu.evaluation.dataset import ModelRef, load_model
from grafu.evaluation.llm.baselines import EDITS, GRAPH, asked, prompt_hash
from grafu.evaluation.llm.chat import Message, Reply
from grafu.evaluation.llm.config import EXAMPLES_SEED, LanguageModel, LlmConfig
from grafu.evaluation.llm.graph_prompt import examples_text, graph_messages
from grafu.evaluation.llm.graph_reply import read_graph_reply
from grafu.evaluation.llm.graph_text import completion_text, graph_text, numbered
from grafu.evaluation.llm.recording import Ask, Unanswered
from grafu.evaluation.perform import method_facts
from grafu.evaluation.still_picture import SIZE, picture_of
from grafu.evaluation.tasks import MethodTask, key_of
from grafu.graph.parse import parse_graph
from grafu.synth.generate import make_specimen
from small_assets import load_annotated, write_pnm

SEED, NUMBER = 990002, 2  # a bookcase with a door
QUICK = LlmConfig(examples=1, picture=False, corrections=1)
NOTHING = '{"edges": []}'


def replies(*texts: str) -> tuple[Ask, list[tuple[Message, ...]]]:
    """Gives these replies in order, and keeps what was asked."""
    asked_for: list[tuple[Message, ...]] = []

    def ask(messages: tuple[Message, ...]) -> Reply:
        asked_for.append(messages)
        return Reply(texts[len(asked_for) - 1], 100, 10, 0.5)

    return ask, asked_for


def model(config: LlmConfig = QUICK) -> LanguageModel:
    return LanguageModel("m", config, Path("replies"))


@pytest.fixture(scope="module")
def cabinet(tmp_path_factory: pytest.TempPathFactory) -> Asset:
    return load_annotated(write_pnm(tmp_path_factory.mktemp("data") / "cabinet"))


def edits_of(asset: Asset, *edits: dict[str, str]) -> str:
    """Returns a reply; a part is named by a word of its id."""
    names = numbered(parse_graph(asset.without_annotation()))
    found = {word: next(n for part, n in names.items() if word in part) for word in ("door", "drawer", "shelf")}
    return json.dumps({"edits": [{k: found.get(v, v) for k, v in edit.items()} for edit in edits]})


def test_the_true_completion_moves_every_part_as_annotated() -> None:
    asset = load_model(ModelRef("made", "made", seed=SEED, number=NUMBER))
    text = completion_text(make_specimen(SEED, NUMBER, points=0))
    ask, asked_for = replies(f"Here it is.\n```json\n{text}\n```")
    answer = asked(GRAPH, model(), asset, SEED, ask)
    (made,) = answer.values
    parts = method_facts(asset, made).parts
    assert parts
    assert all(part.raw.aligned and part.fixed.works for part in parts if part.raw and part.fixed)
    assert (answer.usage.requests, answer.usage.tokens_in, answer.usage.seconds) == (1, 100, 0.5)
    assert [message.role for message in asked_for[0]] == ["system", "user"]


def test_stated_edits_are_built_and_nothing_else_moves(cabinet: Asset) -> None:
    ask, _ = replies(edits_of(cabinet, {"do": "hinge", "part": "door", "edge": "left"}))
    (made,) = asked(EDITS, model(), cabinet, ask=ask).values
    door, drawer = method_facts(cabinet, made).parts
    assert door.fixed
    assert door.fixed.works
    assert drawer.fixed
    assert drawer.fixed.found is None
    assert made.additions == ()


def test_a_graph_without_motions_leaves_every_part_static(cabinet: Asset) -> None:
    ask, _ = replies(NOTHING)
    (made,) = asked(GRAPH, model(), cabinet, ask=ask).values
    assert all(part.raw and part.raw.found is None for part in method_facts(cabinet, made).parts)


def test_a_reply_that_cannot_be_used_is_corrected_once(cabinet: Asset) -> None:
    ask, asked_for = replies("Sorry.", NOTHING)
    answer = asked(GRAPH, model(), cabinet, ask=ask)
    assert len(answer.values) == 1
    assert (answer.usage.requests, answer.usage.tokens_out) == (2, 20)
    roles = [message.role for message in asked_for[1]]
    assert roles == ["system", "user", "assistant", "user"]
    assert asked_for[1][2].text == "Sorry."
    assert "cannot be used: a reply must hold one JSON object with `edges`" in asked_for[1][3].text


def test_what_cannot_be_used_to_the_end_is_a_failure_with_its_cost(cabinet: Asset) -> None:
    ask, _ = replies("Sorry.", '{"edges": [')
    answer = asked(GRAPH, model(), cabinet, ask=ask)
    assert (answer.values, answer.usage.requests) == ((), 2)
    assert "cut off" in answer.fault

    def silent(_: tuple[Message, ...]) -> Reply:
        raise Unanswered("no reply within 1 s; asked 3 times", 3)

    answer = asked(GRAPH, model(), cabinet, ask=silent)
    assert answer.fault == "no reply: no reply within 1 s; asked 3 times"
    assert (answer.usage.requests, answer.usage.unanswered, answer.usage.tokens_in) == (3, 3, 0)


def test_what_cannot_be_built_is_shown_by_the_numbers_that_the_model_knows(cabinet: Asset) -> None:
    wrong = edits_of(cabinet, {"do": "hinge", "part": "door", "edge": "front"})
    ask, asked_for = replies(wrong, edits_of(cabinet))
    answer = asked(EDITS, model(), cabinet, ask=ask)
    assert len(answer.values) == 1
    shown = asked_for[1][3].text
    assert "must turn about one of its borders" in shown
    number = next(n for part, n in numbered(parse_graph(cabinet)).items() if "door" in part)
    assert f"`{number}`" in shown
    assert "cabinet_door" not in shown


def test_examples_are_the_same_in_every_run_and_complete_furniture() -> None:
    first = examples_text(EXAMPLES_SEED, 3, 20)
    examples_text.cache_clear()
    assert examples_text(EXAMPLES_SEED, 3, 20) == first
    assert len(set(first)) == 3
    assert all('"kind": "' in text for text in first)


def test_every_example_is_a_reply_that_can_be_read() -> None:
    for number in range(12):
        specimen = make_specimen(EXAMPLES_SEED, number, points=0)
        found = read_graph_reply(completion_text(specimen), specimen.given, "m")
        truth = specimen.truth
        assert {n.id: found.labels[n.id] for n in specimen.given.nodes} == {
            n.id: truth.node(n.id).label for n in specimen.given.nodes
        }
        assert len(found.motions.joints) == len({edge.child for edge in truth.motions} - set(specimen.missing))


def test_examples_are_never_of_the_furniture_that_is_evaluated() -> None:
    asset = parse_graph(make_specimen(EXAMPLES_SEED, 0, points=0).asset)
    own, _ = graph_messages(asset, QUICK, EXAMPLES_SEED)
    others, _ = graph_messages(asset, QUICK, SEED)
    assert graph_text(make_specimen(EXAMPLES_SEED, 0, points=0).given) in others.text
    assert graph_text(make_specimen(EXAMPLES_SEED, 0, points=0).given) not in own.text
    assert examples_text(EXAMPLES_SEED + 1, 1, QUICK.most_parts)[0] in own.text


def test_the_prompt_holds_twenty_examples_by_default_and_no_annotation(cabinet: Asset) -> None:
    system, user = graph_messages(parse_graph(cabinet.without_annotation()), LlmConfig())
    assert system.text.count("\nExample ") == 20
    assert user.text.count('"id": "p') == len(cabinet.parts)
    assert "revolute" not in user.text
    assert "mobility" not in user.text


def test_a_picture_goes_with_the_question_where_it_is_wanted(cabinet: Asset) -> None:
    for picture in (True, False):
        config = LlmConfig(examples=0, picture=picture)
        ask, asked_for = replies(NOTHING)
        asked(GRAPH, model(config), cabinet, ask=ask)
        question = asked_for[0][1]
        assert bool(question.picture) is picture
        assert ("picture of it is attached" in question.text) is picture


def test_the_picture_shows_the_model_alone(cabinet: Asset) -> None:
    data = picture_of(cabinet)
    assert data.startswith(b"\x89PNG")
    assert picture_of(cabinet.without_annotation()) == data
    assert SIZE[0].to_bytes(4, "big") + SIZE[1].to_bytes(4, "big") in data[:32]


def test_what_determines_a_reply_determines_the_key_of_its_row() -> None:
    hashes = [
        prompt_hash(name, model(config))
        for name in (GRAPH, EDITS)
        for config in (QUICK, LlmConfig(examples=1, picture=True), LlmConfig(examples=1, picture=False, corrections=0))
    ]
    assert len(set(hashes)) == len(hashes)
    dearer = LlmConfig(examples=1, picture=False, price_in=1.0, price_out=1.0, timeout=1.0)
    assert prompt_hash(GRAPH, model(dearer)) == hashes[0]
    assert prompt_hash(GRAPH, model(LlmConfig(examples=2, picture=False))) != hashes[0]
    assert prompt_hash(EDITS, model(LlmConfig(examples=2, picture=False))) == hashes[3]
    from grafu.evaluation.methods import Method

    ref = ModelRef("made", "made", seed=SEED, number=NUMBER)
    keys = {key_of(MethodTask(ref, Method(name, model=model()))) for name in (GRAPH, EDITS)}
    assert len(keys) == 2
