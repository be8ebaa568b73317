"""The two baselines that ask a language model about a model of furniture, from its parts to what the pipeline makes."""

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from hashlib import sha256

from grafu.asset.part import IDENTITY_FRAME, Asset
from grafu.errors import FunctionalizationError, ReplyError
from grafu.evaluation.llm.chat import Message
from grafu.evaluation.llm.config import EXAMPLES_SEED, LanguageModel
from grafu.evaluation.llm.conversation import ModelAnswer, converse
from grafu.evaluation.llm.edit_prompt import EDIT_INSTRUCTIONS, edit_messages
from grafu.evaluation.llm.edit_reply import read_edit_reply
from grafu.evaluation.llm.graph_prompt import GRAPH_INSTRUCTIONS, graph_messages
from grafu.evaluation.llm.graph_reply import read_graph_reply
from grafu.evaluation.llm.graph_text import numbered
from grafu.evaluation.llm.recording import Ask, replies_of
from grafu.evaluation.still_picture import picture_of
from grafu.graph.parse import parse_graph
from grafu.pipeline.functionalize import Functionalized, functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.templates.gallery import builtin_gallery

GRAPH, EDITS = "llm", "llm-edit"


def asked(
    name: str, model: LanguageModel, asset: Asset, seed: int | None = None, ask: Ask | None = None
) -> ModelAnswer[Functionalized]:
    """Returns what the pipeline makes of a language model's reply about an asset, and what that used up.

    A reply that cannot be read, or of which nothing can be built, is shown to the model with the reason, as often as
    its config states; then the answer states the fault.

    Args:
        name: `GRAPH` for a completed graph, `EDITS` for a list of edits.
        model: which model is asked, and how.
        asset: in the object frame; what it states of its motions is not used.
        seed: that of a synthetic asset, so that no example is of the same furniture.
        ask: gets replies; None: recorded ones, and others from the endpoint.

    Raises:
        NotRun: if a reply is not recorded and there is no endpoint.
        ExportError: if a reply cannot be recorded.
    """
    bare = replace(asset.without_annotation(), frame=IDENTITY_FRAME)  # replies are in the object frame
    begin, accept = (_graph if name == GRAPH else _edits)(model, bare, seed)
    return converse(begin, ask or replies_of(model), accept, model.config.corrections)


def prompt_hash(name: str, model: LanguageModel) -> str:
    """Returns a hash of what determines a reply beside the model of furniture."""
    config = model.config
    given = config.picture, config.corrections, config.max_tokens, config.temperature
    if name == GRAPH:
        said: tuple[object, ...] = (GRAPH_INSTRUCTIONS, EXAMPLES_SEED, config.examples, config.most_parts, *given)
    else:
        said = (EDIT_INSTRUCTIONS, *given)
    return sha256(repr(said).encode()).hexdigest()[:16]


Accept = Callable[[str], Functionalized]
Begun = tuple[tuple[Message, ...], Accept]


def _graph(model: LanguageModel, bare: Asset, seed: int | None) -> Begun:
    graph = parse_graph(bare)

    def build(text: str) -> Functionalized:
        found = read_graph_reply(text, graph, model.name)
        return functionalize(bare.with_labels(found.labels), found.motions, builtin_gallery())

    return graph_messages(graph, model.config, seed, _picture(model, bare)), _with_numbers(build, numbered(graph))


def _edits(model: LanguageModel, bare: Asset, _: int | None) -> Begun:
    graph = parse_graph(bare)
    numbers = numbered(graph)
    ids = {number: part for part, number in numbers.items()}

    def build(text: str) -> Functionalized:
        stated = read_edit_reply(text, ids)
        parts = tuple(replace(part, carried_by=stated.attached.get(part.id)) for part in bare.parts)
        edited = replace(bare, parts=parts)  # it states no joints: those of the settings are the only ones
        return functionalize(edited, MotionSource.ANNOTATION, builtin_gallery(), PipelineConfig(stated.settings))

    return edit_messages(graph, _picture(model, bare)), _with_numbers(build, numbers)


def _with_numbers(build: Accept, numbers: Mapping[str, str]) -> Accept:
    """Returns the same, with parts named in its errors as the language model knows them."""
    ids = sorted(map(re.escape, numbers), key=len, reverse=True)
    named = re.compile(rf"(?<!\w)({'|'.join(ids)})(?!\w)")

    def accept(text: str) -> Functionalized:
        try:
            return build(text)
        except ReplyError:  # it names them so already
            raise
        except FunctionalizationError as error:
            raise ReplyError(named.sub(lambda found: numbers[found[0]], str(error))) from None

    return accept


def _picture(model: LanguageModel, asset: Asset) -> bytes:
    return picture_of(asset) if model.config.picture else b""
