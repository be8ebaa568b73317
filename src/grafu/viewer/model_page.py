"""The page of one model: a single file that opens from a disk, without a network. It writes no files.

A header with the verdict (its colour, its sentence, a line for each fault), a 3D view with a slider per joint that
moves by itself, pictures, the functional graph, and the report as tables. The view is WebGL of our own: `model-viewer`
plays the animation of a GLB but has no slider per joint and adds 1 MB to each page; viser needs a server that runs.
"""

from collections.abc import Sequence

from grafu.articulation.articulated_object import ArticulatedObject, Joint, VisualRole
from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import Asset
from grafu.graph.completion import GraphCompletion
from grafu.pipeline.report_schema import FaultRecord, Report, VerdictRecord
from grafu.pipeline.settings import Settings
from grafu.pipeline.verdict import verdict_of
from grafu.pipeline.words import piece_words
from grafu.render.graph_picture import draw_graph, drawing_svg
from grafu.viewer import collecting
from grafu.viewer.pictures import Stills, stills_row
from grafu.viewer.report_tables import (
    LEAD,
    added_table,
    correction_buttons,
    deficiencies_table,
    joints_table,
    lines,
    not_built_table,
    part_button,
    timing_words,
)
from grafu.viewer.scene_data import scene_data
from grafu.viewer.shell import Html, joined, json_block, light_of, section, tag, whole_page
from grafu.viewer.wording import catch_words, facts, size_words, standing_words, unused_joints

_LEAD = "A click copies an option: give it to the same command, with --overwrite."


def verdict_view(report: Report, verdict: VerdictRecord, lead: str = _LEAD) -> Html:
    """Returns the traffic light, the faults with the option that may correct each, and the facts below it.

    `lead` states what a click on an option does.
    """
    light = tag("p", light_of(verdict.colour), " ", verdict.sentence, class_="verdict")
    rows = [_line(fault, {part.id for part in report.parts}) for fault in verdict.lines]
    said = [tag("p", lead, class_="lead")] if any(fault.option for fault in verdict.lines) else []
    faults = [tag("ul", joined(rows), class_="faults"), *said] if rows else []
    return joined([light, *faults, tag("p", facts(report))])


def _line(fault: FaultRecord, known: set[str]) -> Html:
    """Returns one fault: the part, its kind, why, and the option to copy."""
    part = part_button(fault.part) if fault.part in known else tag("span", fault.part)
    copy = correction_buttons((fault.option,) if fault.option else ())
    phrases = [part, " "] if fault.part else []
    kind = tag("span", fault.kind, class_=f"fault {fault.colour}")
    return tag("li", joined([tag("span", joined([*phrases, kind, ": ", fault.why]), class_="said"), copy]))


STYLES = ("page.css", "model.css")
VIEW_SCRIPTS = (
    "dom.js", "matrices.js", "scene.js", "joints.js", "camera.js", "shaders.js", "renderer.js", "view.js",
    "gestures.js", "overlay.js", "controls.js", "model.js",
)  # fmt: skip
PAGE_SCRIPTS = (*VIEW_SCRIPTS, "copy.js", "start.js")
COLLECTING_SCRIPT = "collect.js"
_SCRIPTS_OF_WORDS = ("dom.js", "scene.js", "copy.js")
_NAMED = 28  # nodes whose names have room below them; of more the name shows under the pointer
_HINT = (
    "Select a part to see its name and its axis. Drag to turn; two fingers or Shift to move; click, then wheel to zoom."
)
_ROLES = ((VisualRole.HARDWARE, "hardware", "Hardware"), (VisualRole.ADDED, "added", "Added parts"))


def model_page(
    asset: Asset,
    articulated: ArticulatedObject,
    completion: GraphCompletion,
    report: Report,
    stills: Stills | None,
    settings: Settings | None = None,
    formats: Sequence[str] = (),
) -> str:
    """Returns the page of a model: the input, the result, and its report as text, tables and pictures.

    Without stills it is text and tables, and the graph: no 3D view, no pictures. With the settings that the result was
    made with, options that are chosen on it are collected as new settings, and a command that writes the same
    `formats`; without, an option can be copied.
    """
    collects = settings is not None and bool(report.moves)
    shown: list[Html] = []
    data: list[Html] = []
    if stills is not None:
        scene = scene_data(articulated, report)
        shown = [_stage(articulated), section("Before and after", stills_row(stills, report.input.name))]
        data = [json_block("scene", scene.tables), tag("script", Html(scene.packed), type="text/plain", id="geometry")]
    verdict = verdict_view(report, verdict_of(report), collecting.LINES if collects else _LEAD)
    body = joined([
        tag("header", tag("h1", report.input.name), verdict, header_facts(asset, report)),
        tag("main", *shown, *report_sections(report, completion, collecting.LEAD if collects else LEAD)),
        *([collecting.collected(report, settings, formats)] if settings is not None and collects else []),
        tag("footer", f"grafu {report.version}"),
        *data,
    ])  # fmt: skip
    scripts = (*(PAGE_SCRIPTS if shown else _SCRIPTS_OF_WORDS), *((COLLECTING_SCRIPT,) if collects else ()))
    return whole_page(report.input.name, body, STYLES, scripts)


def header_facts(asset: Asset, report: Report) -> Html:
    """Returns what was read, in a line."""
    phrases = (
        "" if report.piece is None else piece_words(report.piece.kind, report.piece.score),
        f"{report.input.parts} parts",
        size_words(asset.box.size.tolist()),
        f"read as {report.input.kind}",
        f"motions by {report.motion.source}",
        unused_joints(report),
    )
    return tag("p", joined(tag("span", fact) for fact in phrases if fact), class_="facts")


def _stage(articulated: ArticulatedObject) -> Html:
    """Returns the 3D view and what stands beside it; everything is disabled until the script has it."""
    return tag("section", tag("div", *view_box()), joint_panel(articulated), id="stage", aria_label="3D view")


def view_box() -> tuple[Html, ...]:
    """Returns the 3D view, and the lines below it that state what is chosen or why nothing is shown."""
    canvas = tag("canvas", tabindex=0, role="img", aria_label="3D view: arrow keys turn, + and − zoom, Home resets")
    lines_over = tag("svg", class_="overlay", aria_hidden="true", hidden=True)
    label = tag("div", class_="label", hidden=True)
    view = tag("div", canvas, lines_over, label, class_="view")
    noscript = tag("noscript", tag("p", "The 3D view needs JavaScript; the pictures below do not.", class_="note"))
    note = tag("p", id="view-note", class_="note", role="status")
    hint = tag("p", _HINT, id="chosen", data_empty=_HINT, aria_live="polite")
    return view, hint, note, noscript


def joint_panel(articulated: ArticulatedObject) -> Html:
    """Returns the buttons, the sliders and the switches beside the 3D view."""
    joints = articulated.moving_joints
    actions = (("open", "Open all"), ("close", "Close all"), ("play", "Play"))
    buttons = [tag("button", word, type="button", data_action=action, disabled=True) for action, word in actions]
    rows = [_slider(index, joint) for index, joint in enumerate(joints) if joint.coupling is None]
    moving = [tag("div", *buttons, class_="actions"), tag("div", *rows, class_="joints")] if joints else []
    roles = {visual.role for link in articulated.links for visual in link.visuals}
    switches = [_switch(key, word, on=True) for role, key, word in _ROLES if role in roles]
    switches.append(_switch("categories", "Category colours", on=False))
    return tag("div", *moving, tag("div", *switches, class_="switches"), class_="panel")


def _slider(index: int, joint: Joint) -> Html:
    low, high = (motion_kind(joint.type).worded(value) for value in (joint.limits.lower, joint.limits.upper))
    name = f"joint-{index}"
    slider = tag(
        "input", type="range", id=name, min=0, max=1000, value=0, data_joint=index, disabled=True, autocomplete="off"
    )
    limits = tag("span", f"of {high}", class_="limit", title=f"from {low} to {high}")
    words = tag("div", tag("label", joint.child, for_=name), tag("span", tag("output", low, for_=name), " ", limits))
    return tag("div", words, slider, class_=f"joint {joint.kind.hardware}")


def _switch(key: str, word: str, on: bool) -> Html:
    box = tag("input", type="checkbox", data_switch=key, checked=on, disabled=True, autocomplete="off")
    return tag("label", box, " ", word)


def report_sections(report: Report, completion: GraphCompletion, lead: str) -> list[Html]:
    """Returns the report as sections.

    Each joint has the options that set it right beside it, and `lead` states above them what a click does; without
    one there are no options.
    """
    moves = report.moves if lead else {}
    options = {joint.part: moves[joint.part] for joint in report.joints if joint.part in moves}
    return [
        section("Joints", joints_table(report, completion, options), lead=lead if options else "", name="joints"),
        section("What was missing", deficiencies_table(report)),
        section("What was added", added_table(report)),
        section("What was not built", not_built_table(report)),
        section("How it stands", lines([*standing_words(report), *catch_words(report)])),
        section("Functional graph", _graph(completion), _legend(), name="graph"),
        section("How it was read", lines([*report.frame.assumed, *report.input.notes])),
        section("Time", tag("p", timing_words(report))),
    ]


def _graph(completion: GraphCompletion) -> Html:
    count = len(completion.completed.nodes)
    size = (880, 420 if count < 24 else 560)
    drawing = drawing_svg(draw_graph(completion.completed, size, names=count < _NAMED))
    return tag("div", Html(drawing), class_="scroll graph", tabindex=0, role="region", aria_label="Functional graph")


def _legend() -> Html:
    words = ("contact", "hinge", "rail", "attached")
    return tag("p", joined(tag("span", word, class_=f"edge {word}") for word in words), class_="legend")
