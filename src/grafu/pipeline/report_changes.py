"""The records of a report that tell what was added to the input, and what was cut into it."""

from grafu.pipeline.report_record import ReportRecord, stated
from grafu.vocabulary import PartLabel


class AddedRecord(ReportRecord):
    """A part that was added."""

    part: str = stated(description="its id")
    category: PartLabel = stated(description="its category")
    why: str = stated(description="what was missing")
    style: str = stated(description="the template of a handle, the outline of a top, or `drawer box`")
    link: str = stated(description="the link of model.urdf that holds it")


class CarvedRecord(ReportRecord):
    """A recessed grip, or a compartment, that was cut into a part of the input."""

    part: str = stated(description="the part that it was cut into")
    category: PartLabel = stated(description="handle for a grip; else the category of the part")
    why: str = stated(description="what was missing")
    style: str = stated(description="the kind of a grip, or `compartment`")
    link: str = stated(description="the link of model.urdf that holds the part")
