"""A folder of results checked in MuJoCo: each file loaded, each joint pulled, the piece watched as it stands.

It writes nothing: the caller does.
"""

from pathlib import Path
from typing import Final, final

import numpy as np

from grafu.articulation.base import BaseKind
from grafu.articulation.motion_kind import motion_kind
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset
from grafu.geometry.mesh import TriangleMesh
from grafu.pipeline.report_schema import Report
from grafu.pipeline.result_folder import read_report
from grafu.simulation.clip import clip_of
from grafu.simulation.config import DEFAULT_CHECK_CONFIG, CheckConfig
from grafu.simulation.pulls import Recording, check_joint
from grafu.simulation.record import CheckReport, FileCheck, JointCheck
from grafu.simulation.world import Meshes, SimJoint, World, require_mujoco, visual_meshes
from grafu.version import __version__

FILES: Final = ("model.xml", "model.urdf")
NO_SPRINGS: Final = "URDF has no springs, and it opens against its whole weight"


@final
@dataclass(frozen=True)
class Checked:
    """What a check found, and a GIF of the run; the GIF is empty where nothing was loaded."""

    report: CheckReport
    clip: bytes


def check_folder(folder: Path, config: CheckConfig = DEFAULT_CHECK_CONFIG) -> Checked:
    """Returns what the files in a folder of results do in MuJoCo.

    Raises:
        OptionError: if MuJoCo is not installed.
        UnreadableAsset: if it is no folder of results, or holds neither model.xml nor model.urdf.
    """
    mujoco, report = require_mujoco(), read_report(folder)
    there = [name for name in FILES if (folder / name).is_file()]
    if not there:
        raise UnreadableAsset(f"{folder} holds neither {' nor '.join(FILES)}: write one with --formats urdf,mjcf")
    meshes = visual_meshes(folder)
    recording = Recording()
    files = []
    for name in there:
        used = recording if not recording.poses else Recording()
        files.append(_check_file(folder / name, report, meshes, config, used))
    made = CheckReport(version=__version__, mujoco=mujoco.__version__, files=tuple(files))
    return Checked(made, clip_of(recording.poses, meshes, config.frames))


def _check_file(path: Path, report: Report, meshes: Meshes, config: CheckConfig, recording: Recording) -> FileCheck:
    kind = report.base.kind if report.base else BaseKind.FIXED
    try:
        world = World(path, kind is BaseKind.FREE, config)
        tried = [joint for joint in world.joints if not _is_driven(report, joint)]
        found = (
            check_joint(world, joint, _before(world, report, joint), _of(world, joint, meshes), config, recording)
            for joint in tried
        )
        joints = tuple(_explained(joint, path, report, config) for joint in found)
        on_feet = None if kind is BaseKind.WALL else World(path, True, config)
    except UnreadableAsset as error:
        return FileCheck(file=path.name, error=str(error), joints=(), stands=None, stands_open=None)
    stands = on_feet and _stands(on_feet, (), config)
    stands_open = on_feet and _stands(on_feet, on_feet.joints, config)
    why = "" if world.is_stable else "the simulation became unstable"
    return FileCheck(file=path.name, error=why, joints=joints, stands=stands, stands_open=stands_open)


def _explained(found: JointCheck, file: Path, report: Report, config: CheckConfig) -> JointCheck:
    """Returns a joint with what explains that it does not open: in URDF nothing carries the weight of a lid."""
    level = {joint.id for joint in report.joints if motion_kind(joint.type).turns and abs(joint.axis[2]) < config.level}
    heavy = file.suffix == ".urdf" and found.joint in level and found.opened < config.opened
    return found.with_changes(hint=NO_SPRINGS) if heavy else found


def _is_driven(report: Report, joint: SimJoint) -> bool:
    """Whether no hand moves a joint."""
    return any(record.id == joint.name and record.grasp == "driven" for record in report.joints)


def _of(world: World, joint: SimJoint, meshes: Meshes) -> dict[str, TriangleMesh]:
    return dict(meshes.get(world.model.body(joint.body).name, {}))


def _before(world: World, report: Report, joint: SimJoint) -> tuple[SimJoint, ...]:
    """Returns the joints that must be open before one can move, and those before them."""
    waits = {record.id: record.after for record in report.joints}
    named, queue = set[str](), list(waits.get(joint.name, ()))
    while queue:
        other = queue.pop()
        if other not in named:
            named.add(other)
            queue += waits.get(other, ())
    return tuple(other for other in world.joints if other.name in named and other is not joint)


def _stands(world: World, opened: tuple[SimJoint, ...], config: CheckConfig) -> bool:
    """Whether a free piece stays where it is on the floor, with these joints open."""
    world.reset()
    for joint in opened:
        world.set_open(joint)
    world.step(config.settling / 4)  # feet come to rest on the floor
    start = world.pose(world.root)
    world.step(config.settling)
    end = world.pose(world.root)
    moved = float(np.linalg.norm(end[:3, 3] - start[:3, 3]))
    tilt = float(np.arccos(np.clip(end[2, 2], -1.0, 1.0)))
    return moved <= config.still and tilt <= config.tilt and world.is_stable
