"""What looks open from above, and is closed by a lid below the rim: a bench between its arms, a box before a back.

A lid needs the room above it, so a top there would hold it shut.
"""

from typing import final

import numpy as np

from grafu.additions.top.coverage import Coverage
from grafu.additions.top.height_map import heights_of
from grafu.additions.top.roles import Closed, Roles
from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_ratios


@final
@dataclass(frozen=True, slots=True)
class LidBelowConfig:
    """When what turns is a lid, and closes what is open above.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    thin: float = 0.4
    """How thick a lid is at most (fraction of its shorter side seen from above): a front that turns up is higher."""
    level: float = 0.1
    """Upright part of a lid's axis at most (cosine)."""
    closes: float = 0.5
    """What of the opening lies over the lid at least (fraction): with a smaller one, most stays open."""

    def __post_init__(self) -> None:
        require_ratios(self, "thin", "level", "closes")


def lid_in(roles: Roles, coverage: Coverage, config: LidBelowConfig = LidBelowConfig()) -> Closed | None:
    """Returns the lid under the rim that closes most of what is open there, None where none does."""
    level, opened = coverage.level, coverage.opened
    assert level is not None
    for body in roles.turning:
        box = body.mesh.box
        if body.request is None or abs(float(body.request.axis.direction[2])) > config.level:
            continue
        if box.size[2] > config.thin * min(box.size[:2]) or box.high[2] > level:
            continue
        over = np.isfinite(heights_of(body.mesh.triangles, coverage.grid))[opened]
        if over.mean() >= config.closes:
            return body
    return None
