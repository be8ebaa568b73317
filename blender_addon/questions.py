"""How questions are drawn: a number that the package computes has a box `Custom`, and stands beside it once ticked."""

from bpy.props import BoolProperty

from . import thumbnails

_ACROSS = 5.0  # of a picture, in rows of a dialog


def own_switch():
    """Returns the property that states whether a number is chosen; it is where the user was not asked."""
    return BoolProperty(
        name="Custom",
        description="Your own number; where it is not ticked, it is computed",
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


def draw_number(layout, operator, name: str, text: str, switch: str = "") -> None:
    """Draws the box `Custom`, `own_NAME` or `switch`, and beside it the number where it is ticked."""
    switch = switch or f"own_{name}"
    row = layout.row(heading=text, align=True)
    row.prop(operator, switch, text="Custom")
    if getattr(operator, switch):
        row.prop(operator, name, text="")


def draw_part(layout, part: str) -> None:
    """Draws which part is asked about."""
    layout.label(text=part or "no part is chosen", icon="OBJECT_DATA")


def draw_template(layout, operator, name: str) -> None:
    """Draws a choice of templates: their names and, as soon as they are drawn, their pictures; a click shows all."""
    layout.prop(operator, name)
    if thumbnails.how_many():
        layout.template_icon_view(operator, name, show_labels=True, scale=_ACROSS, scale_popup=_ACROSS)


def ask(operator, context):
    """Opens the dialog."""
    thumbnails.begin()
    return context.window_manager.invoke_props_dialog(operator)


def split(operator):
    """Returns a dialog's layout with names on the left and what is chosen on the right."""
    layout = operator.layout
    layout.use_property_split, layout.use_property_decorate = True, False
    return layout
