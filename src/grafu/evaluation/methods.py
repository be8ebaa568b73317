"""The methods that are compared: each states how the parts of a model move, and the pipeline builds it.

Only the annotation sees the annotation. Labels are hidden at random, the same ones for the same model and seed. It
measures nothing.
"""

from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path
from typing import Final, final

import numpy as np

from grafu.additions.config import AdditionConfig
from grafu.additions.interior.request import NOTHING
from grafu.asset.part import Asset
from grafu.errors import OptionError
from grafu.pipeline.foreign import prediction_for
from grafu.pipeline.functionalize import Functionalized, PipelineConfig, functionalize
from grafu.pipeline.motion_source import MotionSource, SourceOption
from grafu.pipeline.settings import Settings
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel

LEVELS = (0.1, 0.3, 0.5, 1.0)
"""The paper's rates."""


def masked(asset: Asset, ratio: float, seed: int) -> Asset:
    """Returns the asset with this fraction of its labels unknown, rounded to whole parts, and no joints or attachments.

    Of one seed the parts that are masked at a lower fraction are masked at every higher one, so that levels differ by
    nothing but what is hidden. The draw depends on the asset's name and its part ids alone.

    Raises:
        ValueError: if the fraction is not in 0..1.
    """
    if not 0 <= ratio <= 1:
        raise ValueError(f"`ratio` must be in 0..1: got {ratio}")
    bare = asset.without_annotation()
    hidden = set(mask_order(bare, seed)[: round(ratio * len(bare.parts))])
    parts = tuple(
        replace(p, label=PartLabel.UNKNOWN, labelled_by="hidden") if p.id in hidden else p for p in bare.parts
    )
    return replace(bare, parts=parts)


def mask_order(asset: Asset, seed: int) -> list[str]:
    """Returns the part ids in the order in which they lose their labels."""
    ids = sorted(part.id for part in asset.parts)
    digest = sha256("\n".join([asset.name, *ids]).encode()).digest()
    order = np.random.default_rng([seed, int.from_bytes(digest[:8])]).permutation(len(ids))
    return [ids[k] for k in order]


OWN: Final = ("annotation", "rule", "network")
FOREIGN: Final = ("particulate", "singapo", "grafu-pred", "urdf")
_JOINTS_ALONE = AdditionConfig(handles=None, grips=None, interior=NOTHING)


@final
@dataclass(frozen=True, slots=True)
class Method:
    """A source of motions by its name; foreign ones have a folder that holds one entry per model id.

    Raises:
        OptionError: if the name is none of those known, or a folder is missing or superfluous.
    """

    name: str
    folder: Path | None = None

    def __post_init__(self) -> None:
        if self.name not in (*OWN, *FOREIGN):
            raise OptionError(f"a method must be one of {', '.join((*OWN, *FOREIGN))}: got `{self.name}`")
        if (self.folder is None) == (self.name in FOREIGN):
            said = f"`{self.name}:DIR` with a folder of predictions" if self.name in FOREIGN else f"`{self.name}` alone"
            raise OptionError(f"method `{self.name}` must be given as {said}")

    @property
    def spelled(self) -> str:
        """The method as the command spells it."""
        return self.name if self.folder is None else f"{self.name}:{self.folder}"

    @property
    def can_be_masked(self) -> bool:
        """Whether it answers from labels, so that hiding them states something."""
        return self.name in ("rule", "network")


def parse_method(text: str) -> Method:
    """Returns the method that a word of the command line spells: `network`, `particulate:DIR`.

    Raises:
        OptionError: if it spells none.
    """
    name, _, folder = text.strip().partition(":")
    return Method(name, Path(folder) if folder else None)


def made_by(method: Method, asset: Asset, model_id: str, joints_alone: bool = False) -> Functionalized:
    """Returns what the pipeline makes of an annotated asset with this method's motions.

    With `joints_alone`, nothing is added that decides no joint: no handles, grips and interiors.

    Raises:
        AssetError: if a foreign prediction is missing, damaged, or fits no part.
        WeightsError: if the network's weights are missing.
    """
    config = PipelineConfig(Settings(additions=_JOINTS_ALONE)) if joints_alone else PipelineConfig()
    if method.can_be_masked:
        return functionalize(asset.without_annotation(), MotionSource(method.name), builtin_gallery(), config)
    if method.folder is None:
        return functionalize(asset, MotionSource.ANNOTATION, builtin_gallery(), config)
    choice = SourceOption(MotionSource(method.name), method.folder)
    foreign = prediction_for(choice, model_id, alone=False)
    return functionalize(asset.without_annotation(), foreign, builtin_gallery(), config)


def made_with_labels_hidden(method: Method, asset: Asset, ratio: float, seed: int) -> Functionalized:
    """Returns what the pipeline makes of the asset with a fraction of its labels hidden, joints alone.

    Raises:
        OptionError: if the method does not answer from labels.
    """
    if not method.can_be_masked:
        raise OptionError(f"labels can be hidden from rule and network alone: got `{method.name}`")
    config = PipelineConfig(Settings(additions=_JOINTS_ALONE))
    return functionalize(masked(asset, ratio, seed), MotionSource(method.name), builtin_gallery(), config)
