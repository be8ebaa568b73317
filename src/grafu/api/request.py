"""What was asked for, as one value: the asset, the settings, and whose motions. Running it gives what was made."""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import final

from grafu.api.arguments import require
from grafu.asset.foreign.motions import ForeignMotions
from grafu.asset.part import Asset
from grafu.errors import OptionError
from grafu.pipeline.functionalize import Functionalized, functionalize
from grafu.pipeline.settings import Settings
from grafu.realization.cache import Cache
from grafu.realization.motion_choice import MotionChoice, choice_in_words
from grafu.templates.available import open_gallery
from grafu.templates.user_handles import load_handles

CACHED_VALUES = 400
"""Values of the stages that results of one lineage share: some ten changes of a model with twenty joints."""


@final
@dataclass(frozen=True)
class Request:
    """One asset, what is chosen for it, and where motions and templates come from.

    `foreign` are the motions that another system predicted (None: those of `settings.motion`), `templates` a folder of
    the user's own templates. `cache` holds what earlier runs of this asset made; the result is the same without it.
    """

    asset: Asset
    settings: Settings
    foreign: ForeignMotions | None = None
    templates: Path | None = None
    cache: Cache = field(default_factory=lambda: Cache(CACHED_VALUES), compare=False, repr=False)

    def with_settings(self, settings: Settings) -> "Request":
        """Returns the request with other settings, and the same cache."""
        return replace(self, settings=settings)

    def run(self) -> Functionalized:
        """Returns what `grafu.pipeline.functionalize` makes of it.

        Raises:
            FunctionalizationError: if a setting names what there is not, or a template or the weights are at fault.
        """
        own = load_handles(self.templates) if self.templates else {}
        source = self.foreign or self.settings.motion
        config = self.settings.pipeline(own)
        return functionalize(self.asset, source, open_gallery(self.templates), config, cache=self.cache)


def motion_in_words(part: str, word: str) -> MotionChoice:
    """Returns how a part moves, of one word.

    Raises:
        TypeError: if it is no str.
        OptionError: if it is another word than those of `Result.with_motion`.
    """
    try:
        return choice_in_words(require(word, str, "how", "a word such as `left`"))
    except OptionError as error:
        raise OptionError(f"how `{part}` moves {error}") from None
