"""The sidebar's lists: one row per joint, added part, part of the input. They change nothing themselves."""

import bpy

from .texts import factor_for_names, fitted

LEVEL_ICONS = {"ok": "CHECKMARK", "warning": "ERROR", "error": "CANCEL"}
ICON = 20.0  # pixels that the icon before a name takes
BUTTONS = 46.0  # pixels that the two buttons beside a part need, without words
_WORD = 50.0  # pixels from which on a category is readable on its button


class GRAFU_UL_joints(bpy.types.UIList):
    """One row per door and drawer."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index=0, flag=0):
        """Draws level, part (with a star if the user chose something) and mechanism."""
        names = (_starred(one) for one in data.joints)
        row = layout.split(factor=factor_for_names(context, names, ICON), align=True)
        row.label(text=fitted(context, _starred(item), ICON), icon=LEVEL_ICONS[item.level])
        row.label(text=item.mechanism or "no joint")


class GRAFU_UL_additions(bpy.types.UIList):
    """One row per added part."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index=0, flag=0):
        """Draws the part with its switch."""
        row = layout.row(align=True)
        button = row.operator("grafu.set_addition", text="", icon="CHECKBOX_HLT" if item.accepted else "CHECKBOX_DEHLT")
        button.part, button.accepted = item.part, not item.accepted
        added = (one.part for one in data.additions)
        names = row.split(factor=factor_for_names(context, added, ICON), align=True)
        names.active = item.accepted
        names.label(text=fitted(context, item.part, ICON))
        names.label(text=item.about.split(": ")[-1])  # the part's name states what it is


class GRAFU_UL_parts(bpy.types.UIList):
    """One row per part of the input."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index=0, flag=0):
        """Draws the part and its category, which a click corrects."""
        names = [one.part for one in data.parts]
        row = layout.split(factor=factor_for_names(context, names, rest=BUTTONS), align=True)
        has_word = factor_for_names(context, names) == factor_for_names(context, names, rest=BUTTONS + _WORD)
        row.label(text=fitted(context, item.part, rest=BUTTONS))
        row = row.row(align=True)
        word = {"text": item.category} if has_word else {"text": "", "icon": "GREASEPENCIL"}
        button = row.operator("grafu.set_label", **word)
        button.part, button.label = item.part, item.category
        row.operator("grafu.set_motion", text="", icon="CON_ROTLIMIT").part = item.part


def _starred(joint) -> str:
    return joint.part + (" *" if joint.changed else "")


CLASSES = (GRAFU_UL_joints, GRAFU_UL_additions, GRAFU_UL_parts)
