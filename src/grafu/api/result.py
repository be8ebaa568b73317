"""`Result`: furniture that works, its joints and its report; what is changed of it gives a new result."""

from collections.abc import Iterable
from dataclasses import replace
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, final

from grafu.additions.handle.config import NO_HANDLE, HandleChoice
from grafu.api.choices import joint_choice, mechanism_class
from grafu.api.request import Request, as_path, as_words, motion_in_words, optional_number, require, require_word
from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.errors import ExportError, OptionError, did_you_mean
from grafu.export.files import write_files
from grafu.export.formats import DEFAULT_FORMATS, exporter_for
from grafu.export.output_names import why_not_apart
from grafu.graph.functional_graph import FunctionalGraph
from grafu.joints.motion_choice import TURNING_SIDES
from grafu.joints.plan import AUTOMATIC
from grafu.pipeline.addition_choice import GRIPS
from grafu.pipeline.functionalize import Functionalized
from grafu.pipeline.settings import Settings
from grafu.pipeline.words import counted
from grafu.templates.gallery import open_handles
from grafu.vocabulary import PartLabel

if TYPE_CHECKING:
    from grafu.pipeline.report_changes import AddedRecord, CarvedRecord
    from grafu.pipeline.report_schema import JointRecord, Report, SkippedRecord


@final
@dataclass(frozen=True, repr=False)
class Result:
    """What `grafu.functionalize` made of one asset.

    `request` is what was asked for, `made` what each stage of the pipeline returned. A result is never changed: each
    `with_...` makes a new one, and makes again only what the change touches.
    """

    request: Request
    made: Functionalized

    @classmethod
    def of(cls, request: Request) -> "Result":
        """Returns the result of a request. Raises FunctionalizationError as `grafu.functionalize` does."""
        return cls(request, request.run())

    def __repr__(self) -> str:
        joints, added, skipped = counted(len(self.joints), "joint"), len(self.added), len(self.skipped)
        return f"<grafu.Result {self.asset.name}: {joints}, {added} added, {skipped} skipped>"

    @property
    def asset(self) -> Asset:
        """The input, as it was read."""
        return self.request.asset

    @property
    def settings(self) -> Settings:
        """What was chosen for it."""
        return self.request.settings

    @property
    def object(self) -> ArticulatedObject:
        """Links, joints and meshes, in metres, Z up, front -Y; every joint is at 0, which is closed."""
        return self.made.object

    @property
    def graph(self) -> FunctionalGraph:
        """The functional graph as it was built, additions included."""
        return self.made.completion.completed

    @cached_property
    def report(self) -> "Report":
        """The values of `report.json`."""
        from grafu.pipeline.report import report_of

        return report_of(self.made, self.asset.name)

    @property
    def joints(self) -> "tuple[JointRecord, ...]":
        """The joints that were built, with limits in radians or metres; the fields are those of `report.json`."""
        return self.report.joints

    @property
    def added(self) -> "tuple[AddedRecord, ...]":
        """The parts that were missing in the input and were added."""
        return self.report.added

    @property
    def carved(self) -> "tuple[CarvedRecord, ...]":
        """The recessed grips and the compartments that were cut into parts."""
        return self.report.carved

    @property
    def skipped(self) -> "tuple[SkippedRecord, ...]":
        """The requests that could not be built, each with its reason."""
        return self.report.skipped

    def joint(self, name: str) -> "JointRecord":
        """Returns the joint of this id, or that of the moving part of this id.

        Raises:
            TypeError: if `name` is no str.
            OptionError: if there is none.
        """
        require_word(name, "name", "the id of a joint or part, as str")
        for joint in self.joints:
            if name in (joint.id, joint.part):
                return joint
        known = ", ".join(joint.part for joint in self.joints) or "none"
        raise OptionError(f"there is no joint `{name}`: parts that move are {known}")

    def save(
        self,
        folder: str | PathLike[str],
        formats: str | Iterable[str] = DEFAULT_FORMATS,
        *,
        page: bool = True,
        overwrite: bool = False,
    ) -> Path:
        """Writes the result into a folder, which appears whole or not at all, and returns its path.

        Args:
            folder: the folder of this one result; missing parents are made.
            formats: names of formats; `grafu.export.formats.FORMATS` holds all.
            page: whether `report.html` is drawn.
            overwrite: whether an earlier result in the folder is replaced.

        Raises:
            TypeError: if an argument has a wrong type.
            ExportError: if a format is unknown, or the folder is there already, holds the input, or cannot be written.
        """
        from grafu.api.saving import files_of

        path, names = as_path(folder, "folder"), as_words(formats, "formats")
        if why := why_not_apart(path, [Path(self.asset.path)] if self.asset.path else []):
            raise ExportError(why)
        for name in names:
            exporter_for(name)
        settings = None if self.request.foreign else self.settings
        saved = files_of(self.made, self.asset.name, names, settings, require(page, bool, "page", "True or False"))
        write_files(saved.files, path, require(overwrite, bool, "overwrite", "True or False"))
        return path

    def with_motion(self, part: str, how: str) -> "Result":
        """Returns the result in which one part has the motion that is given, whatever the motion source states.

        Args:
            part: the id of the part.
            how: `left`, `right`, `top` or `bottom`: the border that it turns about, seen from in front of the object;
                `lift` is `top`, `drop` is `bottom`; `tilt`: about the bottom, with the bin behind it, and not far;
                `lift-parallel`: arms lift it, and it stays upright;
                `slides` or `pull`: it slides out of the front; `slide-left`, `slide-right` or `slide-up`: it slides
                along itself; `fold-left`, `fold-right` or `fold-up`: it is one of two leaves that fold to that side;
                `fixed`: it gets no joint.

        Raises:
            TypeError: if an argument has a wrong type.
            OptionError: if there is no such part, or it cannot have this motion.
        """
        return self._with(self.settings.with_motion(part, motion_in_words(part, how)))

    def with_hinge(
        self,
        part: str,
        *,
        side: str | None = None,
        template: str = "",
        mechanism: str | None = None,
        count: int = 0,
        scale: float = 1.0,
        opening: float | None = None,
        mount: str = "",
    ) -> "Result":
        """Returns the result in which a door or flap has these hinges. What is left out is chosen automatically.

        Args:
            part: the id of the door or flap.
            side: the border that it turns about: `left`, `right`, `top` or `bottom`.
            template: a hinge of `grafu templates`, or `pivot`.
            mechanism: the class: `contact`, `flush`, `perpendicular` (or `C`, `F`, `P`); see docs/templates.md.
            count: how many hinges; 0: by the height of the door.
            scale: a factor on the size of the hinges, 0.25 to 4.
            opening: the widest opening, radians.
            mount: the id of the part that carries it.

        Raises:
            TypeError: if an argument has a wrong type.
            OptionError: if there is no such part, template or class, or a number is out of range.
        """
        require_word(part, "part")
        if side is not None and require_word(side, "side", "a word such as `left`, or None") not in TURNING_SIDES:
            raise OptionError(f"`side` must be one of {', '.join(TURNING_SIDES)}: got {side!r}")
        name = part if side else self.joint(part).part
        settings = self.settings.with_motion(name, motion_in_words(name, side)) if side else self.settings
        chosen = joint_choice(
            template=template,
            mechanism=mechanism_class(mechanism),
            count=count,
            scale=scale,
            opening=optional_number(opening, "opening"),
            mount=mount,
        )
        return self._with(settings.with_joint(name, chosen)) if chosen != AUTOMATIC else self._with(settings)

    def with_rail(
        self,
        part: str,
        *,
        template: str = "",
        mechanism: str | None = None,
        opening: float | None = None,
        mount: str = "",
    ) -> "Result":
        """Returns the result in which a drawer has these rails. What is left out is chosen automatically.

        `opening` is the widest opening in metres; the others are those of `with_hinge`.

        Raises:
            TypeError: if an argument has a wrong type.
            OptionError: if there is no such part, template or class, or a number is out of range.
        """
        require_word(part, "part")
        chosen = joint_choice(
            template=template,
            mechanism=mechanism_class(mechanism),
            opening=optional_number(opening, "opening"),
            mount=mount,
        )
        return self._with(self._sliding(part).with_joint(part, chosen))

    def with_handle(self, part: str, style: str) -> "Result":
        """Returns the result in which a door or drawer has a handle or grip of this style, or `none`.

        Raises:
            TypeError: if an argument has a wrong type.
            OptionError: if there is no such style or no such front.
        """
        known = (*open_handles(self.request.templates), *GRIPS, NO_HANDLE)
        if require_word(style, "style", "a style such as `knob-round`") not in known:
            raise OptionError(f"`style` must be one of {', '.join(known)}: got {style!r}{did_you_mean(style, known)}")
        return self._with(self.settings.with_front(self.joint(part).part, HandleChoice(style=style)))

    def with_label(self, part: str, label: str) -> "Result":
        """Returns the result in which a part has this category.

        Raises:
            TypeError: if an argument has a wrong type.
            OptionError: if there is no such part or category.
        """
        require_word(part, "part")
        if require_word(label, "label", "a category such as `door`") not in {known.value for known in PartLabel}:
            near = did_you_mean(label, PartLabel)
            raise OptionError(f"`label` must be one of {', '.join(PartLabel)}: got {label!r}{near}")
        return self._with(self.settings.with_label(part, PartLabel(label)))

    def without(self, *parts: str) -> "Result":
        """Returns the result without these added parts.

        Raises:
            TypeError: if one is no str.
            OptionError: if one of them was not added. To fix a part of the input: `with_motion(part, "fixed")`.
        """
        settings, known = self.settings, {record.part: record for record in self.added}
        for part in parts:
            if require_word(part, "part") not in known:
                raise OptionError(f"`{part}` was not added: added parts are {', '.join(sorted(known)) or 'none'}")
            settings = _without(settings, known[part])
        return self._with(settings)

    def _sliding(self, part: str) -> Settings:
        """Returns the settings in which a part slides, where it does not already."""
        slides = any(j.part == part and motion_kind(j.type).slides for j in self.joints)
        return self.settings if slides else self.settings.with_motion(part, motion_in_words(part, "slides"))

    def _with(self, settings: Settings) -> "Result":
        return Result.of(replace(self.request, settings=settings))


def _without(settings: Settings, added: "AddedRecord") -> Settings:
    """Returns the settings in which an added part is left out; a handle that was chosen is not chosen any more."""
    if added.link in settings.additions.fronts:
        return settings.with_front(added.link, HandleChoice(style=NO_HANDLE, replaces=False))
    return settings.with_addition(added.part, accepted=False)
