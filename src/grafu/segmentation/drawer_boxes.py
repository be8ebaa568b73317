"""The box of a drawer that was drawn behind its front: of boards, or as one body that is open from above."""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_ratios
from grafu.segmentation.config import MemberConfig
from grafu.segmentation.view import MaskOfShells, ScalarsOfShells, ShellsView


@final
@dataclass(frozen=True, slots=True)
class TubConfig:
    """Which bodies are open from above, and closed before and behind. Faces drawn from both sides change nothing.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    end: float = 0.25
    """How far from an end of the body its walls and its lid lie (fraction of its size there)."""
    wall: float = 0.5
    """What each of both walls covers at least (fraction of the body's outline): the rim of a case covers less."""
    lid: float = 0.4
    """What faces near its top cover at most (fraction of its plan): boards and closed cases have a top."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def drawer_boards(
    view: ShellsView, plate: int, inside: MaskOfShells, near: float, config: MemberConfig
) -> MaskOfShells:
    """Whether each shell is a board of a box behind the plate: two sides, what lies between them, and no lid.

    Low sides, as of a deep drawer for pans, are runners unless a bottom or a back joins them.

    Args:
        view: what is seen.
        plate: the front.
        inside: the shells that may be boards, in its outline.
        near: how far off something still touches.
        config: the thresholds.
    """
    nothing = np.zeros(len(inside), dtype=bool)
    size, whole = view.size, view.size[plate]
    middles = (view.low + view.high)[:, :2] / 2
    amid = ((middles >= view.low[plate, :2]) & (middles <= view.high[plate, :2])).all(axis=1)
    behind = inside & amid & (view.high[:, 2] <= view.high[plate, 2] + near)
    thick = size[:, 2] > near
    upright = behind & thick & (size[:, 0] <= config.side_width * whole[0]) & (size[:, 1] >= config.low_side * whole[1])
    upright &= (size[:, 2] >= config.side_depth * size[:, 0]) & (view.high[:, 2] >= view.low[plate, 2] - near)
    middle = (view.low[plate, 0] + view.high[plate, 0]) / 2
    left, right = upright & (view.high[:, 0] < middle), upright & (view.low[:, 0] > middle)
    if not (left.any() and right.any()):
        return nothing
    ends = view.low[left, 0].min() - near, view.high[right, 0].max() + near
    box = behind & (view.low[:, 0] >= ends[0]) & (view.high[:, 0] <= ends[1])
    sides_end = float(view.low[left | right, 2].min())
    box &= (view.low[:, 2] >= sides_end - near) & (thick | (view.high[:, 2] < view.low[plate, 2] - near))
    lies = box & (size[:, 1] <= config.flat * size[:, [0, 2]].min(axis=1))
    top = float(view.high[left | right, 1].max())
    lid = lies & (np.abs(view.low[:, 1] - top) <= near + size[:, 1]) & (size[:, 0] >= config.lid * whole[0])
    is_low = float(size[left | right, 1].max()) < config.side_height * whole[1]
    joined = (box & ~upright & (size[:, 0] >= config.half * (ends[1] - ends[0]))).any()
    return nothing if lid.any() or (is_low and not joined) or _is_case(view, box, near) else box


def _is_case(view: ShellsView, box: MaskOfShells, near: float) -> bool:
    """Whether a box is the outermost of all on the left, on the right and below: nothing is around it."""
    ends = ((view.low[:, 0], 1), (view.low[:, 1], 1), (view.high[:, 0], -1))
    return all(bool((sign * at[box]).min() <= (sign * at).min() + near) for at, sign in ends)


def drawer_tub(
    view: ShellsView,
    plate: int,
    inside: MaskOfShells,
    cover: ScalarsOfShells,
    near: float,
    config: MemberConfig,
    tubs: TubConfig = TubConfig(),
) -> MaskOfShells:
    """Whether each shell is the box of a drawer drawn as one body, right behind the plate, and open from above.

    Its front wall and the inside of its back wall face the viewer: of a case that is the inside of its back alone.
    `cover` is what the faces of each shell that face the viewer cover (fraction of its outline), `tubs` what is open
    from above; see `drawer_boards` for the other arguments.
    """
    size, whole = view.size, view.size[plate]
    tub = inside & (cover >= config.walls) & (view.low[:, 2] < view.low[plate, 2] - near)
    tub &= np.abs(view.high[:, 2] - view.low[plate, 2]) <= near + whole[2]
    tub &= (size[:, 0] >= config.half * whole[0]) & (size[:, 1] >= config.side_height * whole[1])
    tub &= size[:, 2] >= config.side_depth * whole[2]
    for k in np.flatnonzero(tub).tolist():
        tub[k] = _is_open_box(view, k, tubs)
    return np.asarray(tub)


def _is_open_box(view: ShellsView, shell: int, config: TubConfig) -> bool:
    """Whether faces of a shell that face the viewer cover its near end and its far end, and none cover its top."""
    corners = view.rays.corners(view.shell == shell)
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    size = view.size[shell]
    place = (corners.mean(axis=1) - view.low[shell]) / np.maximum(size, 1e-300)
    towards = np.maximum(area[:, 2], 0.0)
    walls = [float(towards[at].sum()) for at in (place[:, 2] >= 1 - config.end, place[:, 2] <= config.end)]
    above = area[place[:, 1] >= 1 - config.end, 1]
    lid = max(float(np.maximum(sign * above, 0.0).sum()) for sign in (1.0, -1.0))
    return bool(min(walls) >= config.wall * size[0] * size[1] and lid <= config.lid * size[0] * size[2])
