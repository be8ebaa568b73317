"""A question to a language model until its reply can be used, or it has had its chances."""

from collections.abc import Callable
from typing import Final, Generic, TypeVar, final

from grafu.dataclass import dataclass
from grafu.errors import FunctionalizationError
from grafu.evaluation.llm.chat import Message, Usage, usage_of
from grafu.evaluation.llm.recording import Ask, Unanswered

T = TypeVar("T")
_LONGEST: Final = 300  # characters of what was wrong


@final
@dataclass(frozen=True)
class ModelAnswer(Generic[T]):
    """What was made of a model's reply, in `values` (one or none), or the `fault` of its last; and what it used up."""

    values: tuple[T, ...]
    fault: str
    usage: Usage


def converse(first: tuple[Message, ...], ask: Ask, accept: Callable[[str], T], corrections: int) -> ModelAnswer[T]:
    """Returns what `accept` makes of the reply to these messages.

    Where `accept` raises a FunctionalizationError, the model is shown its message and replies again, so many times.

    Raises:
        NotRun: if there is nothing to ask.
        ExportError: if a reply cannot be recorded.
    """
    messages, usage, why = first, Usage(), ""
    for _ in range(corrections + 1):
        try:
            reply = ask(messages)
        except Unanswered as failure:
            missed = Usage(failure.requests, failure.requests)
            return ModelAnswer((), f"no reply: {failure}", usage + missed)
        usage += usage_of(reply)
        try:
            return ModelAnswer((accept(reply.text),), "", usage)
        except FunctionalizationError as fault:
            why = " ".join(str(fault).split())[:_LONGEST]
        wrong = Message("user", f"That reply cannot be used: {why}. Reply again with the whole corrected JSON object.")
        messages = (*messages, Message("assistant", reply.text), wrong)
    return ModelAnswer((), f"a reply that cannot be used: {why}", usage)
