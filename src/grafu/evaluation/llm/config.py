"""How a language model is asked: what it is given, how long it may take, how often it is asked again, what it costs."""

from pathlib import Path
from typing import ClassVar, Final, final

from pydantic import ConfigDict

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_not_negative, require_positive

EXAMPLES_SEED: Final = 20_260_727
"""The seed of the synthetic furniture in the examples; data of this seed get examples of the next one."""


@final
@dataclass(frozen=True, slots=True)
class LlmConfig:
    """The paper's protocol by default: 20 examples and a picture of the model.

    Raises:
        ValueError: if a number is out of range.
    """

    __pydantic_config__: ClassVar = ConfigDict(extra="forbid")

    examples: int = 20
    """Completed graphs of synthetic furniture that are given as context."""
    most_parts: int = 30
    """Furniture of more parts is no example (parts of a complete model)."""
    picture: bool = True
    """Whether a picture of the model is given, too; some models read none."""
    timeout: float = 120.0
    """How long one request may take (seconds)."""
    attempts: int = 3
    """How often one request is sent at most, where no reply comes."""
    pause: float = 2.0
    """How long to wait before a request is sent again (seconds); twice as long each time."""
    corrections: int = 1
    """How often a model is shown what is wrong with its reply, and may reply again."""
    max_tokens: int | None = None
    """Most tokens of a reply; None: as many as the endpoint allows."""
    temperature: float | None = None
    """The temperature of sampling; None: the endpoint's own."""
    price_in: float | None = None
    """What a million tokens of the prompt cost, in the user's currency; None: unknown."""
    price_out: float | None = None
    """What a million tokens of the reply cost, in the user's currency; None: unknown."""

    def __post_init__(self) -> None:
        require_positive(self, "most_parts", "timeout", "attempts")
        require_not_negative(self, "examples", "pause", "corrections")
        if self.max_tokens is not None:
            require_positive(self, "max_tokens")
        for name in ("temperature", "price_in", "price_out"):
            if getattr(self, name) is not None:
                require_not_negative(self, name)


@final
@dataclass(frozen=True, slots=True)
class LanguageModel:
    """A model as the endpoint names it, how it is asked, and the folder in which replies are recorded."""

    name: str
    config: LlmConfig
    replies: Path
