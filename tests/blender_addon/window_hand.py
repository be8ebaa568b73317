"""A hand in Blender's window: it waits, moves the pointer, presses keys and calls operators as a user does.

It runs inside Blender, started with --enable-event-simulate. Scripts are generators: they yield the seconds to wait.
"""

import os
import shutil
import sys
import traceback
from pathlib import Path

import bpy

ROOT, FOLDER, SCREEN, *ARGUMENTS = sys.argv[sys.argv.index("--") + 1 :]
sys.path.insert(0, ROOT)
_TICK = 0.1
_SETTLES = 0.4  # seconds after which a press has been dealt with and drawn


class Hand:
    """Acts in the first window, over its 3D View."""

    def __init__(self) -> None:
        self.window = bpy.context.window_manager.windows[0]
        self.drawn: dict = {}  # how often each panel was drawn
        self.faults: list = []  # of panels and lists

    @property
    def area(self):
        """The 3D View."""
        return next(area for area in self.window.screen.areas if area.type == "VIEW_3D")

    def region(self, kind):
        """Returns a region of the 3D View: WINDOW or UI."""
        return next(region for region in self.area.regions if region.type == kind)

    def call(self, operator, *context, **arguments):
        """Calls an operator as a button does, over the view: it asks where it asks, and can be undone."""
        with bpy.context.temp_override(window=self.window, area=self.area, region=self.region("WINDOW")):
            return next(iter(operator(*(context or ("INVOKE_DEFAULT",)), True, **arguments)))

    def event(self, kind, value="NOTHING", at=None):
        """Sends an event; `at`: pixels from the window's lower left corner."""
        x, y = at or (self.area.x + self.area.width // 3, self.area.y + self.area.height // 2)
        self.window.event_simulate(type=kind, value=value, x=int(x), y=int(y))

    def press(self, key, at=None):
        """Presses a key or a button of the mouse and lets it go."""
        self.event("MOUSEMOVE", at=at)
        yield _TICK
        self.event(key, "PRESS", at)
        yield _TICK
        self.event(key, "RELEASE", at)
        yield _SETTLES

    def watch(self, panels, lists) -> None:
        """Notes what is drawn, and what goes wrong there."""
        for cls in panels:
            cls.draw = self._watched_panel(cls.__name__, cls.draw)
        for cls in lists:
            cls.draw_item = self._watched_list(cls.__name__, cls.draw_item)

    def watch_questions(self, operators) -> None:
        """Notes which dialogs are drawn, and what goes wrong there."""
        for cls in operators:
            if "draw" in vars(cls):
                cls.draw = self._watched_panel(cls.__name__, cls.draw)

    def _watched_panel(self, title, draw):
        def watched(panel, context):  # Blender counts a function's arguments
            self._note(title, draw, panel, context)

        return watched

    def _watched_list(self, title, draw):
        def watched(rows, context, layout, data, item, icon, active_data, active_property, index):
            self._note(title, draw, rows, context, layout, data, item, icon, active_data, active_property, index)

        return watched

    def _note(self, title, draw, *arguments):
        self.drawn[title] = self.drawn.get(title, 0) + 1
        try:
            draw(*arguments)
        except Exception:
            self.faults.append(f"{title}: {traceback.format_exc()}")

    def open_tab(self, first_panel):
        """Shows the sidebar, and clicks on its tabs until the one with a panel is shown."""
        self.area.spaces[0].show_region_ui = True
        yield _SETTLES
        sidebar = self.region("UI")
        right, top = sidebar.x + sidebar.width - 10, sidebar.y + sidebar.height
        for y in range(top - 20, sidebar.y, -20):
            yield from self.press("LEFTMOUSE", (right, y))
            if self.drawn.get(first_panel):
                return
        raise RuntimeError(f"no tab shows `{first_panel}`")

    def wait_while(self, condition, seconds=400.0):
        """Waits until something is over."""
        left = seconds
        while condition():
            left -= _TICK
            if left < 0.0:
                raise RuntimeError("it takes too long")
            yield _TICK

    def picture(self, name) -> None:
        """Keeps what the screen shows."""
        shutil.copy(SCREEN, Path(FOLDER, f"{name}.xwd"))


def play(script) -> None:
    """Lets a generator act, and ends Blender with it: exit code 1 where something went wrong."""
    bpy.context.preferences.view.show_splash = False

    def step():
        try:
            return next(script)
        except StopIteration:
            code = 0
        except BaseException:
            traceback.print_exc()
            code = 1
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)  # Blender's own end may hang

    bpy.app.timers.register(step, first_interval=1.0, persistent=True)
