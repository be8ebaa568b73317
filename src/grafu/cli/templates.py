"""The verb `templates`: lists the gallery, and writes each mechanism as an animated GLB with a contact sheet."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from grafu.templates.template import Gallery, HandleTemplate, HingeModel, RailModel

_DESCRIPTION = """\
Lists the hinges and rails that can be installed and the handles that can be added. With --out it writes each mechanism
as DIR/<id>.glb, which opens and closes, and DIR/templates.png, a page of pictures closed and open; and each handle as
DIR/handle_<id>.glb, and DIR/handles.png.
"""
_EXAMPLES = """\
examples:
  grafu templates
  grafu templates --out gallery
  grafu templates --templates my_hinges --out gallery
"""


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> argparse.ArgumentParser:
    """Adds the verb and returns its parser."""
    parser = verbs.add_parser(
        "templates", help="list and render hinges, rails and handles", description=_DESCRIPTION, epilog=_EXAMPLES
    )
    parser.add_argument("--out", type=Path, metavar="DIR", help="write GLB files and a contact sheet here")
    parser.add_argument("--templates", type=Path, metavar="DIR", help="a folder of your own, listed first")
    parser.add_argument("--overwrite", action="store_true", help="replace an earlier gallery in DIR")
    parser.set_defaults(run=run)
    return parser


def run(options: argparse.Namespace) -> int:
    """Lists the gallery and, with --out, writes it; returns 0.

    Raises:
        FunctionalizationError: if the user's templates are at fault or the output cannot be written.
    """
    from grafu.templates.gallery import open_gallery, open_handles

    gallery, handles = open_gallery(options.templates), open_handles(options.templates)
    _print_gallery(gallery)
    _print_handles(handles.values())
    if options.out is not None:
        from grafu.cli.verb import say
        from grafu.export.files import ExportFiles, write_files
        from grafu.render.gallery import gallery_files, handle_files

        contents = {**gallery_files(gallery).contents, **handle_files(list(handles.values())).contents}
        write_files(ExportFiles(contents), options.out, options.overwrite)
        say(f"written to {options.out}")
    return 0


def _print_gallery(gallery: "Gallery") -> None:
    from math import degrees

    from rich.markup import escape

    from grafu.cli.terminal import plain_table, wide_console

    table = plain_table("id", "title", "class", "natural size (mm)", "range")
    rows = [(m.id, m.title, m.mechanism.in_words, *_size_and_range(m)) for m in gallery.hinges]
    for cup in gallery.concealed:
        size = f"cup {cup.cup_diameter * 1000:.0f} wide, {cup.deepest * 1000:.1f} deep"
        rows.append((cup.id, cup.title, "concealed", size, f"{degrees(cup.range):.0f}°"))
    rows += [(m.id, m.title, m.mechanism.in_words, *_size_and_range(m)) for m in gallery.rails]
    for row in rows:
        table.add_row(*(escape(cell) for cell in row))
    wide_console().print(table)


def _print_handles(handles: "Iterable[HandleTemplate]") -> None:
    from rich.markup import escape

    from grafu.cli.terminal import plain_table, wide_console

    table = plain_table("id", "title", "family", "natural size (mm)", "longest (mm)")
    for handle in handles:
        size = f"{handle.natural.length * 1000:.0f} long, stands out {handle.natural.protrusion * 1000:.0f}"
        longest = f"{handle.longest * 1000:.0f}"
        table.add_row(*(escape(cell) for cell in (handle.id, handle.title, handle.family, size, longest)))
    wide_console().print(table)


def _size_and_range(model: "HingeModel | RailModel") -> tuple[str, str]:
    from math import degrees

    from grafu.templates.template import HingeModel

    if isinstance(model, HingeModel):
        size = f"{model.natural.length * 1000:.0f} long, leaves {model.natural.leaf * 1000:.0f}"
        return size, f"{degrees(model.build(model.natural).range):.0f}°"
    size = f"{model.natural.length * 1000:.0f} long, {model.natural.height * 1000:.0f} high"
    return size, f"{model.build(model.natural).range * 100:.0f} cm"
