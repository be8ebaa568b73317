"""Cabinets of every kind from one spec: a case, a layout of its front, and how the fronts are mounted."""

from dataclasses import dataclass, replace
from typing import final

from grafu.asset.part import Asset
from grafu.synth.assembly import Piece, assemble
from grafu.synth.case import Case, case_pieces
from grafu.synth.finish import PLAIN, Finish, surface_of
from grafu.synth.fronts import Mount, Setting, front_pieces, partition_piece
from grafu.synth.layout import Layout, Pair, Partition, Rect, divide
from grafu.synth.shapes import board
from grafu.vocabulary import PartLabel

BOX = Case()
TWO_DOORS = Pair()


@final
@dataclass(frozen=True, slots=True)
class Cabinet:
    """A cabinet, metres. `lap` is the most that an overlay front covers of a panel; `gap` parts neighbouring fronts.

    Drawer boxes keep `slide_gap` from the walls on either side, 12.5 mm as real slides need.
    """

    name: str = "cabinet"
    case: Case = BOX
    layout: Layout = TWO_DOORS
    mount: Mount = "overlay"
    front: float = 0.018
    gap: float = 0.003
    seat: float = 0.001
    lap: float = 1.0
    slide_gap: float = 0.0125
    finish: Finish = PLAIN

    @property
    def setting(self) -> Setting:
        """Where the fronts sit."""
        case, border = self.case, self.case.border
        sizes = (self.front, self.gap, self.seat, self.lap, border, border - case.panel, self.slide_gap)
        return Setting(case.front, case.inner_back, self.mount, *sizes, self.finish)


def make_cabinet(spec: Cabinet) -> Asset:
    """Returns the cabinet with its true joints.

    Raises:
        ValueError: if the layout leaves some cell no room.
    """
    return assemble(spec.name, cabinet_pieces(spec))


def cabinet_pieces(spec: Cabinet) -> list[Piece]:
    """Returns the pieces of a cabinet: its case is centred in x and y and stands on z = 0."""
    setting = spec.setting
    pieces = list(case_pieces(spec.case, spec.finish, setting.front))
    for item in divide(spec.layout, spec.case.opening, spec.case.edges, spec.case.border):
        if isinstance(item, Partition):
            pieces += _partition(item, spec)
        else:
            pieces += front_pieces(item, setting)
    return pieces


def _partition(item: Partition, spec: Cabinet) -> list[Piece]:
    """Returns a partition's panel and, in a face frame, the frame's bar before it."""
    setting, case = spec.setting, spec.case
    if not case.frame:
        return [partition_piece(item, setting)]
    r, spare = item.rect, setting.wall / 2
    bar = board((r.x0, case.front, r.z0), (r.x1, -case.depth / 2, r.z1))
    pieces = [Piece(PartLabel.FACE_FRAME, "face_frame_bar", (surface_of(bar, spec.finish.case),))]
    if item.kind == "panel":
        thin = (
            replace(r, x0=r.x0 + spare, x1=r.x1 - spare)
            if item.upright
            else replace(r, z0=r.z0 + spare, z1=r.z1 - spare)
        )
        pieces.append(
            partition_piece(replace(item, rect=_to_walls(thin, item, case)), replace(setting, plane=-case.depth / 2))
        )
    return pieces


def _to_walls(rect: Rect, item: Partition, case: Case) -> Rect:
    """Returns a panel behind a face frame lengthened to the case's walls, where it ends at the frame's opening."""
    o, t = case.opening, case.panel
    if item.upright:
        high = case.crown if case.top == "over" else case.height - t
        return replace(
            rect,
            z0=case.floor + t if rect.z0 == o.z0 else rect.z0,
            z1=high if rect.z1 == o.z1 and case.top != "none" else rect.z1,
        )
    return replace(
        rect,
        x0=t - case.width / 2 if rect.x0 == o.x0 else rect.x0,
        x1=case.width / 2 - t if rect.x1 == o.x1 else rect.x1,
    )
