"""Everything that a training run is asked to do, and the runs that have names: `base`, `tune`, `paper`, ..."""

from collections.abc import Mapping
from dataclasses import field, replace
from types import MappingProxyType
from typing import Literal, final

from grafu.completion.features import FeatureConfig
from grafu.data.corruption.config import PAPER as PAPER_CORRUPTION
from grafu.dataclass import dataclass
from grafu.network.config import PAPER as PAPER_NETWORK
from grafu.network.config import GraFuConfig
from grafu.training.loss_config import PAPER as PAPER_LOSS
from grafu.training.loss_config import LossConfig
from grafu.training.sample import CopyMix, SamplerConfig

Precision = Literal["fp32", "bf16", "auto"]
Matrices = Literal["adam", "muon"]
_UNMIRRORED = replace(PAPER_CORRUPTION, mirror_probability=0.0)


@final
@dataclass(frozen=True)
class OptimiserConfig:
    """How weights are moved. The defaults are those of `base`; each states what the paper has.

    Raises:
        ValueError: if a number is out of range.
    """

    rate: float = 1.2e-3
    """Highest learning rate: the paper's is 3e-4 with Adam, for ten times as many steps."""
    weight_decay: float = 0.01
    """Decoupled (AdamW); the authors' 1e-4 is added to the gradient (Adam), see `decoupled`."""
    decoupled: bool = True
    """AdamW; the paper has Adam."""
    matrices: Matrices = "muon"
    """What moves matrices between features; the paper has Adam."""
    momentum: float = 0.95
    """Of Muon."""
    betas: tuple[float, float] = (0.9, 0.98)
    """0.98 forgets the gradients of the start sooner than Adam's 0.999, as transformers with few steps need."""
    warmup: int = 300
    """Steps over which the rate rises; the paper names none."""
    period: int | None = None
    """Step at which the cosine is at zero; None: the last. The authors stop at 120 of 450 epochs."""
    clip: float = 1.0
    """Largest norm of the gradient (the authors')."""
    average: float = 0.999
    """Decay of the running average of the weights that is judged and shipped; 0: the last weights (paper)."""

    def __post_init__(self) -> None:
        if min(self.rate, self.clip) <= 0 or min(self.weight_decay, self.warmup) < 0 or not 0 <= self.average < 1:
            raise ValueError(f"the numbers of `OptimiserConfig` are out of range: got {self}")


@final
@dataclass(frozen=True)
class ValidationConfig:
    """What weights are chosen by: synthetic furniture of a seed of its own, the same graphs every time.

    Each of `models` is judged as it was found, with its labels hidden, and with something taken away.

    Raises:
        ValueError: if a number is less than 1.
    """

    models: int = 96
    every: int = 500
    """Steps between two validations."""
    batch: int = 16
    """Graphs that are judged at once."""

    def __post_init__(self) -> None:
        if min(self.models, self.every, self.batch) < 1:
            raise ValueError(f"the numbers of `ValidationConfig` must be at least 1: got {self}")


@final
@dataclass(frozen=True)
class TrainingConfig:
    """One run. What is not written here does not change its result, but for rounding.

    Raises:
        ValueError: if a number is out of range.
    """

    network: GraFuConfig
    loss: LossConfig
    mix: CopyMix
    sampling: SamplerConfig
    optimiser: OptimiserConfig = OptimiserConfig()
    features: FeatureConfig = field(default_factory=FeatureConfig)
    validation: ValidationConfig = ValidationConfig()
    steps: int = 5_000
    """What two hours of one core do, and the shipped weights had; more are better."""
    seed: int = 1
    mirror: float = 0.5
    """Chance of each model's visit to be its mirror image (paper)."""
    mirror_axes: tuple[int, ...] = (0,)
    """X only, as the authors' code has it: fronts are at -Y in training as in use, so no mirror image across Y is ever
    asked about. The paper has X and Y."""
    precision: Precision = "auto"
    """Arithmetic of matrix products: `auto` is bfloat16 on a GPU and, where the processor multiplies it, on a CPU."""

    def __post_init__(self) -> None:
        if self.steps < 1 or self.seed < 0 or not 0 <= self.mirror <= 1 or not set(self.mirror_axes) <= {0, 1}:
            raise ValueError(f"the numbers of `TrainingConfig` are out of range: got {self}")
        if self.network.kinds != self.features.kinds:
            kinds = f"{self.network.kinds} and {self.features.kinds}"
            raise ValueError(f"network and features must know the same kinds of edges: got {kinds}")


BASE = TrainingConfig(
    network=GraFuConfig(),
    # Probabilities that can be believed, and boxes to the last few per cent: see `LossConfig`.
    loss=LossConfig(
        free_positive=1.0,
        box_error="absolute",
        match_cost="probability",
        free_category=0.5,
        free_centre=3.0,
        free_half=1.0,
    ),
    mix=CopyMix(
        # What is asked in use is the model as it was found, with labels or without, all edges contacts. Kinds of edges
        # that a corruption keeps are never there then, so these strategies, 43 % in the paper, get the rest.
        natural=0.35,
        masked=0.2,
        corruption=_UNMIRRORED.reweighted(
            {
                "drop_doors": 0.0,  # a completion adds no moving bodies
                "drop_drawers": 0.0,
                "fully_anonymized": 0.25,
                "mask_materials_keep_edges": 0.04,
                "mask_random_edges_keep_types": 0.04,
                "drop_nodes_keep_edge_types": 0.04,
                "fully_functional_drop": 0.08,
            }
        ),
    ),
    sampling=SamplerConfig(),
)

TUNE = replace(BASE, optimiser=replace(BASE.optimiser, matrices="adam", rate=3e-4, warmup=200), steps=3_000)
"""To go on from weights that exist (`--start`): AdamW at a quarter of the rate. On a processor that does not multiply
bfloat16, a step of Muon takes as long as the forward and the backward pass."""

PAPER = TrainingConfig(
    network=PAPER_NETWORK,
    loss=PAPER_LOSS,
    mix=CopyMix(natural=1 / 18, masked=0.0, corruption=_UNMIRRORED, folds=17),
    sampling=SamplerConfig(models=16, copies=1, reuse=1, spread=16),
    optimiser=OptimiserConfig(
        rate=3e-4,
        weight_decay=1e-4,
        decoupled=False,
        matrices="adam",
        betas=(0.9, 0.999),
        warmup=0,
        period=94_500,  # 450 epochs (supplement) of 186 models x 18 pairs in batches of 16
        average=0.0,
    ),
    features=FeatureConfig(anchors=256, neighbours=32, kinds="paper", radius=0.2),
    steps=25_200,  # the authors' 120 epochs
    mirror_axes=(0, 1),
    precision="fp32",
)

SMALL = replace(
    BASE,
    network=GraFuConfig(
        hidden=128, heads=4, encoder_layers=2, decoder_layers=2, edge=64, category=64, points=32, geometry=16
    ),
    sampling=SamplerConfig(models=2, copies=4),
    optimiser=replace(BASE.optimiser, rate=2e-3, warmup=200, average=0.995),  # for a few thousand steps
    features=FeatureConfig(points=256, anchors=16, neighbours=16),
    validation=replace(BASE.validation, every=1000),
    steps=2000,
    precision="fp32",
)
"""To compare ways of training within minutes each (`grafu ablate`)."""

TINY = replace(
    BASE,
    network=GraFuConfig(
        hidden=32, heads=2, encoder_layers=1, decoder_layers=1, edge=16, category=16, points=16, geometry=16
    ),
    sampling=SamplerConfig(models=2, copies=2, reuse=2, spread=4),
    optimiser=replace(BASE.optimiser, rate=2e-3, warmup=10),
    features=FeatureConfig(points=64, anchors=8, neighbours=8),
    validation=ValidationConfig(models=6, every=50),
    steps=100,
    precision="fp32",
)
"""To see in a minute that all works on a machine; it learns next to nothing."""

CONFIGS: Mapping[str, TrainingConfig] = MappingProxyType(
    {"base": BASE, "tune": TUNE, "paper": PAPER, "small": SMALL, "tiny": TINY}
)
