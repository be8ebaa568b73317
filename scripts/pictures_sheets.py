"""Contact sheets of models: as drawn, closed, half open, open, from behind and below; each hinge and rail close up.

    python scripts/pictures.py sheets INPUT ... --out FOLDER [--motion SOURCE]

Writes NAME.png for each input, and NAME_2.png and so on where it has more hinges and rails than one sheet holds. An
input is all that `grafu functionalize` reads; the text beside a picture is that of the report.
"""

import argparse
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from math import radians
from pathlib import Path

import numpy as np
from pictures_close_ups import ON_FIXED, ON_MOVING, SUPPORT, Device, close_up, devices_of
from PIL import Image, ImageDraw, ImageFont

import grafu
from grafu.articulation.articulated_object import ArticulatedObject, Visual
from grafu.articulation.collision_shapes import collision_shapes
from grafu.articulation.kinematics import with_coupled
from grafu.articulation.motion_kind import motion_kind
from grafu.articulation.open_together import open_together
from grafu.asset.edit import as_static_object
from grafu.export.output_names import output_name
from grafu.geometry.box import Box
from grafu.pipeline.words import Colour, hardware_in_words
from grafu.render.camera import three_quarter_view
from grafu.render.light import displayed
from grafu.render.picture import Picture, box_of, encode_png, posed_visuals, render

Line = tuple[str, str]  # a text and its colour

KEY = "close up, "
INK, GREY = "#262628", "#6a6a6e"
MARKS = {Colour.GREEN: "#1b7f3b", Colour.YELLOW: "#a66a00", Colour.RED: "#c0221b"}


@dataclass(frozen=True)
class SheetConfig:
    """The sizes of a sheet, pixels, and how many close-ups it holds."""

    tile: tuple[int, int] = (400, 300)
    columns: int = 4
    rows_of_text: int = 4
    """Below a close-up; its verdict is wrapped into what the first two leave."""
    close_ups: int = 12
    font: int = 14
    azimuth: float = radians(30)
    elevation: float = radians(18)

    @property
    def line(self) -> int:
        """The height of a line of text."""
        return round(1.35 * self.font)


@dataclass(frozen=True)
class Tile:
    """A picture with lines of text below."""

    picture: Picture
    lines: tuple[Line, ...]


def main(arguments: Sequence[str]) -> int:
    """Writes the sheets of all inputs; returns 1 if one could not be made."""
    options = parse_arguments(arguments)
    options.out.mkdir(parents=True, exist_ok=True)
    failed = 0
    for path in options.inputs:
        began = time.perf_counter()
        try:
            result = grafu.functionalize(path, motion=options.motion)
        except grafu.FunctionalizationError as error:
            print(f"{path}: {error}", file=sys.stderr, flush=True)
            failed = 1
            continue
        made = time.perf_counter()
        names = write_sheets(sheets_of(result), options.out, output_name(path))
        seconds = f"{made - began:.1f} s to functionalize, {time.perf_counter() - made:.1f} s for pictures"
        print(f"{', '.join(names)}: {seconds}", flush=True)
    return failed


def parse_arguments(arguments: Sequence[str]) -> argparse.Namespace:
    """Returns the options of the command line."""
    summary = (__doc__ or "").splitlines()[0]
    parser = argparse.ArgumentParser(prog="pictures.py sheets", description=summary)
    parser.add_argument(
        "inputs", nargs="+", type=Path, metavar="INPUT", help="a model, as grafu functionalize reads it"
    )
    parser.add_argument("--out", type=Path, required=True, help="the folder of the sheets")
    parser.add_argument("--motion", default="auto", help="where motions come from (default: auto)")
    options = parser.parse_args(arguments)
    names = [output_name(path) for path in options.inputs]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        parser.error(f"two inputs would write {twice[0]}.png: make their sheets in different folders")
    return options


def write_sheets(sheets: Sequence[Picture], folder: Path, name: str) -> list[str]:
    """Writes NAME.png, NAME_2.png and so on, and returns their names."""
    names = [f"{name}.png" if k == 0 else f"{name}_{k + 1}.png" for k in range(len(sheets))]
    for sheet, file in zip(sheets, names, strict=True):
        (folder / file).write_bytes(encode_png(sheet))
    return names


def sheets_of(result: grafu.Result, config: SheetConfig = SheetConfig()) -> list[Picture]:
    """Returns the contact sheets of a result: views and the first close-ups, then the other close-ups."""
    tiles = [close_up_tile(result, device, config) for device in devices_of(result.object)]
    pages = [tiles[k : k + config.close_ups] for k in range(0, max(len(tiles), 1), config.close_ups)]
    views, sheets = view_tiles(result, config), []
    for number, page in enumerate(pages, 1):
        title = f"{result.asset.name}, sheet {number} of {len(pages)}" if len(pages) > 1 else result.asset.name
        blocks = [_rows(page, config)] if page else []
        if number == 1:
            beside = config.tile[0] * (config.columns - 2), config.tile[1] + config.line
            below = np.hstack([_rows(views[4:], config, 2), panel(report_lines(result, title), beside, config)])
            blocks = [_rows(views[:4], config), below, *blocks]
        else:
            width = config.tile[0] * config.columns
            blocks = [panel([(title, INK)], (width, 2 * config.line), config), *blocks]
        sheets.append(np.vstack(blocks))
    return sheets


def view_tiles(result: grafu.Result, config: SheetConfig = SheetConfig()) -> list[Tile]:
    """Returns the whole model: as drawn, closed, half open, open, closed from behind, open from below."""
    made = result.object
    drawn, closed = posed_visuals(as_static_object(result.asset)), posed_visuals(made)
    half, opened = posed_visuals(made, half_open(made)), posed_visuals(made, wide_open(made))
    box = box_of([*drawn, *closed, *opened])
    front = (config.azimuth, config.elevation)
    views = [
        ("as drawn", drawn, box, front),
        ("closed", closed, box, front),
        ("half open", half, box, front),
        ("open", opened, box, front),
        ("closed, from behind", closed, box_of(closed), (config.azimuth + radians(180), config.elevation)),
        ("open, from below", opened, box_of(opened), (config.azimuth, radians(-35))),
    ]
    return [Tile(_seen(visuals, box, angles, config), ((text, INK),)) for text, visuals, box, angles in views]


def half_open(articulated: ArticulatedObject) -> dict[str, float]:
    """Returns every joint half open but for those that wait until others are fully open: they are closed."""
    free = articulated.free_joints
    return with_coupled(articulated, {j.id: j.limits.lower + (0.0 if j.after else 0.5 * j.limits.range) for j in free})


def wide_open(articulated: ArticulatedObject) -> dict[str, float]:
    """Returns every joint as far open as the others leave room, opened in the order in which they can."""
    return open_together(articulated, {link.id: collision_shapes(link) for link in articulated.links})


def close_up_tile(result: grafu.Result, device: Device, config: SheetConfig = SheetConfig()) -> Tile:
    """Returns a hinge or a rail close up, with what the report states of its joint."""
    found = close_up(result.object, device, config.tile)
    joint = result.joint(device.joint)
    hardware = hardware_in_words(joint.count, joint.template, joint.mechanism).replace("×", "x")  # the font has no ×
    opening = motion_kind(joint.type).worded(joint.opening)
    title = f"{joint.part}: {device.title}" + (" (see-through)" if found.is_through else "")
    return Tile(
        found.picture,
        ((title, INK), (f"{joint.type}, {hardware}, opens {opening}", GREY), _verdict_line(result, joint.part)),
    )


def report_lines(result: grafu.Result, title: str) -> list[Line]:
    """Returns what the report states of the whole model, and the key to the colours of close-ups."""
    verdict = result.report.verdict
    lines = [(title, INK), (f"motions: {result.report.motion.source}", GREY)]
    if verdict is not None:
        lines.append((f"{verdict.colour}: {verdict.sentence}", MARKS[verdict.colour]))
        lines += [(f"{f.part or 'the whole'}: {f.kind}, {f.why}", MARKS[f.colour]) for f in verdict.lines]
    lines += [(f"added: {added.part} ({added.style})", GREY) for added in result.added]
    lines += [
        (f"{KEY}on what is fixed", _hex(ON_FIXED)),
        (f"{KEY}on what moves", _hex(ON_MOVING)),
        (f"{KEY}supports", _hex(SUPPORT)),
    ]
    return lines


def panel(lines: Sequence[Line], size: tuple[int, int], config: SheetConfig) -> Picture:
    """Returns lines of text on white; those that do not fit are counted in the last line."""
    sheet = Image.new("RGBA", size, "white")
    draw, font = ImageDraw.Draw(sheet), ImageFont.load_default(size=config.font)
    room, width = max(size[1] // config.line - 1, 1), size[0] - 2 * config.font
    key = [line for line in lines if line[0].startswith(KEY)]
    rest = [(row, colour) for text, colour in lines if (text, colour) not in key for row in _wrapped(text, width, font)]
    if len(rest) + len(key) > room:
        kept = max(room - len(key) - 1, 1)
        rest = [*rest[:kept], (f"and {len(rest) - kept} more lines in the report", GREY)]
    for k, (text, colour) in enumerate([*rest, *key]):
        draw.text((config.font, config.line * (k + 0.5)), text, fill=colour, font=font)
    return np.array(sheet)


def _rows(tiles: Sequence[Tile], config: SheetConfig, columns: int = 0) -> Picture:
    """Returns tiles in rows from the left, their lines of text below each; the last is wrapped if there is room."""
    columns = columns or config.columns
    (width, height), most = config.tile, 1 if max(len(tile.lines) for tile in tiles) == 1 else config.rows_of_text
    step, rows = height + most * config.line, -(-len(tiles) // columns)
    sheet = Image.new("RGBA", (columns * width, rows * step), "white")
    draw, font = ImageDraw.Draw(sheet), ImageFont.load_default(size=config.font)
    for k, tile in enumerate(tiles):
        x, y = (k % columns) * width, (k // columns) * step
        sheet.alpha_composite(Image.fromarray(tile.picture), (x, y))
        draw.rectangle((x, y, x + width - 1, y + height - 1), outline="#d0d0d4")
        for row, (text, colour) in enumerate(_text_below(tile, width - config.font, most, font)):
            draw.text((x + config.font // 2, y + height + row * config.line), text, fill=colour, font=font)
    return np.array(sheet)


def _text_below(tile: Tile, width: float, most: int, font: ImageFont.FreeTypeFont) -> list[Line]:
    """Returns at most so many lines: each in one row, but the last is wrapped into the rows that are left."""
    *first, (text, colour) = tile.lines
    fitted = [(_fitted(line, width, font), ink) for line, ink in first]
    wrapped, room = _wrapped(text, width, font), most - len(first)
    if len(wrapped) > room:
        wrapped = [*wrapped[: room - 1], _fitted(" ".join(wrapped[room - 1 :]), width, font)]
    return [*fitted, *((row, colour) for row in wrapped)]


def _wrapped(text: str, width: float, font: ImageFont.FreeTypeFont) -> list[str]:
    """Returns a text in rows that fit; a word that is wider than a row is cut."""
    rows: list[str] = []
    for word in text.split():
        if rows and font.getlength(f"{rows[-1]} {word}") <= width:
            rows[-1] += f" {word}"
        else:
            rows.append(_fitted(word, width, font))
    return rows


def _fitted(text: str, width: float, font: ImageFont.FreeTypeFont) -> str:
    """Returns a text in one line, cut where it is wider than there is room."""
    if font.getlength(text) <= width:
        return text
    while text and font.getlength(f"{text} ...") > width:
        text = text[:-1]
    return f"{text.rstrip()} ..."


def _seen(visuals: list[Visual], box: Box, angles: tuple[float, float], config: SheetConfig) -> Picture:
    width, height = config.tile
    return render(visuals, three_quarter_view(box, width / height, *angles), config.tile)


def _verdict_line(result: grafu.Result, part: str) -> Line:
    verdict = result.report.verdict
    faults = [fault for fault in (verdict.lines if verdict else ()) if fault.part == part]
    if not faults:
        return "green: works", MARKS[Colour.GREEN]
    return f"{faults[0].colour}: " + "; ".join(f"{f.kind}, {f.why}" for f in faults), MARKS[faults[0].colour]


def _hex(colour: tuple[float, float, float]) -> str:
    return "#" + "".join(f"{value:02x}" for value in displayed(np.array(colour)))
