"""How questions are drawn: a number that may be left to the package stands behind a switch, in words while it is."""

from bpy.props import BoolProperty


def own_switch():
    """Returns the property that states whether a number is chosen; it is where the user was not asked."""
    return BoolProperty(
        name="Chosen",
        description="Whether you choose it; off: automatic",
        default=True,
        options={"HIDDEN", "SKIP_SAVE"},
    )


def chosen_or(operator, name: str, usual):
    """Returns a number if it is chosen, rounded (Blender keeps single precision); else `usual`."""
    return round(getattr(operator, name), 6) if getattr(operator, f"own_{name}") else usual


def fill(operator, name: str, chosen, usual) -> None:
    """Fills a question's number in with what is chosen, else with `usual` (None, 0: nothing is)."""
    setattr(operator, f"own_{name}", bool(chosen))
    setattr(operator, name, chosen or usual)


def draw_number(layout, operator, name: str, text: str, switch: str = "", usual: str = "automatic") -> None:
    """Draws a number behind the switch `own_NAME`, or `switch`; where it is off, the word for what is `usual`."""
    switch = switch or f"own_{name}"
    row = layout.row(heading=text, align=True)
    row.prop(operator, switch, text="")
    if getattr(operator, switch):
        row.prop(operator, name, text="")
    else:
        row.label(text=usual)


def draw_part(layout, part: str) -> None:
    """Draws which part is asked about."""
    layout.label(text=part or "no part is chosen", icon="OBJECT_DATA")


def ask(operator, context):
    """Opens the dialog."""
    return context.window_manager.invoke_props_dialog(operator)


def split(operator):
    """Returns a dialog's layout with names on the left and what is chosen on the right."""
    layout = operator.layout
    layout.use_property_split, layout.use_property_decorate = True, False
    return layout
