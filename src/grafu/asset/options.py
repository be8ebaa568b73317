"""What a user can say about an input before it is read, and a count of what it holds. It reads nothing.

What a model holds is added up as it is found, before anything is built of it.
"""

from dataclasses import field, fields, replace
from pathlib import Path
from typing import Any, Literal, final

from grafu.dataclass import dataclass
from grafu.errors import AssetError, AssetTooLarge
from grafu.visible import ShortRepr

DIRECTIONS = ("+X", "-X", "+Y", "-Y", "+Z", "-Z")

Labelling = Literal["input", "none"]
Division = Literal["auto", "input", "loose"]
Pieces = Literal["together", "split"]


def _limit(default: int, counts: str) -> Any:
    return field(default=default, metadata={"counts": counts})


@final
@dataclass(frozen=True, slots=True)
class Limits:
    """What is read of one model at most: all its files together, and what is placed several times each time.

    `--limit NAME=NUMBER` raises or lowers one; NAME is the field without `max_`, hyphens for underscores.

    Raises:
        AssetError: if one is not a whole number above 0.
    """

    max_bytes: int = _limit(256 * 2**20, "bytes of all files that are read")
    max_parts: int = _limit(5_000, "parts")
    max_faces: int = _limit(2_000_000, "triangles")
    max_vertices: int = _limit(3_000_000, "vertices")
    max_primitives: int = _limit(20_000, "pieces of one material: primitives in glTF, visuals in URDF")
    max_lines: int = _limit(10_000_000, "lines of one OBJ")
    max_groups: int = _limit(200_000, "changes of object, group or material in OBJ files")
    max_corners: int = _limit(2_000, "corners of one polygon")
    max_nodes: int = _limit(50_000, "nodes of a scene, links of a robot")
    max_depth: int = _limit(500, "nodes, links or XML elements one below the other")
    max_values: int = _limit(3_000_000, "values in one JSON, elements and attributes in one XML")
    max_image_pixels: int = _limit(8192 * 8192, "pixels of one image; a larger one is left out")
    max_pixels: int = _limit(4 * 8192 * 8192, "pixels of all images; those beyond are left out")

    def __post_init__(self) -> None:
        for name, value in self.by_name().items():
            if isinstance(value, bool) or not isinstance(value, int) or value < 1:
                raise AssetError(f"--limit {name} must be a whole number above 0: got {value!r}")

    def by_name(self) -> dict[str, int]:
        """Returns every limit by the name that `--limit` knows it by."""
        return {limit_name(f.name): getattr(self, f.name) for f in fields(self)}

    def with_limit(self, name: str, value: int) -> "Limits":
        """Returns the limits with one of them changed, named as by `--limit`.

        Raises:
            AssetError: if there is no such limit, or the value is not a whole number above 0.
        """
        if name not in self.by_name():
            raise AssetError(f"--limit must name one of {', '.join(self.by_name())}: got {name!r}")
        return replace(self, **{f"max_{name.replace('-', '_')}": value})

    def require(self, name: str, count: int, where: object) -> None:
        """Raises AssetTooLarge where `count` of what `name` limits is more than is read; `where` names the input."""
        most = getattr(self, f"max_{name.replace('-', '_')}")  # asked for every file and line: quicker than by_name
        if count > most:
            raise AssetTooLarge(f"{where} has {count:,} {name}: at most {most:,} are read; {how_to_allow(name, count)}")


def limit_name(field_name: str) -> str:
    """Returns the name by which `--limit` knows a field of `Limits`."""
    return field_name.removeprefix("max_").replace("_", "-")


def how_to_allow(name: str, count: int) -> str:
    """Returns what to do where a limit is exceeded."""
    return f"simplify it, or allow more by --limit {name}={count}"


def check_parts(count: int, path: Path, limits: Limits) -> None:
    """Raises AssetTooLarge where `count` parts are more than the limit."""
    limits.require("parts", count, path)


@final
@dataclass(frozen=True, slots=True)
class LoadOptions(ShortRepr):
    """How to read an asset; None leaves the choice to the format, the dataset or the geometry.

    `up` and `front` are directions in the input's own coordinates, like `+Y`; `scale` is metres per input unit;
    `height` is the metric height of the whole object and wins over `scale`. `labels="none"` masks every label.
    `parts="input"` takes the input's objects as parts; `"auto"` cuts those that hide doors or drawers (see
    `cut_where_fronts_appear`); `"loose"` makes each connected shell of a mesh a part (see `loose_parts`).
    `pieces="split"` tells the pieces of furniture in a file apart (see `told_apart`); `piece` is the number of the one
    that is read, from 1, and None where there is one only.

    Raises:
        AssetError: if a direction is not an axis, up and front lie on one axis, a size is not positive, or `piece` is
            below 1 or given where pieces are not split.
    """

    up: str | None = None
    front: str | None = None
    scale: float | None = None
    height: float | None = None
    labels: Labelling = "input"
    parts: Division = "auto"
    pieces: Pieces = "together"
    piece: int | None = None
    limits: Limits = Limits()

    def __post_init__(self) -> None:
        for name in ("up", "front"):
            object.__setattr__(self, name, _direction(name, getattr(self, name)))
        if self.up and self.front and self.up[1] == self.front[1]:
            raise AssetError(f"--up and --front must lie on different axes: got {self.up} and {self.front}")
        for name in ("scale", "height"):
            value = getattr(self, name)
            if value is not None and not 0 < value < float("inf"):
                raise AssetError(f"--{name} must be a positive number: got {value}")
        if self.piece is not None and (self.pieces != "split" or self.piece < 1):
            raise AssetError(f"--piece must be a number from 1, with --pieces split: got {self.piece}, {self.pieces}")


def _direction(name: str, value: str | None) -> str | None:
    if value is None:
        return None
    spelled = value.strip().upper()
    spelled = spelled if spelled[:1] in "+-" else f"+{spelled}"
    if spelled not in DIRECTIONS:
        raise AssetError(f"--{name} must be one of {', '.join(DIRECTIONS)}: got {value!r}")
    return spelled


@final
class Tally:
    """The counts of one model so far, each checked against its limit as it grows."""

    def __init__(self, limits: Limits) -> None:
        self._limits = limits
        self._counts: dict[str, int] = {}

    def require(self, where: object, **counts: int) -> None:
        """Refuses what is too much by itself, beside what was counted, and counts nothing.

        Raises:
            AssetTooLarge: if there is more of something than is read.
        """
        for name, count in counts.items():
            self._limits.require(name, self._counts.get(name, 0) + count, where)

    def left(self, name: str) -> int:
        """Returns how much more of something may be read."""
        return self._limits.by_name()[name] - self._counts.get(name, 0)

    def add(self, where: object, **counts: int) -> None:
        """Adds to what was counted; `where` names the input.

        Raises:
            AssetTooLarge: if there is more of something than is read.
        """
        for name, count in counts.items():
            total = self._counts.get(name, 0) + count
            self._limits.require(name, total, where)
            self._counts[name] = total
