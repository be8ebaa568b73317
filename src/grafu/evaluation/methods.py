"""The methods that are compared: each states how the parts of a model move, and the pipeline builds it.

Only the annotation sees the annotation. Labels are hidden at random, the same ones for the same model and seed. It
measures nothing.
"""

from dataclasses import field, replace
from hashlib import sha256
from pathlib import Path
from typing import Final, final

import numpy as np

from grafu.additions.config import AdditionConfig
from grafu.additions.interior.request import NOTHING
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.errors import OptionError, did_you_mean
from grafu.evaluation.config_file import read_config
from grafu.evaluation.llm.baselines import EDITS, GRAPH
from grafu.evaluation.llm.config import LanguageModel, LlmConfig
from grafu.evaluation.programs.config import OutsideProgram, ProgramConfig
from grafu.evaluation.programs.running import predicted_by
from grafu.pipeline.foreign import prediction_for
from grafu.pipeline.functionalize import Functionalized, functionalize
from grafu.pipeline.motion_source import MotionSource, SourceOption
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel

LEVELS = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0)
"""The paper's rates (0.1, 0.3, 0.5, 1) and those between."""


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
RUN: Final = ("particulate-run", "singapo-run")
ASKED: Final = (GRAPH, EDITS)
KNOWN: Final = (*OWN, *FOREIGN, *RUN, *ASKED)
_JOINTS_ALONE = AdditionConfig(handles=None, grips=None, interior=NOTHING)


@final
@dataclass(frozen=True, slots=True)
class Method:
    """A source of motions by its name, and where it needs that, from where they come.

    Predictions of others have a folder that holds one entry per model id; what is run has a program, what is asked a
    language model. The network may have `weights` in a file; None: those that came with the package.

    Raises:
        OptionError: if the name is none of those known, or what it needs is missing or superfluous.
    """

    name: str
    folder: Path | None = None
    program: OutsideProgram | None = None
    model: LanguageModel | None = None
    weights: Path | None = None

    def __post_init__(self) -> None:
        if self.name not in KNOWN:
            near = did_you_mean(self.name, KNOWN)
            raise OptionError(f"a method must be one of {', '.join(KNOWN)}: got `{self.name}`{near}")
        for names, given, spelled in (
            (FOREIGN, self.folder, "DIR` with a folder of predictions"),
            (RUN, self.program, "FILE` with a file that states how to run it"),
            (ASKED, self.model, "MODEL` with the name of a language model"),
        ):
            if (self.name in names) != (given is not None):
                said = f"`{self.name}:{spelled}" if self.name in names else f"`{self.name}` alone"
                raise OptionError(f"method `{self.name}` must be given as {said}")
        if self.weights is not None and self.name != "network":
            raise OptionError(f"weights are for the method network: got `{self.name}`")

    @property
    def spelled(self) -> str:
        """The method as the command spells it."""
        of = self.folder or self.weights or (self.program and self.program.path) or (self.model and self.model.name)
        return f"{self.name}:{of}" if of else self.name

    @property
    def can_be_masked(self) -> bool:
        """Whether it answers from labels, so that hiding them states something."""
        return self.name in ("rule", "network")


@final
@dataclass(frozen=True, slots=True)
class MethodOptions:
    """How language models are asked, and the folders in which their replies and what programs wrote are kept.

    `weights` are those of the method `network`, where they are not the shipped ones.
    """

    llm: LlmConfig = field(default_factory=LlmConfig)
    replies: Path = Path("replies")
    outputs: Path = Path("predictions")
    weights: Path | None = None


def parse_method(text: str, options: MethodOptions = MethodOptions()) -> Method:
    """Returns the method that a word of the command line spells: `network:FILE`, `particulate:DIR`, `llm:MODEL`.

    Raises:
        OptionError: if it spells none, or the file that it names cannot be read.
    """
    name, _, of = text.strip().partition(":")
    if name in ASKED and of:
        return Method(name, model=LanguageModel(of, options.llm, options.replies))
    if name in RUN and of:
        config = read_config(Path(of), ProgramConfig)
        return Method(name, program=OutsideProgram(Path(of), config, options.outputs, name.removesuffix("-run")))  # type: ignore[arg-type]
    if name == "network":
        return Method(name, weights=Path(of) if of else options.weights)
    return Method(name, Path(of) if of else None)


def made_by(method: Method, asset: Asset, model_id: str, joints_alone: bool = False) -> Functionalized:
    """Returns what the pipeline makes of an annotated asset with this method's motions.

    With `joints_alone`, nothing is added that decides no joint: no handles, grips and interiors.

    Raises:
        AssetError: if a foreign prediction is missing, damaged, or fits no part, or a program fails.
        WeightsError: if the network's weights are missing.
        NotRun: if a program is not installed.
        OptionError: if the method asks a language model, which `grafu.evaluation.llm.baselines` does.
    """
    config = PipelineConfig(_settings(method, joints_alone))
    if method.can_be_masked:
        return functionalize(asset.without_annotation(), MotionSource(method.name), builtin_gallery(), config)
    if method.name == "annotation":
        return functionalize(asset, MotionSource.ANNOTATION, builtin_gallery(), config)
    if method.program is not None:
        foreign = predicted_by(method.program, asset.without_annotation(), model_id)
    elif method.folder is not None:
        choice = SourceOption(MotionSource(method.name), method.folder)
        foreign = prediction_for(choice, model_id, alone=False)
    else:
        raise OptionError(f"a language model is asked apart from other methods: got `{method.spelled}`")
    return functionalize(asset.without_annotation(), foreign, builtin_gallery(), config)


def made_with_labels_hidden(method: Method, asset: Asset, ratio: float, seed: int) -> Functionalized:
    """Returns what the pipeline makes of the asset with a fraction of its labels hidden, joints alone.

    Raises:
        OptionError: if the method does not answer from labels.
    """
    if not method.can_be_masked:
        raise OptionError(f"labels can be hidden from rule and network alone: got `{method.name}`")
    config = PipelineConfig(_settings(method, joints_alone=True))
    return functionalize(masked(asset, ratio, seed), MotionSource(method.name), builtin_gallery(), config)


def _settings(method: Method, joints_alone: bool) -> Settings:
    settings = Settings(weights=method.weights)
    return replace(settings, additions=_JOINTS_ALONE) if joints_alone else settings
