"""How a part moves, said by hand: it turns, slides, folds, or is static, whatever was read or predicted."""

import bpy
from bpy.props import BoolProperty, EnumProperty, StringProperty

from .objects import ID
from .run_operators import Applies
from .state import session_of, settings_of

TURNS, SLIDES, FOLDS = "turns", "slides", "folds"
TILTS, LIFTS, FIXED = "tilts", "lifts", "fixed"
MOVES = [
    (TURNS, "Turns", "A door, flap or lid: it turns about the border that is chosen"),
    (SLIDES, "Slides", "A drawer, or a sliding door: it slides to the side that is chosen"),
    (FOLDS, "Folds", "One of two leaves of a folding door: it folds to the left, to the right or up with the other"),
    (TILTS, "Tilts", "A front with a bin behind it, as of a shoe cabinet: about its lower border, and not far"),
    (LIFTS, "Lifts", "A flap that arms lift upright, where they find room; else it turns about its upper border"),
    (FIXED, "Fixed", "It is no door and no drawer: it gets no joint"),
]
USUAL = "usual"
SIDES = [
    (USUAL, "As usual", "Slides to the front; what turns needs a border, what folds a side"),
    ("left", "Left", "As you stand before it"),
    ("right", "Right", "As you stand before it"),
    ("top", "Top", "The upper border"),
    ("bottom", "Bottom", "The lower border: a flap"),
    ("front", "Front", "Towards you"),
    ("back", "Back", "Away from you: the border of a lid"),
]


def chosen_part(context) -> str:
    """Returns the part to ask about: what is the active object's, else the chosen row's."""
    session, active = session_of(context), context.active_object
    name = active.get(ID, "") if active is not None else ""
    if session.parts.get(name) is not None:
        return name
    row = session.active_joint
    return row.part if row else ""


class GRAFU_OT_set_motion(Applies, bpy.types.Operator):
    """Says how a part moves, or that it does not; what cannot be built changes nothing"""

    bl_idname = "grafu.set_motion"
    bl_label = "Motion"

    part: StringProperty(name="Part", description="Empty: that of the active object", options={"SKIP_SAVE"})
    moves: EnumProperty(name="Moves", items=MOVES, options={"SKIP_SAVE"})
    side: EnumProperty(name="Side", items=SIDES, options={"SKIP_SAVE"})
    inwards: BoolProperty(name="Inwards", description="It opens to the inside of the furniture", options={"SKIP_SAVE"})

    def invoke(self, context, event):
        """Asks, with what was chosen filled in, else with how the part moves now."""
        self.part = self.part or chosen_part(context)
        session = session_of(context)
        choice, row = settings_of(session).motions.get(self.part), session.joints.get(self.part)
        if choice is not None:
            self.moves, self.inwards = choice.moves.value, choice.inwards
            self.side = choice.side.value if choice.side else USUAL
        elif row is not None and row.moves:
            self.moves, self.side, self.inwards = row.moves, row.side, row.inwards
        return context.window_manager.invoke_props_dialog(self)

    def draw(self, context):
        """Draws what matters for such a motion."""
        layout = self.layout
        layout.use_property_split = True
        layout.prop_search(self, "part", session_of(context), "parts")
        layout.prop(self, "moves")
        if self.moves not in (FIXED, TILTS, LIFTS):
            layout.prop(self, "side", text="Border" if self.moves == TURNS else "To the")
        if self.moves == TURNS:
            layout.prop(self, "inwards")
            if self.side == USUAL:
                layout.label(text="Choose the border that it turns about", icon="INFO")

    def changed(self, context, settings):
        """Returns the settings with the motion."""
        from grafu.joints.motion_choice import MotionChoice, Moves, Side

        self.part = self.part or chosen_part(context)
        if not self.part:
            raise ValueError("choose a part: select its object")
        if self.moves == TURNS and self.side == USUAL:
            raise ValueError(f"choose the border that `{self.part}` turns about")
        if self.moves == FOLDS and self.side not in ("left", "right", "top"):
            raise ValueError(f"choose the side that `{self.part}` folds to: left, right or top")
        side = None if self.side == USUAL or self.moves == FIXED else Side(self.side)
        side = {TILTS: Side.BOTTOM, LIFTS: Side.TOP}.get(self.moves, side)
        choice = MotionChoice(Moves(self.moves), side, self.inwards and self.moves == TURNS)
        return settings.with_motion(self.part, choice)

    def unfit(self, before, after):
        """What else stood and is lost, and what was stated and is not built."""
        from grafu.pipeline.triage import lost, not_built

        others = lost(before, after, besides=(self.part,))
        return others if self.moves == FIXED else (*others, *not_built(after, self.part))


class GRAFU_OT_reset_motion(Applies, bpy.types.Operator):
    """Uses the motion of the input, the network or the rule again"""

    bl_idname = "grafu.reset_motion"
    bl_label = "Motion as found"

    part: StringProperty(name="Part", options={"HIDDEN", "SKIP_SAVE"})

    def changed(self, context, settings):
        """Returns the settings without a motion for the part."""
        return settings.with_motion(self.part, None)

    def unfit(self, before, after):
        """What else stood and is lost."""
        from grafu.pipeline.triage import lost

        return lost(before, after, besides=(self.part,))


CLASSES = (GRAFU_OT_set_motion, GRAFU_OT_reset_motion)
