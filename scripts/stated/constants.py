"""Numbers of the code that pages repeat in their sentences: the words of the page, `{}` for a number, and the values.

`docs.py --check` refuses a page that does not say such a sentence with the values that the code has now.
"""

from collections.abc import Iterator
from math import degrees

from grafu.asset import loose
from grafu.asset.foreign import matching
from grafu.cli import evaluate, limit_options
from grafu.cluster.config import ClusterConfig, FetchConfig
from grafu.completion.decode_config import DecodeConfig
from grafu.completion.features import FeatureConfig
from grafu.completion.session import SHIPPED_WEIGHTS
from grafu.data.corruption.config import PAPER as CORRUPTION
from grafu.data.furfun import folder
from grafu.data.shards_arrays import STEPS
from grafu.dataset.config import DescriptorConfig
from grafu.dataset.write import ResultSetPlan
from grafu.evaluation import bootstrap, distribution, measures, methods, moving_parts, plausible, twins
from grafu.evaluation.llm.config import LlmConfig
from grafu.evaluation.programs.config import ProgramConfig
from grafu.judging.coverage import CoverageTestConfig
from grafu.metrics.collision import TOLERANT, ConnectivityConfig
from grafu.network.config import GraFuConfig
from grafu.network.grafu import GraFu
from grafu.pipeline.verdict import VerdictConfig
from grafu.processes import limits
from grafu.processes.limits import PATIENCE
from grafu.training.ablation import FOLD_MODELS
from grafu.training.config import BASE, SMALL
from grafu.training.source import TEST_SEED, VALIDATION_SEED
from stated.constants_built import Sentence, additions, joints, per_cent

_MATCH = matching.MatchConfig()

CLUSTER, FETCHED = ClusterConfig(), FetchConfig()
SEEN, VERDICT, SHAPE, COVERAGE = FeatureConfig(), VerdictConfig(), DescriptorConfig(), CoverageTestConfig()


def millions(config: GraFuConfig) -> float:
    """Returns how many weights a network has, in millions, to one digit."""
    return round(sum(weight.numel() for weight in GraFu(config).parameters()) / 1e6, 1)


def sentences() -> Iterator[Sentence]:
    """Yields a page, its words and the values that stand in them."""
    yield from additions()
    yield from joints()
    yield from evaluation()
    yield from learning()
    yield from others()


def evaluation() -> Iterator[Sentence]:
    """Yields what docs/evaluation.md and metrics.md repeat."""
    page = "evaluation.md"
    yield (
        page,
        "largest side at least {:g} % of the object's, second largest at least {:g} %",
        (
            per_cent(moving_parts.LARGEST),
            per_cent(moving_parts.IN_PLANE),
        ),
    )
    yield (
        page,
        "fraction of {} poses from rest to full in which the part with its attached parts cuts deeper than {}",
        (
            TOLERANT.poses,
            TOLERANT.tolerance,
        ),
    )
    yield page, "never more than {} from the static parts", (ConnectivityConfig().tolerance,)
    yield (
        page,
        "this at most {:g}° or {:g} % of the part's depth",
        (
            degrees(moving_parts.WIDEST_TURN),
            per_cent(moving_parts.DEPTH_RATIO),
        ),
    )
    yield page, "opening {:g} % or more, all at once", (per_cent(measures.OPENS),)
    level = per_cent(bootstrap.LEVEL)
    yield (
        page,
        "Brackets hold {:g} % intervals: the objects are drawn anew {:,} times",
        (level, bootstrap.RESAMPLES),
    )
    yield page, "more than its paired {:g} % interval", (level,)
    yield page, "Candidates agree within {:g} % in seven numbers", (per_cent(twins.ALIKE),)
    yield page, "lie within {} of the other's surface", (twins.ON,)
    yield page, "what is static are within {}", (plausible.NEAR,)
    yield page, "opens to {:g} % of the reference", (per_cent(plausible.OPENS),)
    ends = (*methods.LEVELS[:2], methods.LEVELS[-1])
    yield page, "`masking`: {:g}, {:g}, ... {:g} % of the labels hidden", tuple(map(per_cent, ends))
    yield (
        page,
        "less the mean of {} synthetic models of seed {}",
        (distribution.TRAINING_COUNT, distribution.TRAINING_SEED),
    )
    llm, run = LlmConfig(), ProgramConfig(("program", "{out}"))
    yield page, "what works, {} examples, the graph", (llm.examples,)
    yield page, "one fixed seed, at most {} parts each", (llm.most_parts,)
    yield page, "{:g} s\nwithout an answer) is sent {} times at most", (llm.timeout, llm.attempts)
    for name in ("examples", "most_parts", "timeout", "attempts", "pause", "corrections"):
        yield page, f"\n{name} = {{}} ", (getattr(llm, name),)
    yield page, "timeout = {}                 # seconds for a model", (run.timeout,)
    yield "metrics.md", "the body cuts deeper than {} of the largest side", (TOLERANT.tolerance,)
    yield (
        "metrics.md",
        "within {:g} % of the greatest height over area at all, by rays on a grid of {} cells; a top is there from {}",
        (per_cent(COVERAGE.band), COVERAGE.cells, COVERAGE.covered),
    )
    yield "metrics.md", "{} and {:g} % are those of its code", (COVERAGE.covered, per_cent(COVERAGE.band))
    yield "metrics.md", "compares it with {} of the largest side", (ConnectivityConfig().tolerance,)


def learning() -> Iterator[Sentence]:
    """Yields what the pages on network, training and data repeat."""
    sees = "{} points on its surface in {} groups of {}", (SEEN.points, SEEN.anchors, SEEN.neighbours)
    yield "network.md", *sees
    yield "network.md", "({} million weights)", (millions(BASE.network),)
    yield "network.md", "`src/grafu/completion/weights/grafu.onnx`, {:.1f} MB", (SHIPPED_WEIGHTS.stat().st_size / 1e6,)
    yield "network.md", "made with seed {}", (TEST_SEED,)
    yield (
        "training.md",
        "a network of {} million weights (`base` has {} million)",
        (
            millions(SMALL.network),
            millions(BASE.network),
        ),
    )
    yield "training.md", "for {} steps of {} graphs", (SMALL.steps, SMALL.sampling.models * SMALL.sampling.copies)
    yield "training.md", "`base` is {} models with {} copies each", (BASE.sampling.models, BASE.sampling.copies)
    yield "training.md", "on the first {} models of seed 1", (FOLD_MODELS,)
    yield "training.md", "{} points on each part", (SMALL.features.points,)
    yield "training.md", "{} models of a seed that no training may use ({})", (BASE.validation.models, VALIDATION_SEED)
    yield "training.md", "Seed {} is kept for reporting", (TEST_SEED,)
    yield "training.md", "on the first {} synthetic models of the seed", (FOLD_MODELS,)
    yield "training.md", "each of {} models as it was found", (SMALL.validation.models,)
    yield "dataset.md", "masked with a chance of {:g} %", (per_cent(CORRUPTION.label_masking),)
    yield "dataset.md", "a grid of {} steps", (STEPS,)
    yield "dataset.md", "lie within {} units", (folder.SAME_PLACE,)
    yield "graph.md", "of the edge ({} more)", (DecodeConfig().some_parent,)
    yield "graph.md", "where both together have at least {}", (DecodeConfig().held.possible,)


def others() -> Iterator[Sentence]:
    """Yields what the remaining pages repeat."""
    yield "conventions.md", "Shells under {:g} % of the largest side", (per_cent(loose.LooseConfig().tiny),)
    poses = ConnectivityConfig().poses
    yield (
        "pages.md",
        "it collides in some of {} poses; it comes loose (a gap above {:g} %",
        (poses, per_cent(VERDICT.most_gap)),
    )
    yield "pages.md", "it opens less than {:g} % of what it should |", (per_cent(VERDICT.least_motion),)
    yield "pages.md", "it opens less than {:g} % of what it should; how", (per_cent(VERDICT.least_opening),)
    yield "pages.md", "with a score below {:g} %", (per_cent(VERDICT.least_confidence),)
    yield "pages.md", "a part lost more than {:g} % to carving", (per_cent(VERDICT.most_carved),)
    yield (
        "pages.md",
        "it is higher than {:g} m or its largest side is shorter than {:g} cm",
        (VERDICT.tallest, round(100 * VERDICT.smallest, 6)),
    )
    yield "limits.md", "{:g} s for a model (`evaluate`: {:g} s for a task)", (limit_options.SECONDS, evaluate._SECONDS)
    yield "limits.md", "goes more than {:g} GB beyond", (round(limits._SPARE / 1e9),)
    yield "limits.md", "after {} times as long it is stopped", (PATIENCE,)
    yield "cluster.md", "At most {} files of {:g} GB in all", (FETCHED.files, FETCHED.bytes / 1e9)
    yield "cluster.md", "cannot be reached within {:g} s does", (CLUSTER.reach_seconds,)
    yield "cluster.md", "At most {:g} tasks for each CPU", (CLUSTER.in_flight_per_cpu,)
    yield "cluster.md", "reserves {:g} GB of memory", (CLUSTER.reserved_memory / 1e9,)
    yield "cluster.md", "tried again elsewhere, at most {} times", (CLUSTER.losses,)
    yield "cluster.md", "After {} tries it is set aside", (CLUSTER.tries,)
    yield "cluster.md", "stopped after {} times its `--timeout`", (PATIENCE,)
    yield "limits.md", "| `--memory SIZE` | {} (of", (limit_options.MEMORY,)
    yield "datasets.md", "{} x {} x {} cells", (SHAPE.cells_across, SHAPE.cells_deep, SHAPE.cells_up)
    yield "datasets.md", "at most {:g} apart", (SHAPE.radius,)
    yield "datasets.md", "shards of {:g} MB", (ResultSetPlan().shard_bytes / 1e6,)
    yield "predictions.md", "agree in it to {} of the size", (_MATCH.exact,)
    yield "predictions.md", "({} times the best and {} of the size)", (_MATCH.alike, _MATCH.alike_beyond)


def told() -> dict[str, list[str]]:
    """Returns the sentences that each page must say."""
    found: dict[str, list[str]] = {}
    for page, words, values in sentences():
        shown = (int(v) if isinstance(v, float) and v.is_integer() and abs(v) > 1 else v for v in values)
        found.setdefault(page, []).append(words.format(*shown))
    return found
