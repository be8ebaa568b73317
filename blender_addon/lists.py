"""The sidebar's lists: one row per joint, added part, part of the input. They change nothing themselves."""

import bpy

LEVEL_ICONS = {"ok": "CHECKMARK", "warning": "ERROR", "error": "CANCEL"}
_NAMES = 0.62  # of a row
_LONG_NAMES = 0.6
_HALF = 0.5


class GRAFU_UL_joints(bpy.types.UIList):
    """One row per door and drawer."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index=0, flag=0):
        """Draws level, part (with a star if the user chose something) and mechanism."""
        row = layout.split(factor=_NAMES, align=True)
        row.label(text=item.part + (" *" if item.changed else ""), icon=LEVEL_ICONS[item.level])
        row.label(text=item.mechanism or "no joint")


class GRAFU_UL_additions(bpy.types.UIList):
    """One row per added part."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index=0, flag=0):
        """Draws the part with its switch."""
        row = layout.row(align=True)
        button = row.operator("grafu.set_addition", text="", icon="CHECKBOX_HLT" if item.accepted else "CHECKBOX_DEHLT")
        button.part, button.accepted = item.part, not item.accepted
        names = row.split(factor=_LONG_NAMES, align=True)
        names.active = item.accepted
        names.label(text=item.part)
        names.label(text=item.about.split(": ")[-1])  # the part's name states what it is


class GRAFU_UL_parts(bpy.types.UIList):
    """One row per part of the input."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index=0, flag=0):
        """Draws the part and its category, which a click corrects."""
        row = layout.split(factor=_HALF, align=True)
        row.label(text=item.part)
        row = row.row(align=True)
        button = row.operator("grafu.set_label", text=item.category)
        button.part, button.label = item.part, item.category
        row.operator("grafu.set_motion", text="", icon="CON_ROTLIMIT").part = item.part


CLASSES = (GRAFU_UL_joints, GRAFU_UL_additions, GRAFU_UL_parts)
