"""What the add-on keeps in a scene: settings and report as JSON, the source objects, and lists drawn from them.

All of it is saved with the file and undone with the objects that it goes with. The package is imported where it is
first needed: enabling the add-on takes no time.
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

KIND, ID = "grafu", "id"
LEVELS = [("ok", "ok", ""), ("warning", "warning", ""), ("error", "error", "")]


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
        from . import objects

        objects.select_part(context, joint.part)


class GRAFU_Session(bpy.types.PropertyGroup):
    """All of it; see the module."""

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
    colours: BoolProperty()

    @property
    def active_joint(self):
        """The row that is chosen, or None."""
        return self.joints[self.joint_index] if 0 <= self.joint_index < len(self.joints) else None

    @property
    def has_result(self):
        """Whether something has been functionalized."""
        return bool(self.report_json)


def session_of(context):
    """Returns the scene's session."""
    return context.scene.grafu


def settings_of(session):
    """Returns the settings that the scene holds; the default ones before anything was chosen."""
    from grafu.pipeline.settings import Settings, settings_from_json

    return settings_from_json(json.loads(session.settings_json)) if session.settings_json else Settings()


def report_of(session):
    """Returns the report of the last run that stands, or None."""
    from grafu.pipeline.report_schema import Report

    return Report.model_validate_json(session.report_json) if session.report_json else None


def compartments_of(session) -> list:
    """Returns the compartments of the last run, by number."""
    return json.loads(session.interior_json)["compartments"] if session.interior_json else []


def store(session, settings, report_json: str, interior_json: str, unit: float) -> None:
    """Keeps what a run gave, and draws the lists from it."""
    session.settings_json = json.dumps(settings.to_json())
    session.report_json, session.interior_json = report_json, interior_json
    report = report_of(session)
    chosen = session.active_joint.part if session.active_joint else ""
    session.is_filling = True
    _fill_joints(session, settings, report, unit)
    _fill_additions(session, settings, report)
    session.parts.clear()
    for part in report.parts:
        row = session.parts.add()
        row.name = row.part = part.id
        row.category, row.labelled_by = part.category.value, part.labelled_by
    session.joint_index = next((k for k, row in enumerate(session.joints) if row.part == chosen), 0)
    session.is_filling = False


def _fill_joints(session, settings, report, unit) -> None:
    from grafu.pipeline.triage import joint_states
    from grafu.realization.plan import AUTOMATIC

    records = {joint.part: joint for joint in report.joints}
    session.joints.clear()
    for state in joint_states(report, unit):
        row = session.joints.add()
        row.name = row.part = state.part
        row.joint, row.level, row.why = state.joint, state.level.value, state.why
        row.changed = settings.joints.get(state.part, AUTOMATIC) != AUTOMATIC
        record = records.get(state.part)
        if record is not None:
            row.type, row.template = record.type.value, record.template
            row.mechanism = f"{record.count} x {record.template} ({record.mechanism.value})"
            row.figures = (
                f"collision {100 * record.collision_share:.0f} %, gap {1000 * record.largest_gap:.1f} mm, "
                f"on {record.mount}"
            )


def _fill_additions(session, settings, report) -> None:
    session.additions.clear()
    rows = [(added.part, f"{added.category.value}: {added.style}", True) for added in report.added]
    rows += [(name, "rejected", False) for name in sorted(settings.additions.rejected)]
    for name, about, accepted in rows:
        row = session.additions.add()
        row.name = row.part = name
        row.about, row.accepted = about, accepted


CLASSES = (GRAFU_Source, GRAFU_Joint, GRAFU_Addition, GRAFU_Part, GRAFU_Session)


def attach():
    """Gives every scene its session."""
    bpy.types.Scene.grafu = PointerProperty(type=GRAFU_Session)


def detach():
    """Takes it back; what scenes hold stays in them until they are saved without the add-on."""
    del bpy.types.Scene.grafu
