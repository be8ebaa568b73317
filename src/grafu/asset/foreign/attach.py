"""`attach_motions`: an asset with the joints that another system predicted, as if the input stated them.

What the input itself states about its motions is not read. Realization cannot tell who stated them.
"""

from dataclasses import replace

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.foreign.matching import Match, covered_parts, match_parts
from grafu.asset.foreign.motions import ForeignJoint, ForeignMotions
from grafu.asset.part import AnnotatedJoint, Asset, Part
from grafu.asset.pieces import with_attached
from grafu.vocabulary import PartLabel


def attach_motions(asset: Asset, foreign: ForeignMotions) -> Asset:
    """Returns the asset with predicted joints on its own parts, ranges signed as predicted.

    Of several parts that a prediction moves as one, the largest, or the largest door or drawer, gets the joint, and the
    others ride on it; handles that no prediction moves ride on what they touch. Parts without a label take the
    predicted one. The notes say in which frame the prediction was found, and which joints fit no part.

    Raises:
        AssetError: if the prediction is of another object.
    """
    bare = asset.without_annotation()
    match = match_parts(bare, foreign)
    mains = {joint.part: _main(bare, foreign, match, joint.part) for joint in foreign.joints}
    attached = _attached(bare, foreign, match, mains)
    joints = {
        main.id: _annotated(match.placed(joint, main.box), main, foreign.source)
        for joint in foreign.joints
        if (main := mains[joint.part]) is not None
    }
    parts = [replace(part, carried_by=attached.get(part.id)) for part in _labelled(bare, foreign, match, joints)]
    notes = (*asset.notes, *foreign.notes, *_notes(foreign, match, mains))
    return replace(bare, parts=with_attached(tuple(parts)), joints=tuple(joints.values()), notes=notes)


def _main(asset: Asset, foreign: ForeignMotions, match: Match, body: str) -> Part | None:
    """Returns of the parts that move with a joint the one that carries the others."""
    covered = covered_parts(asset, foreign, match, body)
    own = tuple(p for p, name in zip(asset.parts, match.part_of, strict=True) if name == body)
    spoken = [part for part in covered if part.label.is_movable]
    unnamed = [part for part in own or covered if part.label is not PartLabel.HANDLE]
    pool = spoken or unnamed or list(covered)
    return max(pool, key=lambda part: part.mesh.area, default=None)


def _attached(asset: Asset, foreign: ForeignMotions, match: Match, mains: dict[str, Part | None]) -> dict[str, str]:
    """Returns what rides on what: the rest of each body on its main part, and that on the body that carries it."""
    found: dict[str, str] = {}
    for body, main in mains.items():
        if main is None:
            continue
        found |= {part.id: main.id for part in covered_parts(asset, foreign, match, body) if part.id != main.id}
        carrier = foreign.carrier_of(body)
        above = mains[carrier] if carrier is not None else None
        if above is not None:
            found[main.id] = above.id
    return found


def _labelled(asset: Asset, foreign: ForeignMotions, match: Match, joints: dict[str, AnnotatedJoint]) -> list[Part]:
    """Returns the parts, those without a label with the predicted one, or with what their joint makes them."""
    found = []
    for part, name in zip(asset.parts, match.part_of, strict=True):
        spoken = foreign.labels[name] if name is not None else PartLabel.UNKNOWN
        joint = joints.get(part.id)
        if part.label is not PartLabel.UNKNOWN:
            found.append(part)
        elif spoken is not PartLabel.UNKNOWN and (joint is not None) >= spoken.is_movable:
            found.append(replace(part, label=spoken, labelled_by="prediction"))
        elif joint is not None:
            found.append(replace(part, label=motion_kind(joint.type).label, labelled_by="joint"))
        else:
            found.append(part)
    return found


def _annotated(joint: ForeignJoint, part: Part, source: str) -> AnnotatedJoint:
    low, high = sorted((joint.lower, joint.upper))
    return AnnotatedJoint(part.id, joint.type, joint.axis, low, high, joint.limited, source)


def _notes(foreign: ForeignMotions, match: Match, mains: dict[str, Part | None]) -> list[str]:
    where = match.frame.name + (
        f", joints in its normalised frame of {match.joint_frame.name}" if match.joint_frame.name else ""
    )
    kept = sum(main is not None for main in mains.values())
    said = [
        f"motions from {foreign.source}: {kept} joints; frame: {where}; box faces lie {match.residual:.2g} of the size "
        f"apart, overlap {match.overlap:.2f}"
    ]
    return said + [
        f"the joint of {name} in {foreign.source}'s file fits no part" for name, m in mains.items() if m is None
    ]
