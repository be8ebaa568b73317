"""What older Blenders do otherwise. The add-on is made for 4.2 to 5.0; Debian's 3.4 draws and runs it, too."""

from pathlib import Path

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


def own_folder(name: str) -> Path:
    """Returns a folder of the user's for what the add-on keeps, made where it is missing."""
    if __package__.startswith("bl_ext."):  # an extension, from 4.2 on
        return Path(bpy.utils.extension_path_user(__package__, path=name, create=True))
    return Path(bpy.utils.user_resource("DATAFILES", path=f"grafu/{name}", create=True))


def add_asset_library(name: str, folder: Path):
    """Has Blender list a folder among its asset libraries, copying what is used of it, and returns its entry."""
    libraries = bpy.context.preferences.filepaths.asset_libraries
    if hasattr(libraries, "new"):
        made = libraries.new(name=name, directory=str(folder))
    else:  # before 3.6 there was only the button's operator
        bpy.ops.preferences.asset_library_add(directory=str(folder))
        made = libraries[-1]
        made.name = name
    if hasattr(made, "import_method"):
        made.import_method = "APPEND"
    bpy.context.preferences.is_dirty = True
    return made


def remove_asset_library(entry) -> None:
    """Takes an entry out of Blender's asset libraries; its folder stays."""
    libraries = bpy.context.preferences.filepaths.asset_libraries
    if hasattr(libraries, "remove"):
        libraries.remove(entry)
    else:
        bpy.ops.preferences.asset_library_remove(index=list(libraries).index(entry))
    bpy.context.preferences.is_dirty = True
