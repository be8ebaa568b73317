"""Judges which motions are predicted for doors and drawers of annotated models: type, side, direction; it builds none.

    python scripts/judge_motions.py MODELS... [--rule] [--weights FILE] [--copies 4] [--jobs 2] [--json FILE]

MODELS are folders as `grafu evaluate --data` takes it. Of each model the network (with --rule the rule-based baseline)
gets the parts alone (as the annotation groups them), no joints, in seven variants: as they are, without labels, and
with parts removed. Random variants are drawn --copies times. A motion is right by the definition of `grafu evaluate`:
`aligned` (docs/evaluation.md). Prints a table in Markdown, one of the causes of what is wrong, and of the first two
variants each part that is wrong.

The confidence of a motion is the product of the scores of its decisions (what the part is, how it moves). Its expected
calibration error: in ten bins of confidence, how far the mean confidence is from the fraction that is right, a mean by
the number of motions. Of few motions it is above zero by chance alone: the last column is what a predictor that is
calibrated has with these confidences, the mean of many draws and, in brackets, what it exceeds in one draw of forty.
"""

import argparse
import json
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import final

import numpy as np

from grafu.asset.part import Asset
from grafu.completion.rule import complete_by_rule
from grafu.evaluation.dataset import ModelRef, find_models, load_model
from grafu.evaluation.methods import masked
from grafu.evaluation.moving_parts import MovingPart, counted_parts
from grafu.graph.completion import GraphCompletion
from grafu.graph.parse import parse_graph
from grafu.joints.make_plan import plan_from_completion
from grafu.metrics.motion import Motion, MotionAgreement, compare_motions
from grafu.pipeline.complete import complete_by_weights
from grafu.vocabulary import PartLabel

GONE = 0.25  # of the parts that are static
BINS = 10
DRAWS = 4000  # of what a calibrated predictor would get right
RARE = 97.5  # percentile of these draws
CAUSES = ("does not move", "another type", "another direction", "another border")
OF_MOTION = ("label", "border", "sign", "slide")
Change = Callable[[Asset, Asset, int], Asset]
Complete = Callable[[Asset], GraphCompletion]


@final
@dataclass(frozen=True, slots=True)
class Variant:
    """One variant of the input of a model; `drawn` states whether chance decides what it lacks."""

    name: str
    change: Change
    drawn: bool = False


@final
@dataclass(frozen=True, slots=True)
class Found:
    """What was said of one model in one variant, all draws together; `sure`: confidences, and whether it is right."""

    variant: str
    right: int
    parts: int
    wrong: tuple[str, ...]
    sure: tuple[tuple[float, bool], ...] = ()
    causes: tuple[str, ...] = ()


def main() -> int:
    """Judges, and prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", type=Path, nargs="+", help="folders of annotated models")
    parser.add_argument("--weights", type=Path, help="judge these weights instead of those that ship")
    parser.add_argument("--rule", action="store_true", help="judge the rule-based baseline instead")
    parser.add_argument("--copies", type=int, default=4, help="draws of what is drawn (default: 4; 0 leaves it out)")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--json", type=Path, help="also write the counts there")
    options = parser.parse_args()
    refs = [ref for folder in options.models for ref in find_models(folder)]
    complete = complete_by_rules if options.rule else partial(complete_with, options.weights)
    with ProcessPoolExecutor(options.jobs) as pool:
        found = []
        for done, one in enumerate(pool.map(partial(judge, complete, options.copies), refs), 1):
            found += one
            print(f"  {done}/{len(refs)}", file=sys.stderr, end="\r")
    print(file=sys.stderr)
    print(table(found))
    if options.json:
        options.json.write_text(json.dumps(counts(found), indent=1), "utf-8")
    return 0


def judge(complete: Complete, copies: int, ref: ModelRef) -> list[Found]:
    """Returns what is said of one model in each variant."""
    asset = load_model(ref)
    truth = counted_parts(asset)
    bare = asset.without_annotation()
    found = []
    for variant in VARIANTS:
        draws = range(copies if variant.drawn else 1)
        answers = [one for draw in draws for one in answered(complete, variant.change(asset, bare, draw), truth)]
        wrong = tuple(answer.part for answer in answers if not answer.is_right)
        sure = tuple((a.confidence, a.is_right) for a in answers if a.confidence is not None)
        causes = tuple(answer.cause for answer in answers if not answer.is_right)
        found.append(Found(variant.name, len(answers) - len(wrong), len(answers), wrong, sure, causes))
    return [replace(one, wrong=tuple(f"{ref.id}/{part}" for part in one.wrong)) for one in found]


@final
@dataclass(frozen=True, slots=True)
class Answer:
    """What was said of a moving part: the confidence of its motion (None: it has none), and how that agrees."""

    confidence: float | None
    agreement: MotionAgreement

    @property
    def part(self) -> str:
        """The part's id."""
        return self.agreement.part

    @property
    def is_right(self) -> bool:
        """Whether the motion is as annotated."""
        return self.agreement.whole

    @property
    def cause(self) -> str:
        """Why a wrong motion is wrong: one of `CAUSES`."""
        if self.confidence is None:
            return "does not move"
        if not self.agreement.type:
            return "another type"
        return "another direction" if not self.agreement.direction else "another border"


def answered(complete: Complete, asset: Asset, truth: tuple[MovingPart, ...]) -> Iterator[Answer]:
    """Yields for each moving part what was said of it."""
    completion = complete(asset)
    stated = plan_from_completion(completion, asset)
    true = {part.id: part.motion for part in truth}
    motions = {r.moving: Motion(r.type, r.axis, true[r.moving].center) for r in stated.joints if r.moving in true}
    for one in compare_motions(motions, true):
        scores = [d.score for d in completion.decisions if d.part == one.part and d.question in OF_MOTION]
        yield Answer(float(np.prod(scores)) if one.part in motions else None, one)


def complete_by_rules(asset: Asset) -> GraphCompletion:
    """Returns the asset's graph as the rules complete it."""
    return complete_by_rule(parse_graph(asset))


def complete_with(weights: Path | None, asset: Asset) -> GraphCompletion:
    """Returns the asset's graph as weights complete it: those in a file, or those that ship."""
    return complete_by_weights(asset, parse_graph(asset), weights)


def calibration_error(sure: list[tuple[float, bool]]) -> float:
    """Returns the expected calibration error of confidences in ten bins; not a number where there are none."""
    if not sure:
        return float("nan")
    right = np.array([[r for _, r in sure]], dtype=float)
    return float(binned_errors(np.array([c for c, _ in sure]), right)[0])


def mean_confidence(sure: list[tuple[float, bool]]) -> float:
    """Returns the mean confidence of motions that are stated; not a number where none is."""
    return float(np.mean([c for c, _ in sure])) if sure else float("nan")


def calibrated_errors(sure: list[tuple[float, bool]]) -> tuple[float, float]:
    """Returns the calibration error of a calibrated predictor with the same confidences: its mean, and a rare one."""
    if not sure:
        return float("nan"), float("nan")
    confidence = np.array([c for c, _ in sure])
    right = np.random.default_rng(0).random((DRAWS, len(sure))) < confidence
    errors = binned_errors(confidence, right.astype(float))
    return float(errors.mean()), float(np.percentile(errors, RARE))


def binned_errors(confidence: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Returns the expected calibration errors of confidences (n), one for each row of what is right (draws x n)."""
    bins = np.minimum((confidence * BINS).astype(int), BINS - 1)
    apart = [np.abs((confidence - right)[:, bins == k].sum(axis=1)) for k in range(BINS)]
    return np.sum(apart, axis=0) / len(confidence)


def without_some_still_parts(asset: Asset, bare: Asset, draw: int) -> Asset:
    """Returns the bare asset without a quarter of what neither moves, rides, nor is a handle."""
    moving = {part.id for part in counted_parts(asset)} | {joint.part for joint in asset.joints}
    still = [p.id for p in asset.parts if p.id not in moving and not p.carried_by and p.label is not PartLabel.HANDLE]
    rng = np.random.default_rng([draw, len(still)])
    gone = set(rng.choice(still, round(GONE * len(still)), replace=False).tolist()) if still else set()
    return replace(bare, parts=tuple(p for p in bare.parts if p.id not in gone))


def without_handles(_: Asset, bare: Asset, __: int) -> Asset:
    """Returns the bare asset without its handles."""
    return replace(bare, parts=tuple(p for p in bare.parts if p.label is not PartLabel.HANDLE))


def unlabelled(change: Change) -> Change:
    """Returns a change after which no part has a label."""
    return lambda asset, bare, draw: masked(change(asset, bare, draw), 1.0, 0)


def as_it_is(_: Asset, bare: Asset, __: int) -> Asset:
    """Returns the bare asset."""
    return bare


VARIANTS = (
    Variant("labels given", as_it_is),
    Variant("no labels", unlabelled(as_it_is)),
    Variant("half of the labels", lambda _, bare, draw: masked(bare, 0.5, draw), drawn=True),
    Variant("a quarter of the still parts gone", without_some_still_parts, drawn=True),
    Variant("the same without labels", unlabelled(without_some_still_parts), drawn=True),
    Variant("no handles", without_handles),
    Variant("no handles, no labels", unlabelled(without_handles)),
)


def counts(found: list[Found]) -> dict[str, dict[str, object]]:
    """Returns for each variant how many motions are right, of how many, and which are wrong."""
    of = {variant.name: [one for one in found if one.variant == variant.name] for variant in VARIANTS}
    return {
        name: {
            "right": sum(one.right for one in ones),
            "parts": sum(one.parts for one in ones),
            "wrong": [part for one in ones for part in one.wrong],
            "causes": {cause: sum(one.causes.count(cause) for one in ones) for cause in CAUSES},
            "confidence": mean_confidence([pair for one in ones for pair in one.sure]),
            "calibration error": calibration_error([pair for one in ones for pair in one.sure]),
            "if calibrated": calibrated_errors([pair for one in ones for pair in one.sure]),
        }
        for name, ones in of.items()
    }


def table(found: list[Found]) -> str:
    """Returns the counts as a table, and below it what is wrong in the variants that nothing is drawn for."""
    counted = counts(found)
    head = ["asked about", "motions", "right", "fraction", "mean confidence", "calibration error", "if calibrated"]
    lines = [f"| {' | '.join(head)} |", "|---" * len(head) + "|"]
    for name, one in counted.items():
        if one["parts"]:
            ratio = one["right"] / one["parts"]  # type: ignore[operator]
            mean, rare = one["if calibrated"]  # type: ignore[misc]
            cells = [f"{one[key]:.3f}" for key in ("confidence", "calibration error")]
            cells = [str(one["parts"]), str(one["right"]), f"{ratio:.3f}", *cells, f"{mean:.3f} ({rare:.3f})"]
            lines.append(f"| {name} | {' | '.join(cells)} |")
    lines += ["", f"| wrong | {' | '.join(CAUSES)} |", "|---" * (1 + len(CAUSES)) + "|"]
    for name, one in counted.items():
        if one["parts"]:
            lines.append(f"| {name} | {' | '.join(str(count) for count in one['causes'].values())} |")  # type: ignore[attr-defined]
    wrong = [f"wrong, {name}: {', '.join(counted[name]['wrong'])}" for name in ("labels given", "no labels")]  # type: ignore[arg-type]
    return "\n".join([*lines, "", *wrong])


if __name__ == "__main__":
    sys.exit(main())
