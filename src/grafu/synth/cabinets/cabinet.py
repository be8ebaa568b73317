"""Cabinets of every kind from one spec: a case, a layout of its front, and how the fronts are mounted."""

from collections.abc import Iterator
from dataclasses import replace
from math import pi
from typing import final

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.synth.case.carcass import case_pieces
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Back
from grafu.synth.fronts.front import front_pieces, partition_pieces
from grafu.synth.fronts.layout import Layout, Pair, Partition, Rect, divide
from grafu.synth.fronts.leaf_relief import swept_depth
from grafu.synth.fronts.setting import Mount, Setting
from grafu.synth.pieces.assembly import PieceDraft, assemble, plank
from grafu.synth.pieces.finish import PLAIN, Finish
from grafu.vocabulary import PartLabel

BOX = Case()
TWO_DOORS = Pair()


@final
@dataclass(frozen=True, slots=True)
class Cabinet:
    """A cabinet, metres. `lap` is the most that an overlay front covers of a panel; `gap` parts neighbouring fronts.

    Overlay fronts end `reveal` within the case's outer faces (none: by the gap; 0: flush; below 0: beyond them to the
    sides, as free-standing pieces may). Before a pair bowed as one, a square top over the sides and a bottom under them
    that jut out follow its curve.
    Drawer boxes keep `slide_gap` from the walls on either side, 12.5 mm as real slides need. A two-sided cabinet has a
    second layout, `rear`, that faces +Y; a wall in place of the back then parts the two, `ratio` of the depth for the
    front one.

    Raises:
        ValueError: if `ratio` is not between 0.2 and 0.8.
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
    rear: Layout | None = None
    ratio: float = 0.55
    reveal: float | None = None

    def __post_init__(self) -> None:
        if not 0.2 <= self.ratio <= 0.8:
            raise ValueError(f"`Cabinet.ratio` must be between 0.2 and 0.8: got {self.ratio}")

    @property
    def setting(self) -> Setting:
        """Where the fronts sit; those of a two-sided cabinet's front, which faces -Y."""
        case = self.case
        plain = case.face is None or case.face.kind == "strips" or case.posts > 0
        return Setting(
            plane=case.front,
            back=case.inner_back if self.rear is None else self._wall[0],
            mount=self.mount,
            thickness=self.front,
            gap=self.gap,
            seat=self.seat,
            lap=self.lap,
            panel=case.border,
            wall=0.0 if plain else case.border - case.panel,
            slide_gap=self.slide_gap,
            finish=self.finish,
            borders=case.borders,
            case_wall=0.0 if case.posts else case.side_border - case.panel,
            frame=case.face_depth,
            reveal=self.reveal,
        )

    @property
    def _wall(self) -> tuple[float, float]:
        """The two y of the wall between the fronts of a two-sided cabinet."""
        y = self.case.carcass + self.ratio * (self.case.depth / 2 - self.case.carcass)
        return y - self.case.panel / 2, y + self.case.panel / 2


def make_cabinet(spec: Cabinet) -> Asset:
    """Returns the cabinet with its true joints.

    Raises:
        ValueError: if the layout leaves some cell no room.
    """
    return assemble(spec.name, cabinet_pieces(spec))


def cabinet_pieces(spec: Cabinet) -> list[PieceDraft]:
    """Returns the pieces of a cabinet: its case is centred in x and y and stands on z = 0."""
    case = _following(spec.layout, spec.case)
    case = case if spec.rear is None else replace(case, back=Back("none", 0.0))
    setting = spec.setting
    pieces = [*case_pieces(case, spec.finish, setting.front), *_filling(spec.layout, spec, setting)]
    if spec.rear is not None:
        pieces += _rear(spec.rear, spec, setting)
    return pieces


def _following(layout: Layout, case: Case) -> Case:
    """Returns the case with its top and bottom bulging as far as a pair of swept leaves that fills its front."""
    if not isinstance(layout, Pair) or layout.leaf not in ("swept", "swept frame") or layout.muntin:
        return case
    belly = swept_depth(case.width / 2)
    top = replace(case.top, belly=belly) if case.top.overhang > 0 else case.top
    bottom = replace(case.bottom, belly=belly) if case.bottom.overhang > 0 else case.bottom
    return replace(case, top=top, bottom=bottom)


def _filling(layout: Layout, spec: Cabinet, setting: Setting) -> Iterator[PieceDraft]:
    for item in divide(layout, spec.case.opening, spec.case.edges, spec.case.border):
        if isinstance(item, Partition):
            yield from _partition(item, spec, setting)
        else:
            yield from front_pieces(item, setting)


def _rear(layout: Layout, spec: Cabinet, setting: Setting) -> Iterator[PieceDraft]:
    """Yields the wall and the fronts that face +Y: made facing -Y, then turned about."""
    case, (near, far) = spec.case, spec._wall
    x, high = case.width / 2 - (case.posts or case.panel), case.height - case.top_thickness
    span = ((-x, near, case.floor + case.bottom_thickness), (x, far, high))
    yield plank(PartLabel.DIVIDER, "mid_wall", spec.finish.case, span)
    plain = replace(spec, case=replace(case, frame=None, back=Back("none", 0.0)))
    behind = replace(setting, plane=-case.depth / 2, back=-far, borders=plain.case.borders, case_wall=0.0, wall=0.0)
    turn = from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), pi))
    for piece in _filling(layout, plain, replace(behind, panel=plain.case.border)):
        yield piece.transformed(turn)


def _partition(item: Partition, spec: Cabinet, setting: Setting) -> Iterator[PieceDraft]:
    """Yields a partition's panel and, in a face frame, the frame's bar before it."""
    case, r = spec.case, item.rect
    if case.face is None:
        yield from partition_pieces(item, setting)
        return
    one = case.face.kind == "one"
    stem = "face_frame_bar" if one else "edge_strip" if case.face.kind == "strips" else _bar_name(item)
    label = PartLabel.FACE_FRAME if one else PartLabel.BAR
    yield plank(label, stem, spec.finish.case, ((r.x0, case.front, r.z0), (r.x1, case.carcass, r.z1)))
    if item.kind != "rail":
        spare = max(case.border - case.panel, 0.0) / 2
        thin = (
            replace(r, x0=r.x0 + spare, x1=r.x1 - spare)
            if item.upright
            else replace(r, z0=r.z0 + spare, z1=r.z1 - spare)
        )
        panel = replace(item, rect=_to_walls(thin, item, case))
        yield from partition_pieces(panel, replace(setting, plane=case.carcass))


def _bar_name(item: Partition) -> str:
    return "mid_stile" if item.upright else "mid_rail"


def _to_walls(rect: Rect, item: Partition, case: Case) -> Rect:
    """Returns a panel behind a face frame lengthened to the case's walls, where it ends at the frame's opening."""
    o, t = case.opening, case.posts or case.panel
    if item.upright:
        high = case.height - case.top_thickness - case.top_rail
        return replace(
            rect,
            z0=case.floor + case.bottom_thickness if rect.z0 == o.z0 else rect.z0,
            z1=high if rect.z1 == o.z1 and case.top_thickness else rect.z1,
        )
    return replace(
        rect,
        x0=t - case.width / 2 if rect.x0 == o.x0 else rect.x0,
        x1=case.width / 2 - t if rect.x1 == o.x1 else rect.x1,
    )
