"""The pages of the editor: one model, and the wall of several. What is built comes later, by the scripts."""

from collections.abc import Sequence
from typing import Any, Final

from grafu.editor.choices import LIMITS, handle_styles, hinge_templates, rail_templates
from grafu.pipeline.addition_choice import TOP_SHAPES
from grafu.pipeline.report_schema import Report
from grafu.pipeline.verdict import verdict_of
from grafu.templates.gallery import open_handles
from grafu.version import __version__
from grafu.viewer.model_page import view_box
from grafu.viewer.pictures import CARD
from grafu.viewer.shell import Html, joined, json_block, light_of, tag
from grafu.vocabulary import PartLabel

_EDGES: Final = (("top", "Top"), ("left", "Left"), ("right", "Right"), ("bottom", "Bottom"))
_OTHERS: Final = (
    ("pull", "Slides out"),
    ("slide-left", "Slides left"),
    ("slide-right", "Slides right"),
    ("slide-up", "Slides up"),
    ("lift-parallel", "Lifts"),
    ("tilt", "Tilts"),
    ("fold-left", "Folds left"),
    ("fold-right", "Folds right"),
    ("fold-up", "Folds up"),
    ("front", "Front edge"),
    ("back", "Back edge"),
    ("fixed", "Fixed"),
)
_OFFSETS: Final = ("Handle right by", "Handle up by")
_KEYS: Final = (
    ("n", "next doubtful joint"),
    ("a", "accept"),
    ("r", "reject: no joint"),
    ("o", "open or close the part"),
    ("1 to 4", "hinge side: left, right, top, bottom"),
    ("5 / 6", "slides out / fixed"),
    ("g", "join with the part that was chosen before"),
    ("s", "split the part into its shells"),
    ("c", "cut out of the part what the next lasso encloses"),
    ("arrows", "of a lasso: move the cursor; with Shift by little"),
    ("Enter", "of a lasso: set a corner; again at the same place: close it"),
    ("Backspace", "of a lasso: take the last corner back"),
    ("Ctrl Z / Ctrl Y", "undo / redo"),
    ("j / k", "next / previous model"),
    ("Esc", "choose no part; leave a lasso"),
)


def model_page_of(name: str, number: int, count: int) -> str:
    """Returns the page of one model, the `number`th of `count`, before anything of it is built."""
    lists = {"rails": list(rail_templates()), "hinges": list(hinge_templates())}
    at = {"number": number, "count": count, "limits": dict(LIMITS), **lists}
    body = joined([
        tag("header", tag("h1", name), id="model-header"),
        _toolbar(name, count),
        tag("main", _stage(), tag("div", id="sections")),
        tag("footer", f"grafu {__version__}"),
        json_block("editor", at),
    ])  # fmt: skip
    return _page(name, body, "edit.js")


def wall_page(rows: Sequence[dict[str, Any]]) -> str:
    """Returns the page of several models, each a thumbnail with its traffic light."""
    search = tag("label", "Filter ", tag("input", type="search", id="filter", autocomplete="off"))
    lights = [
        tag("button", colour, type="button", data_colour=colour, aria_pressed="false")
        for colour in ("red", "yellow", "green", "new")
    ]
    keys = tag("p", "Keys: j and k go through the models, Enter opens one.", class_="lead")
    cards = tag("ul", *(_card(row) for row in rows), id="wall", class_="wall")
    head = tag("header", tag("h1", f"{len(rows)} models"), keys)
    found = tag("p", id="found", class_="note", role="status")
    tools = tag("section", search, *lights, found, class_="toolbar", aria_label="Which models are shown")
    return _page(f"{len(rows)} models", joined([head, tools, tag("main", cards)]), "wall.js")


def wall_row(number: int, name: str, report: Report | None, has_picture: bool) -> dict[str, Any]:
    """Returns what the wall shows of one model."""
    colour = str(verdict_of(report).colour) if report else "new"
    sentence = verdict_of(report).sentence if report else "not built yet"
    return {"number": number, "name": name, "colour": colour, "sentence": sentence, "picture": has_picture}


def _card(row: dict[str, Any]) -> Html:
    source = f"thumbnail/{row['number']}" if row["picture"] else ""
    width, height = CARD
    shown = tag("img", src=source, width=width, height=height, alt="", loading="lazy")
    image = shown if source else tag("span", class_="no")
    light = light_of(row["colour"])
    link = tag("a", image, tag("strong", row["name"]), light, tag("span", row["sentence"]), href=f"m/{row['number']}/")
    return tag("li", link, data_colour=row["colour"], data_words=f"{row['name']} {row['sentence']}".lower())


def _page(title: str, body: Html, script: str) -> str:
    up = "../../" if script == "edit.js" else ""
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("meta", name="color-scheme", content="light dark"),
        tag("link", rel="icon", href="data:,"),
        tag("title", f"{title} - grafu edit"),
        tag("link", rel="stylesheet", href=f"{up}style.css"),
    )
    main = tag("body", body, tag("script", Html(""), src=f"{up}{script}"))
    return f"<!DOCTYPE html>\n{tag('html', head, main, lang='en')}\n"


def _toolbar(name: str, count: int) -> Html:
    actions = (
        ("undo", "Undo"),
        ("redo", "Redo"),
        ("next", "Next doubtful joint"),
        ("anew", "Start anew"),
        ("export", "Export"),
    )
    buttons = [tag("button", word, type="button", data_do=do, disabled=True) for do, word in actions]
    wall = [tag("a", "All models", href="../../")] if count > 1 else []
    stop = tag("button", "Stop", type="button", data_do="stop", hidden=True)
    bar = tag("progress", id="bar", aria_label="Building")
    said = tag("p", f"Reading {name} ...", id="progress", role="status", class_="note")
    fault = tag("p", id="fault", role="alert", class_="flag", hidden=True)
    tools = tag("div", *wall, *buttons, bar, stop, class_="toolbar", role="toolbar", aria_label="Actions")
    return tag("section", tools, said, fault, id="editing", aria_label="Editing")


def _stage() -> Html:
    column = tag("div", _inspector(), tag("div", id="joint-panel"), _whole(), _keys(), class_="column")
    return tag("section", tag("div", *view_box()), column, id="stage", aria_label="3D view")


def _inspector() -> Html:
    pick = tag("label", "Part ", tag("select", id="pick", autocomplete="off"))
    verdict = tag("p", id="certainty", class_="lead")
    edges = [_motion(word, name, "side") for word, name in _EDGES]
    square = tag("div", *edges, tag("span", "hinge side", class_="inside"), class_="edges", role="group")
    others = tag("div", *(_motion(word, name, "other") for word, name in _OTHERS), class_="others")
    group = tag("div", square, others, role="group", aria_label="How it moves")
    actions = (("accept", "Accept"), ("reject", "Reject"), ("automatic", "Automatic"), ("open", "Open or close"))
    buttons = tag("div", *(tag("button", w, type="button", data_do=k) for k, w in actions), class_="actions")
    divisions = (("join", "Join with the part before"), ("split", "Split into shells"), ("cut", "Cut out with a lasso"))
    through = tag("label", tag("input", type="checkbox", id="through"), " with all that lies behind", class_="through")
    divide = tag("div", *(tag("button", w, type="button", data_do=k) for k, w in divisions), through, class_="actions")
    clash = tag("button", "Show the collision", type="button", data_do="collision", hidden=True)
    fields = [
        tag("label", "Opens at most ", _number("opening"), tag("span", id="unit")),
        _select("template", "Hinge or rail", ()),
        _select("handle", "Handle", handle_styles()),
        tag("div", *(_offset(k, word) for k, word in enumerate(_OFFSETS)), id="offset-fields", hidden=True),
        _select("label", "Category", tuple(PartLabel)),
        tag("div", id="shelves-fields"),
    ]
    about = (verdict, buttons, clash, group, tag("div", *fields, class_="fields"), _handles(), divide)
    body = tag("div", *about, id="about-part", hidden=True)
    return tag("section", pick, body, id="inspector", class_="panel", aria_label="The part that is chosen")


def _handles() -> Html:
    """Returns a button with a picture for each handle; grips have none, and stand in the list."""
    styles = tuple(open_handles(None))
    images = [tag("img", src=f"../../handle/{name}", width=84, height=62, alt=name, loading="lazy") for name in styles]
    buttons = (
        tag("button", image, type="button", title=name, data_handle=name, aria_pressed="false")
        for name, image in zip(styles, images, strict=True)
    )
    grid = tag("div", *buttons, class_="handles", role="group", aria_label="Handles")
    return tag("details", tag("summary", "Handles in pictures"), grid, class_="panel")


def _motion(word: str, name: str, class_: str) -> Html:
    return tag("button", name, type="button", class_=f"{class_} {word}", data_motion=word, aria_pressed="false")


def _whole() -> Html:
    fields = (
        _select("top", "Missing top", (*TOP_SHAPES, "none")),
        _select("hinge", "Hinges of doors", hinge_templates()),
        _select("handles", "Handles that are added", handle_styles()),
    )
    left_out = tag("div", id="left-out")
    return tag(
        "details", tag("summary", "The whole piece"), tag("div", *fields, class_="fields"), left_out, class_="panel"
    )


def _keys() -> Html:
    rows = joined(joined([tag("dt", key), tag("dd", what)]) for key, what in _KEYS)
    return tag("details", tag("summary", "Keys"), tag("dl", rows), class_="panel keys")


def _select(name: str, label: str, values: Sequence[str]) -> Html:
    options = [tag("option", "automatic", value=""), *(tag("option", value, value=value) for value in values)]
    return tag("label", f"{label} ", tag("select", *options, data_choice=name, autocomplete="off"))


def _offset(index: int, word: str) -> Html:
    field = tag("input", type="number", step="any", value="0", data_offset=index, autocomplete="off")
    return tag("label", f"{word} ", field, tag("span", "cm"))


def _number(name: str) -> Html:
    return tag("input", type="number", step="any", data_choice=name, autocomplete="off")
