"""GraFu in Blender's sidebar: furniture that only looks right is made to work, and each joint is refined.

The add-on holds no geometry: it hands the selected objects to the package `grafu` in a process of its own, and shows
what comes back.
"""

bl_info = {  # for Blenders that know no manifest
    "name": "GraFu",
    "author": "The grafu authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > GraFu",
    "description": "Makes furniture work: hinges, rails, handles, tops, interiors",
    "category": "Animation",
}

_MODULES = (
    "state",
    "run_operators",
    "joint_operators",
    "motion_operators",
    "addition_operators",
    "interior_operators",
    "view_operators",
    "output_operators",
    "lists",
    "model_operators",
    "asset_operators",
    "drag_operators",
    "gizmos",
    "panels",
)


def register():
    """Registers all classes, each module's in its order, and gives every scene its session."""
    import bpy

    from . import overlay, state, thumbnails

    for one in _classes():
        bpy.utils.register_class(one)
    state.attach()
    overlay.attach()
    thumbnails.attach()


def unregister():
    """Stops what goes on, and takes everything back in the opposite order."""
    import bpy

    from . import overlay, run_operators, state, thumbnails, work

    run_operators.stop()
    work.end()
    thumbnails.detach()
    overlay.detach()
    state.detach()
    for one in reversed(_classes()):
        bpy.utils.unregister_class(one)


def _classes():
    from importlib import import_module

    return [one for name in _MODULES for one in import_module(f".{name}", __package__).CLASSES]
