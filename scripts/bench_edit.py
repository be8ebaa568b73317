"""How long a change in the editor takes: one motion after another is changed and taken back, all else is kept.

    python scripts/bench_edit.py [MODELS ...] [--parts 6]

MODELS are inputs; without any, samples of about 30 parts. Of each the first `--parts` parts that move are made to
slide, to turn about another side, and fixed; after each change comes its undo. Seconds are of the processor, from the
choice to the files that the page fetches, in a process that stays warm, as the editor's does.
"""

import argparse
import json
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from bench_table import measured_table

from grafu.editor.building import STATE, Bench, Order
from grafu.errors import FunctionalizationError
from grafu.joints.motion_choice import FIXED, choice_in_words
from grafu.pipeline.settings import Settings

SAMPLES = Path(__file__).parent.parent / "samples"
USUAL = (SAMPLES / "dresser.glb", SAMPLES / "wardrobe.glb", SAMPLES / "kitchen_base.glb")
PARTS = 6
OTHER_SIDE = {"left": "right", "right": "left", "top": "bottom", "bottom": "top"}
UNDO = "undo"
BAR = 0.7


@dataclass(frozen=True)
class Change:
    """One change: of which model and part, to what motion (`undo`: back), and the seconds that it took."""

    model: str
    part: str
    motion: str
    seconds: float


@dataclass
class Edited:
    """One model in a builder that stays warm; not a value."""

    source: Path
    folder: Path
    bench: Bench = field(default_factory=lambda: Bench(say=unheard))

    def built(self, settings: Settings) -> float:
        """Returns how many seconds of the processor the settings take to be built and written."""
        started = time.process_time()
        name = self.source.stem
        self.bench.carry_out(Order("build", self.source, name, self.folder, settings.to_json()))
        return time.process_time() - started

    def motions(self) -> dict[str, dict[str, object]]:
        """Returns how the parts of the last build move."""
        motions: dict[str, dict[str, object]] = json.loads((self.folder / STATE).read_bytes())["motions"]
        return motions


def unheard(_: object) -> None:
    """Takes what the builder tells and does nothing."""


def main() -> int:
    """Times the changes and prints a table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("models", nargs="*", type=Path, metavar="MODELS")
    parser.add_argument("--parts", type=int, default=PARTS, help="how many moving parts of each are changed")
    options = parser.parse_args()
    changes: list[Change] = []
    for source in options.models or USUAL:
        with tempfile.TemporaryDirectory() as folder:
            changes += changes_of(Edited(source, Path(folder)), options.parts)
    print(changes_table(changes))
    return 0


def changes_of(edited: Edited, parts: int) -> list[Change]:
    """Returns the changes of one model, after the build that a session begins with.

    What cannot be built is left out, and said so.
    """
    untouched, found = Settings(), list[Change]()
    edited.built(untouched)
    for part, motion in list(edited.motions().items())[:parts]:
        for word in other_motions(motion):
            choice = FIXED if word == "fixed" else choice_in_words(word)
            try:
                seconds = edited.built(untouched.with_motion(part, choice))
            except FunctionalizationError as error:
                print(f"{edited.source.name}: {part} {word}: {error}", file=sys.stderr)
                continue
            back = edited.built(untouched)
            found += [Change(edited.source.name, part, *what) for what in ((word, seconds), (UNDO, back))]
    return found


def other_motions(motion: dict[str, object]) -> tuple[str, ...]:
    """Returns the motions that a part is changed to."""
    other = OTHER_SIDE.get(str(motion["side"]))
    turned = other or "left"
    return (turned, "fixed") if motion["moves"] == "slides" else ("slides", turned, "fixed")


def changes_table(changes: list[Change]) -> str:
    """Returns a table of seconds by kind of change, in Markdown, and the slowest changes."""
    by_kind: dict[str, list[float]] = {}
    for change in changes:
        by_kind.setdefault(change.motion, []).append(change.seconds)
    rows = [(f"{kind} ({len(seconds)})", spread(seconds)) for kind, seconds in by_kind.items()]
    slowest = sorted(changes, key=lambda change: -change.seconds)[:5]
    rows += [(f"slowest: {c.model}, {c.part}, {c.motion}", f"{c.seconds:.2f}") for c in slowest]
    late = sum(change.seconds > BAR for change in changes)
    rows.append((f"over {BAR} s", f"{late} of {len(changes)}"))
    return measured_table("Changes in the editor", "Seconds: median, 95th percentile and most.", rows)


def spread(seconds: list[float]) -> str:
    """Returns median, 95th percentile and most in words."""
    return f"{np.median(seconds):.2f}, {np.percentile(seconds, 95):.2f}, {max(seconds):.2f}"


if __name__ == "__main__":
    sys.exit(main())
