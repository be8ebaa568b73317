"""One joint, refined: hinges and rails as chosen, labels corrected. Each change is built again at once."""

from dataclasses import replace

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from . import thumbnails
from .questions import ask, chosen_or, draw_number, draw_part, draw_template, fill, own_switch, split
from .run_operators import Applies
from .state import report_of, session_of, settings_of

AUTO = "auto"
PIVOT = "pivot"
SUPPORTS = [
    (AUTO, "As needed", "The shortest block from a rail to whatever stands there"),
    ("slab", "Slabs", "A slab as large as the rail, out to the wall beside it"),
    ("divider", "Dividers", "An upright board along the rail, from what stands below to what stands above"),
    ("none", "None", "Rails stand only where they touch walls and drawer"),
]
_WIDEST = "The widest opening"
_LIMITED = "Your own widest opening; where it is not ticked, it opens as far as it goes"
_items: dict = {}


def class_items(operator, context):
    """Returns the classes of hinges and of rails for a menu: those of the joint that is asked about."""
    return _fitting("classes", _classes, operator, context)


def template_items(operator, context):
    """Returns hinges and rails for a menu: those of the joint and the class that are asked about."""
    return _fitting("templates", _templates, operator, context)


def _fitting(what, make, operator, context):
    """Returns a menu's items, each with a number of its own; Blender wants the texts kept."""
    slides = None
    if operator is not None and operator.asked and context is not None:
        slides = _slides(context, operator.part)
    only = operator.mechanism if what == "templates" and slides is not None else AUTO
    now = _template_now(context, operator.part) if what == "templates" and slides is not None else ""
    key = what, slides, only, now, thumbnails.how_many()
    if key not in _items:
        icon = thumbnails.icon_of("rail" if slides else "hinge", now)  # the picture of what it has
        usual = (AUTO, "Automatic", "What fits best", icon, 0)
        rows = [(row, number + 1) for number, row in enumerate(make())]
        kept = [
            (*texts, thumbnails.icon_of("rail" if rail else "hinge", texts[0]), number)
            for (rail, mechanism, *texts), number in rows
            if slides in (None, rail) and only in (AUTO, mechanism)
        ]
        _items[key] = [usual, *kept]
    return _items[key]


def _classes() -> list:
    """Returns rows: whether it is of rails, class, id, name, words."""
    from grafu.vocabulary import MECHANISM_MENU, RAIL_CLASSES

    rows = MECHANISM_MENU.items()
    return [(m in RAIL_CLASSES, m.value, m.value, m.in_words.capitalize().replace("-", " "), text) for m, text in rows]


def _templates() -> list:
    """Returns rows as `_classes` does."""
    from grafu.templates.gallery import builtin_gallery

    gallery = builtin_gallery()
    hinges = [(False, m.mechanism.value, m.id, f"{m.title} ({m.mechanism.in_words})", "") for m in gallery.hinges]
    rails = [(True, m.mechanism.value, m.id, m.title, "") for m in gallery.rails]
    concealed = [(False, "", m.id, m.title, "A cup in the door, an arm in the case") for m in gallery.concealed]
    return [*hinges, *concealed, *rails, (False, "", PIVOT, "Pivots", "Discs at the ends of the door")]


def _slides(context, part: str):
    """Returns whether a part slides; None: that is not known, for it has no joint."""
    from grafu.articulation.motion_kind import motion_kind
    from grafu.vocabulary import JointType

    row = session_of(context).joints.get(part)
    return motion_kind(JointType(row.type)).slides if row is not None and row.type else None


def _template_now(context, part: str) -> str:
    """Returns the id of the template that a joint has; empty: none."""
    row = session_of(context).joints.get(part)
    return row.template if row is not None else ""


def _class_chosen(operator, _):
    if not operator.template:  # it is of another class
        operator.template = AUTO


class GRAFU_OT_set_joint(Applies, bpy.types.Operator):
    """Builds one joint as chosen; what does not fit is not built, and everything stays as it was"""

    bl_idname = "grafu.set_joint"
    bl_label = "Refine joint"

    part: StringProperty(name="Part", options={"HIDDEN", "SKIP_SAVE"})
    asked: BoolProperty(options={"HIDDEN", "SKIP_SAVE"})
    mechanism: EnumProperty(name="Class", items=class_items, update=_class_chosen, options={"SKIP_SAVE"})
    template: EnumProperty(name="Template", items=template_items, options={"SKIP_SAVE"})
    scale: FloatProperty(name="Scale", default=1.0, min=0.25, max=4.0, options={"SKIP_SAVE"})
    count: IntProperty(
        name="Hinges", description="0: by the door's height", default=0, min=0, max=12, options={"SKIP_SAVE"}
    )
    own_count: own_switch()
    flipped: BoolProperty(name="Other side", description="Hang the door on its opposite border", options={"SKIP_SAVE"})
    opening: FloatProperty(
        name="Opens by",
        description="Radians or metres at most; 0: as far as it goes",
        default=0.0,
        min=0.0,
        options={"HIDDEN", "SKIP_SAVE"},
    )
    limited: BoolProperty(name="Custom", description=_LIMITED, options={"HIDDEN", "SKIP_SAVE"})
    angle: FloatProperty(name="Opens by", description=_WIDEST, min=0.0, subtype="ANGLE", options={"SKIP_SAVE"})
    travel: FloatProperty(name="Opens by", description=_WIDEST, min=0.0, subtype="DISTANCE", options={"SKIP_SAVE"})
    mount: StringProperty(
        name="Mount", description="The part that must carry it; empty: what suits", options={"SKIP_SAVE"}
    )
    supports: EnumProperty(name="Supports", items=SUPPORTS, options={"SKIP_SAVE"})

    def invoke(self, context, event):
        """Asks, with what holds now filled in."""
        session = session_of(context)
        row = session.active_joint
        self.part, self.asked = self.part or (row.part if row else ""), True
        built = next((joint for joint in report_of(session).joints if joint.part == self.part), None)
        choice = settings_of(session).joints.get(self.part)
        if choice is not None:
            self.mechanism = choice.mechanism.value if choice.mechanism else AUTO
            self.template = choice.template or AUTO
            self.scale, self.flipped, self.mount = choice.scale, choice.flipped, choice.mount
            self.supports = choice.supports.value
        opening = choice.opening if choice is not None else None
        fill(self, "count", choice.count if choice is not None else 0, built.count if built else 2)
        self.limited = opening is not None
        self.angle = self.travel = opening or (built.upper if built else 0.0)
        return ask(self, context)

    def draw(self, context):
        """Draws what matters for such a joint."""
        layout, slides = split(self), _slides(context, self.part)
        draw_part(layout, self.part)
        layout.prop(self, "mechanism")
        draw_template(layout, self, "template")
        if slides is not True:
            layout.prop(self, "scale")
            draw_number(layout, self, "count", "Hinges")
            layout.prop(self, "flipped")
        if slides is not False:
            layout.prop(self, "supports")
        draw_number(layout, self, "travel" if slides else "angle", "Opens by", "limited")
        layout.prop_search(self, "mount", session_of(context), "parts", text="Carried by")

    def unfit(self, before, after):
        """What stood and is lost, and the joint itself where it is not built as chosen."""
        from grafu.pipeline.triage import lost, not_built

        return (*lost(before, after, besides=(self.part,)), *not_built(after, self.part))

    def changed(self, context, settings):
        """Returns the settings with the choice."""
        from grafu.joints.plan import JointChoice, Supports
        from grafu.vocabulary import MechanismClass

        opening = self.opening
        if self.asked:
            opening = (self.travel if _slides(context, self.part) else self.angle) if self.limited else 0.0

        return settings.with_joint(
            self.part,
            JointChoice(
                mechanism=None if self.mechanism == AUTO else MechanismClass(self.mechanism),
                template="" if self.template == AUTO else self.template,
                scale=round(self.scale, 6),  # Blender keeps single precision
                count=chosen_or(self, "count", 0),
                flipped=self.flipped,
                opening=round(opening, 6) or None,
                mount=self.mount,
                supports=Supports(self.supports),
            ),
        )


class GRAFU_OT_reset_joint(Applies, bpy.types.Operator):
    """Leaves one joint to the search again"""

    bl_idname = "grafu.reset_joint"
    bl_label = "Automatic again"

    part: StringProperty(name="Part", options={"HIDDEN", "SKIP_SAVE"})

    def changed(self, context, settings):
        """Returns the settings without a choice for the joint."""
        from grafu.joints.plan import AUTOMATIC

        return settings.with_joint(self.part, AUTOMATIC)


def label_items(_, __):
    """Returns all categories for a menu."""
    if "labels" not in _items:
        from grafu.vocabulary import PartLabel

        _items["labels"] = [(label.value, label.value, "") for label in PartLabel]
    return _items["labels"]


class GRAFU_OT_set_label(Applies, bpy.types.Operator):
    """Corrects what a part is, and runs again from there: joints come and go with it"""

    bl_idname = "grafu.set_label"
    bl_label = "Correct category"

    part: StringProperty(name="Part", options={"HIDDEN", "SKIP_SAVE"})
    label: EnumProperty(name="Category", items=label_items, options={"SKIP_SAVE"})
    as_read: BoolProperty(name="As read", description="Take the correction back", options={"SKIP_SAVE"})

    def invoke(self, context, event):
        """Asks."""
        return ask(self, context)

    def draw(self, context):
        """Draws the question."""
        layout = split(self)
        draw_part(layout, self.part)
        layout.prop(self, "as_read")
        if not self.as_read:
            layout.prop(self, "label")

    def changed(self, context, settings):
        """Returns the settings with the part's category."""
        from grafu.vocabulary import PartLabel

        if self.as_read:
            return replace(settings, labels={k: v for k, v in settings.labels.items() if k != self.part})
        return settings.with_label(self.part, PartLabel(self.label))

    def unfit(self, before, after):
        """Nothing: what a part is decides whether it moves."""
        return ()


CLASSES = (GRAFU_OT_set_joint, GRAFU_OT_reset_joint, GRAFU_OT_set_label)
