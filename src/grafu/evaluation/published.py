"""The paper's own rows (its table Quantitative evaluation, its masking table and its text), to stand beside ours.

`MODELS` counts its models of PartNet-Mobility's storage furniture and of HSSD; figures are shares, not per cent.
"""

from dataclasses import dataclass
from typing import Final, final

SOURCE = "the paper"
MODELS: Final = {"PN-M": 345, "HSSD": 50}


@final
@dataclass(frozen=True, slots=True)
class PublishedMotion:
    """A row of the paper's table; raw figures, then with its geometric fix. None: not printed."""

    method: str
    data: str
    aligned: float | None
    reasonable: float | None
    collision: float | None
    collision_fixed: float | None
    connected: float | None
    connected_fixed: float | None


MOTION: Final = (
    PublishedMotion("Particulate", "PN-M", 0.876, 0.965, 0.079, 0.055, 0.132, 0.965),
    PublishedMotion("SINGAPO", "PN-M", 0.878, 0.93, 0.287, 0.270, 0.484, 0.738),
    PublishedMotion("GT annotation", "PN-M", None, None, 0.192, 0.052, 0.491, 0.972),
    PublishedMotion("GraFu", "PN-M", 0.870, 0.963, None, 0.044, None, 0.981),
    PublishedMotion("Particulate", "HSSD", 0.274, None, 0.290, 0.287, 0.628, 0.580),
    PublishedMotion("SINGAPO", "HSSD", 0.594, None, 0.287, 0.246, 0.517, 0.981),
    PublishedMotion("GT annotation", "HSSD", None, None, 0.250, 0.250, 0.821, 0.977),
    PublishedMotion("GraFu", "HSSD", 0.858, None, None, 0.151, None, 0.986),
)
# rate: aligned, collision, connected on PN-M, then on HSSD
MASKING: Final = {
    0.1: ((0.8623, 0.0449, 0.9828), (0.7268, 0.1471, 0.9872)),
    0.3: ((0.8576, 0.0436, 0.9788), (0.7033, 0.1602, 0.9853)),
    0.5: ((0.8544, 0.0446, 0.9783), (0.6268, 0.1682, 0.9693)),
    1.0: ((0.8207, 0.053, 0.9679), (0.5287, 0.218, 0.9610)),
}
TOPS, HANDLES, INTERIORS = 1.0, 0.954, 0.985
