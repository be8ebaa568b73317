"""What a user can say about an input before it is read. It reads nothing."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal, final

from grafu.errors import AssetError, AssetTooLarge

DIRECTIONS = ("+X", "-X", "+Y", "-Y", "+Z", "-Z")

Labelling = Literal["input", "none"]
Division = Literal["input", "loose"]


@final
@dataclass(frozen=True, slots=True)
class Limits:
    """The largest input that is read: bytes per file, parts, and faces in all."""

    max_bytes: int = 512 * 2**20
    max_parts: int = 5_000
    max_faces: int = 20_000_000


def check_parts(count: int, path: Path, limits: Limits) -> None:
    """Raises AssetTooLarge where `count` parts are more than the limit."""
    if count > limits.max_parts:
        raise AssetTooLarge(
            f"{path} has {count:,} parts: at most {limits.max_parts:,} are read; merge or leave out some"
        )


@final
@dataclass(frozen=True, slots=True)
class LoadOptions:
    """How to read an asset; None leaves the choice to the format, the dataset or the geometry.

    `up` and `front` are directions in the input's own coordinates, like `+Y`; `scale` is metres per input unit;
    `height` is the metric height of the whole object and wins over `scale`. `labels="none"` masks every label.
    `parts="loose"` makes each connected shell of a mesh a part (see `loose_parts`), not each object of the input.

    Raises:
        AssetError: if a direction is not an axis, up and front lie on one axis, or a size is not positive.
    """

    up: str | None = None
    front: str | None = None
    scale: float | None = None
    height: float | None = None
    labels: Labelling = "input"
    parts: Division = "input"
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


def _direction(name: str, value: str | None) -> str | None:
    if value is None:
        return None
    spelled = value.strip().upper()
    spelled = spelled if spelled[:1] in "+-" else f"+{spelled}"
    if spelled not in DIRECTIONS:
        raise AssetError(f"--{name} must be one of {', '.join(DIRECTIONS)}: got {value!r}")
    return spelled
