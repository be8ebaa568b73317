"""The form of `check.json`, version `grafu.check/1`: what a simulator made of a result."""

from typing import Literal

from grafu.pipeline.report_record import ReportRecord, stated


class JointCheck(ReportRecord):
    """One joint, pulled and pushed shut in one file."""

    joint: str = stated(description="the joint's name")
    force: float = stated(description="the greatest pull that was allowed, newtons")
    opened: float = stated(description="how far it opened, fraction of its range")
    closed: float = stated(description="where it was in the end, fraction of its range; 0 is closed")
    moved: tuple[str, ...] = stated(description="other joints that moved with it, though nothing couples them")
    carries: bool | None = stated(
        default=None, description="whether a cube dropped into it rests there and is carried; null: it is not hollow"
    )
    works: bool = stated(description="whether it opened, closed, moved alone, and carried the cube")
    hint: str = stated(default="", description="what explains that it does not open; empty: nothing known does")


class FileCheck(ReportRecord):
    """One file, loaded into MuJoCo."""

    file: str = stated(description="model.xml or model.urdf")
    error: str = stated(default="", description="why it could not be loaded or was unstable; empty: it was loaded")
    joints: tuple[JointCheck, ...] = stated(description="every joint that moves by itself within limits")
    stands: bool | None = stated(description="whether it stays at rest on a floor, closed; null: a wall holds it")
    stands_open: bool | None = stated(description="the same with everything open at once")

    @property
    def works(self) -> bool:
        """Whether all that was tried worked."""
        stands = self.stands is not False and self.stands_open is not False
        return not self.error and stands and all(joint.works for joint in self.joints)


class CheckReport(ReportRecord):
    """The whole check."""

    schema: Literal["grafu.check/1"] = stated(default="grafu.check/1", description="the form's name")
    version: str = stated(description="the version of grafu")
    mujoco: str = stated(description="the version of MuJoCo")
    files: tuple[FileCheck, ...] = stated(description="the files that were there")

    @property
    def works(self) -> bool:
        """Whether everything worked in all files."""
        return all(file.works for file in self.files)
