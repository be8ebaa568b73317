"""The verdict at the top of a model's page: its colour, its sentence, and a line for each fault. It judges nothing."""

from grafu.pipeline.report_schema import FaultRecord, Report, VerdictRecord
from grafu.viewer.corrections import correction_buttons
from grafu.viewer.lights import light_of
from grafu.viewer.markup import Html, joined, tag
from grafu.viewer.report_tables import part_button
from grafu.viewer.wording import facts

_LEAD = "A click copies an option: give it to the same command, with --overwrite."


def verdict_view(report: Report, verdict: VerdictRecord) -> Html:
    """Returns the traffic light, what is amiss with the option that may set it right, and the facts below it."""
    light = tag("p", light_of(verdict.colour), " ", verdict.sentence, class_="verdict")
    rows = [_line(fault, {part.id for part in report.parts}) for fault in verdict.lines]
    lead = [tag("p", _LEAD, class_="lead")] if any(fault.option for fault in verdict.lines) else []
    amiss = [tag("ul", joined(rows), class_="faults"), *lead] if rows else []
    return joined([light, *amiss, tag("p", facts(report))])


def _line(fault: FaultRecord, known: set[str]) -> Html:
    """Returns one fault: the part, what is amiss, why, and the option to copy."""
    part = part_button(fault.part) if fault.part in known else tag("span", fault.part)
    copy = correction_buttons((fault.option,) if fault.option else ())
    said = [part, " "] if fault.part else []
    kind = tag("span", fault.kind, class_=f"fault {fault.colour}")
    return tag("li", joined([tag("span", joined([*said, kind, ": ", fault.why]), class_="said"), copy]))
