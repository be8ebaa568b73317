"""Pictures of hinges, rails and handles in the dialogs: `grafu` draws them once a session, in a process of its own."""

import json
from pathlib import Path

import bpy
import bpy.utils.previews

from . import work

_TICK = 0.3  # seconds between looks at the process
_pictures = None  # Blender's own collection of them
_drawing = None  # the process that draws them
_is_tried = False


def icon_of(kind: str, template: str) -> int:
    """Returns Blender's number of the picture of a template (`hinge`, `rail`, `handle`; its id); 0: there is none."""
    key = f"{kind}-{template}"
    return _pictures[key].icon_id if _pictures is not None and key in _pictures else 0


def how_many() -> int:
    """Returns how many pictures there are: none until they are drawn."""
    return len(_pictures) if _pictures is not None else 0


def begin() -> None:
    """Has them drawn, behind the window, where that was not done yet."""
    global _drawing, _is_tried
    if bpy.app.background or _is_tried or _pictures is None:
        return
    _is_tried, _drawing = True, started()
    bpy.app.timers.register(_look, first_interval=_TICK, persistent=True)


def started():
    """Returns a process that draws all into its folder."""
    run = work.Command()
    run.start("grafu.render.thumbnails", [str(run.folder)])
    return run


def take(folder: Path) -> None:
    """Reads what such a process drew."""
    for entry in entries_in(folder):
        if entry["key"] not in _pictures:
            read = _pictures.load(entry["key"], str(folder / f"{entry['key']}.png"), "IMAGE")
            tuple(read.image_size), tuple(read.icon_size)  # else Blender reads the file later, when it is gone


def entries_in(folder: Path) -> list:
    """Returns what such a process states of each template: `key`, `kind`, `id`, `title`, `about`."""
    return json.loads((folder / "templates.json").read_text(encoding="utf-8"))["templates"]


def _look():
    global _drawing
    if _drawing is None or not _drawing.is_done:
        return _TICK if _drawing is not None else None
    try:
        _drawing.require_success()
        take(_drawing.folder)
    except (work.Failed, OSError):
        return None  # the dialogs have their names
    finally:
        _drawing.close()
        _drawing = None
    return None


def attach() -> None:
    """Makes room for them."""
    global _pictures
    _pictures = bpy.utils.previews.new()


def detach() -> None:
    """Stops what draws them, and forgets them."""
    global _pictures, _drawing, _is_tried
    if _drawing is not None:
        _drawing.close()
    bpy.utils.previews.remove(_pictures)
    _pictures, _drawing, _is_tried = None, None, False
