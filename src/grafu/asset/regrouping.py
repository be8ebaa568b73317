"""Parts that the user joins, splits into shells or cuts by a lasso: the same surfaces, divided otherwise.

What the input states about motions stays where its part does: a joint of a part that was joined to another is gone.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from enum import StrEnum
from typing import final

from grafu.asset.lasso_cut import Lasso, inside_lasso
from grafu.asset.loose import shells_of
from grafu.asset.part import Annotation, Asset, Part
from grafu.asset.pieces import with_pieces
from grafu.dataclass import dataclass
from grafu.errors import OptionError, did_you_mean
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.vocabulary import PartLabel


class Regroup(StrEnum):
    """What is done to parts."""

    JOIN = "join"  # the others become pieces of the first
    SPLIT = "split"  # each connected shell becomes a part
    CUT = "cut"  # what lies inside a lasso becomes a part


_DONE = {Regroup.SPLIT: "split", Regroup.CUT: "cut"}


@final
@dataclass(frozen=True, slots=True)
class Regrouping:
    """One change of how a model is divided into parts, by their ids; see `regrouped`.

    `category` is what a part was taken for that is split or cut: what is left of it is that still, where the input
    states none.

    Raises:
        ValueError: if it joins less than two parts or one twice, or splits or cuts more than one, or if a lasso is
            missing where one is to cut, or given where none is.
    """

    do: Regroup
    parts: tuple[str, ...]
    lasso: Lasso | None = None
    category: PartLabel | None = None

    def __post_init__(self) -> None:
        if self.do is Regroup.JOIN and (len(self.parts) < 2 or len(set(self.parts)) < len(self.parts)):
            raise ValueError(f"two parts or more are joined, each once: got {', '.join(self.parts) or 'none'}")
        if self.do is not Regroup.JOIN and len(self.parts) != 1:
            raise ValueError(f"one part is {_DONE[self.do]} at a time: got {', '.join(self.parts) or 'none'}")
        if (self.lasso is not None) != (self.do is Regroup.CUT):
            raise ValueError("a part is cut by a lasso, and by nothing else")


def regrouped(asset: Asset, changes: Sequence[Regrouping]) -> Asset:
    """Returns the asset with its parts joined, split and cut, one change after the other; its notes state each.

    Parts that are joined have the id, the name and the category of the first. Of the shells of a part the largest
    keeps these; the others get ids of their own, and no category. Screws stay with the shell that they lie on. What is
    cut out gets an id of its own, and no category.

    Raises:
        OptionError: if a part does not exist, one that is to be split is a single shell, or all or nothing of one lies
            inside its lasso.
    """
    for change in changes:
        _require_parts(asset, change)
        if change.lasso is not None:
            asset = _cut_out(_taken_for(asset, change), change.parts[0], change.lasso)
        elif change.do is Regroup.SPLIT:
            asset = _split(_taken_for(asset, change), change.parts[0])
        else:
            asset = _joined(asset, change.parts)
    return asset


def _taken_for(asset: Asset, change: Regrouping) -> Asset:
    """Returns the asset in which a part without a category has that of the change."""
    if change.category is None or asset.part(change.parts[0]).label is not PartLabel.UNKNOWN:
        return asset
    named = replace(asset.part(change.parts[0]), label=change.category, labelled_by="prediction")
    return replace(asset, parts=_put(asset.parts, named.id, [named]))


def _require_parts(asset: Asset, change: Regrouping) -> None:
    known = {part.id for part in asset.parts}
    for name in change.parts:
        if name not in known:
            near = did_you_mean(name, known)
            raise OptionError(f"parts to {change.do} must be of {asset.name}, which has no {name}{near}")


def _joined(asset: Asset, parts: tuple[str, ...]) -> Asset:
    host, *others = parts
    note = f"{', '.join(others)} joined to {host} by hand"
    annotation = asset.annotation and _joined_annotation(asset.annotation, parts)
    bare = Annotation(asset.parts, asset.joints, (), asset.small_joints)
    own = _joined_annotation(bare, parts)
    made = replace(asset, parts=own.parts, joints=own.joints, small_joints=own.small_joints, annotation=annotation)
    return replace(made, notes=(*asset.notes, note))


def _joined_annotation(stated: Annotation, parts: tuple[str, ...]) -> Annotation:
    """Returns what is stated of parts of which some are joined; as it is where it has less than two of these."""
    found = {part.id: part for part in stated.parts if part.id in parts}
    present = [name for name in parts if name in found]
    if len(present) < 2:
        return stated
    host, *others = present
    members, hosts = [found[name] for name in others], dict.fromkeys(others, host)
    kept = (part for part in stated.parts if part.id not in hosts)
    made = tuple(with_pieces(part, members if part.id == host else [], hosts) for part in kept)
    free = tuple(replace(part, carried_by=None) if part.carried_by == part.id else part for part in made)
    left = replace(
        stated,
        joints=tuple(joint for joint in stated.joints if joint.part not in hosts),
        small_joints=tuple(joint for joint in stated.small_joints if joint.part not in hosts),
    )
    return left.of_parts(free)


def _split(asset: Asset, name: str) -> Asset:
    shells = shells_of(asset.part(name), asset.box)
    if len(shells) < 2:
        raise OptionError(f"{name} cannot be split: it is one connected shell")
    largest = sorted(shells, key=lambda surfaces: -Box.enclosing(s.mesh.box for s in surfaces).diagonal)
    asset, pieces = _divided(asset, name, largest)
    return replace(asset, notes=(*asset.notes, f"{name} split by hand into {', '.join(pieces)}"))


def _cut_out(asset: Asset, name: str, lasso: Lasso) -> Asset:
    inside, left = inside_lasso(asset.part(name).surfaces, lasso, asset.extent)
    if not inside or not left:
        raise OptionError(f"{name} cannot be cut: {'all' if inside else 'nothing'} of it lies inside the lasso")
    asset, (_, new) = _divided(asset, name, [left, inside])
    return replace(asset, notes=(*asset.notes, f"{new} cut out of {name} by hand"))


def _divided(asset: Asset, name: str, pieces: Sequence[tuple[Surface, ...]]) -> tuple[Asset, list[str]]:
    """Returns the asset with a part in pieces, in its annotation too, and their ids: the part's own comes first."""
    part, annotation = asset.part(name), asset.annotation
    taken = {other.id for other in asset.parts} | {other.id for other in (annotation or asset).parts}
    made = _pieces(part, pieces, taken)
    theirs = next((other for other in annotation.parts if other.id == name), None) if annotation else None
    if annotation is not None and theirs is not None and theirs.mesh == part.mesh:
        annotation = replace(annotation, parts=_put(annotation.parts, name, _pieces(theirs, pieces, taken)))
    found = replace(asset, parts=_put(asset.parts, name, made), annotation=annotation)
    return found, [piece.id for piece in made]


def _pieces(part: Part, pieces: Sequence[tuple[Surface, ...]], taken: Iterable[str]) -> list[Part]:
    """Returns a part for each piece; the first keeps what the part is called."""
    names = _free_names(part.id, len(pieces) - 1, set(taken))
    first = replace(part, surfaces=pieces[0])
    rest = (
        replace(part, id=name, surfaces=surfaces, label=PartLabel.UNKNOWN, labelled_by="none")
        for name, surfaces in zip(names, pieces[1:], strict=True)
    )
    return [first, *rest]


def _free_names(name: str, count: int, taken: set[str]) -> list[str]:
    numbers = (f"{name}_{number}" for number in range(2, 2 + count + len(taken)))
    return [free for free in numbers if free not in taken][:count]


def _put(parts: tuple[Part, ...], name: str, pieces: Sequence[Part]) -> tuple[Part, ...]:
    """Returns parts with some in the place of one."""
    return tuple(each for part in parts for each in (pieces if part.id == name else [part]))
