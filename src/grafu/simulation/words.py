"""A check in words: rows of a table, sentences, and a line for the terminal."""

from grafu.pipeline.words import counted, listed, percent
from grafu.simulation.record import CheckReport, FileCheck, JointCheck

COLUMNS = ("file", "joint", "pull", "opened", "closed to", "moved with it", "carries a cube", "works")


def table_rows(report: CheckReport) -> list[tuple[str, ...]]:
    """Returns one row for each joint of each file."""
    return [_row(file, joint) for file in report.files for joint in file.joints]


def _row(file: FileCheck, joint: JointCheck) -> tuple[str, ...]:
    carries = {None: "–", True: "yes", False: "no"}[joint.carries]
    opened, closed = f"{100 * joint.opened:.0f} %", f"{100 * max(joint.closed, 0.0):.1f} %"
    pull, works = f"{joint.force:.0f} N", "yes" if joint.works else "no"
    return (file.file, joint.joint, pull, opened, closed, listed(joint.moved) or "–", carries, works)


def sentences(report: CheckReport) -> list[str]:
    """Returns a sentence on each file: how many joints work, and whether it stands."""
    return [f"{file.file} in MuJoCo {report.mujoco}: {_sentence(file)}." for file in report.files]


def _sentence(file: FileCheck) -> str:
    if file.error:
        return file.error
    good = sum(joint.works for joint in file.joints)
    failed = "; ".join(_failure(joint) for joint in file.joints if not joint.works)
    said = [f"{good} of {counted(len(file.joints), 'joint')} open and close when they are pulled"]
    said[0] += f" ({failed})" if failed else ""
    states = {True: "stays at rest", False: "does not stay at rest"}
    if file.stands is not None:
        said.append(f"it {states[file.stands]} on a floor")
    if file.stands_open is not None:
        said.append(f"with everything open it {states[file.stands_open]}")
    return "; ".join(said)


def _failure(joint: JointCheck) -> str:
    """Returns what a joint that does not work did."""
    said = [f"opens by {percent(max(joint.opened, 0.0))} under {joint.force:.0f} N"]
    if joint.closed > 0:
        said.append(f"stays open by {percent(joint.closed)}")
    if joint.moved:
        said.append(f"moves {listed(joint.moved)}")
    if joint.carries is False:
        said.append("carries no cube")
    return f"{joint.joint} {listed(said)}{f', for {joint.hint}' if joint.hint else ''}"
