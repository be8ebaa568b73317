"""Racks: open uprights with shelves on brackets, over a cabinet that hangs or stands between them."""

from collections.abc import Iterator
from typing import Literal, final

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Material
from grafu.geometry.arrays import vec3
from grafu.geometry.transform import translation
from grafu.synth.cabinets.cabinet import Cabinet, cabinet_pieces
from grafu.synth.pieces.assembly import PieceDraft, Span, assemble, both_sides, plank
from grafu.vocabulary import PartLabel

LOW_UNIT = Cabinet()


@final
@dataclass(frozen=True, slots=True)
class Rack:
    """A cabinet between uprights that run on above it, metres.

    The uprights, `upright` wide and `deep`, are `height` tall and touch the cabinet's sides: two on either side joined
    by bars ("ladder"), one at the back ("pole") or one board ("panel"). The cabinet's underside is `lift` above the
    floor. `shelves` share the room above it, each `shelf_depth` of the cabinet's depth from the back, on brackets.

    Raises:
        ValueError: if the uprights do not reach above the cabinet, or there is a negative number of shelves.
    """

    name: str = "rack"
    cabinet: Cabinet = LOW_UNIT
    height: float = 1.8
    kind: Literal["ladder", "pole", "panel"] = "ladder"
    upright: float = 0.02
    deep: float = 0.03
    lift: float = 0.1
    shelves: int = 4
    shelf: float = 0.014
    shelf_depth: float = 0.7
    brackets: bool = True
    metal: bool = True

    def __post_init__(self) -> None:
        if self.height <= self.lift + self.cabinet.case.height or self.shelves < 0:
            size = f"{self.height} m over {self.lift + self.cabinet.case.height} m, {self.shelves} shelves"
            raise ValueError(f"`Rack` needs uprights taller than its cabinet, and no negative number: got {size}")

    @property
    def material(self) -> Material:
        """What the uprights are made of."""
        return self.cabinet.finish.metal if self.metal else self.cabinet.finish.case


def make_rack(spec: Rack) -> Asset:
    """Returns the rack with its cabinet's true joints.

    Raises:
        ValueError: if the cabinet's layout leaves some cell no room.
    """
    lift = translation(vec3(0.0, 0.0, spec.lift))
    cabinet = [piece.transformed(lift) for piece in cabinet_pieces(spec.cabinet)]
    return assemble(spec.name, [*cabinet, *_uprights(spec), *_shelves(spec)])


def _uprights(spec: Rack) -> Iterator[PieceDraft]:
    case, w, d, z = spec.cabinet.case, spec.upright, spec.deep, spec.height
    x, y = case.width / 2, case.depth / 2
    if spec.kind == "panel":
        for side, at in both_sides(((x, -y, 0.0), (x + w, y, z))):
            yield plank(PartLabel.SIDE_PANEL, f"side_panel_{side}", spec.material, at)
        return
    spans: list[tuple[str, Span]] = [("upright", ((x, y - d, 0.0), (x + w, y, z)))]
    if spec.kind == "ladder":
        spans.append(("upright", ((x, -y, 0.0), (x + w, d - y, z))))
        levels = (z - d, spec.lift + case.height, 0.0)
        spans += [("cross_bar", ((x, d - y, low), (x + w, y - d, low + d))) for low in levels]
    for stem, span in spans:
        for _, at in both_sides(span):
            yield plank(PartLabel.BAR, stem, spec.material, at)


def _shelves(spec: Rack) -> Iterator[PieceDraft]:
    """Yields the shelves, between the uprights, and the brackets below their ends."""
    case, t = spec.cabinet.case, spec.shelf
    x, y = case.width / 2, case.depth / 2
    front = y - spec.shelf_depth * case.depth
    low, room = spec.lift + case.height, spec.height - spec.lift - case.height
    for k in range(spec.shelves):
        z = low + room * (k + 1) / (spec.shelves + 0.3)
        if z + t > spec.height:
            return
        span = ((-x, front, z), (x, y, z + t))
        yield plank(PartLabel.SHELF, "shelf", spec.cabinet.finish.case, span)
        if spec.brackets:
            for _, at in both_sides(((x - 0.012, front, z - 0.03), (x, y, z))):
                yield plank(PartLabel.MISC, "bracket", spec.material, at)
