"""Parts that the user joins, or splits into their shells: the same surfaces, divided otherwise. It decides nothing.

What the input states about motions stays where its part does: a joint of a part that was joined to another is gone.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import final

from grafu.asset.loose import shells_of
from grafu.asset.part import Annotation, Asset, Part
from grafu.asset.pieces import with_pieces
from grafu.errors import OptionError, did_you_mean
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.vocabulary import PartLabel


class Regroup(StrEnum):
    """What is done to parts."""

    JOIN = "join"  # the others become pieces of the first
    SPLIT = "split"  # each connected shell becomes a part


@final
@dataclass(frozen=True, slots=True)
class Regrouping:
    """One change of how a model is divided into parts, by their ids; see `regrouped`.

    Raises:
        ValueError: if it joins less than two parts or one twice, or splits more than one.
    """

    do: Regroup
    parts: tuple[str, ...]

    def __post_init__(self) -> None:
        if self.do is Regroup.JOIN and (len(self.parts) < 2 or len(set(self.parts)) < len(self.parts)):
            raise ValueError(f"two parts or more are joined, each once: got {', '.join(self.parts) or 'none'}")
        if self.do is Regroup.SPLIT and len(self.parts) != 1:
            raise ValueError(f"one part is split at a time: got {', '.join(self.parts) or 'none'}")


def regrouped(asset: Asset, changes: Sequence[Regrouping]) -> Asset:
    """Returns the asset with its parts joined and split, one change after the other; its notes state each.

    Parts that are joined have the id, the name and the category of the first. Of the shells of a part the largest
    keeps these; the others get ids of their own, and no category. Screws stay with the shell that they lie on.

    Raises:
        OptionError: if a part does not exist, or one that is to be split is a single shell.
    """
    for change in changes:
        _require_parts(asset, change)
        asset = _joined(asset, change.parts) if change.do is Regroup.JOIN else _split(asset, change.parts[0])
    return asset


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
    taken = {part.id for part in asset.parts} | {part.id for part in (asset.annotation or asset).parts}
    pieces = _pieces(asset.part(name), shells, taken)
    annotation = asset.annotation
    if annotation is not None and any(part.id == name for part in annotation.parts):
        theirs = next(part for part in annotation.parts if part.id == name)
        alike = theirs.mesh == asset.part(name).mesh
        if alike:
            annotation = replace(annotation, parts=_put(annotation.parts, name, _pieces(theirs, shells, taken)))
    note = f"{name} split by hand into {', '.join(piece.id for piece in pieces)}"
    return replace(asset, parts=_put(asset.parts, name, pieces), annotation=annotation, notes=(*asset.notes, note))


def _pieces(part: Part, shells: Sequence[tuple[Surface, ...]], taken: Iterable[str]) -> list[Part]:
    """Returns a part for each shell, the largest first, which keeps what the part is called."""
    largest = sorted(shells, key=lambda surfaces: -Box.enclosing(s.mesh.box for s in surfaces).diagonal)
    names = _free_names(part.id, len(shells) - 1, set(taken))
    first = replace(part, surfaces=largest[0])
    rest = (
        replace(part, id=name, surfaces=surfaces, label=PartLabel.UNKNOWN, labelled_by="none")
        for name, surfaces in zip(names, largest[1:], strict=True)
    )
    return [first, *rest]


def _free_names(name: str, count: int, taken: set[str]) -> list[str]:
    numbers = (f"{name}_{number}" for number in range(2, 2 + count + len(taken)))
    return [free for free in numbers if free not in taken][:count]


def _put(parts: tuple[Part, ...], name: str, pieces: Sequence[Part]) -> tuple[Part, ...]:
    """Returns parts with some in the place of one."""
    return tuple(each for part in parts for each in (pieces if part.id == name else [part]))
