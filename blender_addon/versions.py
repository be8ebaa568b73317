"""What older Blenders do otherwise. The add-on is made for 4.2 to 5.0; Debian's 3.4 draws and runs it, too."""

import bpy


def draw_progress(layout, ratio: float, text: str) -> None:
    """Draws how far a run is, 0..1; before 4.0 in words."""
    if bpy.app.version >= (4, 0):
        layout.progress(factor=ratio, text=text)
    else:
        layout.label(text=f"{round(100 * ratio)} %  {text}", icon="TIME")


def line_shader():
    """Returns Blender's shader of lines of any width, in one colour; before 4.0 it had another name."""
    import gpu

    name = "POLYLINE_UNIFORM_COLOR"
    return gpu.shader.from_builtin(name if bpy.app.version >= (4, 0) else f"3D_{name}")
