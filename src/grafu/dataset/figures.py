"""The figures of one model in a set: the columns of its index, and how they follow from a report.

Lengths are metres, angles radians, masses kilograms, as in `report.json`.
"""

from collections import Counter
from collections.abc import Mapping
from typing import Any, Final, Literal, TypeAlias, final

from grafu.dataclass import dataclass
from grafu.pipeline.report_schema import Report
from grafu.pipeline.verdict import verdict_of
from grafu.vocabulary import JointType

Row: TypeAlias = dict[str, Any]
ColumnKind = Literal["text", "whole number", "number", "texts", "numbers", "motions"]
MOVING_TYPES: Final = tuple(kind.value for kind in JointType if kind is not JointType.FIXED)
MOTION_FIELDS: Final[dict[str, ColumnKind]] = {
    "joint": "text",
    "part": "text",
    "type": "text",
    "lower": "number",
    "upper": "number",
}


@final
@dataclass(frozen=True, slots=True)
class IndexColumn:
    """One figure: its name, its kind, and what it states. Only `number`, `numbers` and `text` may be null."""

    name: str
    kind: ColumnKind
    meaning: str


COLUMNS: Final = (
    IndexColumn("name", "text", "the name of the result: its folder's"),
    IndexColumn("key", "text", "the name in the set, before the first dot of its files: `name` without dots"),
    IndexColumn("split", "text", "train, validation or test"),
    IndexColumn("shard", "text", "the file, or the folder, that holds it, relative to the set"),
    IndexColumn("verdict", "text", "green, yellow or red"),
    IndexColumn("reasons", "texts", "the faults: the kind, and the part after a colon"),
    IndexColumn("piece", "text", "what the whole piece is; null: not known"),
    IndexColumn("size", "numbers", "width, depth and height, metres; null: not stated"),
    IndexColumn("parts", "whole number", "parts of the input"),
    IndexColumn("joints", "whole number", "joints"),
    *(IndexColumn(kind, "whole number", f"{kind} joints") for kind in MOVING_TYPES),
    IndexColumn("motions", "motions", "of each joint `joint`, `part`, `type`, `lower` and `upper` (metres or radians)"),
    IndexColumn("mass", "number", "of the whole, kg; null: not stated"),
    IndexColumn("files", "texts", "what the set holds of the result, relative to its folder"),
    IndexColumn("formats", "texts", "the formats among them"),
    IndexColumn("bytes", "whole number", "the size of these files together"),
    IndexColumn("version", "text", "the version of grafu that made it"),
    IndexColumn("geometric_hash", "text", "16 digits that are the same for copies, and often for models much alike"),
    IndexColumn("group", "text", "the group of near-duplicates, which lies in one split"),
    IndexColumn("group_size", "whole number", "how many models of the set are in it"),
)


def figures_of(report: Report) -> Row:
    """Returns what the report states for the index."""
    verdict = verdict_of(report)
    kinds = Counter(joint.type.value for joint in report.joints)
    stability = report.base.stability if report.base else None
    return {
        "verdict": verdict.colour.value,
        "reasons": [f"{fault.kind}: {fault.part}" if fault.part else str(fault.kind) for fault in verdict.lines],
        "piece": report.piece.kind.value if report.piece else None,
        "size": list(report.size) if report.size else None,
        "parts": len(report.parts),
        "joints": len(report.joints),
        **{kind: kinds[kind] for kind in MOVING_TYPES},
        "motions": [
            {"joint": j.id, "part": j.part, "type": j.type.value, "lower": j.lower, "upper": j.upper}
            for j in report.joints
        ],
        "mass": stability.mass if stability else None,
        "version": report.version,
    }


def in_order(row: Mapping[str, Any]) -> Row:
    """Returns a row with its figures in the order of the columns."""
    return {column.name: row[column.name] for column in COLUMNS}
