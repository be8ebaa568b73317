"""The modelling noise of one model: every decision drawn (`ModellingNoise`), and how it is applied.

It gives two assets: the whole (noisy in its geometry, cut and words, complete, with true joints) and what is given
of it (parts missing, labels lost or wrong).
"""

from collections.abc import Callable, Collection
from dataclasses import replace
from typing import Final, Literal, final

import numpy as np

from grafu.asset.edit import centred, yawed
from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.synth.noise import edits
from grafu.synth.noise.distortion import ajar, bent, stretched
from grafu.synth.noise.edits import with_anchored_sheets
from grafu.synth.noise.housing import with_housed_boards
from grafu.synth.noise.loose_objects import with_loose_objects
from grafu.synth.noise.naming import MISTAKES, mistaken, with_labels_masked, worded
from grafu.synth.noise.part_names import NameScheme, named
from grafu.synth.noise.segmentation import (
    in_pieces,
    in_planks,
    is_board,
    with_attached_joined,
    with_box_apart,
    with_edge_strip,
    with_front_alone,
    with_handles_in_pieces,
    with_joined,
)
from grafu.synth.noise.tessellation import Density
from grafu.synth.pieces.riding import moving_with
from grafu.synth.specimen import Defect
from grafu.vocabulary import PartLabel

Offset = tuple[float, float, float]
Faces = Literal["sheet", "open back", "doubled", "inverted", "loose", "shells"]

FACE_EDITS: Final[dict[Faces, Callable[[Asset, Collection[str]], Asset]]] = {
    "sheet": with_anchored_sheets,
    "open back": edits.with_open_backs,
    "doubled": edits.with_doubled_faces,
    "inverted": edits.with_inverted_normals,
    "loose": edits.with_loose_faces,
    "shells": lambda asset, ids: edits.with_many_shells(asset, 3, ids),
}
BOARDS_ONLY: Final[frozenset[Faces]] = frozenset({"shells"})  # edits that would fill what is no plain board


@final
@dataclass(frozen=True, slots=True)
class Joined:
    """Still parts in one: all of `ids` become one part with this label; handles vanish into what carries them."""

    ids: tuple[str, ...]
    label: PartLabel | None  # none: the ids are attached parts, and join what carries them
    named: bool = True  # otherwise the input states no label for it


@final
@dataclass(frozen=True, slots=True)
class PartCut:
    """One part in several: its surfaces, in planks, an edge strip or a drawer's box apart; or a front alone."""

    part: str
    kind: Literal["pieces", "planks", "edge strip", "box apart", "front alone"]
    label: PartLabel | None = None  # of the pieces
    count: int = 2
    axis: int = 0
    width: float = 0.02  # of an edge strip, metres


@final
@dataclass(frozen=True, slots=True)
class Misfit:
    """A part shifted by `offset`, or grown by it to both sides, metres."""

    part: str
    offset: Offset
    grown: bool = False


@final
@dataclass(frozen=True, slots=True)
class ModellingNoise:
    """All that is noisy about one model; the parts named are those of the tidy one.

    `housed` is how deep boards are let into one another (`with_housed_boards`).
    `factors` scale along the axes (a negative x mirrors); `bend` is in metres, `yaw` in radians; `ajar` opens fronts by
    fractions of their range; `masked` is the fraction of parts whose label is lost. `density`, `edge` (metres) and
    `both_sides` say how faces are drawn, `grafu.synth.noise.tessellation`. What is left to chance in applying
    (loose_objects, which labels are lost, names) follows `seed`. `naming` is how parts are called; some of a `misnamed`
    model's are called what they are not.
    """

    style: str
    seed: int = 0
    housed: float = 0.0
    loose_objects: tuple[str, ...] = ()
    joined: tuple[Joined, ...] = ()
    cuts: tuple[PartCut, ...] = ()
    faces: tuple[tuple[Faces, tuple[str, ...]], ...] = ()
    misfits: tuple[Misfit, ...] = ()
    ajar: tuple[tuple[str, float], ...] = ()
    factors: Offset = (1.0, 1.0, 1.0)
    bend: float = 0.0
    yaw: float = 0.0
    wording: tuple[str, ...] = ()
    missing: tuple[str, ...] = ()
    masked: float = 0.0
    mislabelled: bool = False
    shuffled: bool = False
    density: Density = "plain"
    edge: float = 0.0015
    both_sides: bool = False
    handles_in_pieces: bool = False
    naming: NameScheme = "ids"
    misnamed: bool = False


def apply_noise(tidy: Asset, noise: ModellingNoise) -> tuple[Asset, tuple[Defect, ...]]:
    """Returns the whole, noisy model, centred and standing on z = 0, and the defects of its geometry.

    A decision about a part that an earlier one did away with is passed over.
    """
    rng = np.random.default_rng(noise.seed)
    asset = tidy
    for kind in noise.loose_objects:
        asset = with_loose_objects(asset, kind, rng)
    asset = with_housed_boards(asset, noise.housed) if noise.housed else asset
    asset = _recut(asset, noise)
    asset = with_handles_in_pieces(asset, noise.missing) if noise.handles_in_pieces else asset
    asset = worded(asset, noise.wording)
    defects = []
    for part_id, ratio in noise.ajar:
        if _has(asset, part_id):
            asset = ajar(asset, part_id, ratio)
            defects.append(Defect("ajar", (part_id,)))
    for misfit in noise.misfits:
        if _has(asset, misfit.part):
            before, asset = asset, _misfitted(asset, misfit)
            defects.append(_defect(before, asset, misfit))
    for edit, ids in noise.faces:
        asset = _with_faces(asset, edit, ids)
    if noise.bend:
        asset = bent(asset, noise.bend, rng)
        defects.append(Defect("interpenetrating", tuple(joint.part for joint in asset.joints)))
    asset = stretched(asset, vec3(*noise.factors))
    asset = centred(yawed(asset, noise.yaw)) if noise.yaw else asset
    if noise.shuffled:
        asset = replace(asset, parts=tuple(asset.parts[k] for k in rng.permutation(len(asset.parts))))
    return replace(asset, frame=tidy.frame), tuple(defects)


def as_given(whole: Asset, noise: ModellingNoise, removable: Collection[str]) -> tuple[Asset, tuple[Defect, ...]]:
    """Returns what a reader would load of the whole: without missing parts, joints, attachments; labels that survive.

    Only `removable` parts go missing, and never all still parts.
    """
    rng = np.random.default_rng([noise.seed, 1])
    gone = [p.id for p in whole.parts if p.id in noise.missing and p.id in removable]
    given = whole.without_annotation()
    kept = tuple(p for p in given.parts if p.id not in gone)
    if not any(p.label.is_support for p in kept):
        gone, kept = [], given.parts
    given = replace(given, parts=kept)
    defects = [Defect("missing", tuple(gone))] if gone else []
    mistakable = [part for part in kept if part.label in MISTAKES]
    if noise.mislabelled and mistakable:
        part = mistakable[int(rng.integers(len(mistakable)))]
        given = given.with_labels({part.id: mistaken(part, rng)})
        defects.append(Defect("mislabelled", (part.id,)))
    nameless = {_joined_id(k) for k, group in enumerate(noise.joined) if not group.named}
    lost = _masked(given, noise.masked, rng) | {p.id for p in kept if p.id in nameless}
    called, wrong = named(
        with_labels_masked(given, lost),
        {part.id: part.label for part in whole.parts},
        noise.naming,
        noise.misnamed,
        np.random.default_rng([noise.seed, 2]),
    )
    if wrong:
        defects.append(Defect("mislabelled", wrong))
    return called, tuple(defects)


def _masked(given: Asset, ratio: float, rng: np.random.Generator) -> frozenset[str]:
    """Returns which parts lose their label: odd ones and bars rather than panels, unless nearly all do."""
    if ratio <= 0:
        return frozenset()
    odd = {PartLabel.MISC: 6.0, PartLabel.BAR: 2.0, PartLabel.DOOR: 0.4, PartLabel.DRAWER: 0.4}
    weights = np.array([odd.get(part.label, 1.0) for part in given.parts])
    count = min(max(round(ratio * len(weights)), 1), len(weights))
    picked = rng.choice(len(weights), count, replace=False, p=weights / weights.sum())
    return frozenset(given.parts[k].id for k in picked)


def _joined_id(k: int) -> str:
    return f"joined_{k + 1}"


def _has(asset: Asset, part_id: str) -> bool:
    return any(part.id == part_id for part in asset.parts)


def _recut(asset: Asset, noise: ModellingNoise) -> Asset:
    for k, group in enumerate(noise.joined):
        if group.label is None:
            asset = with_attached_joined(asset, group.ids)
            continue
        ids = [p.id for p in asset.parts if p.id in group.ids]
        asset = with_joined(asset, ids, group.label, _joined_id(k)) if len(ids) > 1 else asset
    for cut in noise.cuts:
        asset = _cut(asset, cut) if _has(asset, cut.part) else asset
    return asset


def _cut(asset: Asset, cut: PartCut) -> Asset:
    match cut.kind:
        case "pieces":
            return in_pieces(asset, cut.part, cut.label)
        case "planks":
            return in_planks(asset, cut.part, cut.count, cut.axis)
        case "edge strip":
            return with_edge_strip(asset, cut.part, cut.width)
        case "box apart":
            return with_box_apart(asset, cut.part)
        case "front alone":
            return with_front_alone(asset, cut.part)


def _misfitted(asset: Asset, misfit: Misfit) -> Asset:
    edit = edits.with_swollen if misfit.grown else edits.with_shifted
    return edit(asset, misfit.part, vec3(*misfit.offset))


def _defect(before: Asset, after: Asset, misfit: Misfit) -> Defect:
    """Returns what a misfit comes to: the part cuts deeper into a neighbour's box than before, or only stands off."""
    old, new = before.part(misfit.part).box, after.part(misfit.part).box
    own = moving_with(after, misfit.part)
    deeper = any(
        float(new.axis_gaps(p.box).max()) < min(float(old.axis_gaps(p.box).max()), 0.0) - 1e-5
        for p in after.parts
        if p.id not in own
    )
    return Defect("interpenetrating" if deeper else "floating", (misfit.part,))


def _with_faces(asset: Asset, edit: Faces, ids: Collection[str]) -> Asset:
    def fits(part: Part) -> bool:
        return part.id in ids and (edit not in BOARDS_ONLY or is_board(part))

    present = frozenset(part.id for part in asset.parts if fits(part))
    return FACE_EDITS[edit](asset, present) if present else asset
