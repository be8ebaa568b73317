"""What the add-on keeps in a scene of each model: settings and report as JSON, its sources, and lists drawn from them.

All of it is saved with the file and undone with the objects that it goes with. Each model has a session; the one that
is shown is that of the active object, else the last one. The package is imported where it is first needed: enabling the
add-on takes no time.
"""

import json

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from . import objects

_LISTED = 8  # things that were left out, in the sidebar
LEVELS = [("ok", "ok", ""), ("warning", "warning", ""), ("error", "error", "")]
_shown: dict = {}  # by the scene's name, the slot that was shown last: a click on a lamp changes no panel


class GRAFU_Source(bpy.types.PropertyGroup):
    """One object that was handed over."""

    object: PointerProperty(type=bpy.types.Object)


class GRAFU_Joint(bpy.types.PropertyGroup):
    """One row of the overview."""

    part: StringProperty()
    joint: StringProperty()
    level: EnumProperty(items=LEVELS)
    why: StringProperty()
    type: StringProperty()
    mechanism: StringProperty()
    template: StringProperty()
    figures: StringProperty()
    changed: BoolProperty()
    front_changed: BoolProperty()
    motion_changed: BoolProperty()
    moves: StringProperty(description="How it moves: turns, slides, folds; empty: about no border of its own")
    side: StringProperty(description="The border that it turns about, the side that it slides to")
    inwards: BoolProperty()


class GRAFU_Addition(bpy.types.PropertyGroup):
    """A part that was added, or that was rejected."""

    part: StringProperty()
    about: StringProperty()
    accepted: BoolProperty(default=True)


class GRAFU_Part(bpy.types.PropertyGroup):
    """A part of the input and its category."""

    part: StringProperty()
    category: StringProperty()
    labelled_by: StringProperty()


def _chosen(session, context):
    joint = session.active_joint
    if joint is not None and not session.is_filling:
        objects.select_part(context, session, joint.part)


class GRAFU_Session(bpy.types.PropertyGroup):
    """All of one model; see the module."""

    collection: PointerProperty(type=bpy.types.Collection, description="The result")
    boxes: PointerProperty(type=bpy.types.Collection, description="Its compartments, where they are shown")
    source_file: StringProperty(description="The input, where it is a file and no objects")
    fixed: StringProperty(description="Why nothing can be changed; empty: all can")
    settings_json: StringProperty()
    report_json: StringProperty()
    interior_json: StringProperty()
    status: StringProperty()
    is_filling: BoolProperty(options={"SKIP_SAVE"})
    sources: CollectionProperty(type=GRAFU_Source)
    joints: CollectionProperty(type=GRAFU_Joint)
    additions: CollectionProperty(type=GRAFU_Addition)
    parts: CollectionProperty(type=GRAFU_Part)
    joint_index: IntProperty(update=_chosen)
    addition_index: IntProperty()
    part_index: IntProperty()
    left_out: StringProperty(description="What was to be added and was not, each with the reason")
    furnished: StringProperty(description="The compartments of which something was chosen")
    colours: BoolProperty()

    @property
    def active_joint(self):
        """The row that is chosen, or None."""
        return self.joints[self.joint_index] if 0 <= self.joint_index < len(self.joints) else None

    @property
    def has_result(self):
        """Whether something has been functionalized."""
        return bool(self.report_json)


def slots_in(scene) -> list:
    """Returns the sessions of a scene, also those that are free. The first is where a scene had its only one."""
    return [scene.grafu, *scene.grafu_more]


def session_of(context):
    """Returns the session that is shown: of the active object's model, else of the last; a free one without models."""
    return slots_in(context.scene)[shown_slot(context)]


def shown_slot(context) -> int:
    """Returns the place of the session that is shown among those of the scene."""
    scene = context.scene
    slots = slots_in(scene)
    active = context.view_layer.objects.active if context.view_layer else None
    found = slot_of(scene, active)
    if found is not None:
        _shown[scene.name_full] = found
        return found
    filled = [number for number, session in enumerate(slots) if session.has_result]
    usual = filled[-1] if filled else 0
    return next((k for k in (_shown.get(scene.name_full), scene.grafu_last) if k in filled), usual)


def slot_of(scene, thing):
    """Returns the place of the session to whose result, compartments or sources an object belongs, or None."""
    if thing is None:
        return None
    held = set(thing.users_collection)
    return next((k for k, session in enumerate(slots_in(scene)) if _owns(session, thing, held)), None)


def _owns(session, thing, held) -> bool:
    if not session.has_result:
        return False
    roots = [root for root in (session.collection, session.boxes) if root is not None]
    if any(held & {root, *root.children} for root in roots):
        return True
    return any(row.object == thing for row in session.sources)


def free_slot(scene) -> int:
    """Returns the place where another model's session goes."""
    slots = slots_in(scene)
    return next((number for number, session in enumerate(slots) if not session.has_result), len(slots))


def fill_slot(scene, slot: int):
    """Returns the session at a place, a new one where there is none yet, and lets it be shown."""
    while slot >= len(slots_in(scene)):
        scene.grafu_more.add()
    scene.grafu_last = _shown[scene.name_full] = slot
    return slots_in(scene)[slot]


def clear_slot(scene, slot: int) -> None:
    """Forgets a model."""
    _shown.pop(scene.name_full, None)
    if slot:
        scene.grafu_more.remove(slot - 1)
        return
    for name in GRAFU_Session.__annotations__:
        scene.grafu.property_unset(name)


def settings_of(session):
    """Returns the settings that the scene holds; the default ones before anything was chosen."""
    from grafu.pipeline.settings import Settings, settings_from_json

    return settings_from_json(json.loads(session.settings_json)) if session.settings_json else Settings()


def report_of(session):
    """Returns the report of the last run that stands, or None."""
    from grafu.pipeline.report_schema import Report

    return Report.read_json(session.report_json) if session.report_json else None


def compartments_of(session) -> list:
    """Returns the compartments of the last run, by number."""
    return json.loads(session.interior_json)["compartments"] if session.interior_json else []


def store(session, settings, report_json: str, interior_json: str, made) -> None:
    """Keeps what a run gave, and draws the lists from it; `made` is the articulated object."""
    session.settings_json = json.dumps(settings.to_json())
    session.report_json, session.interior_json = report_json, interior_json
    report = report_of(session)
    chosen = session.active_joint.part if session.active_joint else ""
    session.is_filling = True
    _fill_joints(session, settings, report, made)
    _fill_additions(session, settings, report)
    session.left_out = _left_out(report)
    session.parts.clear()
    for part in report.parts:
        row = session.parts.add()
        row.name = row.part = part.id
        row.category, row.labelled_by = part.category.value, part.labelled_by
    session.furnished = "\n".join(
        f"Compartment {number + 1}: {one.shelves} shelves, {one.dividers} dividers"
        for number, one in sorted(settings.additions.compartments.items())
    )
    session.joint_index = next((k for k, row in enumerate(session.joints) if row.part == chosen), 0)
    session.is_filling = False


def _left_out(report) -> str:
    """Returns what was to be added and was not, a line each; of many, how many more."""
    from grafu.pipeline.triage import left_out

    lines = left_out(report)
    more = [f"and {len(lines) - _LISTED} more: see report.json"] if len(lines) > _LISTED else []
    return "\n".join([*lines[:_LISTED], *more])


def _fill_joints(session, settings, report, made) -> None:
    from grafu.joints.plan import AUTOMATIC
    from grafu.pipeline.motion_choices import motions_of
    from grafu.pipeline.triage import Level, joint_states

    records, motions = {joint.part: joint for joint in report.joints}, motions_of(made)
    session.joints.clear()
    for state in joint_states(report):
        row = session.joints.add()
        row.name = row.part = state.part
        row.joint, row.level, row.why = state.joint, state.level.value, state.why
        row.changed = settings.joints.get(state.part, AUTOMATIC) != AUTOMATIC
        row.front_changed = state.part in settings.additions.fronts
        row.motion_changed = state.part in settings.motions
        motion = motions.get(state.part)
        if motion is not None:
            row.moves, row.side, row.inwards = motion.moves.value, motion.side.value, motion.inwards
        row.mechanism = "is static" if state.level is Level.OK else ""
        record = records.get(state.part)
        if record is not None:
            row.type, row.template = record.type.value, record.template
            row.mechanism = f"{record.count} x {record.template.replace('_', ' ')}"
            row.figures = (
                f"{record.mechanism.in_words}, on {record.mount}\n"
                f"collision {100 * record.collision_share:.0f} %, gap {1000 * record.largest_gap:.1f} mm"
            )


def _fill_additions(session, settings, report) -> None:
    session.additions.clear()
    rows = [(added.part, f"{added.category.value}: {added.style}", True) for added in report.additions]
    rows += [(name, "rejected", False) for name in sorted(settings.additions.rejected)]
    for name, about, accepted in rows:
        row = session.additions.add()
        row.name = row.part = name
        row.about, row.accepted = about, accepted


CLASSES = (GRAFU_Source, GRAFU_Joint, GRAFU_Addition, GRAFU_Part, GRAFU_Session)


def attach():
    """Gives every scene its sessions."""
    bpy.types.Scene.grafu = PointerProperty(type=GRAFU_Session)
    bpy.types.Scene.grafu_more = CollectionProperty(type=GRAFU_Session)
    bpy.types.Scene.grafu_last = IntProperty()
    for happened in _happenings():
        happened.append(_forget_shown)


def detach():
    """Takes them back; what scenes hold stays in them until they are saved without the add-on."""
    for name in ("grafu", "grafu_more", "grafu_last"):
        delattr(bpy.types.Scene, name)
    for happened in _happenings():
        happened.remove(_forget_shown)
    _shown.clear()


def _happenings() -> list:
    handlers = bpy.app.handlers
    return [handlers.undo_post, handlers.redo_post, handlers.load_post]


@bpy.app.handlers.persistent
def _forget_shown(*_):
    """Trusts what the scene holds: it is another one, or as it was before."""
    _shown.clear()
