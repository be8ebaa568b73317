"""The records of a report that tell what was added to the input, and what was cut into it."""

from pydantic import Field

from grafu.pipeline.report_record import ReportRecord
from grafu.vocabulary import PartLabel


class AddedRecord(ReportRecord):
    """A part that was added."""

    part: str = Field(description="its id")
    category: PartLabel = Field(description="its category")
    why: str = Field(description="what was missing")
    style: str = Field(description="the template of a handle, the outline of a top, or `drawer box`")
    link: str = Field(description="the link of model.urdf that holds it")


class CarvedRecord(ReportRecord):
    """A recessed grip, or a compartment, that was cut into a part of the input."""

    part: str = Field(description="the part that it was cut into")
    category: PartLabel = Field(description="handle for a grip; else the category of the part")
    why: str = Field(description="what was missing")
    style: str = Field(description="the kind of a grip, or `compartment`")
    link: str = Field(description="the link of model.urdf that holds the part")
