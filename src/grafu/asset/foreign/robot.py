"""URDF files and PartNet-Mobility folders as predictions: the joints of any robot description. It matches nothing."""

import re
from pathlib import Path

from grafu.asset.foreign.motions import ForeignJoint, ForeignMotions, ForeignPart
from grafu.asset.options import LoadOptions, check_parts
from grafu.asset.part import AnnotatedJoint, Annotation
from grafu.asset.partnet_mobility import read_partnet_mobility
from grafu.asset.resources import ModelFiles, read_bytes
from grafu.asset.urdf import read_urdf
from grafu.errors import AssetError, UnreadableAsset

_JOINT_NAMES = re.compile(rb"<joint\b[^>]*\bname=[\"']([^\"']*)")
_PARTICULATE = re.compile(rb"joint_\d+_\d+")  # joint_<parent>_<child>


def read_robot(path: Path, options: LoadOptions = LoadOptions()) -> ForeignMotions:
    """Returns the joints of a URDF file (or of a folder that is a PartNet-Mobility model) as a prediction.

    A URDF whose joints are all named in Particulate's way comes out as Particulate's.

    Raises:
        UnreadableAsset: if the file is missing or damaged.
        AssetTooLarge: if it exceeds the limits.
    """
    files = ModelFiles(path, options.limits)
    reading = read_partnet_mobility(path, options, files) if path.is_dir() else read_urdf(path, options, files)
    stated = reading.annotation or Annotation(reading.parts)
    check_parts(len(stated.parts), path, options.limits)
    parts = tuple(ForeignPart(p.id, p.mesh, label=p.label, parent=p.rides_on) for p in stated.parts)
    joints = tuple(_joint(joint) for joint in stated.joints)
    named = [] if path.is_dir() else _JOINT_NAMES.findall(read_bytes(path, options.limits))
    is_particulate = bool(named) and all(_PARTICULATE.fullmatch(name) for name in named)
    try:
        return ForeignMotions(
            "particulate" if is_particulate else "urdf", str(path), parts, joints, notes=(*reading.notes, *stated.notes)
        )
    except AssetError as error:
        raise UnreadableAsset(str(error)) from None


def _joint(joint: AnnotatedJoint) -> ForeignJoint:
    return ForeignJoint(joint.part, joint.type, joint.axis, joint.lower, joint.upper, joint.limited)
