"""The card of a set, `README.md` in the form of Hugging Face's: what its header states is read by `load_dataset` there.

The header names the files of each split and the type of each figure.
"""

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import field
from typing import Final, final

from grafu.dataclass import dataclass
from grafu.dataset.figures import COLUMNS, MOTION_FIELDS, MOVING_TYPES, ColumnKind, Row
from grafu.dataset.layout import BUNDLE, INDEX, METADATA, SPLITS
from grafu.errors import OptionError
from grafu.pipeline.words import Colour
from grafu.version import __version__

UNKNOWN_LICENSE: Final = "unknown"
_LICENSE: Final = re.compile(r"[a-z0-9][a-z0-9.+-]*")
_SIZES: Final = {1_000: "n<1K", 10_000: "1K<n<10K", 100_000: "10K<n<100K", 1_000_000: "100K<n<1M"}
_LARGEST: Final = "1M<n<10M"
_TYPES: Final[dict[str, str]] = {"text": "string", "whole number": "int64", "number": "float64"}


def require_license(text: str) -> str:
    """Returns a license as Hugging Face spells it.

    Raises:
        OptionError: if it has another form.
    """
    if not _LICENSE.fullmatch(text):
        raise OptionError(f"the license must be spelled as on Hugging Face, such as cc-by-4.0 or mit: got {text}")
    return text


@final
@dataclass
class SplitTally:
    """What a split holds, added up as models come."""

    models: int = 0
    parts: int = 0
    size: int = 0
    verdicts: Counter[str] = field(default_factory=Counter)
    joints: Counter[str] = field(default_factory=Counter)
    groups: set[str] = field(default_factory=set)

    def add(self, row: Row) -> None:
        """Counts a model."""
        self.models += 1
        self.parts += row["parts"]
        self.size += row["bytes"]
        self.verdicts[row["verdict"]] += 1
        self.joints.update({kind: row[kind] for kind in MOVING_TYPES})
        self.groups.add(row["group"])


def card(title: str, tallies: Mapping[str, SplitTally], is_tar: bool, license_name: str, seed: int) -> str:
    """Returns the text of the card; splits without a model are not named in its header."""
    held = {split: tallies[split] for split in SPLITS if split in tallies and tallies[split].models}
    header = [*_header(held, is_tar, license_name), *_features(is_tar)]
    return "\n".join(["---", *header, "---", "", *_body(title, held, is_tar, license_name, seed), ""])


def _header(tallies: Mapping[str, SplitTally], is_tar: bool, license_name: str) -> Iterator[str]:
    count = sum(tally.models for tally in tallies.values())
    yield f"license: {license_name}"
    yield from ("task_categories:", "- robotics")
    yield from ("tags:", *(f"- {tag}" for tag in ("3d", "furniture", "articulated-objects", "simulation", "grafu")))
    yield from ("size_categories:", f"- {next((word for most, word in _SIZES.items() if count < most), _LARGEST)}")
    yield from ("configs:", "- config_name: default", "  data_files:")
    for split in tallies:
        yield f"  - split: {split}"
        yield f"    path: {f'{split}-*.tar' if is_tar else f'{split}/{METADATA}'}"


def _features(is_tar: bool) -> Iterator[str]:
    yield from ("dataset_info:", "  features:")
    if not is_tar:
        yield from _typed_columns("  ")
        return
    yield from ("  - name: __key__", "    dtype: string", "  - name: __url__", "    dtype: string")
    yield from ("  - name: model.glb", "    dtype: binary", "  - name: json", "    struct:")
    yield from _typed_columns("    ")


def _typed_columns(indent: str) -> Iterator[str]:
    for column in COLUMNS:
        yield from _typed(column.name, column.kind, indent)


def _typed(name: str, kind: ColumnKind, indent: str) -> Iterator[str]:
    yield f"{indent}- name: {name}"
    if kind == "motions":
        yield f"{indent}  list:"
        for inner, held in MOTION_FIELDS.items():
            yield from _typed(inner, held, f"{indent}  ")
    elif kind in _TYPES:
        yield f"{indent}  dtype: {_TYPES[kind]}"
    else:
        yield f"{indent}  list: {_TYPES[kind.removesuffix('s')]}"


def _body(title: str, tallies: Mapping[str, SplitTally], is_tar: bool, license_name: str, seed: int) -> Iterator[str]:
    yield from (f"# {title}", "", "Furniture whose doors, drawers and lids move: results of `grafu functionalize`.")
    yield from ("", *_table(tallies), "", "## Splits", "")
    yield "Near-duplicates (moved, scaled, mirrored, cut into other triangles) are one `group`, and lie in one split."
    yield f"The split follows from the geometric hash and the seed {seed}."
    yield from ("", "## What is in it", "")
    yield f"`{INDEX}` has a row for each model (`index.parquet` has the same rows, where it is there):"
    yield from ("", "| figure | what it is |", "|---|---|", *(f"| `{c.name}` | {c.meaning} |" for c in COLUMNS), "")
    yield from _layout(is_tar)
    yield from ("", "## Where it comes from, and its licence", "")
    yield f"Made with grafu {__version__}. Shapes and textures are those of the models that were read; hinges, rails,"
    yield "handles, joints and masses were added. The rights in a model are those of its source, and grafu grants none."
    yield "`report.json` names each source as it was given."
    is_known = license_name != UNKNOWN_LICENSE
    yield f"The licence as stated: `{license_name}`." if is_known else "No licence was stated."


def _layout(is_tar: bool) -> Iterator[str]:
    if is_tar:
        yield "A shard (WebDataset) holds `KEY.json`, the row, and the files of the result, as `KEY.model.glb`;"
        yield f"`KEY.{BUNDLE}` holds those that find each other by their paths (model.urdf and its meshes)."
    else:
        yield f"Each folder `SPLIT/KEY` holds the files of a result; `SPLIT/{METADATA}` has the rows of the split."
    yield from ("", "```python", "from grafu.dataset import load_dataset", "")
    yield from (
        'for sample in load_dataset("DIR", split="train"):',
        '    sample.figures, sample.files["model.glb"]',
        "```",
    )


def _table(tallies: Mapping[str, SplitTally]) -> Iterator[str]:
    heads = ("split", "models", "groups", *Colour, "parts", *(f"{kind} joints" for kind in MOVING_TYPES), "MB")
    yield f"| {' | '.join(heads)} |"
    yield f"|{'---|' * len(heads)}"
    for split, tally in tallies.items():
        counts = [tally.models, len(tally.groups), *(tally.verdicts[colour] for colour in Colour), tally.parts]
        counts += [tally.joints[kind] for kind in MOVING_TYPES]
        yield f"| {split} | {' | '.join(map(str, counts))} | {tally.size / 1e6:.1f} |"
